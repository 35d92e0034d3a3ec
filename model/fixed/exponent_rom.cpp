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

// Computes the contents of a table: each word is scaled, kept at or below `largest`, and passed
// through `round`.
template <typename Round>
class TableContents {
 public:
  TableContents(const DatapathConfiguration& configuration, double shininess, double scale,
                double largest, Round round)
      : f_(configuration),
        largest_(largest),
        round_(round),
        contents_(static_cast<std::size_t>(configuration.rom_words())) {
    if (f_.rom_layout == RomLayout::plain) {
      for (int i = 0; i < f_.rom_words(); ++i) {
        const double x = ExponentRom::entry_x(f_, i, shininess);
        word(i) = round_(std::min(scale * std::pow(x, shininess), largest_));
      }
      return;
    }
    compute_wanted(Power(configuration, shininess), scale);
    for (int block = 0; block <= f_.rom_octaves; ++block) {
      if (f_.rom_layout == RomLayout::octave) {
        fill_block(block);
      } else {
        for (int high = 0; high < highs(); ++high) fill_high(block, high);
      }
    }
    // What lies beyond the reach reads the last word.
    if (shininess > 0) word(f_.rom_bases() - 1) = 0;
  }

  std::vector<double> take() { return std::move(contents_); }

 private:
  double& word(int place) { return contents_[static_cast<std::size_t>(place)]; }
  int low_values() const { return 1 << f_.rom_low_bits(); }  // and middle ones, if bipartite
  int highs() const { return 1 << (f_.rom_block_bits() - 2 * f_.rom_low_bits()); }

  // What addresses should read, by their block and their bits below the leading one: the middle
  // between the ends of the values of x^n.
  void compute_wanted(const Power& power, double scale) {
    for (int block = 0; block <= f_.rom_octaves; ++block) {
      const int size = 1 << f_.rom_block_bits(), leading = block == 0 ? 0 : size;
      const double spacing = block == 0 ? 1 : std::ldexp(1, block - 1);
      double near = power(leading * spacing);
      for (int below = 0; below < size; ++below) {
        const double far = power((leading + below + 1) * spacing);
        wanted_.push_back(std::min(scale * (near + far) / 2, largest_));
        near = far;
      }
    }
  }
  double wanted(int block, int below) const {
    const int place = (block << f_.rom_block_bits()) + below;
    return wanted_[static_cast<std::size_t>(place)];
  }

  void fill_block(int block) {
    const int size = 1 << f_.rom_block_bits();
    for (int i = 0; i < size; ++i) word(block * size + i) = round_(wanted(block, i));
  }

  // Bases and increments of one high value. Both are the middle of what the other leaves: the
  // increments of the differences from the last low value, the faintest, which has none.
  void fill_high(int block, int high) {
    const int size = low_values(), first = (block * highs() + high) * size;
    const auto at = [&](int middle, int low) {
      return wanted(block, (high * size + middle) * size + low);
    };
    const auto middle_of = [size](auto value) {
      double least = value(0), most = least;
      for (int i = 1; i < size; ++i) {
        least = std::min(least, value(i));
        most = std::max(most, value(i));
      }
      return (least + most) / 2;
    };
    double* const increments = &word(f_.rom_bases() + first);
    for (int low = 0; low < size; ++low) {
      increments[low] = round_(middle_of([&](int m) { return at(m, low) - at(m, size - 1); }));
    }
    for (int m = 0; m < size; ++m) {
      const double base = middle_of([&](int low) { return at(m, low) - increments[low]; });
      word(first + m) = std::clamp(round_(base), 0.0, largest_ - increments[0]);
    }
  }

  const DatapathConfiguration& f_;
  double largest_;
  Round round_;
  std::vector<double> wanted_;  // of the octave layouts
  std::vector<double> contents_;
};

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
  const bool lower_end = configuration.index_rounding == IndexRounding::truncate &&
                         configuration.rom_layout == RomLayout::plain;
  const double offset = lower_end ? 0 : 0.5;
  const double reach = highlight_reach(configuration, shininess);
  // (address + offset) / addresses with the reach of the plain layout, to the last bit.
  return (1 - reach) + reach * ((address + offset) / configuration.rom_addresses());
}

ExponentRom::ExponentRom(const DatapathConfiguration& configuration, double specular,
                         double shininess) {
  const double full_scale = std::ldexp(kOutputMax, configuration.rom_data_bits - kOutputBits);
  const double largest = (1 << configuration.rom_data_bits) - 1;
  const auto round = [](double word) { return std::round(word); };
  const std::vector<double> contents =
      TableContents(configuration, shininess, full_scale * specular, largest, round).take();
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
  const auto as_it_is = [](double word) { return word; };
  constexpr double kAny = std::numeric_limits<double>::infinity();
  return by_address(configuration,
                    TableContents(configuration, shininess, 1, kAny, as_it_is).take());
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
