// The closed form of the pixel loop, kLanes pixels at a time. Values equal those of stepping to the
// bit.
//
// Registers are left-aligned in Word, so that both overflow together; signed overflow wraps
// (-fwrapv). This source is compiled once per instruction set, by the functions that inline it
// (pixel_datapath.cpp).
#pragma once

#include <cstdint>
#include <cstring>

#include "model/fixed/pixel_datapath.h"

namespace phongpipe {

template <typename Word, int kLanes>
using Lanes __attribute__((vector_size(kLanes * sizeof(Word)))) = Word;

// v, and its differences to the same lane of the next kLanes pixels.
template <typename Word, int kLanes>
struct LaneSeries {
  using Vector = Lanes<Word, kLanes>;
  Vector v = {}, d1 = {}, d2 = {};

  // v(i) = v + i d1 + i(i−1)/2 d2. `unused`: bits of a word beyond the register's width.
  inline __attribute__((always_inline)) void load(const SeriesStart& start, int unused) {
    Vector index, pairs;
    for (int i = 0; i < kLanes; ++i) {
      index[i] = i;
      pairs[i] = i * (i - 1) / 2;
    }
    v = index * static_cast<Word>(start.d1) + pairs * static_cast<Word>(start.d2);
    v = (v + static_cast<Word>(start.v)) << unused;
  }

  // v(i + k) − v(i) = k d1 + (k i + k(k−1)/2) d2. For spans of more than kLanes pixels.
  inline __attribute__((always_inline)) void load_differences(const SeriesStart& start,
                                                              int unused) {
    Vector pairs;
    for (int i = 0; i < kLanes; ++i) pairs[i] = kLanes * i + kLanes * (kLanes - 1) / 2;
    d1 = (pairs * static_cast<Word>(start.d2) + kLanes * static_cast<Word>(start.d1)) << unused;
    d2 = (Vector{} + kLanes * kLanes * static_cast<Word>(start.d2)) << unused;
  }

  inline __attribute__((always_inline)) void advance() {
    v += d1;
    d1 += d2;
  }
};

// Values common to all spans. Shifts are in bits.
template <typename Word>
struct LaneFormat {
  explicit LaneFormat(const DatapathConfiguration& configuration)
      : depth_cue(configuration.depth_cue),
        unused_diffuse(kBits - configuration.diffuse_width()),
        unused_specular(kBits - configuration.specular_width()),
        sum_fraction(configuration.sum_fraction_bits()),
        diffuse_shift(kBits - (1 + kGuardBits + kOutputBits) - sum_fraction),
        address_shift(kBits -
                      (1 + configuration.specular_guard_bits + configuration.rom_address_bits)),
        last_address(static_cast<Word>(configuration.rom_addresses() - 1)) {}

  static constexpr int kBits = static_cast<int>(8 * sizeof(Word));
  static constexpr int kUnusedCue = kBits - kCueWidth;
  static constexpr int kFactorShift = kBits - 1 - kCueIntegerBits - kCueFactorBits;
  bool depth_cue;
  int unused_diffuse, unused_specular;  // bits of a word beyond the registers' widths
  int sum_fraction, diffuse_shift, address_shift;
  Word last_address;
};

struct LaneInputs {
  const DatapathConfiguration* configuration;
  const std::uint8_t* cue_color;           // of each channel
  const std::int32_t* const* aligned_rom;  // of each channel
};

// kLanes pixels of a span. kSpecular: whether it has a highlight.
template <typename Word, int kLanes, int kChannels, bool kSpecular, GateSource kGate>
struct PixelLanes {
  using Vector = Lanes<Word, kLanes>;
  using Format = LaneFormat<Word>;
  LaneSeries<Word, kLanes> specular, gate, cue, diffuse[kChannels];
  Word level[kChannels];

  inline __attribute__((always_inline)) void load(const Format& format, const Span& span) {
    if constexpr (kSpecular) specular.load(span.specular, format.unused_specular);
    if constexpr (kGate == GateSource::series) gate.load(span.gate, format.unused_diffuse);
    if (format.depth_cue) cue.load(span.cue, Format::kUnusedCue);
    for (std::size_t c = 0; c < kChannels; ++c) {
      diffuse[c].load(span.diffuse[c], format.unused_diffuse);
      level[c] = static_cast<Word>(span.level[c]) << format.unused_diffuse;
    }
  }

