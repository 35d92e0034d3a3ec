// The scalar that records: operation counts are measured by running the formulas, so it must count
// what is executed, no more and no less, and know what depends on what.
#include "model/shading/dataflow.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

#include "model/shading/triangle_setup.h"
#include "sim/schedule.h"

namespace phongpipe {
namespace {

void expect_counts(const Dataflow& dataflow, std::size_t add, std::size_t multiply,
                   std::size_t rsqrt) {
  const OperationCounts counts = dataflow.counts();
  EXPECT_EQ(counts.add, add);
  EXPECT_EQ(counts.multiply, multiply);
  EXPECT_EQ(counts.rsqrt, rsqrt);
  EXPECT_EQ(dataflow.nodes.size(), add + multiply + rsqrt);
}

TEST(Dataflow, CountsWhatIsExecuted) {
  Recording recording;
  const Recorded a = 2.0, b, c;
  Recorded sum = a * b - c;
  sum += rsqrt(a) * b;
  sum *= c;
  sum -= b;
  expect_counts(recording.dataflow(), 3, 3, 1);
}

TEST(Dataflow, SignsAndPowersOfTwoAreFree) {
  Recording recording;
  const Recorded a;
  (void)half(twice(-a));
  expect_counts(recording.dataflow(), 0, 0, 0);
}

TEST(Dataflow, APowerIsOneOperationWhateverItsExponent) {
  Recording recording;
  const Recorded a, p;
  (void)power(a, p);
  (void)power(a, Recorded(7));
  const OperationCounts counts = recording.dataflow().counts();
  EXPECT_EQ(counts.power, 2U);
  EXPECT_EQ(recording.dataflow().nodes.size(), 2U);
  EXPECT_EQ((counts + counts - counts).power, 2U);
}

TEST(Dataflow, ADotProductIsThreeProductsAndTwoSums) {
  Recording recording;
  const Vector3<Recorded> a, b;
  (void)a.dot(b);
  expect_counts(recording.dataflow(), 2, 3, 0);
}

TEST(Dataflow, AQuadraticIsFiveAndFive) {
  Recording recording;
  const Quadratic<Recorded> t{};
  (void)t(Recorded(), Recorded());
  expect_counts(recording.dataflow(), 5, 5, 0);
}

TEST(Dataflow, KnowsWhatDependsOnWhat) {
  Recording recording;
  const Recorded a, b;
  const Recorded product = a * b;        // 0
  const Recorded root = rsqrt(product);  // 1
  const Recorded copy = -half(root);
  (void)(copy + product);  // 2
  (void)(a + 1.0);         // 3
  const std::vector<Dataflow::Node>& nodes = recording.dataflow().nodes;
  ASSERT_EQ(nodes.size(), 4U);
  const auto expect_node = [&nodes](std::size_t i, Operation operation, int left, int right) {
    EXPECT_EQ(nodes[i].operation, operation) << "node " << i;
    EXPECT_EQ(nodes[i].left, left) << "node " << i;
    EXPECT_EQ(nodes[i].right, right) << "node " << i;
  };
  expect_node(0, Operation::multiply, Dataflow::kInput, Dataflow::kInput);
  expect_node(1, Operation::rsqrt, 0, Dataflow::kInput);
  expect_node(2, Operation::add, 1, 0);
  expect_node(3, Operation::add, Dataflow::kInput, Dataflow::kInput);
}

TEST(Dataflow, IsRecordedOnceAtATimeAndOnlyInARecording) {
  const Recorded a, b;
  EXPECT_THROW((void)(a + b), std::logic_error);
  {
    Recording recording;
    EXPECT_THROW(Recording(), std::logic_error);
    EXPECT_NO_THROW((void)(a + b));
  }
  EXPECT_THROW((void)(a * b), std::logic_error);
  Recording again;
  expect_counts(again.dataflow(), 0, 0, 0);
}

TEST(Dataflow, OfTheSetupIsTheSameInEveryRun) {
  for (const bool local_viewer : {false, true}) {
    for (const bool gate_series : {false, true}) {
      for (const int channels : {1, 3}) {
        SeriesPlan plan;
        plan.channels = channels;
        plan.gate = gate_series ? SeriesForm::fitted : SeriesForm::absent;
        plan.form.local_viewer = local_viewer;
        const Dataflow first = record_setup(plan), second = record_setup(plan);
        ASSERT_EQ(first.nodes.size(), second.nodes.size());
        for (std::size_t i = 0; i < first.nodes.size(); ++i) {
          EXPECT_EQ(first.nodes[i].operation, second.nodes[i].operation);
          EXPECT_EQ(first.nodes[i].left, second.nodes[i].left);
          EXPECT_EQ(first.nodes[i].right, second.nodes[i].right);
          // A node can only use what is computed before it.
          EXPECT_LT(first.nodes[i].left, static_cast<int>(i));
          EXPECT_LT(first.nodes[i].right, static_cast<int>(i));
        }
      }
    }
  }
}

TEST(Dataflow, OfTheSetupGrowsByWhatThePlanAsksFor) {
  const auto counts = [](auto change) {
    SeriesPlan plan;
    change(plan);
    return record_setup(plan).counts();
  };
  const OperationCounts grey = counts([](SeriesPlan&) {});
  const OperationCounts color = counts([](SeriesPlan& plan) { plan.channels = 3; });
  const OperationCounts gated = counts([](SeriesPlan& plan) { plan.gate = SeriesForm::fitted; });
  const OperationCounts local = counts([](SeriesPlan& plan) { plan.form.local_viewer = true; });
  // Every further channel, and the gate, is the same series times another scale.
  EXPECT_EQ(color.multiply - grey.multiply, 12U);
  EXPECT_EQ(color.add, grey.add);
  EXPECT_EQ(gated.multiply - grey.multiply, 6U);
  EXPECT_EQ(gated.add, grey.add);
  // 1/|det| and 1/|C|; a finite eye needs 1/|E| at three corners and 1/|F|, too.
  EXPECT_EQ(grey.rsqrt, 2U);
  EXPECT_EQ(local.rsqrt, 6U);
  EXPECT_GT(local.add, grey.add);
  EXPECT_GT(local.multiply, grey.multiply);
}

}  // namespace
}  // namespace phongpipe
