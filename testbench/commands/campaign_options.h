// Options of the commands that do campaigns, `sweep` and `regress`, and how these run.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "testbench/campaign/campaign.h"

namespace phongpipe {

struct CampaignCommand {
  std::string kind;      // "sweep" or "regress"
  std::string database;  // file; of sweep and regress alike
  std::string shard;     // I/N
  RtlToVerify rtl = RtlToVerify::native;
  CampaignOptions options;
  std::string again;  // the command line, to go on after Ctrl-C

  void add_to(CLI::App& command);
  // Does the runs; shows progress, then the answer. `keys`: those that vary. Returns the exit
  // status. `result`, if not null, takes what was done.
  int run(std::vector<CampaignRun> runs, const std::vector<std::string>& keys,
          CampaignResult* result = nullptr);
};

// Exit status after Ctrl-C, as shells have it.
constexpr int kInterrupted = 130;

}  // namespace phongpipe
