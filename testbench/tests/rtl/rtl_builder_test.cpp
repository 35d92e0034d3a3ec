// RTL is built whatever the paths, and where it is not, the tool's first complaint is told.
#include "testbench/rtl/rtl_builder.h"
#include "testbench/rtl/tool_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/rtl/rtl_cache.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class RtlBuilder : public ::testing::Test {
 protected:
  RtlBuilder()
      : folder_(fs::path(::testing::TempDir()) / fmt::format("rtl-builder-{}", getpid())),
        search_path_(std::getenv("PATH")) {
    fs::create_directories(folder_ / "tools");
    copy_rtl(rtl());
  }
  ~RtlBuilder() override {
    setenv("PATH", search_path_.c_str(), 1);
    fs::remove_all(folder_);
  }

  fs::path rtl() const { return folder_ / "rtl"; }
  fs::path cache() const { return folder_ / "cache"; }
  fs::path library() const { return cache() / "library.so"; }

  static void copy_rtl(const fs::path& to) {
    fs::create_directories(to);
    for (const fs::path& file : rtl_sources(PHONGPIPE_HARDWARE)) {
      fs::copy_file(file, to / file.filename());
    }
  }
  void replace(const std::string& file, const std::string& correct,
               const std::string& broken) const {
    std::string text = read_whole_file(rtl() / file);
    const std::size_t at = text.find(correct);
    ASSERT_NE(at, std::string::npos) << file << " has changed; fix the test";
    std::ofstream(rtl() / file) << text.replace(at, correct.size(), broken);
  }
  // In place of the tool that is installed.
  void pretend(const std::string& tool, const std::string& script) const {
    std::ofstream(folder_ / "tools" / tool) << "#!/bin/sh\n" << script << '\n';
    fs::permissions(folder_ / "tools" / tool, fs::perms(0755));
    setenv("PATH", ((folder_ / "tools").string() + ":" + search_path_).c_str(), 1);
  }
  // Besides those that begin with a dot.
  static int files_in(const fs::path& folder) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
      count += entry.path().filename().string().front() != '.';
    }
    return count;
  }
  void build() const { build_rtl({{FrameConfiguration(), library()}}, rtl()); }
  // One line, and nothing stays behind.
  template <typename Error = ToolError>
  void expect_failure(const std::string& message) const {
    try {
      build();
      ADD_FAILURE() << "it was built";
    } catch (const Error& error) {
      const std::string text = error.what();
      EXPECT_NE(text.find(message), std::string::npos) << text;
      EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    }
    EXPECT_TRUE(!fs::exists(cache()) || fs::is_empty(cache()));
  }

  fs::path folder_;

 private:
  std::string search_path_;
};

TEST_F(RtlBuilder, AnyPathsWillDo) {
  const std::string odd = "a b'c\"d$HOME;e\n`f`*(ü)&|\\ -x";
  const fs::path sources = folder_ / odd / "rtl", kept = folder_ / odd / "-kept";
  copy_rtl(sources);
  std::ofstream(sources / "$an extra;.sv") << "module _an_extra_;\nendmodule\n";
  RtlBuildOptions options;
  options.sources = sources;
  options.destination = kept;
  const RtlLibrary library(FrameConfiguration(), options);
  EXPECT_EQ(library.file().parent_path(), kept);
  void* const datapath = library.interface().create();
  EXPECT_NE(datapath, nullptr);
  library.interface().destroy(datapath);
  EXPECT_EQ(files_in(kept), 1) << "only the library stays";
}

// With tools that leave a file that cannot be loaded.
TEST_F(RtlBuilder, ALibraryIsNamedByTheContentsAndNamesOfItsSources) {
  pretend("verilator", "exit 0");
  pretend("g++", "echo none > pixel_datapath.so");
  RtlBuildOptions options;
  options.destination = cache();
  const auto libraries_after_loading_from = [&](const fs::path& sources) {
    options.sources = sources;
    try {
      const RtlLibrary library(FrameConfiguration(), options);
      ADD_FAILURE() << "it was loaded";
    } catch (const ToolError& error) {
      EXPECT_NE(std::string(error.what()).find("remove the file to have it built anew"),
                std::string::npos)
          << error.what();
    }
    return files_in(cache());
  };
  std::ofstream(rtl() / "color_sum.sv", std::ios::app) << "//\n";  // not what is installed
  EXPECT_EQ(libraries_after_loading_from(rtl()), 1);
  fs::copy(rtl(), folder_ / "copy");
  EXPECT_EQ(libraries_after_loading_from(folder_ / "copy"), 1) << "the RTL is the same";
  std::ofstream(rtl() / "color_sum.sv", std::ios::app) << "//\n";
  EXPECT_EQ(libraries_after_loading_from(rtl()), 2);
  fs::rename(rtl() / "color_sum.sv", rtl() / "colour_sum.sv");
  EXPECT_EQ(libraries_after_loading_from(rtl()), 3);
}

