#include "testbench/rtl/superset.h"

#include <algorithm>

namespace phongpipe {

DatapathConfiguration superset_of(const DatapathConfiguration& configuration) {
  DatapathConfiguration wide = configuration;
  if (configuration.kind == DatapathKind::serial) return wide;
  for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
    if (setting.rtl_parameter.empty()) continue;
    // Words of the table end at the output's LSB from above and cannot be shifted; in the octave
    // layouts, addresses cannot.
    if (setting.rtl_parameter == "ROM_DATA_BITS" || setting.rtl_parameter == "ROM_OCTAVES") {
      continue;
    }
    if (setting.rtl_parameter == "ROM_ADDRESS_BITS" &&
        configuration.rom_layout != RomLayout::plain) {
      continue;
    }
    setting.put(wide, setting.high);
  }
  wide.specular_fraction_bits -= std::max(0, wide.specular_width() - kWidestSeries);
  return wide;
}

RtlAlignment superset_alignment(const DatapathConfiguration& configuration) {
  const DatapathConfiguration wide = superset_of(configuration);
  return {wide.diffuse_width() - configuration.diffuse_width(),
          wide.specular_width() - configuration.specular_width(),
          wide.rom_address_bits - configuration.rom_address_bits};
}

}  // namespace phongpipe
