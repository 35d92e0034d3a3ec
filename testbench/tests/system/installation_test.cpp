// Files and shipped things by name, and what is told about names there are none of.
#include "testbench/system/installation.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

// In a folder of its own, beside which the shipped scenes lie.
class FindNamed : public ::testing::Test {
 protected:
  FindNamed()
      : folder_(fs::path(::testing::TempDir()) / fmt::format("find-named-{}", getpid())),
        before_(fs::current_path()) {
    fs::create_directories(folder_ / "here");
    fs::create_directories(shipped() / "effects");
    for (const char* name : {"teapot", "pawn", "effects/nettle", "effects/ambient"}) {
      std::ofstream(shipped() / (std::string(name) + ".toml")) << "#\n";
    }
    fs::current_path(folder_ / "here");
  }
  ~FindNamed() override {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }

  fs::path shipped() const { return folder_ / "shipped"; }
  fs::path find(const std::string& name) const { return find_named(name, shipped(), "scene"); }
  void expect_unknown(const std::string& name, const std::string& message) const {
    try {
      ADD_FAILURE() << find(name) << " was found";
    } catch (const InputError& error) {
      EXPECT_EQ(error.what(), message);
    }
  }

 private:
  fs::path folder_, before_;
};

constexpr const char* kList = "there are the scenes pawn, teapot, effects/{ambient, nettle}";

TEST_F(FindNamed, ShippedOnesByNameAlsoInSubfolders) {
  EXPECT_EQ(find("pawn"), shipped() / "pawn.toml");
  EXPECT_EQ(find("effects/ambient"), shipped() / "effects" / "ambient.toml");
}

TEST_F(FindNamed, AFileComesFirst) {
  std::ofstream("pawn") << "#\n";
  EXPECT_EQ(find("pawn"), "pawn");
}

TEST_F(FindNamed, AFolderHidesNothing) {
  fs::create_directory("pawn");
  EXPECT_EQ(find("pawn"), shipped() / "pawn.toml");
}

TEST_F(FindNamed, PipesAndDevicesAreFiles) {
  ASSERT_EQ(mkfifo("pawn", 0600), 0);
  EXPECT_EQ(find("pawn"), "pawn");
  EXPECT_EQ(find("/dev/stdin"), "/dev/stdin");
}

TEST_F(FindNamed, WhatThereIsIsListedAndTheLikelyOneProposed) {
  expect_unknown("xyzzy", fmt::format("xyzzy: no such file or scene; {}", kList));
  expect_unknown("teapto",
                 fmt::format("teapto: no such file or scene; did you mean teapot? {}", kList));
  expect_unknown("ambiant", fmt::format("ambiant: no such file or scene; did you mean "
                                        "effects/ambient? {}",
                                        kList));
  fs::create_directory("folder");
  expect_unknown("folder", fmt::format("folder: is a folder, not a scene; {}", kList));
}

TEST_F(FindNamed, AnyTextIsAName) {
  const std::string list = std::string(": no such file or scene; ") + kList;
  expect_unknown("", list);
  expect_unknown("a\nb\xff", "a\\nb\\xff" + list);
  expect_unknown(std::string(5000, 'x'), std::string(5000, 'x') + list);
}

}  // namespace
}  // namespace phongpipe
