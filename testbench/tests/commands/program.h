// phongpipe as its user runs it, in a folder of the test's own.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "model/files/text_file.h"
#include "testbench/system/process.h"

namespace phongpipe {

class Program : public ::testing::Test {
 protected:
  Program()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                fmt::format("phongpipe-{}", getpid())) {
    std::filesystem::create_directories(folder_);
    // Not the user's; and kept, so that only the first run builds the RTL.
    setenv("XDG_CACHE_HOME", PHONGPIPE_RTL_CACHE, 1);
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  static ProcessOutput run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), PHONGPIPE_PROGRAM);
    return run_process(arguments);
  }
  // Standard output alone: a sanitizer may say something of its own.
  static ProcessOutput run_for_answer(const std::string& arguments) {
    return run_process({"sh", "-c", PHONGPIPE_PROGRAM " " + arguments + " 2>/dev/null"});
  }
  // What verify writes as JSON.
  nlohmann::json verify(std::vector<std::string> arguments, int status = 0) const {
    arguments.insert(arguments.begin(), "verify");
    arguments.insert(arguments.end(), {"--json", file("r.json")});
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, status) << output.text;
    return json("r.json");
  }
  static void expect_agreement(const nlohmann::json& result) {
    EXPECT_EQ(result["mismatches"]["model_rtl"], 0);
    EXPECT_EQ(result["mismatches"]["model_systemc"], 0);
    EXPECT_EQ(result["mismatches"]["frame_rtl"], 0);
    EXPECT_EQ(result["mismatches"]["frame_systemc"], 0);
    EXPECT_EQ(result["cycles"]["difference"], 0);
    EXPECT_EQ(result["coefficient_overflows"], 0);
    EXPECT_TRUE(result["passed"]);
  }
  // Bad input: one line that holds `message`, status 2, and nothing written.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& message) const {
    const auto files = [this] {
      return std::distance(std::filesystem::directory_iterator(folder_),
                           std::filesystem::directory_iterator());
    };
    const auto before = files();
    const ProcessOutput output = run(arguments);
    EXPECT_EQ(output.status, 2) << output.text;
    EXPECT_NE(output.text.find(message), std::string::npos) << output.text;
    EXPECT_EQ(lines_of(output.text), 1) << output.text;
    EXPECT_EQ(files(), before) << "something was left behind";
  }

  // The lines of ours: the address sanitizer warns of the stacks of SystemC's threads, now and
  // then.
  static int lines_of(const std::string& text) {
    int count = 0;
    std::string_view line;
    for (LineReader lines(text); lines.next(line);) {
      const auto begins = [line](std::string_view start) {
        return line.substr(0, start.size()) == start;
      };
      count += !begins("==") && !begins("False positive") && !begins("For details see");
    }
    return count;
  }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return file(name);
  }
  nlohmann::json json(const std::string& name) const {
    return nlohmann::json::parse(read_whole_file(file(name)));
  }
  static std::string shipped_scene(const std::string& name) {
    return read_whole_file(std::filesystem::path(PHONGPIPE_SCENES) / (name + ".toml"));
  }
  // A scene whose object lies beside the image.
  std::string write_empty_picture() const {
    std::string text = shipped_scene("sphere");
    const std::string object = "primitive = \"sphere\"\n";
    text.insert(text.find(object) + object.size(), "translate = [1000, 0, 0]\n");
    return write("away.toml", text);
  }

  std::filesystem::path folder_;
};

}  // namespace phongpipe
