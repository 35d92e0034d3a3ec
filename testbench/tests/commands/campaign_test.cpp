// sweep, regress, export and merge, as their user runs them.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "testbench/campaign/store.h"
#include "testbench/tests/commands/program.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class Campaigns : public Program {
 protected:
  // A sweep of 12 points over a small sphere.
  std::vector<std::string> sweep(const std::string& database,
                                 const std::vector<std::string>& more = {},
                                 const std::string& rtl = "off") const {
    std::vector<std::string> arguments = {"sweep",  "sphere",
                                          "--set",  "scene.image.width=96",
                                          "--set",  "scene.image.height=96",
                                          "--set",  "scene.object.0.segments=[12,8]",
                                          "--vary", "rom_address_bits=6:9",
                                          "--vary", "diffuse_fraction_bits=4,8,16",
                                          "--rtl",  rtl,
                                          "--db",   file(database)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  }
  // Begins a sweep of 144 runs, executes `script` once some of them are done, in which $pid is the
  // sweep, and waits for the end.
  ProcessOutput signal_sweep(const std::string& script) const {
    std::string command = PHONGPIPE_PROGRAM;
    for (const std::string& word : sweep("signal.db", {"--vary", "seed=1:12"})) {
      command += " " + word;
    }
    return run_process(
        {"sh", "-c",
         fmt::format("{} & pid=$!\nwhile ! test -s {}; do sleep 0.02; done\nsleep 0.1\n{}\n"
                     "wait $pid; echo status $?",
                     command, file("signal.db"), script)});
  }
  ResultTable table(const std::string& database) const {
    return Store(file(database), Store::Access::read).table();
  }
  // All of the table but what was measured with a clock.
  std::string without_seconds(const std::string& database) const {
    const ResultTable results = table(database);
    std::string text;
    for (const auto& row : results.rows) {
      for (std::size_t i = 0; i < row.size(); ++i) {
        if (results.columns[i].find("seconds") != std::string::npos) continue;
        text += exact_text(row[i]) + ",";
      }
      text += "\n";
    }
    return text;
  }
  static std::vector<std::string> words(const std::string& command) {
    std::vector<std::string> result;
    for (const std::string_view word : phongpipe::words(command)) {
      std::string& plain = result.emplace_back(word);
      plain.erase(std::remove(plain.begin(), plain.end(), '\''), plain.end());
    }
    return result;
  }
};

TEST_F(Campaigns, ASweepsRowsEqualVerifyToTheLastDigit) {
  const ProcessOutput output =
      run({"sweep", "sphere", "--set", "scene.object.0.segments=[12,8]", "--vary",
           "diffuse_fraction_bits=4,9", "--vary", "stall=0,30", "--db", file("a.db")});
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("PASSED sweep  4 of 4 runs passed"), std::string::npos) << output.text;
  const ResultTable results = table("a.db");
  ASSERT_EQ(results.rows.size(), 4U);
  for (std::size_t row = 0; row < 4; ++row) {
    EXPECT_EQ(results.text(row, "verified_by"), "native");
    std::vector<std::string> command = words(results.text(row, "command"));
    ASSERT_EQ(command[0] + command[1], "phongpipeverify");
    command.erase(command.begin(), command.begin() + 2);
    const nlohmann::json verified = verify(command);
    EXPECT_EQ(results.text(row, "configuration_hash"), verified["configuration_hash"]);
    for (const Metric& metric : metrics()) {
      if (metric.json.empty()) continue;
      const auto& value = verified.at(nlohmann::json::json_pointer(std::string(metric.json)));
      if (value.is_null()) {
        EXPECT_EQ(results.text(row, metric.name), "") << metric.name;
      } else {
        EXPECT_EQ(*results.number(row, metric.name), value.get<double>()) << metric.name;
      }
    }
  }
}

