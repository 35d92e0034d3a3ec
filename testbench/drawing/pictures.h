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
  int channels = 1;                                               // 1 or 3
  std::vector<std::uint8_t, LargeAllocator<std::uint8_t>> bytes;  // row by row from the top

  Picture() = default;
  // All pixels of one colour, given by the first `channels` bytes of `color`.
  Picture(int width, int height, int channels, const std::uint8_t* color);
  std::uint8_t* pixel(std::size_t index) {
    return bytes.data() + index * static_cast<std::size_t>(channels);
  }
};

// The picture in a framebuffer.
Picture picture_of(const Framebuffer& framebuffer, int width, int height, int channels);
// Packed colours as numbers in LSB, in three channels.
std::vector<Color> in_lsb(const std::vector<std::uint32_t>& colors, int channels);
// The picture of real colours in LSB, rounded; grey if `channels` is 1.
Picture picture_of(const std::vector<Color>& colors, int width, int height, int channels);

// Colour of an error in LSB: from black at 0 through blue, red and yellow to white at kErrorMapTop
// and above. Dark green marks pixels that are not covered.
constexpr double kErrorMapTop = 4;
constexpr Rgb kUncoveredColor = {12, 40, 24};
Rgb error_color(double error);

// The bytes of a PNG file.
std::string png(const Picture& picture);
// Writes the file as write_text() does.
void write_png(const std::filesystem::path& file, const Picture& picture);
// Float RGB, bottom row first, little-endian.
void write_pfm(const std::filesystem::path& file, const std::vector<Color>& colors, int width,
               int height);

}  // namespace phongpipe
