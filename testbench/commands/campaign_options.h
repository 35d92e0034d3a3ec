// Options of the commands that do campaigns, `sweep` and `regress`, and how these run.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "testbench/campaign/campaign.h"
#include "testbench/campaign/plan.h"

namespace phongpipe {

struct CampaignCommand {
  std::string kind;      // "sweep" or "regress"
  std::string database;  // file, or Store::kInMemory
  std::string shard;     // I/N
  RtlToVerify rtl = RtlToVerify::native;
  std::filesystem::path rtl_sources;  // folder; empty: the installed RTL
  CampaignOptions options;
  std::function<void(const Store&)> finish;  // called with all results, if set

  void add_to(CLI::App& command);
  // Both do the runs, show progress, then the answer, and return the exit status.
  int run(const Plan& plan);
  // Begins random runs until there were `count`, or for `seconds`; 0: no limit.
  int run_random(std::uint64_t seed, std::uint64_t count, double seconds);
};

// Exit status after Ctrl-C, as shells have it.
constexpr int kInterrupted = 130;

}  // namespace phongpipe
