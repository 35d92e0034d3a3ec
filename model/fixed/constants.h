// The numbers that C++ and RTL share. hw/constants.svh is generated from this file and from the
// table of settings; a test fails when it is not current.
#pragma once

#include <array>
#include <cstdint>

namespace phongpipe {

// Output: one channel of a pixel is an unsigned integer of kOutputBits; 1 LSB is 1/255 of full
// scale.
constexpr int kOutputBits = 8;
constexpr int kOutputMax = (1 << kOutputBits) - 1;
using OutputColor = std::array<std::uint8_t, 3>;  // of the channels in use

// Integer guard bits of every series: a Taylor polynomial overshoots 1 when the peak lies inside
// the triangle, by less than a factor of two while max |Nᵢ − C| / |C| < 1.86.
constexpr int kGuardBits = 1;

// The same of the specular series in the octave layouts, at most: there full scale is the reach of
// the narrowest highlight, of shininess 10,000.
constexpr int kSpecularGuardBits = 12;

constexpr int kCoordinateBits = 12;               // x and y, 0 … 4095
constexpr int kLengthBits = kCoordinateBits + 1;  // pixels in a span, 1 … 4096

// Clocks from the acceptance of a span to its first pixel at the output of pixel_datapath; also the
// number of pixels the datapath holds. Depth cueing adds a stage.
constexpr int kDatapathLatency = 4;
constexpr int kDepthCueLatency = 1;

// The share of a pixel's own colour under depth cueing: a linear series
// s(kCueIntegerBits).(kCueFraction), clamped to 0 … 1 and truncated to kCueFactorBits before the
// multiplication.
constexpr int kCueIntegerBits = 11;
constexpr int kCueFraction = 20;
constexpr int kCueFactorBits = 10;
constexpr int kCueWidth = 1 + kCueIntegerBits + kCueFraction;

// Bits of a diffuse (or gate) register: sign, guard, output LSBs, fraction.
constexpr int diffuse_width(int fraction_bits) {
  return 1 + kGuardBits + kOutputBits + fraction_bits;
}
// Bits of a specular register: sign, guard, ROM address, fraction.
constexpr int specular_width(int guard_bits, int address_bits, int fraction_bits) {
  return 1 + guard_bits + address_bits + fraction_bits;
}

}  // namespace phongpipe
