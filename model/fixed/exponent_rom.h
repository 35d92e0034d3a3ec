// The power of Phong's highlight by table: word = specular · x^n, addressed by the integer part of
// the specular series, which saturates: negative → 0, at or above full scale → the last address.
//
// The series stands for x = 1 − reach (1 − v / 2^rom_address_bits). In the plain layout of the
// paper the reach is 1, v is x itself, and each address has a word of its own. In the octave
// layouts the reach is such that x^n falls to 1/2048, ⅛ LSB, where the last word
// begins, which is 0: so many words serve every shininess alike. What is beyond the reach reads
// that word.
//
//   octave     c = 2^rom_address_bits − 1 − address counts from the brightest. An octave of c, from
//              2^k to before 2^(k+1), has 2^(rom_address_bits − rom_octaves) words, as has all
//              below the lowest.
//   bipartite  as octave, with the bits of c below its leading one split into high, middle and low:
//              the word is base[block, high, middle] + increment[block, high, low].
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// Shininess that the octave layouts hold, besides 0.
constexpr double kLeastShininess = 0.5, kMostShininess = 10'000;

// The 1 − x that full scale of the specular series stands for.
double highlight_reach(const FixedPointFormats& formats, double shininess);

// Where the words of an address are in ExponentRom::contents().
struct RomPlaces {
  std::size_t base = 0;
  std::optional<std::size_t> increment;  // in the bipartite layout
};

class ExponentRom {
 public:
  // One channel's table for highlight colour `specular` (light included, 0 to 1) and exponent n.
  // Words are rounded to nearest and saturate at 2^rom_data_bits − 1, increments included.
  ExponentRom(const DatapathConfiguration& configuration, double specular, double shininess);

  // What each address reads, increments added.
  const std::vector<std::int32_t>& words() const { return words_; }
  // What the hardware's memories hold, in the order in which it is loaded: rom_words() words.
  const std::vector<std::int32_t>& contents() const { return contents_; }

  // The address of a specular value of configuration.specular_width() bits.
  static int address(const DatapathConfiguration& configuration, std::int64_t v);
  static RomPlaces places(const DatapathConfiguration& configuration, int address);

  // The x in the middle of an address, or at its lower end in the plain layout (see IndexRounding).
  static double entry_x(const DatapathConfiguration& configuration, int address, double shininess);

  // What each address reads, without the rounding of words and with `specular` 1.
  static std::vector<double> powers(const DatapathConfiguration& configuration, double shininess);

  // Largest |x^n − power| for x in [0, 1], both as fractions of full scale, without the rounding of
  // words. To first order, with N words: n/(2N) for nearest, n/N for truncated indices of a plain
  // table.
  static double largest_error(const DatapathConfiguration& configuration, double shininess);

 private:
  std::vector<std::int32_t> contents_, words_;
};

}  // namespace phongpipe
