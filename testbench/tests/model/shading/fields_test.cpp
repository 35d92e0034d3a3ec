// Records whose fields are named once: a forgotten member is noticed, and what is named travels.
#include "model/shading/fields.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "sim/pipeline.h"
#include "testbench/cosim/implementation_result.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

struct Whole {
  int a = 0;
  std::string b;
  std::optional<double> c;
  static constexpr auto fields() {
    return std::make_tuple(field("a", &Whole::a), field("b", &Whole::b), field("c", &Whole::c));
  }
};

struct Forgetful {
  int a = 0;
  std::string b;
  std::optional<double> c;
  static constexpr auto fields() {
    return std::make_tuple(field("a", &Forgetful::a), field("c", &Forgetful::c));
  }
};

TEST(Fields, AForgottenMemberIsNoticed) {
  static_assert(names_every_field<Whole>());
  static_assert(!names_every_field<Forgetful>());
  static_assert(names_every_field<SimulationCounts>());
  static_assert(names_every_field<ImplementationResult>());
}

TEST(Fields, RecordsAreEqualWhereAllMembersAre) {
  const Whole record = {1, "x", 2.5};
  EXPECT_TRUE(equal_fields(record, Whole{1, "x", 2.5}));
  EXPECT_FALSE(equal_fields(record, Whole{2, "x", 2.5}));
  EXPECT_FALSE(equal_fields(record, Whole{1, "y", 2.5}));
  EXPECT_FALSE(equal_fields(record, Whole{1, "x", std::nullopt}));
}

TEST(Fields, RecordsTravelAsBytes) {
  ImplementationResult sent;
  sent.counts.datapath_busy_cycles = std::numeric_limits<std::int64_t>::max();
  sent.counts.setup_operations.power = 3;
  sent.counts.pixel_operations.reads = 4;
  sent.counts.modules = {"a", "b"};
  sent.fingerprint.stream_hash = std::numeric_limits<std::uint64_t>::max();
  sent.processor_seconds = 0.1;
  sent.first_divergence = Divergence{5, 4, 6, 7, {8, 9, 10}, {11, 12, 13}, true};
  const auto received = from_bytes<ImplementationResult>(to_bytes(sent));
  EXPECT_EQ(nlohmann::json(received), nlohmann::json(sent));
  EXPECT_EQ(received.first_divergence->found.color, 13U);
  EXPECT_FALSE(from_bytes<ImplementationResult>(to_bytes(ImplementationResult()))
                   .first_divergence.has_value());
}

}  // namespace
}  // namespace phongpipe
