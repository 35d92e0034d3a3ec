#include "model/fixed/exponent_rom.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace phongpipe {
namespace {

// x^n at a distance from the brightest end, in addresses.
class Power {
 public:
  Power(const DatapathConfiguration& configuration, double shininess)
      : addresses_(configuration.rom_addresses()),
        reach_(highlight_reach(configuration, shininess)),
        shininess_(shininess) {}

  double x(double distance) const { return std::max(0.0, 1 - reach_ * distance / addresses_); }
  double operator()(double distance) const { return std::pow(x(distance), shininess_); }

 private:
  int addresses_;
  double reach_, shininess_;
};

// The contents of a table, each word scaled, kept at or below `largest` and passed through `round`.
template <typename Round>
std::vector<double> fill(const DatapathConfiguration& f, double shininess, double scale,
                         double largest, Round round) {
  const Power power(f, shininess);
  std::vector<double> contents(static_cast<std::size_t>(f.rom_words()));
  if (f.rom_layout == RomLayout::plain) {
    for (int i = 0; i < f.rom_words(); ++i) {
      const double x = ExponentRom::entry_x(f, i, shininess);
      contents[static_cast<std::size_t>(i)] =
          round(std::min(scale * std::pow(x, shininess), largest));
    }
    return contents;
  }
  // Values `begin` to `end` of the bits below the leading one, in a block: the middle between the
  // ends of what x^n takes on there.
  const auto middle = [&](int block, int begin, int end) {
    const int leading = block == 0 ? 0 : 1 << f.rom_block_bits();
    const double spacing = block == 0 ? 1 : std::ldexp(1, block - 1);
    const double near = power((leading + begin) * spacing), far = power((leading + end) * spacing);
    return std::min(scale * (near + far) / 2, largest);
  };
  const int blocks = f.rom_octaves + 1;
  if (f.rom_layout == RomLayout::octave) {
    const int size = 1 << f.rom_block_bits();
    for (int i = 0; i < f.rom_words(); ++i) {
      contents[static_cast<std::size_t>(i)] = round(middle(i / size, i % size, i % size + 1));
    }
  } else {
    const int low = f.rom_low_bits(), size = 1 << low;
    const int highs = blocks << (f.rom_block_bits() - 2 * low);  // of all blocks
    for (int h = 0; h < highs; ++h) {
      const int block = h >> (f.rom_block_bits() - 2 * low);
      const int begin = (h << 2 * low) & ((1 << f.rom_block_bits()) - 1);
      const auto wanted = [&](int m, int l) {
        const int below = begin + m * size + l;
        return middle(block, below, below + 1);
      };
      double* const bases = &contents[static_cast<std::size_t>(h * size)];
      double* const increments = bases + f.rom_bases();
      // Both are the middle of what the other leaves: the brightest low value has the largest
      // increment, the last has none.
      for (int l = 0; l < size; ++l) {
        double least = std::numeric_limits<double>::infinity(), most = 0;
        for (int m = 0; m < size; ++m) {
          const double rise = wanted(m, l) - wanted(m, size - 1);
          least = std::min(least, rise);
          most = std::max(most, rise);
        }
        increments[l] = round((least + most) / 2);
      }
      for (int m = 0; m < size; ++m) {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (int l = 0; l < size; ++l) {
          const double rest = wanted(m, l) - increments[l];
          least = std::min(least, rest);
          most = std::max(most, rest);
        }
        bases[m] = std::clamp(round((least + most) / 2), 0.0, largest - increments[0]);
      }
    }
  }
  // What lies beyond the reach reads the last word.
  if (shininess > 0) contents[static_cast<std::size_t>(f.rom_bases() - 1)] = 0;
  return contents;
}

template <typename Value>
std::vector<Value> by_address(const DatapathConfiguration& configuration,
                              const std::vector<Value>& contents) {
  std::vector<Value> words(static_cast<std::size_t>(configuration.rom_addresses()));
  for (std::size_t i = 0; i < words.size(); ++i) {
    const RomPlaces places = ExponentRom::places(configuration, static_cast<int>(i));
    words[i] = contents[places.base] + (places.increment ? contents[*places.increment] : 0);
  }
  return words;
}

}  // namespace

