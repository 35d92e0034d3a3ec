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

// Clocks from the acceptance of a span to its first pixel at the output of pixel_datapath, and what
// depth cueing adds.
constexpr int kDatapathLatency = 13;
constexpr int kDepthCueLatency = 6;

// Pixels that fit in the queue at the end of pixel_datapath. The pipeline before it never stalls,
// so that there must be more than a pixel needs from its acceptance until its slot is free again.
constexpr int kPixelQueueBits = 5;
constexpr int kPixelQueueSlots = 1 << kPixelQueueBits;
static_assert(kPixelQueueSlots > kDatapathLatency + kDepthCueLatency + 1);

// The serial datapath reads and adds this many bits of a series a clock; a series has so many such
// digits, at least.
constexpr int kDigitBits = 8;
constexpr int kLeastDigits = 3;
// Its latency is the clocks that a pixel takes + kDatapathLatency − kSerialStages: the digits come
// in place of the stages before kWholeStage.
constexpr int kSerialStages = 3;
// Bits of the numbers of a series and of a digit in it.
constexpr int kSeriesBits = 3;
constexpr int kDigitPlaceBits = 3;

// Pixels side by side that a wide datapath delivers in a clock, at most, and the clocks in which it
// computes where its lanes start.
constexpr int kMostLanes = 4;
constexpr int kLaneStages = 3;

// A sum of a series is made in two clocks: its low bits, then its upper kHighBits with their carry.
// Counted from above, so that a series in a wider register is split at the same place.
constexpr int kHighBits = 13;
constexpr int low_bits(int width) {
  return width > kHighBits ? width - kHighBits : 1;
}

// The share of a pixel's own colour under depth cueing: a linear series
// s(kCueIntegerBits).(kCueFraction), clamped to 0 … 1 and truncated to kCueFactorBits before the
// multiplication.
constexpr int kCueIntegerBits = 11;
constexpr int kCueFraction = 20;
constexpr int kCueFactorBits = 10;
constexpr int kCueWidth = 1 + kCueIntegerBits + kCueFraction;

// What enables the specular term. `off`: always enabled, as in the paper. `diffuse`: the sign of
// the diffuse series. `series`: a separate series of N·L, for a diffuse colour of 0.
enum class GateSource { off, diffuse, series };

// Bits of a diffuse (or gate) register: sign, guard, output LSBs, fraction.
constexpr int diffuse_width(int fraction_bits) {
  return 1 + kGuardBits + kOutputBits + fraction_bits;
}
// Bits of a specular register: sign, guard, ROM address, fraction.
constexpr int specular_width(int guard_bits, int address_bits, int fraction_bits) {
  return 1 + guard_bits + address_bits + fraction_bits;
}

}  // namespace phongpipe
