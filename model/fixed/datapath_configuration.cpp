#include "model/fixed/datapath_configuration.h"

#include <fmt/format.h>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

void require_range(const char* name, int value, int low, int high, const char* reason) {
  if (value < low || value > high) {
    throw InputError(
        fmt::format("{} = {} is out of range: {} to {} ({})", name, value, low, high, reason));
  }
}

}  // namespace

void DatapathConfiguration::check() const {
  if (channels != 1 && channels != 3) {
    throw InputError(fmt::format("datapath.channels = {}: 1 (grey) or 3 (colour)", channels));
  }
  require_range("datapath.diffuse_fraction_bits", diffuse_fraction_bits, kMinDiffuseFraction,
                kMaxDiffuseFraction, "more would not fit the 64-bit start of a span");
  require_range("datapath.specular_fraction_bits", specular_fraction_bits, kMinSpecularFraction,
                kMaxSpecularFraction, "more would not fit the 64-bit start of a span");
  require_range("datapath.rom_address_bits", rom_address_bits, kMinRomAddressBits,
                kMaxRomAddressBits, "64 to 8192 words");
  require_range("datapath.rom_data_bits", rom_data_bits, kMinRomDataBits, kMaxRomDataBits,
                "a word is a fraction of full scale");
  require_range("setup_engine.subdivide_degrees", subdivide_degrees, 0, 180, "0: never");
  if (specular && !diffuse && gate == GateSource::diffuse) {
    throw InputError(
        "datapath.specular_gate = \"diffuse\" needs a diffuse series; use \"series\" or \"off\"");
  }
}

}  // namespace phongpipe
