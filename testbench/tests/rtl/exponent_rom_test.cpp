// RTL exponent_rom ≡ model, exhaustively: every value of every legal size in every layout.
#include "model/fixed/exponent_rom.h"

#include "model/fixed/fixed_point.h"

#include <gtest/gtest.h>

#include "Vexponent_rom_sizes.h"
#include "testbench/cases/format_range.h"

namespace phongpipe {
namespace {

constexpr int kWordBits = 12;

// A word that tells its address apart from its neighbours'.
std::uint32_t word_at(std::uint32_t address) {
  return (address * 2654435761U >> 7) & 0xfff;
}

class ExponentRomRtl : public ::testing::Test {
 protected:
  ExponentRomRtl() {
    rtl_.write = 1;
    for (std::uint32_t address = 0; address < 8192; ++address) {
      rtl_.write_address = static_cast<SData>(address);
      rtl_.write_word = static_cast<SData>(word_at(address));
      clock();
    }
    rtl_.write = 0;
  }
  void clock() {
    rtl_.clk = 0;
    rtl_.eval();
    rtl_.clk = 1;
    rtl_.eval();
  }
  std::uint32_t word(int bits, RomLayout layout = RomLayout::plain) const {
    const int first = (8 * static_cast<int>(layout) + bits - kMinRomAddressBits) * kWordBits;
    std::uint64_t pair = rtl_.words[first / 32];
    if (first / 32 < 8) pair |= std::uint64_t{rtl_.words[first / 32 + 1]} << 32;
    return static_cast<std::uint32_t>(pair >> (first % 32)) & 0xfff;
  }
  // What the model's address finds. A small table was overwritten by each larger address that ends
  // in the same bits.
  static std::uint32_t expected(int bits, RomLayout layout, std::int64_t v) {
    FrameConfiguration configuration;
    configuration.rom_address_bits = bits;
    configuration.rom_octaves = 1 + bits % 4;
    configuration.rom_layout = layout;
    configuration.specular_fraction_bits = 1;
    const auto address =
        static_cast<std::uint32_t>(ExponentRom::address(configuration, wrap_to(v, bits + 3)));
    if (layout == RomLayout::plain) return word_at((8191U >> bits << bits) | address);
    const RomPlaces places = ExponentRom::places(configuration, static_cast<int>(address));
    const auto at = [](std::size_t place) { return word_at(static_cast<std::uint32_t>(place)); };
    return (at(places.base) + (places.increment ? at(*places.increment) : 0)) & 0xfff;
  }

  Vexponent_rom_sizes rtl_;
};

TEST_F(ExponentRomRtl, EveryValueOfEverySizeFourClocksLater) {
  constexpr std::int64_t kLater = 3;  // values that follow before the word is there
  for (std::int64_t next = 0; next < 65536 + kLater; ++next) {
    rtl_.v = static_cast<SData>(next);
    clock();
    const std::int64_t v = next - kLater;
    if (v < 0) continue;
    for (int bits = kMinRomAddressBits; bits <= kMaxRomAddressBits; ++bits) {
      for (const RomLayout layout : {RomLayout::plain, RomLayout::octave, RomLayout::bipartite}) {
        ASSERT_EQ(word(bits, layout), expected(bits, layout, v))
            << "2^" << bits << " addresses, layout " << static_cast<int>(layout) << ", v " << v;
      }
    }
  }
}

}  // namespace
}  // namespace phongpipe
