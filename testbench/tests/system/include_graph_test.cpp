// The architecture as the folders show it: includes go from a room to the rooms below it, never up.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "model/files/text_file.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

// From the bottom up. A file may include its own room's headers and those of the rooms before it.
constexpr std::string_view kRooms[] = {
    "model/scene/",       "model/shading/",       "model/fixed/",         "sim/",
    "model/files/",       "testbench/system/",    "testbench/drawing/",   "testbench/hardware/",
    "testbench/rtl/",     "testbench/synthesis/", "testbench/accuracy/",  "testbench/cosim/",
    "testbench/cases/",   "testbench/trace/",     "testbench/methods/",   "testbench/campaign/",
    "testbench/reports/", "testbench/commands/",  "testbench/generators/"};
// They stand beside the program and may include anything, but nothing includes them.
constexpr std::string_view kOutside[] = {"testbench/tests/", "testbench/bench/", "testbench/fuzz/"};

bool is_outside(std::string_view path) {
  return std::any_of(std::begin(kOutside), std::end(kOutside),
                     [path](std::string_view folder) { return starts_with(path, folder); });
}

// The place of the file's room in kRooms, or its size where there is no such room.
std::size_t room_of(std::string_view path) {
  const auto found =
      std::find_if(std::begin(kRooms), std::end(kRooms),
                   [path](std::string_view room) { return starts_with(path, room); });
  return static_cast<std::size_t>(found - std::begin(kRooms));
}

struct Include {
  std::string file;
  std::string header;  // without quotes or brackets
};

std::vector<Include> all_includes() {
  std::vector<Include> includes;
  const fs::path root = PHONGPIPE_SOURCES;
  for (const char* top : {"model", "sim", "testbench"}) {
    for (const auto& entry : fs::recursive_directory_iterator(root / top)) {
      const std::string extension = entry.path().extension().string();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string text = read_whole_file(entry.path());
      std::string_view line;
      for (LineReader lines(text); lines.next(line);) {
        const std::string_view directive = "#include ";
        if (!starts_with(line, directive)) continue;
        const std::string_view quoted = line.substr(directive.size());
        const std::size_t end = quoted.find_first_of("\">", 1);
        includes.push_back(
            {fs::relative(entry.path(), root).string(), std::string(quoted.substr(1, end - 1))});
      }
    }
  }
  return includes;
}

TEST(IncludeGraph, NoArrowRunsUpwards) {
  std::size_t arrows = 0;
  for (const Include& include : all_includes()) {
    const bool own = starts_with(include.header, "model/") || starts_with(include.header, "sim/") ||
                     starts_with(include.header, "testbench/");
    if (!own || is_outside(include.file)) continue;
    ++arrows;
    const std::size_t from = room_of(include.file), to = room_of(include.header);
    ASSERT_LT(from, std::size(kRooms)) << include.file << " stands in no room";
    EXPECT_LE(to, from) << include.file << " includes " << include.header;
  }
  EXPECT_GT(arrows, 300U) << "the sources were not found";
}

TEST(IncludeGraph, TheModelNeedsNoFilesNorSimulators) {
  for (const Include& include : all_includes()) {
    const bool model =
        starts_with(include.file, "model/") && !starts_with(include.file, "model/files/");
    if (!model && !starts_with(include.file, "sim/")) continue;
    for (const char* library :
         {"toml++", "nlohmann", "seccomp", "verilated", "filesystem", "fstream", "thread"}) {
      EXPECT_FALSE(starts_with(include.header, library))
          << include.file << " includes " << include.header;
    }
    EXPECT_FALSE(model && include.header == "systemc") << include.file;
  }
}

}  // namespace
}  // namespace phongpipe