  inline __attribute__((always_inline)) void load_differences(const Format& format,
                                                              const Span& span) {
    if constexpr (kSpecular) specular.load_differences(span.specular, format.unused_specular);
    if constexpr (kGate == GateSource::series) {
      gate.load_differences(span.gate, format.unused_diffuse);
    }
    if (format.depth_cue) cue.load_differences(span.cue, Format::kUnusedCue);
    for (std::size_t c = 0; c < kChannels; ++c) {
      diffuse[c].load_differences(span.diffuse[c], format.unused_diffuse);
    }
  }

  inline __attribute__((always_inline)) void advance(const Format& format) {
    if constexpr (kSpecular) specular.advance();
    if constexpr (kGate == GateSource::series) gate.advance();
    if (format.depth_cue) cue.advance();
    for (auto& series : diffuse) series.advance();
  }

  template <typename Gather>
  inline __attribute__((always_inline)) void shade(const Format& format, const LaneInputs& inputs,
                                                   bool first_pass, std::uint32_t* colors) const {
    Vector address = {};
    Vector open = Vector{} - 1;  // all ones: the highlight counts
    if constexpr (kSpecular) {
      address = specular.v >> format.address_shift;
      address = address < 0 ? Vector{} : address;
      address = address > format.last_address ? Vector{} + format.last_address : address;
      if constexpr (kGate == GateSource::series) open = gate.v > 0;
      if constexpr (kGate == GateSource::diffuse) open = Vector{};
    }
    Vector clamped[kChannels];
    for (int c = 0; c < kChannels; ++c) {
      const Vector lit = diffuse[c].v > level[c];
      if constexpr (kSpecular && kGate == GateSource::diffuse) open |= lit;
      clamped[c] = (lit ? diffuse[c].v : Vector{} + level[c]) >> format.diffuse_shift;
    }
    Vector factor = {};
    if (format.depth_cue) {
      factor = cue.v >> Format::kFactorShift;
      factor = factor < 0 ? Vector{} : factor;
      factor = factor > (1 << kCueFactorBits) ? Vector{} + (1 << kCueFactorBits) : factor;
    }

    Vector color = {};
    for (int c = 0; c < kChannels; ++c) {
      Vector sum = clamped[c];
      if constexpr (kSpecular) {
        Vector word;
        Gather::read(inputs.aligned_rom[c], address, word);
        sum += word & open;
      }
      sum = sum >> format.sum_fraction;
      if (format.depth_cue) {
        const Word own = first_pass ? inputs.cue_color[c] : 0;
        sum = own + (((sum - own) * factor + (1 << (kCueFactorBits - 1))) >> kCueFactorBits);
      }
      sum = sum > kOutputMax ? Vector{} + kOutputMax : sum;
      color |= sum << (c * kOutputBits);
    }
    const auto stored = __builtin_convertvector(color, Lanes<std::uint32_t, kLanes>);
    std::memcpy(colors, &stored, sizeof(stored));
  }
};

template <typename Word, int kLanes, int kChannels, bool kSpecular, GateSource kGate,
          typename Gather>
inline __attribute__((always_inline)) void shade_span(const LaneFormat<Word>& format,
                                                      const LaneInputs& inputs, const Span& span,
                                                      std::uint32_t* colors) {
  PixelLanes<Word, kLanes, kChannels, kSpecular, kGate> lanes;
  lanes.load(format, span);
  lanes.template shade<Gather>(format, inputs, span.first_pass, colors);
  if (span.row.length <= kLanes) return;
  lanes.load_differences(format, span);
  for (int i = kLanes; i < span.row.length; i += kLanes) {
    lanes.advance(format);
    lanes.template shade<Gather>(format, inputs, span.first_pass, colors + i);
  }
}

// Shades spans. Gather::read() reads words[address] of each lane. kSpecular: whether spans may have
// a highlight.
template <typename Word, int kLanes, int kChannels, bool kSpecular, GateSource kGate,
          typename Gather>
inline __attribute__((always_inline)) void shade_lanes(const LaneInputs& inputs, const Span* spans,
                                                       std::size_t count, std::uint32_t* colors) {
  const LaneFormat<Word> format(*inputs.configuration);
  for (const Span* span = spans; span != spans + count; ++span) {
    if (kSpecular && span->highlight) {
      shade_span<Word, kLanes, kChannels, kSpecular, kGate, Gather>(format, inputs, *span, colors);
    } else {
      shade_span<Word, kLanes, kChannels, false, GateSource::off, Gather>(format, inputs, *span,
                                                                          colors);
    }
    colors += span->row.length;
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
