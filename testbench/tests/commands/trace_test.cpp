// phongpipe trace, diff-traces and replay, as a user calls them.
#include <filesystem>

#include "model/files/text_file.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class TraceProgram : public Program {
 protected:
  // RTL with a fault: of the highlight in one pixel.
  std::string faulty_rtl() {
    constexpr const char* kCorrect = "highlight[2], s1_highlight";
    return faulty_rtl(kCorrect, std::string(kCorrect) + " ^ (s1_x == 100 && s1_y == 120)");
  }
  std::string faulty_rtl(const std::string& correct, const std::string& broken,
                         const std::string& module = "pixel_datapath.sv") {
    fs::create_directories(folder_ / "rtl");
    for (const auto& entry : fs::directory_iterator(PHONGPIPE_HARDWARE)) {
      if (entry.is_regular_file()) fs::copy(entry.path(), folder_ / "rtl");
    }
    std::string text = read_whole_file(file("rtl/" + module));
    text.replace(text.find(correct), correct.size(), broken);
    write("rtl/" + module, text);
    setenv("XDG_CACHE_HOME", file("cache").c_str(), 1);
    return file("rtl");
  }
};

TEST_F(TraceProgram, WritesTheTraceAndItsViews) {
  const ProcessOutput output = run({"trace", "sphere", "--worst", "-o", file("t.fst")});
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("marker   enters "), std::string::npos) << output.text;
  for (const char* name : {"t.fst", "t.gtkw", "t.sucl"}) {
    EXPECT_TRUE(fs::exists(file(name))) << name;
  }
  EXPECT_LT(fs::file_size(file("t.fst")), 100'000U);
  EXPECT_EQ(run({"diff-traces", file("t.fst"), file("t.fst")}).status, 0);
}

TEST_F(TraceProgram, BadTargetsAreOneLineAndNothingIsWritten) {
  const std::string t = file("t.fst");
  expect_refused({"trace", "sphere", "-o", t}, "Give one of --pixel X,Y");
  expect_refused({"trace", "sphere", "--pixel", "1,1", "-o", t}, "the nearest that is");
  expect_refused({"trace", "sphere", "--pixel", "1", "-o", t}, "give X,Y");
  expect_refused({"trace", "sphere", "--pixel", "300,1", "-o", t}, "x goes from 0 to 255");
  expect_refused({"trace", "sphere", "--cycles", "7:3", "-o", t}, "write A:B");
  expect_refused({"trace", "sphere", "--span", "7", "--frame", "-o", t}, "Give one of");
  expect_refused({"trace", "sphere", "--worst", "-o", file("t.txt")}, ".fst or .vcd");
  expect_refused({"trace", "sphere", "--worst", "-o", "/nosuch/t.fst"}, "/nosuch/t.fst");
  expect_refused({"diff-traces", "a.fst", "b.fst"}, "a.fst: no such file");
  expect_refused({"replay", "a.toml"}, "a.toml: no such file");
  EXPECT_FALSE(fs::exists(t));
}

// The trace is written, and tells why it ends; a pixel before the end can be explained.
TEST_F(TraceProgram, RtlThatHangsIsTold) {
  const std::string correct = "assign span_ready = room && open";
  const std::string rtl = faulty_rtl(correct, correct + " && remaining != 3", "span_control.sv");
  const ProcessOutput trace = run(
      {"trace", "sphere", "--pixel", "128,17", "--rtl", rtl, "--rtl-drives", "-o", file("t.vcd")});
  EXPECT_EQ(trace.status, 1) << trace.text;
  EXPECT_NE(trace.text.find("stopped  nothing has moved"), std::string::npos) << trace.text;
  EXPECT_TRUE(fs::exists(file("t.vcd")));
  EXPECT_EQ(run({"explain", "sphere", "--pixel", "128,12", "--rtl", rtl}).status, 0);
  const ProcessOutput after = run({"explain", "sphere", "--pixel", "128,17", "--rtl", rtl});
  EXPECT_EQ(after.status, 1) << after.text;
  EXPECT_NE(after.text.find("differs    the RTL delivers the pixel 0 times, the model 1 (nothing"),
            std::string::npos)
      << after.text;
}

