// What the hardware is told before a frame, in three parts that are kept apart: the formats a user
// chooses, the blocks that the scene's effects call for, and the policy of the setup engine.
#pragma once

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

#include "model/fixed/constants.h"
#include "model/fixed/setting.h"
#include "model/shading/quadratics/series_fit.h"

namespace phongpipe {

// Where T_i are rounded to the datapath's fraction. `triangle`: once, as the paper has it; the
// error grows with the extent n of the triangle as 1 + 2n + 3n². `span`: setup keeps
// kSetupExtraBits more and rounds the start of each span; the error grows with the length of the
// span as 1 + n + n(n−1)/2.
enum class Anchor { triangle, span };
constexpr int kSetupExtraBits = 20;

// What x a ROM entry stands for: the middle of the interval that shares its address (which is what
// rounding to nearest means for an address cut off below its LSB), or the interval's lower end.
enum class IndexRounding { nearest, truncate };

// What allows the specular term. `off`: always, the paper's form. `diffuse`: the sign of the
// diffuse series. `series`: a series of N·L of its own, where the diffuse colour is 0 and cannot
// tell.
enum class GateSource { off, diffuse, series };

// `automatic`: one channel where all colours of the scene are grey, else three.
enum class ChannelChoice { automatic, one, three };

// What the user chooses of the datapath and the framebuffer.
struct FixedPointFormats {
  ChannelChoice channel_choice = ChannelChoice::automatic;
  int diffuse_fraction_bits = 16;   // below one output LSB
  int specular_fraction_bits = 12;  // below one ROM address
  int rom_address_bits = 10;
  int rom_data_bits = 8;  // one word is full scale / 2^rom_data_bits per unit
  IndexRounding index_rounding = IndexRounding::nearest;
  // Of `diffuse` and `series` the scene decides which one it is (see derive_blocks).
  GateSource gate_choice = GateSource::diffuse;
  Anchor anchor = Anchor::span;
  int depth_bits = 24;  // of the framebuffer's depth

  static const Settings<FixedPointFormats>& settings();
};

// What is built of the datapath, as the scene's effects ask for.
struct EffectBlocks {
  int channels = 1;        // 1 (grey) or 3
  bool diffuse = true;     // a series a channel; without it the level stands for it
  bool specular = true;    // series, gate and exponent_rom
  bool depth_cue = false;  // a linear series, a multiplier a channel and kDepthCueLatency stages
  GateSource gate = GateSource::diffuse;
};

// The pixel datapath: formats and blocks, and what follows from them.
struct DatapathConfiguration : FixedPointFormats, EffectBlocks {
  // Two's complement: sign, guard, integer, fraction. Overflow wraps.
  // Diffuse (and gate) series: s(1 + kGuardBits + kOutputBits).(diffuse_fraction_bits), in output
  // LSB.
  int diffuse_width() const { return phongpipe::diffuse_width(diffuse_fraction_bits); }
  // Specular series: integer part is the ROM address, so full scale is 2^rom_address_bits.
  int specular_width() const {
    return phongpipe::specular_width(rom_address_bits, specular_fraction_bits);
  }
  // Fraction bits that color_sum keeps: what the ROM words have below one output LSB.
  int sum_fraction_bits() const { return std::max(0, rom_data_bits - kOutputBits); }
  int rom_words() const { return 1 << rom_address_bits; }

  bool has_gate_series() const { return specular && gate == GateSource::series; }
  int series() const {
    return (diffuse ? channels : 0) + (specular ? 1 : 0) + (has_gate_series() ? 1 : 0);
  }
  // Additions per pixel: two a series, one a channel to add diffuse and specular; with depth cueing
  // one for its linear series and two a channel to move it towards the colour.
  int adders() const {
    return 2 * series() + (specular ? channels : 0) + (depth_cue ? 1 + 2 * channels : 0);
  }
  int multipliers() const { return depth_cue ? channels : 0; }
  int rom_bits() const { return specular ? rom_words() * channels * rom_data_bits : 0; }
  // Of the series' values and differences: three registers each, two for the linear one of depth
  // cueing.
  int register_bits() const {
    return 3 * ((diffuse ? channels : 0) + (has_gate_series() ? 1 : 0)) * diffuse_width() +
           (specular ? 3 * specular_width() : 0) + (depth_cue ? 2 * kCueWidth : 0);
  }
  // Clocks from the acceptance of a span to its first pixel at the output, and the number of pixels
  // that the datapath holds.
  int latency_cycles() const { return kDatapathLatency + (depth_cue ? kDepthCueLatency : 0); }

  // Throws InputError naming key, value and legal range.
  void check() const;
};

// What the setup engine makes of a triangle. No register or adder of the datapath depends on it.
struct SetupPolicy {
  SeriesFit series_fit = SeriesFit::taylor;
  int subdivide_degrees = 0;  // triangles whose normals turn by more are split; 0: none

  static const Settings<SetupPolicy>& settings();
};

// All that the values of a frame depend on, besides the scene.
struct FrameConfiguration : DatapathConfiguration, SetupPolicy {
  void check() const;
};

// The parameters of pixel_datapath.sv, by name.
std::vector<std::pair<std::string_view, int>> rtl_parameters(const DatapathConfiguration& datapath);

}  // namespace phongpipe
