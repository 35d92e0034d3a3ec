// RTL of the arithmetic units ≡ integer arithmetic, for every pair of operands of 8 bits and for
// random ones of 16; 1/√x ≡ model for every x.
#include "model/fixed/units.h"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "Varithmetic_units.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

struct Operands {
  std::uint32_t a = 0, b = 0;
};

class UnitsRtl : public ::testing::Test {
 protected:
  // Executes a clock with these operands. Every result that is due then belongs to the operands of
  // as many clocks before as its unit takes.
  void clock(const Operands& operands) {
    fed_.push_front(operands);
    if (fed_.size() > kLongest) fed_.pop_back();
    rtl_.a = static_cast<SData>(operands.a);
    rtl_.b = static_cast<SData>(operands.b);
    edge();
  }
  void edge() {
    rtl_.clk = 0;
    rtl_.eval();
    rtl_.clk = 1;
    rtl_.eval();
  }
  // The operands whose result is there after `clocks` clocks; null if they were not fed.
  const Operands* due(std::size_t clocks) const {
    return fed_.size() >= clocks ? &fed_[clocks - 1] : nullptr;
  }
  void expect_all() const {
    expect(8, rtl_.sum_8, rtl_.product_8, rtl_.quotient_8);
    expect(16, rtl_.sum_16, rtl_.product_16, rtl_.quotient_16);
  }
  void expect(int bits, std::uint32_t sum, std::uint32_t product, std::uint32_t quotient) const {
    const std::uint32_t mask = (1U << bits) - 1;
    const auto as_signed = [bits](std::uint32_t value) {
      return static_cast<std::int64_t>(value << (32 - bits)) << 32 >> (64 - bits);
    };
    if (const Operands* const in = due(2)) {
      ASSERT_EQ(sum, (in->a + in->b) & mask) << in->a << " + " << in->b;
    }
    const auto width = static_cast<std::size_t>(bits);
    if (const Operands* const in = due(width)) {
      const std::uint32_t a = in->a & mask, b = in->b & mask;
      const auto expected = static_cast<std::uint64_t>(as_signed(a) * as_signed(b));
      ASSERT_EQ(product, static_cast<std::uint32_t>(expected) & (bits == 8 ? 0xffffU : ~0U))
          << as_signed(a) << " * " << as_signed(b);
      ASSERT_EQ(quotient, b == 0 ? mask : a / b) << a << " / " << b;
    }
  }

  static constexpr std::size_t kLongest = 16;
  Varithmetic_units rtl_;
  std::deque<Operands> fed_;  // the last ones first
};

TEST_F(UnitsRtl, EveryPairOfEightBits) {
  for (std::uint32_t a = 0; a < 256; ++a) {
    for (std::uint32_t b = 0; b < 256; ++b) {
      clock({a, b});
      expect_all();
      if (HasFatalFailure()) return;
    }
  }
}

TEST_F(UnitsRtl, RandomPairsOfSixteenBits) {
  constexpr std::uint32_t kSeed = 61;
  SCOPED_TRACE(kSeed);
  Random random(kSeed);
  const auto any = [&] {
    // Extremes and small numbers as often as others.
    const double kind = random.uniform(0, 1);
    const auto value = static_cast<std::uint32_t>(random.uniform(0, 65536));
    return kind < 0.1 ? 0x8000U : kind < 0.2 ? 0xffffU : kind < 0.4 ? value & 0xffU : value;
  };
  for (int i = 0; i < 200'000; ++i) {
    clock({any(), any()});
    expect_all();
    if (HasFatalFailure()) return;
  }
}

TEST_F(UnitsRtl, RootsAreTheModels) {
  const RsqrtFormat format;
  const std::vector<RsqrtWord> table = rsqrt_table(format);
  rtl_.table_write = 1;
  for (std::size_t i = 0; i < table.size(); ++i) {
    rtl_.table_address = static_cast<SData>(i);
    rtl_.table_data = table[i].root << format.slope_bits | table[i].slope;
    edge();
  }
  rtl_.table_write = 0;
  const auto latency = static_cast<std::size_t>(format.delta_bits()) + 4;
  double largest_lsb = 0;
  for (std::uint32_t x = 1U << 14; x < (1U << 16) + latency - 1; ++x) {
    clock({x & 0xffffU, 0});
    const Operands* const in = due(latency);
    if (in == nullptr) continue;
    ASSERT_EQ(rtl_.root, rsqrt_word(format, table, in->a)) << in->a;
    const double exact = std::ldexp(1 / std::sqrt(std::ldexp(in->a, -14)), format.width);
    largest_lsb = std::max(largest_lsb, std::fabs(std::min(exact, 65535.0) - rtl_.root));
  }
  EXPECT_LT(largest_lsb, 2);
  EXPECT_GT(largest_lsb, 0.5) << "the bound says nothing";
}

}  // namespace
}  // namespace phongpipe