TEST_F(Campaigns, WhatIsThereIsNotComputedAgain) {
  ASSERT_EQ(run(sweep("a.db", {"--jobs", "1"})).status, 0);
  const ResultTable before = table("a.db");
  ASSERT_EQ(before.rows.size(), 12U);
  const ProcessOutput again = run(sweep("a.db"));
  EXPECT_NE(again.text.find("PASSED sweep  all 12 were known; "), std::string::npos) << again.text;
  EXPECT_EQ(before.rows, table("a.db").rows) << "seconds included";
  ASSERT_EQ(run(sweep("b.db", {"--jobs", "3"})).status, 0);
  EXPECT_EQ(without_seconds("a.db"), without_seconds("b.db"));
  // A stronger verification is done, a weaker is not.
  const ProcessOutput native = run(sweep("a.db", {"--where", "rom_address_bits==6"}, "native"));
  EXPECT_NE(native.text.find("3 of 3 runs passed"), std::string::npos) << native.text;
  EXPECT_NE(run(sweep("a.db")).text.find("12 were known"), std::string::npos);
}

// In the widest RTL the same numbers come out; the front is verified in RTL of its own. In the
// plain layout, smaller tables are copied into the largest.
TEST_F(Campaigns, TheSupersetGivesTheNumbersOfNativeRtl) {
  const std::vector<std::string> plain = {"--set", "rom_layout=plain"};
  ASSERT_EQ(run(sweep("native.db", plain, "native")).status, 0);
  ASSERT_EQ(run(sweep("superset.db", plain, "superset")).status, 0);
  const ResultTable native = table("native.db"), superset = table("superset.db");
  ASSERT_EQ(native.rows.size(), superset.rows.size());
  std::map<std::string, int> verified_by;
  for (std::size_t row = 0; row < native.rows.size(); ++row) {
    ++verified_by[superset.text(row, "verified_by")];
    for (std::size_t i = 0; i < native.columns.size(); ++i) {
      const std::string& column = native.columns[i];
      if (column == "verified_by" || column.find("seconds") != std::string::npos) continue;
      EXPECT_EQ(native.rows[row][i], superset.rows[row][i]) << column;
    }
  }
  EXPECT_GT(verified_by["superset"], 0);
  EXPECT_GT(verified_by["native"], 0);
  EXPECT_EQ(verified_by.size(), 2U);
}

TEST_F(Campaigns, KilledTwentyTimesItEqualsAnUninterruptedSweep) {
  ASSERT_EQ(run(sweep("whole.db", {"--vary", "seed=1:12"})).status, 0);
  std::string command = PHONGPIPE_PROGRAM;
  for (const std::string& word : sweep("killed.db", {"--vary", "seed=1:12"})) command += " " + word;
  std::map<std::string, std::string> seconds;  // by identity
  int killed = 0;
  for (int i = 0; i < 20; ++i) {
    // So long that some runs end, and some do not.
    killed +=
        run_process({"sh", "-c",
                     fmt::format("timeout -s KILL 0.{:02} {} >/dev/null 2>&1", 4 + i % 5, command)})
            .status == 137;
    if (!fs::exists(file("killed.db"))) continue;
    ResultTable results;
    try {
      results = table("killed.db");
    } catch (const std::exception&) {
      continue;  // not yet a database: killed while it was made
    }
    for (std::size_t row = 0; row < results.rows.size(); ++row) {
      const std::string identity = results.text(row, "identity");
      const auto first = seconds.emplace(identity, results.text(row, "seconds"));
      EXPECT_EQ(first.first->second, results.text(row, "seconds")) << "computed twice";
    }
    EXPECT_LE(seconds.size(), results.rows.size()) << "a finished run was lost";
  }
  EXPECT_GT(killed, 0);
  ASSERT_EQ(run(sweep("killed.db", {"--vary", "seed=1:12"})).status, 0);
  EXPECT_EQ(without_seconds("whole.db"), without_seconds("killed.db"));
}

