// A test of the harness: RTL with a bug must be found out, and at the right pixel.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "model/files/scene_file.h"
#include "model/files/text_file.h"
#include "model/fixed/model_frame.h"
#include "testbench/cases/recorded_model.h"
#include "testbench/reports/verification_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

const fs::path kScene = fs::path(PHONGPIPE_SCENES) / "sphere.toml";

class SeededBug : public ::testing::Test {
 protected:
  SeededBug()
      : folder_(fs::path(::testing::TempDir()) / fmt::format("phongpipe-bug-{}", getpid())),
        hardware_(load_hardware("paper-1k", {})) {
    fs::create_directories(folder_ / "hw");
    for (const auto& entry : fs::directory_iterator(PHONGPIPE_HARDWARE)) {
      if (entry.is_regular_file()) fs::copy(entry.path(), folder_ / "hw");
    }
    // Broken libraries must not stay in the user's cache.
    setenv("XDG_CACHE_HOME", folder_.c_str(), 1);
  }
  ~SeededBug() override { fs::remove_all(folder_); }

  void seed(const std::string& file, const std::string& correct, const std::string& broken) {
    std::string text = read_whole_file(folder_ / "hw" / file);
    const std::size_t at = text.find(correct);
    ASSERT_NE(at, std::string::npos) << file << " has no " << correct;
    write_text(folder_ / "hw" / file, text.replace(at, correct.size(), broken));
  }
  VerificationResult run(Detail detail = Detail::span) {
    VerificationOptions options;
    options.detail = detail;
    options.rtl_sources = folder_ / "hw";
    return verify(load_scene(kScene), hardware_, options);
  }

  fs::path folder_;
  Hardware hardware_;
};

TEST_F(SeededBug, NoneWithoutABug) {
  const VerificationResult v = run();
  EXPECT_EQ(v.rtl->stream_mismatches, 0U);
  EXPECT_TRUE(v.passed());
}

TEST_F(SeededBug, OnePixelsHighlightIsReportedAtThatPixel) {
  const PreparedFrame frame(load_scene(kScene), hardware_.formats, hardware_.setup);
  const RecordedModel model = record_model(frame.setup);
  std::size_t brightest = 0;
  for (std::size_t i = 0; i < model.stream.size(); ++i) {
    if (model.stream[i].color > model.stream[brightest].color) brightest = i;
  }
  const ShadedPixel pixel = model.stream[brightest];
  seed("pixel_datapath.sv", "highlight[2], s1_highlight",
       fmt::format("highlight[2], s1_highlight ^ (s1_x == {} && s1_y == {})", pixel.x, pixel.y));

  const VerificationResult v = run();
  EXPECT_FALSE(v.passed());
  EXPECT_EQ(v.systemc.stream_mismatches, 0U);
  EXPECT_EQ(v.rtl->stream_mismatches, 1U);
  EXPECT_EQ(v.rtl->frame_mismatches, 1U);
  ASSERT_TRUE(v.rtl->first_divergence.has_value());
  EXPECT_EQ(v.rtl->first_divergence->stream_index, brightest);
  EXPECT_EQ(v.rtl->first_divergence->model, pixel);
  SpanStream spans(frame.setup);
  for (std::uint64_t i = 0; i <= v.rtl->first_divergence->span; ++i) ASSERT_TRUE(spans.next());
  const RowSpan& row = spans.span().row;
  EXPECT_EQ(row.y, pixel.y);
  EXPECT_TRUE(row.x <= pixel.x && pixel.x < row.x + row.length) << row.x << " + " << row.length;
  EXPECT_LT(v.rtl->first_divergence->found.color, pixel.color);
  const std::string report = report_text(v, {});
  EXPECT_NE(report.find(fmt::format("triangle {}, x {}, y {}, cycle {}, span {}, pixel",
                                    v.rtl->first_divergence->triangle, pixel.x, pixel.y,
                                    v.rtl->first_divergence->cycle, v.rtl->first_divergence->span)),
            std::string::npos)
      << report;
  EXPECT_NE(report.find("FAILED"), std::string::npos);
}

