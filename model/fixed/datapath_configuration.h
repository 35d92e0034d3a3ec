// Configuration of the hardware for a frame, in three separate parts: the formats a user chooses,
// the blocks that the scene's effects require, and the policy of the setup engine.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>
#include <vector>

#include "model/fixed/constants.h"
#include "model/fixed/setting.h"
#include "model/shading/quadratics/series_fit.h"

namespace phongpipe {

// Where values are rounded to the datapath's fraction. `triangle`: the T_i, once, as in the paper;
// the error grows with the extent n of the triangle as 1 + 2n + 3n². `span`: T_i keep
// kSetupExtraBits more, and the start of each span is rounded; the error grows with the length of
// the span as 1 + n + n(n−1)/2.
enum class Anchor { triangle, span };
constexpr int kSetupExtraBits = 20;
// Bits of a register whose exact starts of spans fit in 64 bits.
constexpr int kWidestSeries = 40;

// The x that a word of the plain layout is computed for, out of the interval of its address.
// `nearest`: the middle, which equals rounding the address to nearest. `truncate`: the lower end.
enum class IndexRounding { nearest, truncate };

// Where the word of an address is, see exponent_rom.h.
enum class RomLayout { plain, octave, bipartite };

// Integer bits of the specular series above full scale: in the octave layouts a multiple of 4, so
// that few datapaths serve all scenes. 4 are enough for a shininess of up to 36.
constexpr int kSpecularGuardStep = 4;
constexpr int least_specular_guard_bits(RomLayout layout) {
  return layout == RomLayout::plain ? kGuardBits : kSpecularGuardStep;
}

// `pipelined`: a pixel a clock. `serial`: a digit of one series a clock, in few LUTs. `wide2` and
// `wide4`: 2 and 4 pixels side by side a clock, of as many pipelined datapaths that take turns.
enum class DatapathKind { pipelined, serial, wide2, wide4 };
struct DatapathKindTraits {
  DatapathKind kind;
  std::string_view name;        // of the setting datapath.kind
  std::string_view rtl_module;  // several kinds may have one
  int lanes;                    // pixels that enter together, and leave together
};
inline constexpr std::array<DatapathKindTraits, 4> kDatapathKinds = {{
    {DatapathKind::pipelined, "pipelined", "pixel_datapath", 1},
    {DatapathKind::serial, "serial", "pixel_datapath_serial", 1},
    {DatapathKind::wide2, "wide2", "pixel_datapath_wide", 2},
    {DatapathKind::wide4, "wide4", "pixel_datapath_wide", kMostLanes},
}};
constexpr const DatapathKindTraits& traits(DatapathKind kind) {
  return kDatapathKinds[static_cast<std::size_t>(kind)];
}
static_assert(traits(DatapathKind::serial).kind == DatapathKind::serial &&
              traits(DatapathKind::wide2).kind == DatapathKind::wide2 &&
              traits(DatapathKind::wide4).kind == DatapathKind::wide4);

// `automatic`: one channel if all colours of the scene are grey, else three.
enum class ChannelChoice { automatic, one, three };

// The user's settings of the datapath and the framebuffer.
struct FixedPointFormats {
  DatapathKind kind = DatapathKind::pipelined;
  ChannelChoice channel_choice = ChannelChoice::automatic;
  int diffuse_fraction_bits = 16;   // below one output LSB
  int specular_fraction_bits = 12;  // below one ROM address
  RomLayout rom_layout = RomLayout::plain;
  int rom_address_bits = 10;
  int rom_octaves = 4;    // of the octave layouts
  int rom_data_bits = 8;  // 1 LSB is full scale / 2^rom_data_bits
  IndexRounding index_rounding = IndexRounding::nearest;
  // The scene decides between `diffuse` and `series` (see derive_blocks).
  GateSource gate_choice = GateSource::diffuse;
  Anchor anchor = Anchor::span;
  int depth_bits = 24;  // of a depth in the framebuffer

