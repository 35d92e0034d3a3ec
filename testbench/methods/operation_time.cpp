#include "testbench/methods/operation_time.h"

#include <algorithm>

namespace phongpipe {
namespace {

double per_clock(const Units& units) {
  return static_cast<double>(units.count) / units.interval;
}

}  // namespace

Roots roots_of(const OperationCounts& counts) {
  const std::size_t pairs = std::min(counts.divide, counts.sqrt);
  return {pairs, counts.divide - pairs, counts.sqrt - pairs};
}

double clocks(const OperationCounts& counts, const PipelineConfiguration& units) {
  const auto [pairs, divisions, roots] = roots_of(counts);
  const auto multiplications = static_cast<double>(counts.multiply + pairs + 2 * divisions + roots);
  const auto rsqrts = static_cast<double>(counts.rsqrt + pairs + divisions + roots);
  return std::max({static_cast<double>(counts.add) / per_clock(units.adders),
                   multiplications / per_clock(units.multipliers), rsqrts / per_clock(units.rsqrt),
                   static_cast<double>(counts.power) / per_clock(units.power),
                   static_cast<double>(counts.read)});
}

double sequential_operations(const OperationCounts& counts) {
  constexpr double kTabled = 10;
  const auto [pairs, divisions, roots] = roots_of(counts);
  return static_cast<double>(counts.add + counts.multiply + counts.read + pairs) +
         kTabled * static_cast<double>(counts.rsqrt + counts.power + pairs + divisions + roots);
}

}  // namespace phongpipe
