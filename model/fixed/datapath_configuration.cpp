#include "model/fixed/datapath_configuration.h"

#include <cmath>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

std::vector<std::string_view> kind_names() {
  std::vector<std::string_view> names;
  names.reserve(kDatapathKinds.size());
  for (const DatapathKindTraits& kind : kDatapathKinds) names.push_back(kind.name);
  return names;
}

}  // namespace

const Settings<FixedPointFormats>& FixedPointFormats::settings() {
  using F = FixedPointFormats;
  // Fractions end where the registers of the plain layout have kWidestSeries bits.
  static const Settings<F> all = {
      choice_setting("datapath", "kind", &F::kind, kind_names(),
                     "a pixel a clock; or a digit of 8 bits of one series a clock, in half the "
                     "LUTs; or 2 or 4 pixels side by side a clock"),
      choice_setting("datapath", "channels", &F::channel_choice, {"auto", "1", "3"},
                     "grey or colour; auto: one channel where all of the scene is grey"),
      number_setting("datapath", "diffuse_fraction_bits", &F::diffuse_fraction_bits, "bits", 4, 30,
                     "fraction of the diffuse and gate series, below one output LSB",
                     "DIFFUSE_FRACTION"),
      number_setting("datapath", "specular_fraction_bits", &F::specular_fraction_bits, "bits", 1,
                     25, "fraction of the specular series, below one ROM address",
                     "SPECULAR_FRACTION"),
      choice_setting("datapath", "rom_layout", &F::rom_layout, {"plain", "octave", "bipartite"},
                     "the exponent ROM has a word for each address; or finer ones the brighter the "
                     "highlight; or these in two tables whose words are added"),
      number_setting("datapath", "rom_address_bits", &F::rom_address_bits, "bits", 6, 13,
                     "of the exponent ROM; plain, it has 2^this words: 64 to 8192",
                     "ROM_ADDRESS_BITS"),
      number_setting("datapath", "rom_octaves", &F::rom_octaves, "octaves", 1, 4,
                     "that octave and bipartite tell apart; 1 to 4 leave 1, 3/4, 1/2, 5/16 of "
                     "the words, coarser ones for fainter highlights",
                     "ROM_OCTAVES"),
      number_setting("datapath", "rom_data_bits", &F::rom_data_bits, "bits", 4, 12,
                     "of a word of the exponent ROM, a fraction of full scale", "ROM_DATA_BITS"),
      choice_setting(
          "datapath", "index_rounding", &F::index_rounding, {"nearest", "truncate"},
          "whether a word of the plain layout stands for the middle or the lower end of its "
          "interval; in the others, always for the middle"),
      choice_setting("datapath", "specular_gate", &F::gate_choice, {"off", "diffuse", "series"},
                     "what keeps highlights off unlit surfaces: nothing, or N·L; the scene decides "
                     "whether its diffuse series can tell or N·L needs a series of its own"),
      choice_setting("datapath", "anchor", &F::anchor, {"triangle", "span"},
                     "where coefficients are rounded to the fraction: once a triangle, as in the "
                     "paper, or at the start of each span"),
      number_setting("framebuffer", "depth_bits", &F::depth_bits, "bits", 8, 30,
                     "of the depth that is kept for each pixel"),
  };
  return all;
}

const Settings<SetupPolicy>& SetupPolicy::settings() {
  using P = SetupPolicy;
  static const Settings<P> all = {
      choice_setting("setup_engine", "series", &P::series_fit, series_fit_names(),
                     "which six numbers a triangle gets: the paper's Taylor series, or a fit"),
      number_setting("setup_engine", "subdivide_degrees", &P::subdivide_degrees, "degrees", 0, 180,
                     "triangles whose normals turn by more are split into four; 0: never"),
      number_setting(
          "setup_engine", "mantissa_bits", &P::mantissa_bits, "bits", 8, kDoubleMantissaBits,
          "of the setup engine's numbers: every operation is rounded to them; 52: double "
          "precision"),
      decimal_setting(
          "setup_engine", "max_error", &P::max_error_thousandths, "LSB", 1000, 0, 255'000,
          "that no pixel exceeds, by proof: each triangle gets the cheapest of Taylor, six-point, "
          "subdivision and exact path; series and subdivide_degrees play no part; 0: no proof"),
  };
  return all;
}

int DatapathConfiguration::serial_digits() const {
  int widest = diffuse_width();
  if (specular) widest = std::max(widest, specular_width());
  if (depth_cue) widest = std::max(widest, kCueWidth);
  return std::max(kLeastDigits, (widest + kDigitBits - 1) / kDigitBits);
}

void DatapathConfiguration::check() const {
  check_settings<FixedPointFormats>(settings(), *this);
  if (specular_width() > kWidestSeries) {
    throw InputError(fmt::format(
        "datapath.specular_fraction_bits = {}: at most {} here, for the narrowest highlight of the "
        "scene takes {} bits above full scale",
        specular_fraction_bits, specular_fraction_bits - (specular_width() - kWidestSeries),
        specular_guard_bits));
  }
  if (channels != 1 && channels != 3) {
    throw InputError(fmt::format("datapath.channels = {}: 1 (grey) or 3 (colour)", channels));
  }
  if (specular && !diffuse && gate == GateSource::diffuse) {
    throw InputError(
        "datapath.specular_gate = \"diffuse\" needs a diffuse series; use \"series\" or \"off\"");
  }
}

void FrameConfiguration::check() const {
  DatapathConfiguration::check();
  check_settings<SetupPolicy>(SetupPolicy::settings(), *this);
  if (!certifies()) return;
  if (mantissa_bits != kDoubleMantissaBits) {
    throw InputError(fmt::format(
        "setup_engine.max_error is proved for mantissa_bits = {}, not {}; leave one of them out",
        kDoubleMantissaBits, mantissa_bits));
  }
  if (max_error_lsb() < least_certified_error_lsb(*this)) {
    throw InputError(fmt::format(
        "setup_engine.max_error = {:g} LSB: the least that can be had is {:g}: output rounding "
        "alone errs by ½; or 0 for no limit",
        max_error_lsb(), std::ceil(1000 * least_certified_error_lsb(*this)) / 1000));
  }
}

RtlParameters rtl_parameters(const DatapathConfiguration& datapath) {
  RtlParameters parameters = {{"CHANNELS", datapath.channels},
                              {"DIFFUSE", datapath.diffuse},
                              {"SPECULAR", datapath.specular},
                              {"DEPTH_CUE", datapath.depth_cue},
                              {"GATE", static_cast<int>(datapath.gate)},
                              {"SPECULAR_GUARD", datapath.specular_guard_bits},
                              {"ROM_LAYOUT", static_cast<int>(datapath.rom_layout)}};
  if (datapath.lanes() > 1) parameters.emplace_back("LANES", datapath.lanes());
  for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
    if (!setting.rtl_parameter.empty()) {
      parameters.emplace_back(setting.rtl_parameter, setting.get(datapath));
    }
  }
  return parameters;
}

std::string parameters_text(const RtlParameters& parameters) {
  std::string text;
  for (const auto& [name, value] : parameters) {
    if (!text.empty()) text += '-';
    text += std::string(name) + "=" + std::to_string(value);
  }
  return text;
}

std::string rtl_parameters_text(const DatapathConfiguration& datapath) {
  const std::string parameters = parameters_text(rtl_parameters(datapath));
  return datapath.kind == DatapathKind::pipelined
             ? parameters
             : std::string(traits(datapath.kind).rtl_module) + "-" + parameters;
}

}  // namespace phongpipe
