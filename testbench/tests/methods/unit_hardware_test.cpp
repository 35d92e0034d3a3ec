// Hardware for one pixel a clock: the units that the operations need, with the figures of the card.
#include "testbench/methods/unit_hardware.h"

#include <gtest/gtest.h>

#include "testbench/methods/operation_time.h"

namespace phongpipe {
namespace {

MeasuredUnit unit(const char* operation, int luts, double clock_ns) {
  MeasuredUnit unit;
  unit.operation = operation;
  unit.design.luts = luts;
  unit.design.registers = 10 * luts;
  unit.design.block_rams = 1;
  unit.design.clock_ns = clock_ns;
  return unit;
}

TEST(UnitHardware, IsAUnitForEachOperationAtTheClockOfTheSlowest) {
  Technology card;
  card.units = {unit("add", 1, 4), unit("multiply", 10, 6), unit("divide", 100, 9),
                unit("rsqrt", 1000, 5), unit("power", 10'000, 3)};
  OperationCounts pixel;
  pixel.add = 3;
  pixel.multiply = 2;
  pixel.read = 1;
  auto hardware = unit_hardware(pixel, card);
  ASSERT_TRUE(hardware.has_value());
  EXPECT_EQ(hardware->luts, 10'023);
  EXPECT_EQ(hardware->registers, 100'230);
  EXPECT_EQ(hardware->block_rams, 6);
  EXPECT_EQ(hardware->clock_ns, 6);
  EXPECT_EQ(hardware->lut_ns(), 6 * 10'023);
  // x/√y is x · 1/√y; of the two divisions one is left.
  pixel.divide = 2;
  pixel.sqrt = 1;
  hardware = unit_hardware(pixel, card);
  EXPECT_EQ(hardware->luts, 10'023 + 10 + 1000 + 100);
  EXPECT_EQ(hardware->clock_ns, 9);
}

TEST(UnitHardware, TheCardsHaveAllUnits) {
  OperationCounts all;
  all.add = all.multiply = all.divide = all.rsqrt = all.power = 1;
  for (const char* card : {"ice40-hx8k", "ice40-up5k"}) {
    const auto hardware = unit_hardware(all, load_technology(card));
    ASSERT_TRUE(hardware.has_value()) << card;
    EXPECT_GT(hardware->luts, 1000) << card;
  }
  EXPECT_FALSE(unit_hardware(all, load_technology("generic")).has_value());
}

}  // namespace
}  // namespace phongpipe
