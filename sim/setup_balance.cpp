#include "sim/setup_balance.h"

#include <algorithm>

#include "sim/schedule.h"

namespace phongpipe {
namespace {

// The dataflow of a plan and how often it is carried out.
struct Repeated {
  Dataflow dataflow;
  OperationCounts counts;
  std::int64_t times = 0;
};

std::vector<Repeated> recorded(const std::vector<SetupUse>& uses) {
  std::vector<Repeated> result;
  result.reserve(uses.size());
  for (const SetupUse& use : uses) {
    Dataflow dataflow = record_setup(use.plan);
    const OperationCounts counts = dataflow.counts();
    result.push_back({std::move(dataflow), counts, static_cast<std::int64_t>(use.triangles)});
  }
  return result;
}

// Cycles during which a kind of unit is occupied at least.
std::int64_t occupied(std::size_t operations, const Units& units) {
  const auto each = (static_cast<std::int64_t>(operations) + units.count - 1) / units.count;
  return each * units.interval;
}

class Search {
 public:
  Search(const std::vector<SetupUse>& uses, const PipelineConfiguration& units, std::int64_t cycles)
      : setups_(recorded(uses)), units_(units), cycles_(cycles) {
    for (const Repeated& setup : setups_) {
      most_.adders = std::max(most_.adders, static_cast<int>(setup.counts.add));
      most_.multipliers = std::max(most_.multipliers, static_cast<int>(setup.counts.multiply));
      most_.rsqrt = std::max(most_.rsqrt, static_cast<int>(setup.counts.rsqrt));
      most_.power = std::max(most_.power, static_cast<int>(setup.counts.power));
    }
  }

  std::optional<PipelineConfiguration> fewest() {
    const int most = most_.adders + most_.multipliers + most_.rsqrt + most_.power;
    set(most_.adders, most_.multipliers, most_.rsqrt, most_.power);
    if (!suffices()) return std::nullopt;
    for (int total = kKinds; total <= most; ++total) {
      if (try_total(total)) return units_;
    }
    return units_;
  }

 private:
  static constexpr int kKinds = 4;
  struct Counts {
    int adders = 1, multipliers = 1, rsqrt = 1, power = 1;
  };

  void set(int adders, int multipliers, int rsqrt, int power) {
    units_.adders.count = adders;
    units_.multipliers.count = multipliers;
    units_.rsqrt.count = rsqrt;
    units_.power.count = power;
  }
  bool try_total(int total) {
    for (int multipliers = 1; multipliers <= most_.multipliers; ++multipliers) {
      for (int rsqrt = 1; rsqrt <= most_.rsqrt; ++rsqrt) {
        for (int power = 1; power <= most_.power; ++power) {
          const int adders = total - multipliers - rsqrt - power;
          if (adders < 1 || adders > most_.adders) continue;
          set(adders, multipliers, rsqrt, power);
          if (suffices()) return true;
        }
      }
    }
    return false;
  }
  // Cheap bounds first: most numbers of units fail by them.
  bool suffices() const {
    std::int64_t least = 0;
    for (const Repeated& setup : setups_) {
      least += setup.times * std::max({occupied(setup.counts.add, units_.adders),
                                       occupied(setup.counts.multiply, units_.multipliers),
                                       occupied(setup.counts.rsqrt, units_.rsqrt),
                                       occupied(setup.counts.power, units_.power)});
    }
    if (least > cycles_) return false;
    std::int64_t cycles = 0;
    for (const Repeated& setup : setups_) {
      cycles += setup.times * schedule_cycles(setup.dataflow, units_);
      if (cycles > cycles_) return false;
    }
    return true;
  }

  std::vector<Repeated> setups_;
  PipelineConfiguration units_;
  std::int64_t cycles_;
  Counts most_;  // more of a kind are never used
};

}  // namespace

std::int64_t setup_cycles(const std::vector<SetupUse>& uses, const PipelineConfiguration& units) {
  std::int64_t cycles = 0;
  for (const Repeated& setup : recorded(uses)) {
    cycles += setup.times * schedule_cycles(setup.dataflow, units);
  }
  return cycles;
}

PipelineConfiguration with_most_units(PipelineConfiguration pipeline) {
  constexpr int kMost = 1000;
  for (Units* const units :
       {&pipeline.adders, &pipeline.multipliers, &pipeline.rsqrt, &pipeline.power}) {
    units->count = kMost;
  }
  return pipeline;
}

std::optional<PipelineConfiguration> fewest_setup_units(const std::vector<SetupUse>& uses,
                                                        const PipelineConfiguration& units,
                                                        std::int64_t cycles) {
  return Search(uses, units, cycles).fewest();
}

}  // namespace phongpipe
