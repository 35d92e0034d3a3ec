// Does the runs of a campaign on all cores, and records their results as they come.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "testbench/campaign/store.h"
#include "testbench/trace/failure.h"

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
  // Where capsules of runs that diverge are kept, as IDENTITY.toml.
  std::filesystem::path failures = kFailureFolder;
  bool fail_fast = false;  // no new runs after the first that failed or crashed
};

// The run with the least error of those that passed.
struct BestRun {
  double max_lsb = 0, frame_ns_per_pixel = 0;
};

// Numbers of runs by their outcome.
class OutcomeCounts {
 public:
  std::uint64_t& operator[](Outcome outcome) { return counts_[static_cast<std::size_t>(outcome)]; }
  std::uint64_t operator[](Outcome outcome) const {
    return counts_[static_cast<std::size_t>(outcome)];
  }
  std::uint64_t all() const { return std::accumulate(counts_.begin(), counts_.end(), 0UL); }
  std::uint64_t failures() const {
    return all() - (*this)[Outcome::passed] - (*this)[Outcome::refused];
  }
  OutcomeCounts& operator+=(const OutcomeCounts& others) {
    for (std::size_t i = 0; i < counts_.size(); ++i) counts_[i] += others.counts_[i];
    return *this;
  }

 private:
  std::array<std::uint64_t, kOutcomes> counts_{};
};

// State of a campaign.
struct CampaignProgress {
  std::uint64_t total = 0;      // runs of the shard
  OutcomeCounts known;          // of them that were stored before
  OutcomeCounts done;           // done now
  double seconds = 0;           // since the first run was begun
  std::optional<BestRun> best;  // of those done now

  // Of two parts of a campaign, one done after the other.
  CampaignProgress operator+(const CampaignProgress& later) const;
  std::uint64_t failures() const { return known.failures() + done.failures(); }
  std::uint64_t left() const { return total - known.all() - done.all(); }
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
