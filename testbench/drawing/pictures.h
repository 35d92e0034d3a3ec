// Pictures of a frame, as files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "model/fixed/framebuffer.h"
#include "model/scene/scene.h"
#include "testbench/system/large_memory.h"

namespace phongpipe {

using Rgb = std::array<std::uint8_t, 3>;

struct Picture {
  int width = 0, height = 0;
  int channels = 1;          // bytes of a pixel, 1 or 3
  std::vector<Rgb> palette;  // empty, or what a byte stands for
  std::vector<std::uint8_t, LargeAllocator<std::uint8_t>> bytes;  // row by row from the top

  Picture() = default;
  // All pixels of one colour, given by the first `channels` bytes of `color`.
  Picture(int width, int height, int channels, const std::uint8_t* color);
  std::uint8_t* pixel(std::size_t index) {
    return bytes.data() + index * static_cast<std::size_t>(channels);
  }
  Rgb color(std::size_t index) const;
};

// The picture in a framebuffer.
Picture picture_of(const Framebuffer& framebuffer, int width, int height, int channels);
// Packed colours as numbers in LSB, in three channels.
std::vector<Color> in_lsb(const std::vector<std::uint32_t>& colors, int channels);
// The picture of real colours in LSB, rounded; grey if `channels` is 1.
Picture picture_of(const std::vector<Color>& colors, int width, int height, int channels);

// An error map with no pixel covered, which is shown in dark green. Pixels are set to
// error_level(): black for no error, through blue, red and yellow, to white.
Picture error_map(int width, int height);
// The place of an error in the palette of error maps; from kErrorMapTop LSB on all are the same.
constexpr double kErrorMapTop = 4;
std::uint8_t error_level(double error_lsb);

// The bytes of a PNG file.
std::string png(const Picture& picture);
// Writes the file as write_text() does.
void write_png(const std::filesystem::path& file, const Picture& picture);
// Float RGB, bottom row first, little-endian.
void write_pfm(const std::filesystem::path& file, const std::vector<Color>& colors, int width,
               int height);

}  // namespace phongpipe
