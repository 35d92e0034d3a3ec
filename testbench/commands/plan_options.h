// Options that say what varies: scenes, sweep files, --vary, --tie, --where and --sample.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "testbench/campaign/plan.h"
#include "testbench/commands/options.h"

namespace phongpipe {

struct PlanOptions {
  std::vector<std::string> inputs;  // scenes, and at most one sweep file or shipped sweep
  HardwareOptions hardware;
  std::vector<std::string> vary, ties, conditions;
  std::optional<std::uint64_t> sample, seed;  // none: as the sweep file has them

  void add_to(CLI::App& command);
  // Throws InputError if there is no scene.
  Plan plan() const;
};

}  // namespace phongpipe
