// pixel_queue loses and overwrites nothing and cannot deadlock: proved by yosys for any number of
// clocks, with the pipelines of both lengths.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "model/files/text_file.h"
#include "model/fixed/constants.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

// Yosys's verdict by induction. `queue`: the source of pixel_queue.
ProcessOutput prove(int stages, const std::string& queue) {
  std::string connections;
  for (const char* name :
       {"minus_free", "minus_colors", "place_slot", "color_slot", "read_slot", "left"}) {
    connections += fmt::format("connect -set {0} queue.{0}; ", name);
  }
  return run_process(
      {"yosys", "-q", "-p",
       fmt::format("read_verilog -sv -formal -I{} {} {}/testbench/tests/rtl/pixel_queue_proof.sv; "
                   "chparam -set STAGES {} pixel_queue_proof; "
                   "hierarchy -top pixel_queue_proof; proc; flatten; {}memory_map; opt_clean; "
                   "sat -tempinduct -prove-asserts -seq 1 -maxsteps 8 -set-at 1 reset 1'd1 -verify",
                   PHONGPIPE_HARDWARE, queue, PHONGPIPE_SOURCES, stages, connections)});
}

TEST(PixelQueueProof, NothingIsLostOrOverwrittenAndThereIsAlwaysRoomAgain) {
  for (const int depth_cue : {0, kDepthCueLatency}) {
    const ProcessOutput output =
        prove(kDatapathLatency - 2 + depth_cue, PHONGPIPE_HARDWARE "/pixel_queue.sv");
    EXPECT_EQ(output.status, 0) << output.text;
  }
}

// The proof can fail: a queue with a slot fewer than it counts overwrites one, and one that forgets
// pixels that left deadlocks.
TEST(PixelQueueProof, BrokenQueuesAreRejected) {
  const std::string correct = read_whole_file(PHONGPIPE_HARDWARE "/pixel_queue.sv");
  for (const auto& [right, wrong] :
       {std::pair{"minus_free <= {1'b1, {SLOT_BITS{1'b0}}}",
                  "minus_free <= {1'b1, {SLOT_BITS{1'b0}}} - 1'b1"},
        {"left <= pixel_valid && pixel_ready;", "left <= pixel_valid && pixel_ready && room;"}}) {
    std::string text = correct;
    const std::size_t at = text.find(right);
    ASSERT_NE(at, std::string::npos) << right;
    text.replace(at, std::string(right).size(), wrong);
    const std::string file = testing::TempDir() + "pixel_queue_broken.sv";
    write_text(file, text);
    const ProcessOutput output = prove(kDatapathLatency - 2, file);
    EXPECT_NE(output.status, 0);
    EXPECT_NE(output.text.find("proof did fail"), std::string::npos) << output.text;
  }
}

}  // namespace
}  // namespace phongpipe
