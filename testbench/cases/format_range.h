// The legal ranges of the formats, from the table of settings.
#pragma once

#include <stdexcept>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

inline const Setting<FixedPointFormats>& format_setting(std::string_view key) {
  for (const Setting<FixedPointFormats>& setting : FixedPointFormats::settings()) {
    if (setting.key == key) return setting;
  }
  throw std::logic_error("no such setting");
}

inline const int kMinDiffuseFraction = format_setting("diffuse_fraction_bits").low;
inline const int kMaxDiffuseFraction = format_setting("diffuse_fraction_bits").high;
inline const int kMinSpecularFraction = format_setting("specular_fraction_bits").low;
inline const int kMaxSpecularFraction = format_setting("specular_fraction_bits").high;
inline const int kMinRomAddressBits = format_setting("rom_address_bits").low;
inline const int kMaxRomAddressBits = format_setting("rom_address_bits").high;
inline const int kMinRomDataBits = format_setting("rom_data_bits").low;
inline const int kMaxRomDataBits = format_setting("rom_data_bits").high;

}  // namespace phongpipe
