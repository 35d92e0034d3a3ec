#include "testbench/drawing/pictures.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "model/scene/tool_error.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

// Places in the palette of error maps.
constexpr std::uint8_t kUncoveredLevel = 255;
constexpr double kLargestLevel = kUncoveredLevel - 1;

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

Rgb Picture::color(std::size_t index) const {
  const std::uint8_t* const first = bytes.data() + index * static_cast<std::size_t>(channels);
  if (!palette.empty()) return palette[*first];
  return channels == 1 ? Rgb{*first, *first, *first} : Rgb{first[0], first[1], first[2]};
}

Picture error_map(int width, int height) {
  using Stop = std::array<double, 3>;
  constexpr Rgb kUncovered = {12, 40, 24};
  constexpr std::array<Stop, 5> kStops = {Stop{0, 0, 0}, Stop{40, 40, 160}, Stop{190, 40, 80},
                                          Stop{250, 180, 40}, Stop{255, 255, 255}};
  Picture picture(width, height, 1, &kUncoveredLevel);
  picture.palette.assign(kUncoveredLevel + 1, kUncovered);
  for (std::size_t level = 0; level < kUncoveredLevel; ++level) {
    const double at = static_cast<double>(level * (kStops.size() - 1)) / kLargestLevel;
    const auto stop = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
    const double weight = at - static_cast<double>(stop);
    for (std::size_t c = 0; c < 3; ++c) {
      picture.palette[level][c] = static_cast<std::uint8_t>(
          std::lround(kStops[stop][c] * (1 - weight) + kStops[stop + 1][c] * weight));
    }
  }
  return picture;
}

std::uint8_t error_level(double error_lsb) {
  const double level = std::min(error_lsb / kErrorMapTop, 1.0) * kLargestLevel;
  // Not below 0; std::lround costs as much as all the rest.
  return static_cast<std::uint8_t>(level + 0.5);  // NOLINT(bugprone-incorrect-roundings)
}

std::string png(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = picture.channels == 3 ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  if (!picture.palette.empty()) image.format = PNG_FORMAT_RGB_COLORMAP;
  image.colormap_entries = static_cast<png_uint_32>(picture.palette.size());
  image.flags = PNG_IMAGE_FLAG_FAST;  // larger by a half, in a sixth of the time
  std::vector<char, LargeAllocator<char>> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
  png_alloc_size_t size = bytes.size();
  constexpr int kAsTheyAre = 0, kRowByRow = 0;
  if (png_image_write_to_memory(&image, bytes.data(), &size, kAsTheyAre, picture.bytes.data(),
                                kRowByRow, picture.palette.data()) == 0) {
    throw ToolError(std::string("libpng said: ") + image.message);
  }
  return {bytes.data(), size};
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
