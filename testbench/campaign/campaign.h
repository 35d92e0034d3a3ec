// Does the runs of a campaign on all cores, and records their results as they come.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "testbench/campaign/store.h"

namespace phongpipe {

// A run to do.
struct CampaignRun {
  RunRequest request;
  std::vector<std::pair<std::string, std::string>> values;  // of keys that vary
};

struct CampaignOptions {
  int jobs = 0;  // runs at once; 0: one for each core
  int shard = 1, shards = 1;
  RunLimits limits;
  bool retry_failed = false;  // runs that failed, crashed or took too long are done again
  // Runs whose only fault is that values do not fit their registers count as refused: hardware
  // drawn at random often cannot represent a scene drawn at random.
  bool overflow_is_refusal = false;
  bool fail_fast = false;  // no new runs after the first that failed or crashed
};

// The run with the least error of those that passed.
struct BestRun {
  double max_lsb = 0, frame_ns_per_pixel = 0;
};

// State of a campaign.
struct CampaignProgress {
  std::uint64_t total = 0;           // runs of the shard
  std::uint64_t known = 0;           // of them that were stored before
  std::uint64_t known_failures = 0;  // of these that failed, crashed or timed out
  std::uint64_t known_crashes = 0;   // of these that crashed
  std::uint64_t passed = 0, failed = 0, refused = 0, crashed = 0, timed_out = 0;  // done now
  double seconds = 0;           // since the first run was begun
  std::optional<BestRun> best;  // of those done now

  // Of two parts of a campaign, one done after the other.
  CampaignProgress operator+(const CampaignProgress& later) const;
  std::uint64_t failures() const { return failed + crashed + timed_out + known_failures; }
  std::uint64_t done() const { return passed + failed + refused + crashed + timed_out; }
};

struct CampaignResult {
  CampaignProgress progress;
  std::vector<std::string> identities;            // of the shard's runs that are legal
  bool interrupted = false;                       // by Ctrl-C, or by fail_fast
  std::vector<StoredRun> not_passed;              // failed, crashed or timed out now
  std::map<std::string, std::uint64_t> refusals;  // now, by reason
};

using ShowCampaign = std::function<void(const CampaignProgress&)>;

// Does all runs that the store does not have. `open_store` is called once, when it is known that
// some run is legal; otherwise InputError is thrown. `should_stop` is asked often; once it is true,
// the runs in flight are finished and no others are begun.
CampaignResult run_campaign(const std::vector<CampaignRun>& runs, const CampaignOptions& options,
                            const std::function<Store&()>& open_store, const ShowCampaign& show,
                            const std::function<bool()>& should_stop);

}  // namespace phongpipe
