// A configuration in wider RTL: proved equal by yosys, from any state in which the registers of
// both correspond, for any inputs, in every clock. Tables are not written meanwhile. What
// pixel_queue gets is equal in every clock; it is the same module in both, and gives room to both
// or to none.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "testbench/rtl/rtl_builder.h"
#include "testbench/rtl/tool_folder.h"
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
  const auto equal = [&](const std::string& name) {
    pairs.emplace_back(fmt::format("\\narrow.{}", name), fmt::format("\\wide.{}", name));
  };
  for (const char* name : {"valid",
                           "first",
                           "restart",
                           "after_first",
                           "control.open",
                           "control.ending",
                           "control.remaining",
                           "s0_x_term",
                           "s1_x",
                           "s1_y",
                           "s1_highlight",
                           "highlight",
                           "color.highlight",
                           "color.specular.s7_open",
                           "color.s8_open",
                           "color.specular.rom.new_word",
                           "color.specular.rom.plain.bank[0].s6_word",
                           "color.specular.rom.plain.s7_words",
                           "color.s8_words",
                           "color.s6_lit",
                           "color.s10_sum"}) {
    equal(name);
  }
  for (const char* name :
       {"s5_low_above", "s5_diffuse", "s5_level_complement", "s5_diffuse_cut", "s5_level_cut",
        "s6_diffuse_cut", "s6_level_cut", "s7_clamped", "s8_clamped", "s9_clamped", "s9_addend"}) {
    equal(fmt::format("color.channel[0].summation.{}", name));
  }
  const auto shifted = [&](const std::string& name, int width, int low) {
    pairs.emplace_back(
        fmt::format("\\narrow.{}", name),
        fmt::format("\\wide.{}[{}:{}]", name, width + widths.wider - 1, widths.wider));
    pairs.emplace_back(fmt::format("\\wide.{}[{}:0]", name, widths.wider - 1),
                       fmt::format("{}'d{}", widths.wider, low));
  };
  const int diffuse = diffuse_width(widths.diffuse_fraction);
  const int specular = specular_width(kGuardBits, 6, widths.specular_fraction);
  for (const auto& [series, width] : {std::pair{"channel[0].diffuse.diffuse_series", diffuse},
                                      std::pair{"specular.specular_series", specular}}) {
    for (const char* name : {"s0_start_v", "s0_start_d1", "last_term.s0_start", "s1_term",
                             "s1_next_term", "s1_last_term", "s4_v"}) {
      shifted(fmt::format("{}.{}", series, name), width, 0);
    }
    for (const char* name : {"s2_difference_low", "s3_v_low"}) {
      shifted(fmt::format("{}.{}", series, name), low_bits(width), 0);
    }
    for (const char* name :
         {"s0_stepping", "s2_term_high", "s3_difference_high", "s2_carry", "s3_carry"}) {
      equal(fmt::format("{}.{}", series, name));
    }
  }
  shifted("s1_level", diffuse, 0);
  // The level is not negative, and its sign goes no further.
  for (const char* name : {"s2_level", "s3_level"}) {
    pairs.emplace_back(
        fmt::format("\\narrow.{}[{}:0]", name, diffuse - 2),
        fmt::format("\\wide.{}[{}:{}]", name, diffuse + widths.wider - 2, widths.wider));
    pairs.emplace_back(fmt::format("\\wide.{}[{}:0]", name, widths.wider - 1),
                       fmt::format("{}'d0", widths.wider));
  }
  shifted("color.channel[0].summation.s4_level_complement", diffuse - 1, (1 << widths.wider) - 1);
  // What of_span took of the inputs: y, highlight, first pass and the level.
  const int flags = kCoordinateBits + 2;
  pairs.emplace_back(fmt::format("\\narrow.of_span.s0_start[{}:{}]", diffuse + flags - 1, diffuse),
                     fmt::format("\\wide.of_span.s0_start[{}:{}]",
                                 diffuse + widths.wider + flags - 1, diffuse + widths.wider));
  pairs.emplace_back(
      fmt::format("\\narrow.of_span.s0_start[{}:0]", diffuse - 1),
      fmt::format("\\wide.of_span.s0_start[{}:{}]", diffuse + widths.wider - 1, widths.wider));
  pairs.emplace_back(fmt::format("\\wide.of_span.s0_start[{}:0]", widths.wider - 1),
                     fmt::format("{}'d0", widths.wider));
  pairs.emplace_back("\\narrow.color.specular.rom.s5_address",
                     "\\wide.color.specular.rom.s5_address[6:1]");
  for (int i = 0; i < 128; ++i) {
    pairs.emplace_back(
        fmt::format("\\wide.color.specular.rom.plain.bank[0].table_words[{}]", i),
        fmt::format("\\narrow.color.specular.rom.plain.bank[0].table_words[{}]", i / 2));
  }
  for (const char* side : {"narrow", "wide"}) {
    for (const char* name : {"bank[0].write_bank", "s6_bank", "s7_bank"}) {
      pairs.emplace_back(fmt::format("\\{}.color.specular.rom.plain.{}", side, name), "1'd0");
    }
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
      "hierarchy -top superset_aligned\nsetattr -mod -set keep 1 *pixel_queue\nblackbox "
      "*pixel_queue\n"
      "prep -flatten\nmemory_map\nopt_clean\ndelete t:*pixel_queue\n"
      "sat -tempinduct -seq 1 -verify -set rom_write 1'd0 -set \\narrow.room \\wide.room",
      PHONGPIPE_SOURCES, widths.diffuse_fraction, widths.specular_fraction, widths.wider);
  for (const auto& [a, b] : correspondence(widths)) {
    script += fmt::format(" -set-at 1 {0} {1} -prove {0} {1}", a, b);
  }
  for (const char* written : {"valid", "s1_x", "s1_y", "last_color"}) {
    script += fmt::format(" -prove \\narrow.{0} \\wide.{0}", written);
  }
  const std::filesystem::path file =
      std::filesystem::path(::testing::TempDir()) / fmt::format("phongpipe-{}.ys", getpid());
  write_text(file, script + also + "\n");
  ProcessOutput output = run_process({"yosys", "-q", file.string()});
  std::filesystem::remove(file);
  return output;
}

TEST(SupersetProof, WiderRegistersAndALargerTableChangeNothing) {
  for (const Widths& widths : {Widths{8, 6, 4}, Widths{16, 12, 14}}) {
    const ProcessOutput output = prove(widths);
    EXPECT_EQ(output.status, 0) << output.text;
  }
}

// The proof can fail.
TEST(SupersetProof, AFalseClaimIsRejected) {
  const ProcessOutput output = prove({8, 6, 4}, " -prove \\narrow.s2_level \\wide.s2_level[20:3]");
  EXPECT_NE(output.status, 0);
  EXPECT_NE(output.text.find("proof did fail"), std::string::npos) << output.text;
}

}  // namespace
}  // namespace phongpipe