TEST_F(RtlBuilder, AWarningOfVerilatorIsToldWithTheUsersFile) {
  replace("color_sum.sv", "endmodule", "  logic [7:0] wide = 9'd256 + 9'd1;\nendmodule");
  expect_failure("verilator said: %Warning-");
  expect_failure((rtl() / "color_sum.sv").string() + ":");
}

TEST_F(RtlBuilder, TheFirstComplaintIsToldWhateverElseIsPrinted) {
  pretend("verilator",
          "echo 'perl: warning: no such locale'; echo '%Warning-WIDTH: a.sv:3:1: too wide'; "
          "echo '%Error: a.sv:4:1: worse'; echo '%Error: Exiting due to 1 error(s)'; exit 1");
  expect_failure("verilator said: %Warning-WIDTH: a.sv:3:1: too wide");
}

TEST_F(RtlBuilder, AnErrorOfVerilatorIsToldWithTheUsersFile) {
  replace("color_sum.sv", "endmodule", "nonsense here\nendmodule");
  expect_failure("verilator said: %Error: " + (rtl() / "color_sum.sv").string() + ":");
}

TEST_F(RtlBuilder, AnErrorOfTheCompilerIsTold) {
  pretend("g++",
          "echo 'In file included from a.cpp:1:'; echo 'a.h:2:3: error: no such port'; "
          "echo 'a.h:9:9: error: another'; exit 1");
  expect_failure("g++ said: a.h:2:3: error: no such port");
  pretend("g++",
          "echo '/usr/bin/ld: cannot find -lm'; echo 'collect2: error: ld returned 1'; exit 1");
  expect_failure("g++ said: /usr/bin/ld: cannot find -lm");
  pretend("g++", "kill -9 $$");
  expect_failure("g++ said: nothing, and ended with 128");
}

TEST_F(RtlBuilder, AToolThatIsMissingIsNamedWithItsPackage) {
  // Only what Verilator's script needs.
  const fs::path tools = folder_ / "few";
  fs::create_directory(tools);
  for (const char* tool : {"perl", "env", "sh"}) {
    fs::create_symlink(fs::path("/usr/bin") / tool, tools / tool);
  }
  setenv("PATH", tools.c_str(), 1);
  expect_failure("verilator is not installed; install the package verilator, or choose");
  for (const char* tool : {"verilator", "verilator_bin"}) {
    fs::create_symlink(fs::path("/usr/bin") / tool, tools / tool);
  }
  expect_failure("g++ is not installed; install the package g++, or choose");
}

TEST_F(RtlBuilder, AFolderWithoutRtlIsBadInput) {
  for (const fs::path& file : rtl_sources(rtl())) {
    if (file.extension() == ".sv") fs::remove(file);
  }
  expect_failure<InputError>("rtl: no RTL here");
  fs::remove_all(rtl());
  expect_failure<InputError>("rtl: No such file or directory");
}