TEST_F(SeededBug, CountingEndsAfterTheFirstPixels) {
  seed("pixel_datapath.sv", "highlight[2], s1_highlight", "highlight[2], !s1_highlight");
  const VerificationResult v = run();
  EXPECT_FALSE(v.passed());
  EXPECT_EQ(v.rtl->stream_mismatches, kMismatchesCounted);
  EXPECT_EQ(v.rtl->frame_mismatches, 0U) << "the frame is not complete";
  ASSERT_TRUE(v.rtl->first_divergence.has_value());
  const std::string report = report_text(v, {});
  EXPECT_NE(report.find("RTL ≠ model: 100 of"), std::string::npos) << report;
  EXPECT_NE(report.find("and no more were counted"), std::string::npos) << report;
}

TEST_F(SeededBug, LostPixelsDoNotHangTheHarness) {
  seed("span_control.sv", "span_length == 2 : remaining == 3;",
       "span_length == 2 : remaining == 3 || remaining == 7;");
  const VerificationResult v = run();
  EXPECT_FALSE(v.passed());
  EXPECT_GT(v.rtl->stream_mismatches, 0U);
  EXPECT_NE(v.rtl->counts.failure.find("nothing has moved"), std::string::npos)
      << v.rtl->counts.failure;
}

TEST_F(SeededBug, ADeadDatapathIsReportedWithItsQueues) {
  seed("span_control.sv", "assign span_ready = ", "assign span_ready = 1'b0 && ");
  const VerificationResult v = run();
  EXPECT_FALSE(v.passed());
  EXPECT_NE(v.rtl->counts.failure.find("span queue 8 of 8"), std::string::npos)
      << v.rtl->counts.failure;
}

TEST_F(SeededBug, PixelsForEverEndTheSimulation) {
  seed("pixel_datapath.sv", "valid <= {valid[LAST-1:0], enter};",
       "valid <= {valid[LAST-1:0], enter || 1'b1};");
  for (const Detail detail : {Detail::span, Detail::cycle}) {
    const VerificationResult v = run(detail);
    EXPECT_FALSE(v.passed());
    EXPECT_GT(v.rtl->stream_mismatches, 0U);
    EXPECT_NE(v.rtl->counts.failure.find("pixels that no span asked for"), std::string::npos)
        << v.rtl->counts.failure;
    EXPECT_TRUE(v.rtl->first_divergence.has_value());
  }
}

TEST_F(SeededBug, ABubbleBetweenSpansIsFoundByTheCycles) {
  seed("span_control.sv", "logic open, ending;",
       "logic open, ending, entered;\nalways_ff @(posedge clk) entered <= enter;");
  seed("span_control.sv", "assign span_ready = room && open;",
       "assign span_ready = room && open && !entered;");
  const VerificationResult v = run();
  EXPECT_EQ(v.rtl->stream_mismatches, 0U);
  EXPECT_FALSE(v.same_cycles());
  EXPECT_FALSE(v.passed());
}

// The hashes of the first simulation differ; the second, which looks for the pixels, finds none.
TEST_F(SeededBug, AFaultOfOnlyTheFirstSimulationStillFails) {
  const std::string marker = (folder_ / "simulated").string();
  seed("color_pipeline.sv", "logic s8_open;",
       fmt::format("logic s8_open;\n"
                   "bit once;\n"
                   "integer file;\n"
                   "initial begin\n"
                   "  once = 0;\n"
                   "  file = $fopen(\"{0}\", \"r\");\n"
                   "  if (file == 0) begin\n"
                   "    once = 1;\n"
                   "    file = $fopen(\"{0}\", \"w\");\n"
                   "  end\n"
                   "end",
                   marker));
  seed("color_pipeline.sv", ".s8_open,", ".s8_open(s8_open ^ once),");
  const VerificationResult v = run();
  EXPECT_FALSE(v.passed());
  EXPECT_TRUE(v.systemc.agrees());
  EXPECT_EQ(v.rtl->stream_mismatches, 0U);
  EXPECT_EQ(v.rtl->frame_mismatches, 0U);
  EXPECT_FALSE(v.rtl->first_divergence.has_value());
  EXPECT_EQ(v.rtl->counts.failure, "simulated twice, it differed from the model only once");
  const std::string report = report_text(v, {});
  EXPECT_NE(report.find("FAILED"), std::string::npos) << report;
  EXPECT_NE(report.find(v.rtl->counts.failure), std::string::npos) << report;
  EXPECT_TRUE(run().passed()) << "the marker is there now";
}

TEST_F(SeededBug, RtlThatDoesNotCompileIsAnInputErrorOfOneLine) {
  seed("color_sum.sv", "endmodule", "endmodul");
  try {
    run();
    FAIL() << "no error";
  } catch (const std::exception& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("building the RTL failed: verilator"), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace phongpipe
