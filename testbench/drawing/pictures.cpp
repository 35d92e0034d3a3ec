#include "testbench/drawing/pictures.h"

#include <fmt/format.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

void append(void* context, void* data, int size) {
  static_cast<std::string*>(context)->append(static_cast<const char*>(data),
                                             static_cast<std::size_t>(size));
}

std::size_t pixels(int width, int height) {
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
}

}  // namespace

Picture::Picture(int width_, int height_, int channels_, const std::uint8_t* color)
    : width(width_), height(height_), channels(channels_) {
  const auto size = static_cast<std::size_t>(channels);
  if (channels == 1) {
    bytes.assign(pixels(width, height), *color);
    return;
  }
  bytes.resize(pixels(width, height) * size);
  for (std::size_t i = 0; i < bytes.size(); i += size) std::copy(color, color + size, &bytes[i]);
}

Picture picture_of(const Framebuffer& framebuffer, int width, int height, int channels) {
  const auto bytes_of = [](std::uint32_t color) {
    return std::array<std::uint8_t, 3>{static_cast<std::uint8_t>(color),
                                       static_cast<std::uint8_t>(color >> 8),
                                       static_cast<std::uint8_t>(color >> 16)};
  };
  Picture picture(width, height, channels, bytes_of(framebuffer.background()).data());
  framebuffer.for_each_covered([&](std::size_t index, std::uint32_t color) {
    const auto bytes = bytes_of(color);
    std::copy(bytes.data(), bytes.data() + channels, picture.pixel(index));
  });
  return picture;
}

std::vector<Color> in_lsb(const std::vector<std::uint32_t>& colors, int channels) {
  std::vector<Color> result;
  result.reserve(colors.size());
  for (const std::uint32_t color : colors) {
    const auto channel = [&](int c) { return static_cast<double>(color >> (8 * c) & 0xff); };
    result.push_back(channels == 1 ? Color(Color::Constant(channel(0)))
                                   : Color(channel(0), channel(1), channel(2)));
  }
  return result;
}

Picture picture_of(const std::vector<Color>& colors, int width, int height, int channels) {
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.channels = channels;
  picture.bytes.reserve(colors.size() * static_cast<std::size_t>(channels));
  for (const Color& color : colors) {
    for (int c = 0; c < channels; ++c) {
      picture.bytes.push_back(static_cast<std::uint8_t>(std::lround(color[c])));
    }
  }
  return picture;
}

Rgb error_color(double error) {
  using Stop = std::array<double, 3>;
  constexpr std::array<Stop, 5> kStops = {Stop{0, 0, 0}, Stop{40, 40, 160}, Stop{190, 40, 80},
                                          Stop{250, 180, 40}, Stop{255, 255, 255}};
  const double at = std::min(error / kErrorMapTop, 1.0) * (kStops.size() - 1);
  const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const double weight = at - static_cast<double>(stop);
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double value = kStops[stop][c] * (1 - weight) + kStops[stop + 1][c] * weight;
    // Not below 0; std::lround costs as much as all the rest.
    color[c] = static_cast<std::uint8_t>(value + 0.5);  // NOLINT(bugprone-incorrect-roundings)
  }
  return color;
}

std::string png(const Picture& picture) {
  // Differences to the row above; trying every filter on each row takes longer than compressing.
  constexpr int kUp = 2;
  stbi_write_force_png_filter = kUp;
  std::string bytes;
  bytes.reserve(picture.bytes.size() / 4);
  stbi_write_png_to_func(append, &bytes, picture.width, picture.height, picture.channels,
                         picture.bytes.data(), picture.width * picture.channels);
  return bytes;
}

void write_png(const std::filesystem::path& file, const Picture& picture) {
  write_text(file, png(picture));
}

void write_pfm(const std::filesystem::path& file, const std::vector<Color>& colors, int width,
               int height) {
  std::string bytes = fmt::format("PF\n{} {}\n-1.0\n", width, height);
  bytes.reserve(bytes.size() + pixels(width, height) * 3 * sizeof(float));
  for (int y = height; y-- > 0;) {
    const Color* row = colors.data() + pixels(width, y);
    for (int x = 0; x < width; ++x) {
      const Eigen::Array3f rgb = row[x].cast<float>();
      bytes.append(reinterpret_cast<const char*>(rgb.data()), 3 * sizeof(float));
    }
  }
  write_text(file, bytes);
}

}  // namespace phongpipe
