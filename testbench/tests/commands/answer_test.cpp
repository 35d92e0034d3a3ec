// What verify writes and says of one scene.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "model/files/text_file.h"
#include "testbench/cosim/metrics.h"
#include "testbench/hardware/hardware.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

TEST_F(Program, TheAnswerIsFiveLines) {
  const ProcessOutput output = run_for_answer("verify sphere");
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 5) << output.text;
  for (const char* part :
       {"PASSED sphere  256×256, 42,464 pixels, hardware default ",
        "\n  same     model = SystemC = RTL, every pixel and every cycle (",
        "\n  time     20.86 of 100 ns a pixel, clock 4.93 ns measured; datapath 7.70; limited "
        "by setup",
        "\n  error    at most 0.57 LSB", "\n  more     --verbose"}) {
    EXPECT_NE(output.text.find(part), std::string::npos) << part << " in\n" << output.text;
  }
}

TEST_F(Program, VerboseTellsEverySettingAndMetric) {
  const ProcessOutput output = run({"verify", "sphere", "--verbose"});
  ASSERT_EQ(output.status, 0) << output.text;
  for (const Setting<Hardware>& setting : hardware_settings()) {
    EXPECT_NE(output.text.find(fmt::format("{} ", setting.key)), std::string::npos)
        << setting.name();
  }
  for (const Metric& metric : metrics()) {
    EXPECT_NE(output.text.find(fmt::format("\n  {} ", metric.name)), std::string::npos)
        << metric.name;
  }
}

TEST_F(Program, NoColourAndNoProgressInAPipe) {
  const ProcessOutput output = run({"verify", "sphere"});
  EXPECT_EQ(output.text.find('\033'), std::string::npos);
  EXPECT_EQ(output.text.find('\r'), std::string::npos);
}

TEST_F(Program, JsonAloneGoesToStandardOutput) {
  const ProcessOutput output = run_for_answer("verify sphere --json -");
  EXPECT_TRUE(nlohmann::json::accept(output.text)) << output.text;
}

TEST_F(Program, VerifyWritesEveryKeyAndThreePictures) {
  const nlohmann::json result = verify({"sphere", "--effects", "both", "--out", folder_.string()});
  for (const char* key : {"/scene",
                          "/configuration",
                          "/configuration_hash",
                          "/triangles",
                          "/pixels",
                          "/subdivision/triangles",
                          "/subdivision/pieces",
                          "/mismatches/model_rtl",
                          "/mismatches/model_systemc",
                          "/cycles/frame",
                          "/cycles/datapath_rtl",
                          "/cycles/datapath_systemc",
                          "/cycles/difference",
                          "/clock_ns",
                          "/clock_source",
                          "/ns_per_pixel/datapath",
                          "/ns_per_pixel/frame",
                          "/budget_ns",
                          "/effects/used",
                          "/effects/left_out",
                          "/effects/built",
                          "/effects/everything",
                          "/within_budget",
                          "/detail",
                          "/stall_percent",
                          "/seed",
                          "/limited_by",
                          "/implementations/rtl/failure",
                          "/implementations/rtl/first_divergence",
                          "/implementations/systemc/first_divergence",
                          "/accuracy/max_lsb",
                          "/accuracy/rms_lsb",
                          "/accuracy/psnr_db",
                          "/accuracy/over_half",
                          "/accuracy/over_one",
                          "/accuracy/over_two",
                          "/accuracy_split",
                          "/passed"}) {
    EXPECT_TRUE(result.contains(nlohmann::json::json_pointer(key))) << key;
  }
  for (const char* picture : {"sphere-result.png", "sphere-exact.png", "sphere-error.png"}) {
    EXPECT_EQ(read_whole_file(file(picture)).substr(1, 3), "PNG") << picture;
  }
}

}  // namespace
}  // namespace phongpipe