TEST_F(RtlBuilder, ACacheThatCannotBeWrittenIsNamed) {
  std::ofstream(folder_ / "file") << "in the way";
  try {
    build_rtl({{FrameConfiguration(), folder_ / "file" / "cache" / "library.so"}}, rtl());
    FAIL() << "it was built";
  } catch (const ToolError& error) {
    EXPECT_NE(std::string(error.what()).find("cache: no folder can be made there: Not a directory"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(RtlBuilder, WhatAKilledBuildLeftBehindIsSwept) {
  const pid_t dead = fork();
  if (dead == 0) _exit(0);
  waitpid(dead, nullptr, 0);
  std::string machine(256, '\0');
  gethostname(machine.data(), machine.size() - 1);
  machine = machine.c_str();
  const auto scratch = [&](const std::string& of, pid_t process) {
    return cache() / fmt::format("build-{}-{}-a1B2c3", of, process);
  };
  const fs::path abandoned = scratch(machine, dead), in_use = scratch(machine, getpid()),
                 elsewhere = scratch("another-machine", dead);
  for (const fs::path& folder : {abandoned, in_use, elsewhere}) {
    fs::create_directories(folder / "inner");
  }
  pretend("g++", "exit 1");
  EXPECT_THROW(build(), ToolError);
  EXPECT_FALSE(fs::exists(abandoned));
  EXPECT_TRUE(fs::exists(in_use / "inner"));
  EXPECT_TRUE(fs::exists(elsewhere / "inner"));
}

TEST_F(RtlBuilder, ADamagedLibraryIsBuiltAgain) {
  RtlBuildOptions options;
  options.sources = rtl();
  options.destination = cache();
  std::ofstream(rtl() / "color_sum.sv", std::ios::app) << "//\n";  // not what is installed
  const fs::path file = RtlLibrary(FrameConfiguration(), options).file();
  const std::string whole = read_whole_file(file);
  std::string changed = whole;
  changed[whole.size() / 2] ^= 1;
  for (const std::string& damaged : {changed, whole.substr(0, whole.size() - 1), whole + "x",
                                     std::string(), whole.substr(0, whole.size() / 2)}) {
    // A new file: the library may still be mapped.
    fs::remove(file);
    std::ofstream(file, std::ios::binary) << damaged;
    EXPECT_FALSE(is_sealed(file));
  }
  EXPECT_EQ(RtlLibrary(FrameConfiguration(), options).file(), file);
  EXPECT_TRUE(is_sealed(file));
}

TEST_F(RtlBuilder, ALibraryOfAnotherConfigurationOrUserIsBuiltAgain) {
  RtlBuildOptions options;
  options.sources = rtl();
  options.destination = cache();
  std::ofstream(rtl() / "color_sum.sv", std::ios::app) << "//\n";  // not what is installed
  FrameConfiguration other;
  other.channels = 3;
  const fs::path file = RtlLibrary(FrameConfiguration(), options).file(),
                 others = RtlLibrary(other, options).file();
  fs::remove(file);
  fs::copy_file(others, file);
  EXPECT_EQ(RtlLibrary(FrameConfiguration(), options).file(), file);
  EXPECT_NE(read_whole_file(file), read_whole_file(others));
  if (geteuid() == 0) {  // only root can give a file away
    ASSERT_EQ(chown(file.c_str(), 12345, 12345), 0);
    EXPECT_FALSE(is_sealed(file));
  }
}

TEST_F(RtlBuilder, WhoNeedsTheSameRtlAtOnceBuildsItOnce) {
  pretend("g++",
          fmt::format("echo built >> '{}'\nexec /usr/bin/g++ \"$@\"", (folder_ / "log").string()));
  RtlBuildOptions options;
  options.sources = rtl();
  options.destination = cache();
  std::ofstream(rtl() / "color_sum.sv", std::ios::app) << "//\n";  // not what is installed
  std::vector<pid_t> others;
  for (int i = 0; i < 3; ++i) {
    others.push_back(fork());
    if (others.back() != 0) continue;
    try {
      const RtlLibrary library(FrameConfiguration(), options);
      _exit(0);
    } catch (...) {
      _exit(1);
    }
  }
  for (const pid_t other : others) {
    int status = -1;
    waitpid(other, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(read_whole_file(folder_ / "log"), "built\n");
}

TEST_F(RtlBuilder, TheCacheBelongsToTheUserAlone) {
  setenv("XDG_CACHE_HOME", (folder_ / "home").c_str(), 1);
  const auto mode = [](const fs::path& folder) {
    return static_cast<unsigned>(fs::status(folder).permissions());
  };
  EXPECT_EQ(user_cache(), folder_ / "home" / "phongpipe");
  EXPECT_EQ(mode(user_cache()), 0700U);
  const fs::path library = user_cache() / "a.so";
  std::ofstream(library) << "x";
  fs::permissions(user_cache(), fs::perms(0755));
  EXPECT_EQ(mode(user_cache()), 0700U) << "made by a version that left it open";
  EXPECT_TRUE(fs::exists(library));
  fs::permissions(user_cache(), fs::perms(0777));
  EXPECT_EQ(mode(user_cache()), 0700U);
  EXPECT_FALSE(fs::exists(library)) << "anybody may have put it there";
  if (geteuid() == 0) {  // only root can give a folder away
    ASSERT_EQ(chown(user_cache().c_str(), 12345, 12345), 0);
    EXPECT_THROW(user_cache(), InputError);
  }
  unsetenv("XDG_CACHE_HOME");
  const char* const home = std::getenv("HOME");
  const std::string before = home == nullptr ? "" : home;
  unsetenv("HOME");
  EXPECT_NE(user_cache().parent_path().parent_path(), fs::temp_directory_path());
  setenv("HOME", before.c_str(), 1);
}

}  // namespace
}  // namespace phongpipe