TEST_F(Campaigns, CtrlCFinishesWhatIsInFlightAndSaysHowToGoOn) {
  const ProcessOutput output = signal_sweep("kill -INT $pid");
  EXPECT_NE(output.text.find("status 130"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("STOPPED sweep"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("go on    the same command does the other"), std::string::npos);
  const std::size_t done = table("signal.db").rows.size();
  EXPECT_LT(done, 144U);
  const ProcessOutput rest = run(sweep("signal.db", {"--vary", "seed=1:12"}));
  EXPECT_NE(rest.text.find(fmt::format("{} were known", done)), std::string::npos) << rest.text;
  EXPECT_EQ(table("signal.db").rows.size(), 144U);
}

// The runs that a killed worker had not finished are done by others.
TEST_F(Campaigns, AKilledWorkerCostsNoRun) {
  const ProcessOutput output = signal_sweep("pkill -KILL -P $pid");
  EXPECT_NE(output.text.find("status 0"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("144 of 144 runs passed"), std::string::npos) << output.text;
}

TEST_F(Campaigns, WorkersEndWithTheirParent) {
  const ProcessOutput output = signal_sweep(
      "children=$(pgrep -P $pid); kill -KILL $pid; sleep 0.5; "
      "for child in $children; do grep -qs State:.[RSDT] /proc/$child/status && echo child lives; "
      "done");
  EXPECT_NE(output.text.find("status 137"), std::string::npos) << output.text;
  EXPECT_EQ(output.text.find("child lives"), std::string::npos) << output.text;
}

TEST_F(Campaigns, ShardsMergeIntoTheWhole) {
  ASSERT_EQ(run(sweep("whole.db")).status, 0);
  for (const char* shard : {"1", "2", "3"}) {
    ASSERT_EQ(
        run(sweep(fmt::format("part{}.db", shard), {"--shard", fmt::format("{}/3", shard)})).status,
        0);
  }
  const ProcessOutput output =
      run({"merge", file("part1.db"), file("part2.db"), file("part3.db"), "-o", file("all.db")});
  ASSERT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("12 runs of 3 files"), std::string::npos) << output.text;
  EXPECT_EQ(without_seconds("whole.db"), without_seconds("all.db"));
  expect_refused({"merge", file("part1.db"), "-o", file("part1.db")},
                 "cannot be merged into itself");
  expect_refused(sweep("x.db", {"--shard", "4/3"}), "write I/N");
}

TEST_F(Campaigns, AShardWhoseRunsAreAllRefusedIsNoFailure) {
  std::size_t rows = 0;
  for (int shard = 1; shard <= 6; ++shard) {
    const std::string name = fmt::format("part{}.db", shard);
    const ProcessOutput output =
        run({"sweep", "sphere", "--vary", "rom_address_bits=8,99,100,101,102", "--rtl", "off",
             "--db", file(name), "--shard", fmt::format("{}/6", shard)});
    EXPECT_EQ(output.status, 0) << output.text;
    rows += table(name).rows.size();
  }
  EXPECT_EQ(rows, 5U);
}

TEST_F(Campaigns, AMergeThatIsRefusedLeavesNothing) {
  ASSERT_EQ(run(sweep("a.db")).status, 0);
  ASSERT_EQ(
      run({"sweep", "sphere", "--vary", "stall=0,1", "--rtl", "off", "--db", file("b.db")}).status,
      0);
  expect_refused({"merge", file("a.db"), file("b.db"), "-o", file("c.db")}, "not one campaign");
  expect_refused({"merge", file("a.db"), "-o", ":memory:"}, "not the name of a file");
}

TEST_F(Campaigns, AFullDiskLosesNothingThatIsStored) {
  const auto command = [&](const char* diffuse_fraction_bits) {
    return fmt::format(
        "{} sweep sphere --vary rom_address_bits=6:13 --vary diffuse_fraction_bits={} --rtl off "
        "--db {}",
        PHONGPIPE_PROGRAM, diffuse_fraction_bits, file("a.db"));
  };
  // How many rows one transaction holds depends on the speed of the machine: those that must
  // survive are stored before files are limited.
  ASSERT_EQ(run_process({"sh", "-c", command("4:5")}).status, 0);
  ASSERT_EQ(table("a.db").rows.size(), 16U);
  const ProcessOutput full = run_process({"sh", "-c", "ulimit -f 128; " + command("4:19")});
  EXPECT_EQ(full.status, 2) << full.text;
  EXPECT_NE(full.text.find("is the disk full"), std::string::npos) << full.text;
  const std::size_t stored = table("a.db").rows.size();
  EXPECT_GE(stored, 16U);
  EXPECT_LT(stored, 128U);
  const ProcessOutput rest = run_process({"sh", "-c", command("4:19")});
  EXPECT_EQ(rest.status, 0) << rest.text;
  EXPECT_NE(rest.text.find(fmt::format("{} were known", stored)), std::string::npos) << rest.text;
  EXPECT_EQ(table("a.db").rows.size(), 128U);
}

TEST_F(Campaigns, AClosedStandardErrorIsNoReasonToStop) {
  EXPECT_EQ(run_process({"sh", "-c",
                         PHONGPIPE_PROGRAM " regress --random --count 2 --rtl off 2>&- >/dev/null"})
                .status,
            0);
  EXPECT_EQ(run_process({"sh", "-c", PHONGPIPE_PROGRAM " verify nosuch 2>/dev/full"}).status, 2);
}

TEST_F(Campaigns, ValuesOutOfRangeAreRefusedRowsAndFailOnlyIfAllAre) {
  const ProcessOutput output = run(
      {"sweep", "sphere", "--vary", "rom_address_bits=5:7", "--rtl", "off", "--db", file("a.db")});
  EXPECT_EQ(output.status, 0) << output.text;
  EXPECT_NE(output.text.find("2 of 3 runs passed, 1 refused"), std::string::npos) << output.text;
  EXPECT_EQ(table("a.db").text(0, "outcome"), "refused");
  EXPECT_NE(table("a.db").text(0, "message").find("6 to 13"), std::string::npos);
  const ProcessOutput none = run(
      {"sweep", "sphere", "--vary", "rom_address_bits=3:5", "--rtl", "off", "--db", file("b.db")});
  EXPECT_EQ(none.status, 2) << none.text;
}

TEST_F(Campaigns, AFailedCheckIsToldWithItsCommand) {
  const ProcessOutput output = run(sweep("a.db", {"--vary", "budget=1,100"}));
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(output.text.find("12 failed"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("12 × budget"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("again  phongpipe verify sphere"), std::string::npos) << output.text;
  // Failed runs are known, too; --retry-failed does them again.
  const ProcessOutput again = run(sweep("a.db", {"--vary", "budget=1,100", "--retry-failed"}));
  EXPECT_NE(again.text.find("0 of 12 runs passed, 12 failed; 12 were known"), std::string::npos)
      << again.text;
  const ProcessOutput first =
      run(sweep("b.db", {"--vary", "budget=1", "--fail-fast", "--jobs", "1"}));
  EXPECT_EQ(first.status, 1) << first.text;
  EXPECT_LT(table("b.db").rows.size(), 12U);
}

TEST_F(Campaigns, ARunThatTakesTooLongOrTooMuchEndsAlone) {
  const ProcessOutput late = run({"sweep", "pawn", "sphere", "--vary", "detail=cycle", "--vary",
                                  "stall=90", "--rtl", "off", "--timeout", "1", "--set",
                                  "scene.image.width=2048", "--set", "scene.image.height=2048",
                                  "--set", "framebuffer.write_cycles=900", "--db", file("a.db")});
  EXPECT_EQ(late.status, 1) << late.text;
  EXPECT_NE(late.text.find("timed out"), std::string::npos) << late.text;
}

TEST_F(Campaigns, ARunThatTakesTooMuchMemoryEndsAlone) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "the address sanitizer takes terabytes of addresses, so that none are counted";
#endif
  const ProcessOutput output = run({"sweep", "sphere", "--vary", "scene.image.height=64,4096",
                                    "--set", "scene.image.width=4096", "--vary", "budget=1e6",
                                    "--rtl", "off", "--memory", "150", "--db", file("a.db")});
  EXPECT_EQ(output.status, 3) << output.text;
  EXPECT_NE(output.text.find("1 of 2 runs passed, 1 crashed"), std::string::npos) << output.text;
  EXPECT_NE(output.text.find("1 × memory: out of memory"), std::string::npos) << output.text;
}

TEST_F(Campaigns, BadPlansAreRefusedAndLeaveNothing) {
  const auto refuse = [&](const std::vector<std::string>& more, const std::string& message) {
    std::vector<std::string> arguments = {"sweep", "sphere", "--db", file("x.db")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_refused(arguments, message);
  };
  refuse({}, "nothing varies");
  refuse({"--vary", "rom_adress_bits=6:13"}, "did you mean rom_address_bits?");
  refuse({"--vary", "rom_address_bits=6:13:0"}, "a step of 0");
  refuse({"--vary", "rom_address_bits=6:13", "--where", "rom_address_bits>20"}, "no point is left");
  refuse({"--vary", "seed=0:99999", "--vary", "stall=0:99"}, "--sample");
  refuse({"--vary", "rom_address_bits=6:13", "--set", "nosuch=3"}, "unknown key");
  expect_refused({"sweep", "sphere", "nosuch", "--vary", "stall=1,2", "--db", file("x.db")},
                 "no such file or scene");
  refuse({"--vary", "hardware=default,nosuch"}, "no such file or preset");
  refuse({"--vary", "technology=generic,nosuch"}, "no such file or technology card");
  refuse({"--vary", "stall=1,2", "--seed", "7"}, "--seed is of a sample");
  expect_refused({"export", file("x.db"), "--csv", "-"}, "no such file");
}

TEST_F(Campaigns, ASweepFileSaysTheSameAsTheCommandLine) {
  ASSERT_EQ(run(sweep("a.db")).status, 0);
  const std::string plan = write("plan.toml",
                                 "scenes = [\"sphere\"]\n"
                                 "[set]\n\"scene.image.width\" = 96\n\"scene.image.height\" = 96\n"
                                 "\"scene.object.0.segments\" = \"[12,8]\"\n"
                                 "[vary]\nrom_address_bits = \"6:9\"\n"
                                 "diffuse_fraction_bits = [4, 8, 16]\n");
  const ProcessOutput output = run({"sweep", plan, "--rtl", "off", "--db", file("a.db")});
  EXPECT_NE(output.text.find("12 were known"), std::string::npos) << output.text;
  const std::string wrong = write("wrong.toml", "scenes = \"sphere\"\n[vary]\nrom_bits = 3\n");
  expect_refused({"sweep", wrong, "--db", file("b.db")}, "wrong.toml:3: rom_bits: unknown key");
}

// "… 1k bytes … powers up to 20 with less than 1 percent error … 8k bytes … powers up to 164": two
// points of the shipped sweep over tables.
TEST_F(Campaigns, ThePapersTablesHoldWhatItClaims) {
  const std::string claims =
      "(rom_address_bits == 10 && shininess == 20) || (rom_address_bits == 13 && shininess == 164)";
  const ProcessOutput output = run({"sweep", "tables", "--where",
                                    claims + " || "
                                             "(rom_address_bits == 9 && shininess == 20) || "
                                             "(rom_address_bits == 12 && shininess == 164)",
                                    "--rtl", "off", "--db", file("a.db")});
  ASSERT_EQ(output.status, 0) << output.text;
  const ResultTable results = table("a.db");
  ASSERT_EQ(results.rows.size(), 4U);
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    const bool claimed = results.text(row, "datapath.rom_address_bits") == "10" ||
                         results.text(row, "datapath.rom_address_bits") == "13";
    const double error = *results.number(row, "rom_error");
    EXPECT_EQ(error < 0.01, claimed) << error << ": half the words are not enough";
  }
}

TEST_F(Campaigns, RandomRegressionsOfOneSeedAreTheSame) {
  const auto regress = [&](const std::string& name, const std::string& count) {
    return run({"regress", "--random", "--count", count, "--seed", "7", "--rtl", "off", "--db",
                file(name), "--junit", file("junit.xml")});
  };
  ASSERT_EQ(regress("a.db", "12").status, 0);
  ASSERT_EQ(regress("b.db", "20").status, 0);
  std::set<std::string> more;
  const ResultTable results = table("b.db");
  for (std::size_t row = 0; row < results.rows.size(); ++row) {
    more.insert(results.text(row, "command"));
  }
  EXPECT_EQ(more.size(), 20U);
  const ResultTable fewer = table("a.db");
  for (std::size_t row = 0; row < fewer.rows.size(); ++row) {
    EXPECT_EQ(more.count(fewer.text(row, "command")), 1U) << "the first 12 are the same";
  }
  const std::string junit = read_whole_file(file("junit.xml"));
  EXPECT_NE(junit.find("tests=\"20\""), std::string::npos) << junit;
  expect_refused({"regress", "--count", "5"}, "go with --random");
  expect_refused({"regress", "sphere", "--random"}, "draws its scenes itself");
}

// RTL that reads a wrong word of the table fails in one bucket, with the command that shows it. The
// same RTL again is known; the installed RTL is another run.
TEST_F(Campaigns, FailuresOfTheUsersRtlAreOneBucket) {
  fs::create_directories(folder_ / "rtl");
  for (const auto& entry : fs::directory_iterator(PHONGPIPE_HARDWARE)) {
    if (entry.is_regular_file()) fs::copy(entry.path(), folder_ / "rtl");
  }
  std::string rom = read_whole_file(file("rtl/exponent_rom.sv"));
  const std::string read = "s7_word <= table_words[s6_place];";
  ASSERT_NE(rom.find(read), std::string::npos);
  rom.replace(rom.find(read), read.size(), "s7_word <= table_words[s6_place ^ 64];");
  write("rtl/exponent_rom.sv", rom);
  setenv("XDG_CACHE_HOME", file("cache").c_str(), 1);
  const std::vector<std::string> regress = {"regress",       "sphere",    "torus",
                                            "--rtl-sources", file("rtl"), "--db",
                                            file("a.db"),    "--junit",   file("junit.xml")};
  const ProcessOutput output = run(regress);
  EXPECT_EQ(output.status, 1) << output.text;
  EXPECT_NE(
      output.text.find("2 × RTL: color: "
                       "pixel_datapath.color.specular.rom.octave.channel[].s7_word: RTL differs"),
      std::string::npos)
      << output.text;
  EXPECT_NE(output.text.find("again  phongpipe verify sphere --rtl " + file("rtl")),
            std::string::npos)
      << output.text;
  EXPECT_NE(read_whole_file(file("junit.xml")).find("failures=\"2\""), std::string::npos);
  const ProcessOutput again = run(regress);
  EXPECT_EQ(again.status, 1) << "what is known to fail still fails";
  EXPECT_NE(again.text.find("2 were known, 2 of them failed"), std::string::npos) << again.text;
  const ProcessOutput installed = run({"regress", "sphere", "--db", file("a.db")});
  EXPECT_NE(installed.text.find("1 of 1 runs passed"), std::string::npos) << installed.text;
}

TEST_F(Campaigns, ExportsTheColumnsThatScriptsRelyOn) {
  ASSERT_EQ(run(sweep("a.db")).status, 0);
  const ProcessOutput csv = run_for_answer("export " + file("a.db") + " --csv -");
  ASSERT_EQ(csv.status, 0);
  const std::string header = csv.text.substr(0, csv.text.find('\n'));
  std::set<std::string_view> columns;
  for (const std::string_view column : split(header, ',')) columns.insert(column);
  for (const char* column :
       {"scene", "configuration_hash", "outcome", "verified_by", "max_lsb", "rms_lsb",
        "datapath_ns_per_pixel", "frame_ns_per_pixel", "frame_cycles", "adders", "register_bits",
        "rom_bits", "command", "datapath.rom_address_bits", "datapath.diffuse_fraction_bits"}) {
    EXPECT_EQ(columns.count(column), 1U) << column;
  }
  ASSERT_EQ(run({"export", file("a.db"), "--json", file("a.json")}).status, 0);
  EXPECT_EQ(json("a.json").size(), 12U);
  EXPECT_EQ(json("a.json")[0]["outcome"], "passed");
}

}  // namespace
}  // namespace phongpipe
