// Bad usage, bad input, outputs that cannot be written and tools that fail: one line and a status.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

TEST_F(Program, BadUsageIsOneLineAndTwo) {
  expect_refused({}, "which command? There are verify, render, compare");
  expect_refused({"frob"}, "frob: no such command; there are verify, render, compare");
  expect_refused({"verfy", "sphere"}, "did you mean verify?");
  expect_refused({"verify"}, "give scenes, or --hard-cases");
  expect_refused({"verify", "sphere", "--bugdet", "80"}, "did you mean --budget?");
  expect_refused({"verify", "sphere", "--bugdet=80"}, "did you mean --budget?");
  expect_refused({"verify", "sphere", "--xyzzy"}, "see phongpipe verify --help");
  expect_refused({"--xyzzy"}, "see phongpipe --help");
  expect_refused({"verify", write("ball.obj", "v 0 0 0\n")}, "a mesh, not a scene");
  expect_refused({"verify", "nosuch.toml"},
                 "nosuch.toml: no such file or scene; there are the scenes mesh, pawn,");
  expect_refused({"verify", "sphere", "--hardware", "nosuch"}, "paper-1k, paper-8k");
  expect_refused({"verify", "sphere", "--set", "rom_adress_bits=9"},
                 "did you mean rom_address_bits");
  expect_refused({"verify", "sphere", "--set", "rom_address_bits=99"}, "6 to 13");
  expect_refused({"verify", "sphere", "--set", "rom_address_bits=ten"}, "whole number");
  expect_refused({"verify", "sphere", "--set", "anchor=pixel"}, "one of triangle, span");
  expect_refused({"verify", "sphere", "--set", "technology=nosuch"}, "generic, ice40-hx8k");
  for (const char* budget : {"-3", "0", "nan", "inf"}) {
    expect_refused({"verify", "sphere", "--budget", budget}, "a number of ns above 0");
  }
  expect_refused({"verify", "sphere", "--stall", "101"},
                 "stall = 101: a whole number from 0 to 100");
  expect_refused({"verify", "sphere", "--rtl", "/nosuch"}, "--rtl");
  expect_refused({"verify", "sphere", "--effects", "nonsense"},
                 "effects = nonsense: one of scene, all, both");
  expect_refused({"render", "sphere", "-o", file("a.png"), "--power", "lyon-4"},
                 "use --power with --arithmetic real");
  expect_refused({"render", "sphere"}, "nothing to write");
  expect_refused({"verify", "sphere", "torus", "--timeline", file("t.json")}, "of one scene");
  expect_refused({"verify", "sphere", "--timeline", file("t.svg")}, "a file .json");
  expect_refused({"render", "sphere", "-o", file("a.jpg")}, ".png or .pfm");
  expect_refused({"verify", "efects/ambient"}, "did you mean effects/ambient?");
  expect_refused(
      {"render", "sphere", "--method", "phong", "--arithmetic", "fixed", "-o", file("a.png")},
      "no fixed-point form");
}

TEST_F(Program, BadFilesAreNamedWithTheirLine) {
  expect_refused({"verify", write("broken.toml", "[image\n")}, "broken.toml:1:");
  expect_refused({"verify", write("zero.toml", "[image]\nwidth = 0\nheight = 4\n")},
                 "zero.toml:2:");
  const std::string hardware = write("h.toml", "[datapath]\nrom_data_bits = 3\n");
  expect_refused({"verify", "sphere", "--hardware", hardware}, "h.toml:2:");
  const std::string unknown = write("u.toml", "[datapath]\nrom_bits = 8\n");
  expect_refused({"verify", "sphere", "--hardware", unknown}, "u.toml:2:");
}

TEST_F(Program, AnEmptyPictureIsNoPass) {
  const std::string scene = write_empty_picture();
  const std::string message = "away.toml: nothing of the scene covers a pixel";
  expect_refused({"verify", scene}, message);
  expect_refused({"compare", scene}, message);
  expect_refused({"compare", scene, "--curve", "max-error"}, message);
}

TEST_F(Program, OutputsThatCannotBeWrittenAreRefusedBeforeTheWork) {
  expect_refused({"verify", "sphere", "--json", "/nosuch/r.json"}, "/nosuch/r.json");
  expect_refused({"verify", "sphere", "--timeline", "/nosuch/t.json"}, "/nosuch/t.json");
  expect_refused({"verify", "sphere", "--out", "/dev/null/pictures"}, "/dev/null/pictures");
  expect_refused({"render", "sphere", "-o", "/nosuch/a.png"}, "/nosuch/a.png");
  expect_refused({"compare", "sphere", "--csv", folder_.string()}, folder_.string());
  const ProcessOutput full =
      run_process({"sh", "-c", PHONGPIPE_PROGRAM " verify sphere > /dev/full"});
  EXPECT_EQ(full.status, 3) << full.text;
  EXPECT_NE(full.text.find("No space left on device"), std::string::npos) << full.text;
}

TEST_F(Program, FailedToolsAreStatusThree) {
  fs::create_directories(folder_ / "hw");
  write("hw/pixel_datapath.sv", "module pixel_datapath; endmodul\n");
  const ProcessOutput output = run({"verify", "sphere", "--rtl", file("hw")});
  EXPECT_EQ(output.status, 3) << output.text;
  EXPECT_NE(output.text.find("building the RTL failed: verilator said: %Error"), std::string::npos)
      << output.text;
  EXPECT_EQ(std::count(output.text.begin(), output.text.end(), '\n'), 1) << output.text;
}

}  // namespace
}  // namespace phongpipe
