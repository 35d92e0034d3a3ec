// stream_checker: where a stream of pixels differs from the model's, for each way to differ.
#include "testbench/cosim/stream_checker.h"

#include <gtest/gtest.h>

#include "model/fixed/prepared_frame.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cases/recorded_model.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {
namespace {

class StreamCheck : public testing::Test {
 protected:
  StreamCheck()
      : hardware_(load_hardware("paper-1k", {})),
        frame_(load_named_scene("screen-triangles", {}), hardware_.formats, hardware_.setup),
        right_(record_model(frame_.setup).stream) {}

  // The checker after a stream, a pixel a cycle.
  StreamChecker checked(const std::vector<ShadedPixel>& stream) const {
    StreamChecker checker(frame_.setup);
    std::int64_t cycle = 0;
    for (const ShadedPixel& pixel : stream) checker.observe(pixel, cycle++);
    checker.finish(cycle);
    return checker;
  }

  Hardware hardware_;
  PreparedFrame frame_;
  std::vector<ShadedPixel> right_;
};

TEST_F(StreamCheck, TheModelsOwnStreamAgrees) {
  const StreamChecker checker = checked(right_);
  EXPECT_EQ(checker.mismatches(), 0U);
  EXPECT_FALSE(checker.first().has_value());
}

TEST_F(StreamCheck, AWrongColorIsTheFirstDifference) {
  std::vector<ShadedPixel> stream = right_;
  stream[500].color ^= 1;
  const StreamChecker checker = checked(stream);
  EXPECT_EQ(checker.mismatches(), 1U);
  const Divergence& first = checker.first().value();
  EXPECT_EQ(first.stream_index, 500U);
  EXPECT_EQ(first.cycle, 500);
  EXPECT_EQ(first.model, right_[500]);
  EXPECT_EQ(first.found, stream[500]);
  EXPECT_FALSE(first.missing || first.extra);
}

TEST_F(StreamCheck, PixelsThatDoNotComeAreMissing) {
  std::vector<ShadedPixel> stream = right_;
  stream.resize(right_.size() - 3);
  const StreamChecker checker = checked(stream);
  EXPECT_EQ(checker.mismatches(), 3U);
  const Divergence& first = checker.first().value();
  EXPECT_TRUE(first.missing);
  EXPECT_EQ(first.stream_index, stream.size());
  EXPECT_EQ(first.model, right_[stream.size()]);
}

TEST_F(StreamCheck, APixelTooManyIsWhereItWasFound) {
  std::vector<ShadedPixel> stream = right_;
  stream.push_back({7, 9, 200});
  const StreamChecker checker = checked(stream);
  EXPECT_EQ(checker.mismatches(), 1U);
  const Divergence& first = checker.first().value();
  EXPECT_TRUE(first.extra);
  EXPECT_EQ(first.stream_index, right_.size());
  EXPECT_EQ(first.model.x, 7);
  EXPECT_EQ(first.model.y, 9);
}

}  // namespace
}  // namespace phongpipe
