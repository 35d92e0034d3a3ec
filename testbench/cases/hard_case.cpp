#include "testbench/cases/hard_case.h"

#include <fmt/format.h>

#include <sstream>

#include "model/files/text_file.h"
#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/cases/guards.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

// The lines that begin with `#!`, without that; other lines are left empty, so that those of
// messages are those of the file.
std::string head_of(const std::string& text) {
  constexpr std::string_view kMark = "#!";
  std::istringstream lines(text);
  std::string head, line;
  while (std::getline(lines, line)) {
    if (line.compare(0, kMark.size(), kMark) == 0) head += line.substr(kMark.size());
    head += '\n';
  }
  return head;
}

}  // namespace

HardCase load_hard_case(const std::filesystem::path& file, const std::string& name) {
  const TomlTable head = TomlTable::read_text(head_of(read_whole_file(file)), file);
  HardCase result;
  result.name = name;
  result.file = file;
  result.breaks = head.text("breaks");
  result.must = head.text("must");
  result.guard = head.text("guard");
  result.hardware = head.text("hardware", result.hardware);
  if (head.has("settings")) result.settings = head.values("settings");
  if (head.has("without")) result.without = head.values("without");
  result.max_error_lsb = head.number("max_error_lsb", {0.5, 255}, result.max_error_lsb);
  result.refused = head.text("refused", "");
  result.stall_percent = head.integer("stall", 0, 100, 0);
  if (find_guard(result.guard) == nullptr) {
    head.fail("guard",
              fmt::format("no guard is called '{}'; there are {}", result.guard, guard_names()));
  }
  if ((result.guard == kRefusal) == result.refused.empty()) {
    head.fail("guard", "guard = \"refusal\" and refused = \"part of the message\" go together");
  }
  if ((result.guard == kSettings) == result.without.empty()) {
    head.fail("guard", "guard = \"settings\" and without = [\"key=value\"] go together");
  }
  head.finish();
  return result;
}

std::vector<HardCase> hard_cases() {
  const std::filesystem::path folder = installation().hard_cases;
  std::vector<HardCase> cases;
  for (const std::string& name : names_in(folder)) {
    cases.push_back(load_hard_case(folder / (name + ".toml"), name));
  }
  return cases;
}

}  // namespace phongpipe