  static const Settings<FixedPointFormats>& settings();
};

// Fraction bits of the T_i, for a series of `fraction_bits` in the datapath.
inline int setup_fraction_bits(const FixedPointFormats& formats, int fraction_bits) {
  return fraction_bits + (formats.anchor == Anchor::span ? kSetupExtraBits : 0);
}

// The blocks of the datapath that are built, as the scene's effects require.
struct EffectBlocks {
  int channels = 1;        // 1 (grey) or 3
  bool diffuse = true;     // one series per channel; without it, `level` replaces it
  bool specular = true;    // series, gate and exponent_rom
  bool depth_cue = false;  // a linear series, one multiplier per channel, kDepthCueLatency stages
  GateSource gate = GateSource::diffuse;
  int specular_guard_bits = kGuardBits;  // integer bits of the specular series above full scale
};

// The pixel datapath: formats and blocks, and sizes derived from them.
struct DatapathConfiguration : FixedPointFormats, EffectBlocks {
  // Two's complement: sign, guard, integer, fraction. Overflow wraps.
  // Diffuse (and gate) series: s(1 + kGuardBits + kOutputBits).(diffuse_fraction_bits), in output
  // LSB.
  int diffuse_width() const { return phongpipe::diffuse_width(diffuse_fraction_bits); }
  // Specular series: s(1 + specular_guard_bits + rom_address_bits).(specular_fraction_bits), in
  // addresses of the ROM.
  int specular_width() const {
    return phongpipe::specular_width(specular_guard_bits, rom_address_bits, specular_fraction_bits);
  }
  // Fraction bits that color_sum keeps: those of the ROM words below one output LSB.
  int sum_fraction_bits() const { return std::max(0, rom_data_bits - kOutputBits); }
  int rom_addresses() const { return 1 << rom_address_bits; }
  // Bits of an address below its leading one in the octave layouts; in the bipartite layout the low
  // ones of these, and as many in the middle.
  int rom_block_bits() const { return rom_address_bits - rom_octaves; }
  int rom_low_bits() const { return (rom_block_bits() + 2) / 3; }
  // Words of one channel: of all tables, and of the first, which holds the bases.
  int rom_words() const { return rom_bases() * (rom_layout == RomLayout::bipartite ? 2 : 1); }
  int rom_bases() const {
    const int blocks = rom_octaves + 1;  // one for what is below
    return rom_layout == RomLayout::plain    ? rom_addresses()
           : rom_layout == RomLayout::octave ? blocks << rom_block_bits()
                                             : blocks << (rom_block_bits() - rom_low_bits());
  }