double highlight_reach(const FixedPointFormats& formats, double shininess) {
  if (formats.rom_layout == RomLayout::plain || shininess == 0) return 1;
  constexpr int kFaintestBits = 11;
  const double last_begins = 1 - std::exp2(formats.rom_octaves - formats.rom_address_bits - 1);
  return (1 - std::exp2(-kFaintestBits / shininess)) / last_begins;
}

double ExponentRom::entry_x(const DatapathConfiguration& configuration, int address,
                            double shininess) {
  const double offset = configuration.index_rounding == IndexRounding::nearest ? 0.5 : 0.0;
  const double reach = highlight_reach(configuration, shininess);
  // (address + offset) / addresses with the reach of the plain layout, to the last bit.
  return (1 - reach) + reach * ((address + offset) / configuration.rom_addresses());
}

ExponentRom::ExponentRom(const DatapathConfiguration& configuration, double specular,
                         double shininess) {
  const double full_scale = std::ldexp(kOutputMax, configuration.rom_data_bits - kOutputBits);
  const double largest = (1 << configuration.rom_data_bits) - 1;
  const std::vector<double> contents = fill(configuration, shininess, full_scale * specular,
                                            largest, [](double word) { return std::round(word); });
  contents_.reserve(contents.size());
  for (const double word : contents) contents_.push_back(static_cast<std::int32_t>(word));
  words_ = by_address(configuration, contents_);
}

int ExponentRom::address(const DatapathConfiguration& configuration, std::int64_t v) {
  const std::int64_t index = v >> configuration.specular_fraction_bits;
  return static_cast<int>(
      std::clamp<std::int64_t>(index, 0, std::int64_t{configuration.rom_addresses()} - 1));
}

RomPlaces ExponentRom::places(const DatapathConfiguration& configuration, int address) {
  if (configuration.rom_layout == RomLayout::plain) return {static_cast<std::size_t>(address), {}};
  const int bits = configuration.rom_block_bits();
  int below = configuration.rom_addresses() - 1 - address, block = 0;
  if (below >> bits != 0) {
    for (block = 1; below >> (bits + block) != 0; ++block) {
    }
    below = (below >> (block - 1)) & ((1 << bits) - 1);
  }
  if (configuration.rom_layout == RomLayout::octave) {
    return {static_cast<std::size_t>((block << bits) + below), {}};
  }
  const int low = configuration.rom_low_bits(), first = block << (bits - low);
  const int high = below >> 2 * low, low_value = below & ((1 << low) - 1);
  return {static_cast<std::size_t>(first + (below >> low)),
          static_cast<std::size_t>(configuration.rom_bases() + first + (high << low) + low_value)};
}

std::vector<double> ExponentRom::powers(const DatapathConfiguration& configuration,
                                        double shininess) {
  return by_address(configuration,
                    fill(configuration, shininess, 1, std::numeric_limits<double>::infinity(),
                         [](double word) { return word; }));
}

double ExponentRom::largest_error(const DatapathConfiguration& configuration, double shininess) {
  const Power power(configuration, shininess);
  const std::vector<double> powers = ExponentRom::powers(configuration, shininess);
  const int addresses = configuration.rom_addresses();
  double largest = 0;
  for (int i = 0; i < addresses; ++i) {
    // x^n is monotonic, so the error over an address is largest at one of its ends.
    const double word = powers[static_cast<std::size_t>(i)];
    // What is below the first address reads it, too.
    const double low = i == 0 ? std::pow(0.0, shininess) : power(addresses - i);
    largest =
        std::max({largest, std::fabs(word - low), std::fabs(power(addresses - i - 1) - word)});
  }
  return largest;
}

}  // namespace phongpipe
