// generate_constants: prints hw/constants.svh from model/fixed/constants.h.
#include <fmt/format.h>

#include "model/fixed/constants.h"
#include "model/fixed/datapath_configuration.h"

int main() {
  using namespace phongpipe;
  fmt::print("// Generated from model/fixed/constants.h by scripts/generate.sh; do not edit.\n");
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
  define("MIN_DIFFUSE_FRACTION", kMinDiffuseFraction);
  define("MAX_DIFFUSE_FRACTION", kMaxDiffuseFraction);
  define("MIN_SPECULAR_FRACTION", kMinSpecularFraction);
  define("MAX_SPECULAR_FRACTION", kMaxSpecularFraction);
  define("MIN_ROM_ADDRESS_BITS", kMinRomAddressBits);
  define("MAX_ROM_ADDRESS_BITS", kMaxRomAddressBits);
  define("MIN_ROM_DATA_BITS", kMinRomDataBits);
  define("MAX_ROM_DATA_BITS", kMaxRomDataBits);
}