  bool has_gate_series() const { return specular && gate == GateSource::series; }
  int series() const {
    return (diffuse ? channels : 0) + (specular ? 1 : 0) + (has_gate_series() ? 1 : 0);
  }
  // Adders of increments in a bipartite ROM, of a lane.
  int rom_adders() const { return specular && rom_layout == RomLayout::bipartite ? channels : 0; }
  // Adders that compute where the lanes of a wide datapath start: of a quadratic series, of a
  // linear one; see series_lanes.sv.
  int quadratic_lane_adders() const { return lanes() == 1 ? 0 : lanes() == 2 ? 3 : 11; }
  int linear_lane_adders() const { return lanes() - 1; }
  // Adders: in each lane two per series, one per channel to add diffuse and specular, and those of
  // the ROM. Depth cueing takes one for its linear series and two per channel to move it towards
  // the cue colour. The serial datapath has two, of a digit, for all series.
  int adders() const {
    const int sums = (specular ? channels : 0) + rom_adders() + (depth_cue ? 2 * channels : 0);
    if (kind == DatapathKind::serial) return 2 + sums;
    return lanes() * (2 * series() + sums + (depth_cue ? 1 : 0)) +
           series() * quadratic_lane_adders() + (depth_cue ? linear_lane_adders() : 0);
  }
  int multipliers() const { return depth_cue ? lanes() * channels : 0; }
  int rom_bits() const { return specular ? lanes() * rom_words() * channels * rom_data_bits : 0; }
  // For values and differences: three registers per series, two for the linear one of depth cueing.
  // The serial datapath has them in block RAM, and a register for each value and level.
  int register_bits() const {
    if (kind == DatapathKind::serial) {
      return ((diffuse ? 2 : 1) * channels + (has_gate_series() ? 1 : 0)) * diffuse_width() +
             (specular ? specular_width() : 0) + (depth_cue ? kCueWidth : 0);
    }
    return lanes() *
           (3 * ((diffuse ? channels : 0) + (has_gate_series() ? 1 : 0)) * diffuse_width() +
            (specular ? 3 * specular_width() : 0) + (depth_cue ? 2 * kCueWidth : 0));
  }
  int lanes() const { return traits(kind).lanes; }
  // Clocks from the acceptance of a span to its entrance into the lanes, if there are several.
  int lane_stages() const { return lanes() > 1 ? kLaneStages : 0; }
  // Clocks from a pixel, or a group of as many as there are lanes, that enters to the next one.
  int interval_cycles() const {
    return kind == DatapathKind::serial ? serial_series() * serial_digits() : 1;
  }
  // Series whose digits the serial datapath reads: a diffuse one of each channel in any case, for
  // the level is read with it.
  int serial_series() const {
    return channels + (specular ? 1 : 0) + (has_gate_series() ? 1 : 0) + (depth_cue ? 1 : 0);
  }
  // Digits of each of them, of the widest register.
  int serial_digits() const;
  // Clocks from the acceptance of a span to its first pixel at the output.
  int latency_cycles() const {
    return kDatapathLatency + (depth_cue ? kDepthCueLatency : 0) +
           (kind == DatapathKind::serial ? interval_cycles() - kSerialStages : 0) + lane_stages();
  }

  // Throws InputError naming key, value and legal range.
  void check() const;
};

constexpr int kDoubleMantissaBits = 52;

// How the setup engine computes coefficients. No register or adder of the datapath depends on it.
struct SetupPolicy {
  SeriesFit series_fit = SeriesFit::taylor;
  int subdivide_degrees = 0;  // triangles that turn more sharply are split; 0: none
  // Of the setup engine's numbers, after the leading one; every operation is rounded to them.
  int mantissa_bits = kDoubleMantissaBits;
  // Largest error of a pixel that is proved for every triangle, see certificate.h; 0: none is.
  int max_error_thousandths = 0;  // of an output LSB

  bool certifies() const { return max_error_thousandths > 0; }
  double max_error_lsb() const { return max_error_thousandths / 1000.0; }

  static const Settings<SetupPolicy>& settings();
};

// All settings that the values of a frame depend on.
struct FrameConfiguration : DatapathConfiguration, SetupPolicy {
  void check() const;
};

// What the arithmetic of exact_path, and of the exact Phong shading it is measured against, may
// lose: pixels that could lose more are refused, see exact_path.h.
constexpr double kExactPathNoise = 1e-3;

// Error of exact_path: rounding to the diffuse register, to 8 bits, and noise.
inline double least_certified_error_lsb(const DatapathConfiguration& datapath) {
  return 0.5 + std::ldexp(0.5, -datapath.diffuse_fraction_bits) + kExactPathNoise;
}

// Parameters of an RTL module by name.
using RtlParameters = std::vector<std::pair<std::string_view, int>>;
// Those of the module of the configuration's kind.
RtlParameters rtl_parameters(const DatapathConfiguration& datapath);
// "CHANNELS=1-DIFFUSE=1-…", after the name of the module if it is not pixel_datapath: names the RTL
// of a configuration in file names, messages, libraries and technology cards.
std::string parameters_text(const RtlParameters& parameters);
std::string rtl_parameters_text(const DatapathConfiguration& datapath);

}  // namespace phongpipe
