#include "model/fixed/exponent_rom.h"

#include <algorithm>
#include <cmath>

namespace phongpipe {

double ExponentRom::entry_x(const DatapathConfiguration& configuration, int address) {
  const double offset = configuration.index_rounding == IndexRounding::nearest ? 0.5 : 0.0;
  return (address + offset) / configuration.rom_words();
}

ExponentRom::ExponentRom(const DatapathConfiguration& configuration, double specular,
                         double shininess) {
  const double full_scale = std::ldexp(kOutputMax, configuration.rom_data_bits - kOutputBits);
  const double largest = (1 << configuration.rom_data_bits) - 1;
  words_.resize(static_cast<std::size_t>(configuration.rom_words()));
  for (int i = 0; i < configuration.rom_words(); ++i) {
    const double word = full_scale * specular * std::pow(entry_x(configuration, i), shininess);
    words_[static_cast<std::size_t>(i)] =
        static_cast<std::int32_t>(std::min(std::round(word), largest));
  }
}

int ExponentRom::address(const DatapathConfiguration& configuration, std::int64_t v) {
  const std::int64_t index = v >> configuration.specular_fraction_bits;
  return static_cast<int>(
      std::clamp<std::int64_t>(index, 0, std::int64_t{configuration.rom_words()} - 1));
}

double ExponentRom::largest_error(const DatapathConfiguration& configuration, double shininess) {
  const int words = configuration.rom_words();
  double largest = 0;
  for (int i = 0; i < words; ++i) {
    // x^n is monotonic, so the error over an interval is largest at one of its ends.
    const double entry = std::pow(entry_x(configuration, i), shininess);
    const double low = std::pow(static_cast<double>(i) / words, shininess);
    const double high = std::pow(static_cast<double>(i + 1) / words, shininess);
    largest = std::max({largest, std::fabs(entry - low), std::fabs(high - entry)});
  }
  return largest;
}

}  // namespace phongpipe
