// generate_constants: prints hw/constants.svh from model/fixed/constants.h and the table of
// settings.
#include <fmt/format.h>

#include "model/fixed/constants.h"
#include "model/fixed/datapath_configuration.h"

int main() {
  using namespace phongpipe;
  fmt::print("// Generated from model/fixed by scripts/generate.sh; do not edit.\n");
  const auto define = [](const char* name, int value) {
    fmt::print("`define PHONGPIPE_{} {}\n", name, value);
  };
  define("OUTPUT_BITS", kOutputBits);
  define("GUARD_BITS", kGuardBits);
  define("COORDINATE_BITS", kCoordinateBits);
  define("LENGTH_BITS", kLengthBits);
  define("CUE_WIDTH", kCueWidth);
  define("CUE_FRACTION", kCueFraction);
  define("CUE_FACTOR_BITS", kCueFactorBits);
  define("GATE_OFF", static_cast<int>(GateSource::off));
  define("GATE_DIFFUSE", static_cast<int>(GateSource::diffuse));
  define("GATE_SERIES", static_cast<int>(GateSource::series));
  define("LAYOUT_PLAIN", static_cast<int>(RomLayout::plain));
  define("LAYOUT_OCTAVE", static_cast<int>(RomLayout::octave));
  define("LAYOUT_BIPARTITE", static_cast<int>(RomLayout::bipartite));
  define("SPECULAR_GUARD_BITS", kSpecularGuardBits);
  define("DATAPATH_LATENCY", kDatapathLatency);
  define("DEPTH_CUE_LATENCY", kDepthCueLatency);
  define("PIXEL_QUEUE_BITS", kPixelQueueBits);
  define("HIGH_BITS", kHighBits);
  define("DIGIT_BITS", kDigitBits);
  define("LEAST_DIGITS", kLeastDigits);
  define("SERIES_BITS", kSeriesBits);
  define("DIGIT_PLACE_BITS", kDigitPlaceBits);
  // Where a parameter is out of range, elaboration stops in every tool at a module that does not
  // exist and whose name says which parameter it is.
  std::string checks;
  for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
    if (setting.rtl_parameter.empty()) continue;
    checks += fmt::format(
        " \\\n  if ({0} < {1} || {0} > {2}) begin : {0}_out_of_range"
        " \\\n    {0}_must_be_{1}_to_{2} stop (); end",
        setting.rtl_parameter, setting.low, setting.high);
  }
  fmt::print("`define PHONGPIPE_CHECK_PARAMETERS{}\n", checks);
}