TEST_F(TraceProgram, AFaultIsNamedTracedAndReplayed) {
  const std::string rtl = faulty_rtl();
  const ProcessOutput output =
      run({"verify", "sphere", "--rtl", rtl, "--out", file("out"), "--json", file("r.json")});
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(output.text.find("cause    pixel_datapath.s2_highlight: model 0x"), std::string::npos)
      << output.text;
  const auto json = nlohmann::json::parse(read_whole_file(file("r.json")))["first_divergence"];
  EXPECT_EQ(json["x"], 100);
  EXPECT_EQ(json["y"], 120);
  EXPECT_EQ(json["block"], "pixel_datapath");
  EXPECT_EQ(json["signal"], "s2_highlight");
  EXPECT_NE(json["model"], json["other"]);
  const std::string capsule = json["capsule"];
  EXPECT_EQ(capsule, file("out/sphere.toml"));
  for (const char* name : {"out/sphere.fst", "out/sphere.gtkw", "out/sphere.sucl"}) {
    EXPECT_TRUE(fs::exists(file(name))) << name;
  }
  EXPECT_EQ(run({"diff-traces", file("out/sphere.fst"), file("out/sphere.fst")}).status, 1)
      << "RTL and SystemC differ there";

  const ProcessOutput story = run({"explain", "sphere", "--pixel", "100,120", "--rtl", rtl});
  EXPECT_EQ(story.status, 1) << story.text;
  EXPECT_LT(story.text.find("differs    the RTL"), story.text.find("triangles that cover it"));
  EXPECT_NE(story.text.find("WRONG in the RTL: colour"), std::string::npos) << story.text;
  EXPECT_EQ(run({"explain", "sphere", "--pixel", "100,120"}).text.find("WRONG"), std::string::npos);
  expect_refused({"explain", "sphere", "--worst", "--rtl", "/nosuch"}, "/nosuch");

  const ProcessOutput unwritable =
      run_process({"sh", "-c", PHONGPIPE_PROGRAM " verify sphere --rtl " + rtl}, "/proc/self");
  EXPECT_EQ(unwritable.status, 1) << "the report comes all the same";
  EXPECT_NE(unwritable.text.find("the failure is not kept"), std::string::npos) << unwritable.text;
  EXPECT_NE(unwritable.text.find("FAILED sphere"), std::string::npos) << unwritable.text;

  const ProcessOutput replay = run({"replay", capsule, "--rtl", rtl});
  EXPECT_EQ(replay.status, 1) << replay.text;
  EXPECT_NE(replay.text.find("the same divergence as recorded"), std::string::npos) << replay.text;
  expect_refused({"replay", capsule}, "found in other RTL");
  const ProcessOutput mended = run({"replay", capsule, "--anyway"});
  EXPECT_EQ(mended.status, 0) << mended.text;
  EXPECT_NE(mended.text.find("recorded was pixel_datapath.s2_highlight"), std::string::npos)
      << mended.text;
}

// No register differs, only what leaves.
TEST_F(TraceProgram, AFaultAtTheOutputIsDifferent) {
  const std::string rtl =
      faulty_rtl(".place({s1_x, s1_y})", ".place({s1_x ^ X_BITS'(s1_x == 100), s1_y})");
  const ProcessOutput output = run({"verify", "sphere", "--rtl", rtl, "--out", file("out")});
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_EQ(output.text.find("Warning"), std::string::npos) << output.text;
  const ProcessOutput diff = run({"diff-traces", file("out/sphere.fst"), file("out/sphere.fst")});
  EXPECT_EQ(diff.status, 1) << diff.text;
  EXPECT_NE(diff.text.find("pixel_datapath.pixel_x of the pixel"), std::string::npos) << diff.text;
}

// A lane whose pixels do not count, though all its registers are right.
TEST_F(TraceProgram, AMissingLaneIsDifferent) {
  const std::string rtl = faulty_rtl("lane_x[(k+1)*X_BITS-1];", "lane_x[(k+1)*X_BITS-1] && k != 1;",
                                     "pixel_datapath_wide.sv");
  const ProcessOutput output =
      run({"verify", "sphere", "--set", "datapath.kind=wide2", "--rtl", rtl, "--out", file("out")});
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(output.text.find("pixel_datapath.pixel_valid: model 0x3, rtl 0x1"), std::string::npos)
      << output.text;
  const ProcessOutput diff = run({"diff-traces", file("out/sphere.fst"), file("out/sphere.fst")});
  EXPECT_EQ(diff.status, 1) << diff.text;
  EXPECT_NE(diff.text.find("pixel_datapath.pixel_valid of the pixel"), std::string::npos)
      << diff.text;
}

TEST_F(TraceProgram, KindsOfDatapathsAreNotCompared) {
  ASSERT_EQ(run({"trace", "sphere", "--worst", "-o", file("a.fst")}).status, 0);
  ASSERT_EQ(run({"trace", "sphere", "--worst", "--set", "datapath.kind=wide2", "-o", file("b.fst")})
                .status,
            0);
  expect_refused({"diff-traces", file("a.fst"), file("b.fst")},
                 "A is of a pipelined datapath, B of a wide2 one");
}

// The library that reads FST files trusts them; it crashes, loops and ends the process.
TEST_F(TraceProgram, DamagedWaveformsAreRefused) {
  const std::string whole = file("t.fst"), damaged = file("d.fst");
  ASSERT_EQ(run({"trace", "sphere", "--worst", "-o", whole}).status, 0);
  const std::string bytes = read_whole_file(whole);
  const auto expect_contained = [&](const std::string& contents) {
    std::ofstream(damaged, std::ios::binary) << contents;
    const ProcessOutput output = run({"diff-traces", damaged, whole});
    EXPECT_LE(output.status, 2) << output.text;
    EXPECT_EQ(output.status == 2 ? lines_of(output.text) : 1, 1) << output.text;
  };
  for (const std::size_t cut : {1U, 4U, 1500U, 5000U}) {
    expect_contained(bytes.substr(0, bytes.size() - cut));
  }
  for (std::size_t at = 200; at < bytes.size(); at += bytes.size() / 25) {
    std::string changed = bytes;
    changed[at] = static_cast<char>(changed[at] ^ 0xFF);
    expect_contained(changed);
  }
  const std::string head =
      "$scope module pixel_datapath $end\n$var wire 1 ! clk $end\n$upscope $end\n"
      "$enddefinitions $end\n";
  std::string scopes;
  for (int i = 0; i < 300; ++i) scopes += "$scope module a $end\n";
  for (const std::string& text :
       {head + "$var wire 1 \" late $end\n#0\n1\"\n", head + head, scopes + head}) {
    write("a.vcd", text);
    expect_refused({"diff-traces", file("a.vcd"), file("a.vcd")}, "no VCD or FST file");
  }
}

}  // namespace
}  // namespace phongpipe
