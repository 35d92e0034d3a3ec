// The power of Phong's highlight by table: word = specular · x^n, addressed by the integer part of
// the specular series. The address saturates: negative → 0, at or above full scale → the last word.
#pragma once

#include <cstdint>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

class ExponentRom {
 public:
  // One channel's table for highlight colour `specular` (light included, 0 to 1) and exponent n.
  // Words are rounded to nearest and saturate at 2^rom_data_bits − 1.
  ExponentRom(const DatapathConfiguration& configuration, double specular, double shininess);

  const std::vector<std::int32_t>& words() const { return words_; }

  // The address of a specular value of configuration.specular_width() bits.
  static int address(const DatapathConfiguration& configuration, std::int64_t v);

  // The x an entry is computed for (see IndexRounding).
  static double entry_x(const DatapathConfiguration& configuration, int address);

  // Largest |x^n − entry| for x in [0, 1], both as fractions of full scale, without the rounding of
  // words. To first order, with N words: n/(2N) for nearest, n/N for truncated indices.
  static double largest_error(const DatapathConfiguration& configuration, double shininess);

 private:
  std::vector<std::int32_t> words_;
};

}  // namespace phongpipe
