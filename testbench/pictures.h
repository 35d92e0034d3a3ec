// Pictures of a frame, as files. Each is written under another name first and then renamed, so that
// none is left half written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "model/scene/scene.h"

namespace phongpipe {

struct Picture {
  int width = 0, height = 0;
  int channels = 1;                 // 1 or 3
  std::vector<std::uint8_t> bytes;  // row by row from the top
};

// Framebuffer colours, channel 0 in the low byte.
Picture picture_of(const std::vector<std::uint32_t>& colors, int width, int height, int channels);
// The same in LSB, as three channels.
std::vector<Color> in_lsb(const std::vector<std::uint32_t>& colors, int channels);
// Real colours in LSB, rounded; grey ones if `channels` is 1.
Picture picture_of(const std::vector<Color>& colors, int width, int height, int channels);
// Errors in LSB: black at 0 over blue, red and yellow to white at kErrorMapTop and above; dark green
// where nothing is covered (NaN).
constexpr double kErrorMapTop = 4;
Picture error_map(const std::vector<float>& errors, int width, int height);

// Throw InputError where the file cannot be written.
void write_png(const std::filesystem::path& file, const Picture& picture);
// Float RGB, bottom row first, little-endian.
void write_pfm(const std::filesystem::path& file, const std::vector<Color>& colors, int width,
               int height);
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace phongpipe
