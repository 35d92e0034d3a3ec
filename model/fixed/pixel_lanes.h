// The closed form of the pixel loop, kLanes pixels at a time; bit for bit the values of stepping.
//
// Registers are left-aligned in Word, so that its overflow is theirs. One source, compiled for each
// instruction set by the functions that inline it (pixel_datapath.cpp).
#pragma once

#include <cstdint>
#include <type_traits>

#include "model/fixed/pixel_datapath.h"

namespace phongpipe {

template <typename Word, int kLanes>
using Lanes __attribute__((vector_size(kLanes * sizeof(Word)))) = Word;

// v, and what takes it to the same lane of the next kLanes pixels.
template <typename Word, int kLanes>
struct LaneSeries {
  using Vector = Lanes<Word, kLanes>;
  Vector v = {}, d1 = {}, d2 = {};

  // v(i) = v + i d1 + i(i−1)/2 d2; v(i + k) − v(i) = k d1 + (k i + k(k−1)/2) d2.
  inline __attribute__((always_inline)) void load(const SeriesStart& start, int width) {
    using Unsigned = std::make_unsigned_t<Word>;
    const int shift = static_cast<int>(8 * sizeof(Word)) - width;
    const auto aligned = [shift](std::int64_t value) {
      return static_cast<Word>(static_cast<Unsigned>(value) << shift);
    };
    const Word first = aligned(start.v), slope = aligned(start.d1), bend = aligned(start.d2);
    Vector index = {}, pairs = {};
    for (int i = 0; i < kLanes; ++i) {
      index[i] = i;
      pairs[i] = i * (i - 1) / 2;
    }
    v = index * slope + pairs * bend + first;
    d1 = (kLanes * index + kLanes * (kLanes - 1) / 2) * bend + wrapping_multiply(slope, kLanes);
    d2 = Vector{} + wrapping_multiply(bend, kLanes * kLanes);
  }

  inline __attribute__((always_inline)) void advance() {
    v += d1;
    d1 += d2;
  }

 private:
  static Word wrapping_multiply(Word a, int b) {
    using Unsigned = std::make_unsigned_t<Word>;
    return static_cast<Word>(static_cast<Unsigned>(a) * static_cast<Unsigned>(b));
  }
};

struct LaneInputs {
  const DatapathConfiguration* configuration;
  const std::uint8_t* cue_color;           // of each channel
  const std::int32_t* const* aligned_rom;  // of each channel
};

// Gather: lanes of words[address]. kSpecular: whether the span has a highlight.
template <typename Word, int kLanes, int kChannels, bool kSpecular, GateSource kGate,
          typename Gather>
inline __attribute__((always_inline)) void shade_lanes(const LaneInputs& inputs, const Span& span,
                                                       std::uint32_t* colors) {
  using Vector = Lanes<Word, kLanes>;
  const DatapathConfiguration& configuration = *inputs.configuration;
  constexpr int kBits = static_cast<int>(8 * sizeof(Word));
  const int diffuse_width = configuration.diffuse_width();
  const int sum_fraction = configuration.sum_fraction_bits();
  const int diffuse_shift = kBits - (1 + kGuardBits + kOutputBits) - sum_fraction;
  const int address_shift = kBits - (1 + kGuardBits + configuration.rom_address_bits);
  const Word last_address = static_cast<Word>(configuration.rom_words() - 1);
  const bool depth_cue = configuration.depth_cue;

  LaneSeries<Word, kLanes> specular, gate, cue, diffuse[kChannels];
  Word level[kChannels];
  if constexpr (kSpecular) specular.load(span.specular, configuration.specular_width());
  if constexpr (kSpecular && kGate == GateSource::series) gate.load(span.gate, diffuse_width);
  if (depth_cue) cue.load(span.cue, kCueWidth);
  for (std::size_t c = 0; c < kChannels; ++c) {
    diffuse[c].load(span.diffuse[c], diffuse_width);
    level[c] = static_cast<Word>(static_cast<std::make_unsigned_t<Word>>(span.level[c])
                                 << (kBits - diffuse_width));
  }

  for (int i = 0; i < span.row.length; i += kLanes) {
    Vector address = {};
    Vector open = Vector{} - 1;  // all ones: the highlight counts
    if constexpr (kSpecular) {
      address = specular.v >> address_shift;
      address = address < 0 ? Vector{} : address;
      address = address > last_address ? Vector{} + last_address : address;
      specular.advance();
      if constexpr (kGate == GateSource::series) {
        open = gate.v > 0;
        gate.advance();
      }
      if constexpr (kGate == GateSource::diffuse) open = Vector{};
    }
    Vector clamped[kChannels];
    for (int c = 0; c < kChannels; ++c) {
      const Vector lit = diffuse[c].v > level[c];
      if constexpr (kSpecular && kGate == GateSource::diffuse) open |= lit;
      clamped[c] = (lit ? diffuse[c].v : Vector{} + level[c]) >> diffuse_shift;
      diffuse[c].advance();
    }
    Vector factor = {};
    if (depth_cue) {
      factor = cue.v >> (kBits - 1 - kCueIntegerBits - kCueFactorBits);
      factor = factor < 0 ? Vector{} : factor;
      factor = factor > (1 << kCueFactorBits) ? Vector{} + (1 << kCueFactorBits) : factor;
      cue.advance();
    }

    Vector color = {};
    for (int c = 0; c < kChannels; ++c) {
      Vector sum = clamped[c];
      if constexpr (kSpecular) {
        Vector word;
        Gather::read(inputs.aligned_rom[c], address, word);
        sum += word & open;
      }
      sum = sum >> sum_fraction;
      if (depth_cue) {
        const Word own = span.base ? inputs.cue_color[c] : 0;
        sum = own + (((sum - own) * factor + (1 << (kCueFactorBits - 1))) >> kCueFactorBits);
      }
      sum = sum > kOutputMax ? Vector{} + kOutputMax : sum;
      color |= sum << (c * kOutputBits);
    }
    for (int lane = 0; lane < kLanes; ++lane) {
      colors[i + lane] = static_cast<std::uint32_t>(color[lane]);
    }
  }
}

struct LoopGather {
  template <typename Vector>
  static inline __attribute__((always_inline)) void read(const std::int32_t* words,
                                                         const Vector& address, Vector& result) {
    constexpr int kLanes = sizeof(Vector) / sizeof(address[0]);
    for (int lane = 0; lane < kLanes; ++lane) result[lane] = words[address[lane]];
  }
};

}  // namespace phongpipe
