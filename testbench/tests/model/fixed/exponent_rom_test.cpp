// The power of Phong's highlight by table: every word, every corner of its address, and the
// accuracy figures of NUMERICS section 6.
#include "model/fixed/exponent_rom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "testbench/cases/format_range.h"

namespace phongpipe {
namespace {

FrameConfiguration table(int address_bits, int data_bits = 8,
                         IndexRounding rounding = IndexRounding::nearest) {
  FrameConfiguration configuration;
  configuration.rom_address_bits = address_bits;
  configuration.rom_data_bits = data_bits;
  configuration.index_rounding = rounding;
  return configuration;
}

// 2^data_bits · 255/256 is full scale: a word is in units of 2^−(data_bits − 8) output LSB.
long double exact_word(const FrameConfiguration& c, double specular, double n, int address) {
  const long double offset = c.index_rounding == IndexRounding::nearest ? 0.5L : 0.0L;
  const long double x = (address + offset) / (1L << c.rom_address_bits);
  return 255.0L / 256 * (1L << c.rom_data_bits) * specular * std::pow(x, (long double){n});
}

void expect_every_word(const FrameConfiguration& c, double specular, double n) {
  const ExponentRom rom(c, specular, n);
  ASSERT_EQ(rom.words().size(), std::size_t{1} << c.rom_address_bits);
  const std::int32_t largest = (1 << c.rom_data_bits) - 1;
  int wrong = 0;
  for (int i = 0; i < c.rom_words(); ++i) {
    const long double exact = exact_word(c, specular, n, i);
    const auto expected =
        static_cast<std::int32_t>(std::min(std::round(exact), (long double){1.0} * largest));
    if (rom.words()[static_cast<std::size_t>(i)] == expected) continue;
    if (++wrong > 3) return;
    ADD_FAILURE() << "word " << i << " is " << rom.words()[static_cast<std::size_t>(i)]
                  << ", exactly " << static_cast<double>(exact) << "; " << c.rom_address_bits
                  << " address bits, " << c.rom_data_bits << " data bits, specular " << specular
                  << ", n " << n;
  }
}

TEST(ExponentRom, EveryWordOfEverySizeIsRounded) {
  for (int address_bits = kMinRomAddressBits; address_bits <= kMaxRomAddressBits; ++address_bits) {
    for (int data_bits = kMinRomDataBits; data_bits <= kMaxRomDataBits; ++data_bits) {
      for (const IndexRounding rounding : {IndexRounding::nearest, IndexRounding::truncate}) {
        const FrameConfiguration c = table(address_bits, data_bits, rounding);
        for (const double n : {1.0, 20.0, 164.0}) {
          expect_every_word(c, 1, n);
          expect_every_word(c, 0.3125, n);  // exact: 0.3 would be decided by its own rounding
        }
      }
    }
  }
}

TEST(ExponentRom, WordsSaturateAboveFullScale) {
  const FrameConfiguration c = table(8, 8);
  const ExponentRom rom(c, 2.5, 1);
  EXPECT_EQ(rom.words().back(), 255);
  EXPECT_EQ(rom.words()[0], 1);  // 255 · 2.5 · 0.5/256 = 1.25
  expect_every_word(c, 2.5, 1);
}

TEST(ExponentRom, WithoutExponentEveryWordIsFullScale) {
  for (const IndexRounding rounding : {IndexRounding::nearest, IndexRounding::truncate}) {
    const ExponentRom rom(table(6, 12, rounding), 1, 0);
    for (const std::int32_t word : rom.words()) EXPECT_EQ(word, 4080);
  }
}

TEST(ExponentRom, AddressSaturatesAtTheExtremesOfEveryFormat) {
  for (int address_bits = kMinRomAddressBits; address_bits <= kMaxRomAddressBits; ++address_bits) {
    for (int fraction = kMinSpecularFraction; fraction <= kMaxSpecularFraction; ++fraction) {
      FrameConfiguration c = table(address_bits);
      c.specular_fraction_bits = fraction;
      const std::int64_t full_scale = std::int64_t{1} << (address_bits + fraction);
      const std::int64_t one = std::int64_t{1} << fraction;  // address
      const std::int64_t beyond = std::int64_t{1} << (c.specular_width() - 1);
      const int last = c.rom_words() - 1;
      const auto expect_address = [&](std::int64_t v, int expected) {
        EXPECT_EQ(ExponentRom::address(c, v), expected)
            << "v = " << v << ", " << address_bits << " address bits, " << fraction << " fraction";
      };
      EXPECT_EQ(beyond, 2 * full_scale) << "one guard bit";
      expect_address(-beyond, 0);
      expect_address(-1, 0);
      expect_address(0, 0);
      expect_address(one - 1, 0);
      expect_address(one, 1);
      expect_address(full_scale - one - 1, last - 1);
      expect_address(full_scale - one, last);
      expect_address(full_scale - 1, last);
      expect_address(full_scale, last);
      expect_address(beyond - 1, last);
    }
  }
}

TEST(ExponentRom, LargestErrorsAreThoseOfTheAnalysis) {
  const auto percent = [](int address_bits, double n, IndexRounding rounding) {
    return 100 * ExponentRom::largest_error(table(address_bits, 8, rounding), n);
  };
  // To the digits shown there.
  EXPECT_NEAR(percent(10, 20, IndexRounding::nearest), 0.972, 0.0005);
  EXPECT_NEAR(percent(13, 164, IndexRounding::nearest), 0.996, 0.0005);
  EXPECT_NEAR(percent(10, 20, IndexRounding::truncate), 1.94, 0.005);
  EXPECT_NEAR(percent(13, 164, IndexRounding::truncate), 1.98, 0.005);
  EXPECT_NEAR(percent(13, 200, IndexRounding::nearest), 1.2, 0.05);
  EXPECT_NEAR(percent(13, 10000, IndexRounding::nearest), 46, 0.5);
}

TEST(ExponentRom, LargestErrorIsWhatADenseSamplingFinds) {
  for (const int address_bits : {6, 8, 10}) {
    for (const double n : {0.5, 1.0, 20.0, 164.0}) {
      for (const IndexRounding rounding : {IndexRounding::nearest, IndexRounding::truncate}) {
        const FrameConfiguration c = table(address_bits, 8, rounding);
        const double bound = ExponentRom::largest_error(c, n);
        const int words = c.rom_words();
        double sampled = 0;
        for (int i = 0; i < words; ++i) {
          const double entry = std::pow(ExponentRom::entry_x(c, i, n), n);
          for (int k = 0; k <= 16; ++k) {  // up to a whisker below the next interval
            const double x = (i + std::min(k / 16.0, 1 - 1e-9)) / words;
            sampled = std::max(sampled, std::fabs(std::pow(x, n) - entry));
          }
        }
        const std::string which =
            std::to_string(address_bits) + " address bits, n = " + std::to_string(n);
        EXPECT_LE(sampled, bound) << which;
        EXPECT_GE(sampled, bound * (1 - 1e-6)) << which;
      }
    }
  }
}

FrameConfiguration laid_out(RomLayout layout, int address_bits, int octaves, int data_bits = 12) {
  FrameConfiguration configuration = table(address_bits, data_bits);
  configuration.rom_layout = layout;
  configuration.rom_octaves = octaves;
  return configuration;
}

// Largest error in LSB of the words that an x reads, over x in [0, 1]: at both ends of what each
// address stands for.
double error_of_words(const FrameConfiguration& c, double n) {
  const ExponentRom rom(c, 1, n);
  const double reach = highlight_reach(c, n);
  double largest = 0;
  for (int address = 0; address < c.rom_addresses(); ++address) {
    const double word =
        std::ldexp(rom.words()[static_cast<std::size_t>(address)], kOutputBits - c.rom_data_bits);
    for (const int end : {0, 1}) {
      const double u =
          address + end == 0 ? 0 : (address + end) / static_cast<double>(c.rom_addresses());
      const double x = u == 0 ? 0 : std::max(0.0, 1 - reach * (1 - u));
      largest = std::max(largest, std::fabs(word - kOutputMax * std::pow(x, n)));
    }
  }
  return largest;
}

constexpr double kShininesses[] = {1, 1.5, 2, 5, 20, 50, 164, 500, 1000, 3000, 10'000};

TEST(OctaveRom, HoldsEveryShininessWithinAFifthOfAnLsb) {
  const FrameConfiguration c = laid_out(RomLayout::bipartite, 13, 4);
  EXPECT_EQ(c.rom_words(), 640);
  double largest = 0;
  for (const double n : kShininesses) {
    EXPECT_LT(error_of_words(c, n), 0.2) << n;
    largest = std::max(largest, error_of_words(c, n));
  }
  EXPECT_GT(largest, 0.15) << "or the bound says little";
}

// The paper's table of 8k words errs by 2.56 LSB at its own shininess.
TEST(OctaveRom, ASixtyFourthOfThePapersWordsIsAsGood) {
  const double paper = error_of_words(table(13, 12), 164);
  EXPECT_NEAR(paper, 2.55, 0.05);
  const FrameConfiguration small = laid_out(RomLayout::bipartite, 9, 3);
  EXPECT_EQ(small.rom_words(), 8192 / 64);
  for (const double n : kShininesses) EXPECT_LT(error_of_words(small, n), paper) << n;
}

TEST(OctaveRom, OneTableIsAsGoodAsStated) {
  const FrameConfiguration c = laid_out(RomLayout::octave, 10, 4);
  EXPECT_EQ(c.rom_words(), 320);
  for (const double n : kShininesses) EXPECT_LT(error_of_words(c, n), 1.1) << n;
}

TEST(OctaveRom, WordsFallFromFullScaleToZeroAndNeverWrap) {
  for (const RomLayout layout : {RomLayout::octave, RomLayout::bipartite}) {
    for (int address_bits = kMinRomAddressBits; address_bits <= kMaxRomAddressBits;
         ++address_bits) {
      for (int octaves = 1; octaves <= 4; ++octaves) {
        for (const int data_bits : {kMinRomDataBits, 8, kMaxRomDataBits}) {
          const FrameConfiguration c = laid_out(layout, address_bits, octaves, data_bits);
          for (const double specular : {0.3, 1.0, 2.5}) {
            for (const double n : {0.5, 20.0, 10'000.0}) {
              const ExponentRom rom(c, specular, n);
              ASSERT_EQ(rom.contents().size(), static_cast<std::size_t>(c.rom_words()));
              const int most = (1 << data_bits) - 1;
              for (const std::int32_t word : rom.words()) ASSERT_TRUE(word >= 0 && word <= most);
              for (const std::int32_t word : rom.contents()) ASSERT_TRUE(word >= 0 && word <= most);
              ASSERT_EQ(rom.words().front(), 0);
              ASSERT_EQ(rom.words().back(),
                        *std::max_element(rom.words().begin(), rom.words().end()));
            }
          }
        }
      }
    }
  }
}

TEST(OctaveRom, WithoutExponentEveryWordIsFullScale) {
  for (const RomLayout layout : {RomLayout::octave, RomLayout::bipartite}) {
    const ExponentRom rom(laid_out(layout, 9, 3), 1, 0);
    for (const std::int32_t word : rom.words()) ASSERT_EQ(word, 4080);
  }
}

// The octave of an address by its definition.
TEST(OctaveRom, AddressesShareWordsByTheirOctave) {
  const FrameConfiguration c = laid_out(RomLayout::octave, 8, 3);  // blocks of 32
  const auto place = [&](int from_brightest) {
    return ExponentRom::places(c, 255 - from_brightest).base;
  };
  for (int i = 0; i < 64; ++i) EXPECT_EQ(place(i), static_cast<std::size_t>(i));
  for (int i = 64; i < 128; ++i) EXPECT_EQ(place(i), static_cast<std::size_t>(64 + (i - 64) / 2));
  for (int i = 128; i < 256; ++i) EXPECT_EQ(place(i), static_cast<std::size_t>(96 + (i - 128) / 4));
}

TEST(OctaveRom, LargestErrorIsThatOfUnroundedWords) {
  for (const RomLayout layout : {RomLayout::octave, RomLayout::bipartite}) {
    const FrameConfiguration c = laid_out(layout, 11, 3);
    const double rounding = layout == RomLayout::octave ? 0.5 : 1;  // units of a word
    for (const double n : kShininesses) {
      const double error = kOutputMax * ExponentRom::largest_error(c, n);
      EXPECT_NEAR(error, error_of_words(c, n), std::ldexp(rounding, -4) + 1e-9) << n;
    }
  }
}

}  // namespace
}  // namespace phongpipe
