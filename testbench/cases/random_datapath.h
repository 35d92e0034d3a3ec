// Random configurations, tables and spans for tests of pixel_datapath: every combination of blocks,
// and any contents of their registers.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "testbench/cases/format_range.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {

inline std::string text(const DatapathConfiguration& c) {
  return "channels " + std::to_string(c.channels) + ", diffuse " +
         (c.diffuse ? std::to_string(c.diffuse_fraction_bits) : "left out") + ", specular " +
         (c.specular ? std::to_string(c.specular_fraction_bits) : "left out") + ", rom " +
         std::to_string(c.rom_address_bits) + " x " + std::to_string(c.rom_data_bits) +
         " (layout " + std::to_string(static_cast<int>(c.rom_layout)) + ", " +
         std::to_string(c.rom_octaves) + " octaves)" + ", gate " +
         std::to_string(static_cast<int>(c.gate)) + (c.depth_cue ? ", depth cueing" : "");
}

// A legal configuration. Widths are often at an end of their range.
inline DatapathConfiguration random_configuration(Random& random) {
  DatapathConfiguration c;
  const auto in_range_or_at_an_end = [&random](int low, int high) {
    const int choice = random.integer(0, 5);
    return choice == 0 ? low : choice == 1 ? high : random.integer(low, high);
  };
  c.channels = random.integer(0, 1) == 0 ? 1 : 3;
  c.diffuse = random.integer(0, 3) > 0;
  c.specular = random.integer(0, 3) > 0;
  c.depth_cue = random.integer(0, 1) == 0;
  c.diffuse_fraction_bits = in_range_or_at_an_end(kMinDiffuseFraction, kMaxDiffuseFraction);
  c.specular_fraction_bits = in_range_or_at_an_end(kMinSpecularFraction, kMaxSpecularFraction);
  c.rom_address_bits = in_range_or_at_an_end(kMinRomAddressBits, kMaxRomAddressBits);
  c.rom_data_bits = in_range_or_at_an_end(kMinRomDataBits, kMaxRomDataBits);
  c.rom_layout = static_cast<RomLayout>(random.integer(0, 2));
  c.rom_octaves = random.integer(1, 4);
  c.specular_guard_bits = least_specular_guard_bits(c.rom_layout) *
                          (c.rom_layout == RomLayout::plain ? 1 : random.integer(1, 3));
  c.specular_fraction_bits -= std::max(0, c.specular_width() - kWidestSeries);
  c.anchor = random.integer(0, 1) == 0 ? Anchor::triangle : Anchor::span;
  c.gate = static_cast<GateSource>(random.integer(0, 2));
  if (c.specular && !c.diffuse && c.gate == GateSource::diffuse) c.gate = GateSource::series;
  return c;
}

inline HighlightTable random_table(Random& random, const DatapathConfiguration& c) {
  HighlightTable table;
  for (int channel = 0; channel < c.channels; ++channel) {
    const double specular = random.uniform(0, 1.5), shininess = random.uniform(0, 200);
    table.roms.emplace_back(c, specular, shininess);
  }
  return table;
}

inline OutputColor random_color(Random& random) {
  OutputColor color;
  for (std::uint8_t& channel : color) channel = static_cast<std::uint8_t>(random.integer(0, 255));
  return color;
}

// From small values to the whole range of the register, extremes included; bits beyond the width
// are arbitrary.
inline SeriesStart random_start(Random& random, int width) {
  const auto value = [&](int smallest_shift) {
    switch (random.integer(0, 9)) {
      case 0:
        return std::int64_t{1} << (width - 1);  // the most negative
      case 1:
        return (std::int64_t{1} << (width - 1)) - 1;  // the most positive
      default:
        return random.bits() >> random.integer(smallest_shift, 63);
    }
  };
  return {value(0), value(64 - width), value(64 - width)};
}

// A span as the span walker may produce it: a series that is not stepped has no differences, and
// `level` replaces a missing diffuse series.
inline Span random_span(Random& random, const DatapathConfiguration& c, int length) {
  Span span;
  span.row = {random.integer(0, 4096 - length), random.integer(0, 4095), length};
  span.first_pass = random.integer(0, 1) == 0;
  span.step_diffuse = (c.diffuse || c.has_gate_series()) && random.integer(0, 3) > 0;
  span.step_specular = c.specular && random.integer(0, 3) > 0;
  span.highlight = c.specular && random.integer(0, 3) > 0;
  const auto start = [&random](int width, bool step) {
    SeriesStart result = random_start(random, width);
    if (!step) result.d1 = result.d2 = 0;
    return result;
  };
  for (std::size_t channel = 0; channel < 3; ++channel) {
    span.level[channel] =
        std::llround(std::ldexp(random.uniform(0, kOutputMax) + 0.5, c.diffuse_fraction_bits));
    span.diffuse[channel] = c.diffuse ? start(c.diffuse_width(), span.step_diffuse)
                                      : SeriesStart{span.level[channel], 0, 0};
  }
  span.specular = start(c.specular_width(), span.step_specular);
  span.gate = start(c.diffuse_width(), span.step_diffuse);
  span.cue = random_start(random, kCueWidth);
  span.cue.d2 = 0;
  return span;
}

}  // namespace phongpipe
