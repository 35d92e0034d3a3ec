// The fewest units with which the setup engine takes at most some cycles, against trying them all.
#include "sim/setup_balance.h"

#include <gtest/gtest.h>

#include "sim/schedule.h"

namespace phongpipe {
namespace {

std::vector<SetupUse> two_plans() {
  SetupUse full, diffuse;
  full.triangles = 30;
  diffuse.triangles = 100;
  diffuse.plan.specular = SeriesForm::absent;
  return {full, diffuse};
}

PipelineConfiguration with_units(int adders, int multipliers, int rsqrt) {
  PipelineConfiguration units;
  units.adders.count = adders;
  units.multipliers.count = multipliers;
  units.rsqrt.count = rsqrt;
  return units;
}

int total(const PipelineConfiguration& units) {
  return units.adders.count + units.multipliers.count + units.rsqrt.count + units.power.count;
}

TEST(SetupBalance, CyclesAreThoseOfAllTriangles) {
  const std::vector<SetupUse> uses = two_plans();
  const PipelineConfiguration units = with_units(2, 3, 1);
  SetupTimes times(units);
  EXPECT_EQ(setup_cycles(uses, units),
            30 * times.of(uses[0].plan).cycles + 100 * times.of(uses[1].plan).cycles);
}

TEST(SetupBalance, FindsTheFewestUnits) {
  const std::vector<SetupUse> uses = two_plans();
  constexpr int kMost = 6;
  for (const PipelineConfiguration& enough :
       {with_units(1, 2, 1), with_units(3, 2, 1), with_units(4, 5, 2)}) {
    const std::int64_t cycles = setup_cycles(uses, enough);
    const auto fewest = fewest_setup_units(uses, PipelineConfiguration(), cycles);
    ASSERT_TRUE(fewest.has_value());
    EXPECT_LE(setup_cycles(uses, *fewest), cycles);
    int least = total(enough);
    for (int adders = 1; adders <= kMost; ++adders) {
      for (int multipliers = 1; multipliers <= kMost; ++multipliers) {
        for (int rsqrt = 1; rsqrt <= 2; ++rsqrt) {
          const PipelineConfiguration units = with_units(adders, multipliers, rsqrt);
          if (total(units) < least && setup_cycles(uses, units) <= cycles) least = total(units);
        }
      }
    }
    EXPECT_EQ(total(*fewest), least);
  }
}

TEST(SetupBalance, OneOfEachSufficesWhereThereIsTime) {
  const auto fewest = fewest_setup_units(two_plans(), PipelineConfiguration(), 1'000'000);
  ASSERT_TRUE(fewest.has_value());
  EXPECT_EQ(total(*fewest), 4);
}

TEST(SetupBalance, NoNumberOfUnitsIsFasterThanTheLongestChain) {
  const std::vector<SetupUse> uses = two_plans();
  const std::int64_t shortest = setup_cycles(uses, with_most_units({}));
  const auto fewest = fewest_setup_units(uses, PipelineConfiguration(), shortest);
  ASSERT_TRUE(fewest.has_value());
  EXPECT_EQ(setup_cycles(uses, *fewest), shortest);
  EXPECT_FALSE(fewest_setup_units(uses, PipelineConfiguration(), shortest - 1).has_value());
}

}  // namespace
}  // namespace phongpipe
