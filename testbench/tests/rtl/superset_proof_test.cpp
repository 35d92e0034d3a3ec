// A configuration in wider RTL: proved equal by yosys, from any state in which the registers of
// both correspond, for any inputs, in every clock. Tables are not written meanwhile.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "testbench/rtl/rtl_builder.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"

namespace phongpipe {
namespace {

struct Widths {
  int diffuse_fraction, specular_fraction, wider;
};

// Pairs of signals that must be equal: a register of the narrow datapath, and bits of the wide one.
std::vector<std::pair<std::string, std::string>> correspondence(const Widths& widths) {
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const char* name : {"fd_valid",
                           "s1_valid",
                           "s2_valid",
                           "s3_valid",
                           "fd_remaining",
                           "fd_x",
                           "fd_y",
                           "s1_x",
                           "s1_y",
                           "s2_x",
                           "s2_y",
                           "s3_x",
                           "s3_y",
                           "fd_step_diffuse",
                           "fd_step_specular",
                           "fd_highlight",
                           "s2_open",
                           "s2_words",
                           "specular.s1_highlight",
                           "s1_lit",
                           "s3_sum",
                           "channel[0].summation.diffuse_cut",
                           "channel[0].summation.level_cut",
                           "channel[0].summation.clamped"}) {
    pairs.emplace_back(fmt::format("\\narrow.{}", name), fmt::format("\\wide.{}", name));
  }
  const auto shifted = [&](const std::string& name, int width) {
    pairs.emplace_back(
        fmt::format("\\narrow.{}", name),
        fmt::format("\\wide.{}[{}:{}]", name, width + widths.wider - 1, widths.wider));
    pairs.emplace_back(fmt::format("\\wide.{}[{}:0]", name, widths.wider - 1),
                       fmt::format("{}'d0", widths.wider));
  };
  for (const char* name : {"v", "d1", "d2"}) {
    shifted(fmt::format("channel[0].diffuse.diffuse_series.{}", name),
            diffuse_width(widths.diffuse_fraction));
    shifted(fmt::format("specular.specular_series.{}", name),
            specular_width(kGuardBits, 6, widths.specular_fraction));
  }
  shifted("fd_level", diffuse_width(widths.diffuse_fraction));
  pairs.emplace_back("\\narrow.specular.rom.address", "\\wide.specular.rom.address[6:1]");
  for (int i = 0; i < 128; ++i) {
    pairs.emplace_back(fmt::format("\\wide.specular.rom.table_words[{}]", i),
                       fmt::format("\\narrow.specular.rom.table_words[{}]", i / 2));
  }
  return pairs;
}

// Yosys's verdict on the correspondence. `also`: one more claim.
ProcessOutput prove(const Widths& widths, const std::string& also = {}) {
  std::string script = fmt::format("read_verilog -sv -I{0}", PHONGPIPE_HARDWARE);
  for (const auto& file : rtl_sources(PHONGPIPE_HARDWARE)) {
    if (file.extension() == ".sv") script += " " + file.string();
  }
  script += fmt::format(
      " {}/testbench/tests/rtl/superset_aligned.sv\n"
      "chparam -set DIFFUSE_FRACTION {} -set SPECULAR_FRACTION {} -set WIDER {} superset_aligned\n"
      "prep -top superset_aligned -flatten\nmemory_map\nopt_clean\n"
      "sat -tempinduct -seq 1 -verify -set rom_write 1'd0",
      PHONGPIPE_SOURCES, widths.diffuse_fraction, widths.specular_fraction, widths.wider);
  for (const auto& [a, b] : correspondence(widths)) {
    script += fmt::format(" -set-at 1 {0} {1} -prove {0} {1}", a, b);
  }
  for (const char* output : {"valid", "place", "color"}) {
    script += fmt::format(" -prove narrow_{0} wide_{0}", output);
  }
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / fmt::format("phongpipe-{}.ys", getpid());
  write_text(file, script + also + "\n");
  ProcessOutput output = run_process({"yosys", "-q", file.string()});
  std::filesystem::remove(file);
  return output;
}

TEST(SupersetProof, WiderRegistersAndALargerTableChangeNothing) {
  for (const Widths& widths : {Widths{8, 5, 4}, Widths{16, 12, 14}}) {
    const ProcessOutput output = prove(widths);
    EXPECT_EQ(output.status, 0) << output.text;
  }
}

// The proof can fail.
TEST(SupersetProof, AFalseClaimIsRejected) {
  const ProcessOutput output = prove({8, 5, 4}, " -prove \\narrow.fd_level \\wide.fd_level[20:3]");
  EXPECT_NE(output.status, 0);
  EXPECT_NE(output.text.find("proof did fail"), std::string::npos) << output.text;
}

}  // namespace
}  // namespace phongpipe
