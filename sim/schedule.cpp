#include "sim/schedule.h"

#include <algorithm>
#include <array>
#include <queue>
#include <stdexcept>
#include <vector>

namespace phongpipe {
namespace {

constexpr std::size_t kKinds = 4;  // of operations that the setup engine has units for

const Units& units_for(Operation operation, const PipelineConfiguration& units) {
  switch (operation) {
    case Operation::add:
      return units.adders;
    case Operation::multiply:
      return units.multipliers;
    case Operation::rsqrt:
      return units.rsqrt;
    case Operation::power:
      return units.power;
    case Operation::divide:
    case Operation::sqrt:
    case Operation::read:
      break;
  }
  throw std::logic_error("the setup engine has no unit for divisions, roots or table reads");
}

// For each node, cycles from its start to the end of the longest chain that hangs on it.
std::vector<int> remaining_path(const Dataflow& dataflow, const PipelineConfiguration& units) {
  std::vector<int> path(dataflow.nodes.size(), 0);
  for (std::size_t i = dataflow.nodes.size(); i-- > 0;) {
    const Dataflow::Node& node = dataflow.nodes[i];
    path[i] += units_for(node.operation, units).latency;
    for (const int operand : {node.left, node.right}) {
      if (operand == Dataflow::kInput) continue;
      int& before = path[static_cast<std::size_t>(operand)];
      before = std::max(before, path[i]);
    }
  }
  return path;
}

}  // namespace

Dataflow record_setup(const SeriesPlan& plan) {
  Recording recording;
  const TriangleInput<Recorded> triangle;
  const LightInput<Recorded> light;
  setup_triangle(plan, triangle, light, bound_triangle(plan, triangle, light));
  return recording.dataflow();
}

const SetupTimes::Cost& SetupTimes::of(const SeriesPlan& plan) {
  for (const Cost& cost : known_) {
    if (cost.plan == plan) return cost;
  }
  const Dataflow dataflow = record_setup(plan);
  known_.push_back({plan, dataflow.counts(), schedule_cycles(dataflow, *units_)});
  return known_.back();
}

int schedule_cycles(const Dataflow& dataflow, const PipelineConfiguration& units) {
  const std::size_t count = dataflow.nodes.size();
  const std::vector<int> path = remaining_path(dataflow, units);
  std::vector<std::vector<std::size_t>> users(count);
  std::vector<int> waiting_for(count, 0), operands_at(count, 0);
  using Ready = std::pair<int, std::size_t>;  // remaining path, node
  std::array<std::priority_queue<Ready>, kKinds> ready;
  std::vector<std::vector<std::size_t>> arriving;  // by cycle
  const auto arrive = [&arriving](int cycle, std::size_t node) {
    const auto at = static_cast<std::size_t>(cycle);
    if (arriving.size() <= at) arriving.resize(at + 1);
    arriving[at].push_back(node);
  };
  for (std::size_t i = 0; i < count; ++i) {
    for (const int operand : {dataflow.nodes[i].left, dataflow.nodes[i].right}) {
      if (operand == Dataflow::kInput) continue;
      users[static_cast<std::size_t>(operand)].push_back(i);
      ++waiting_for[i];
    }
    if (waiting_for[i] == 0) arrive(0, i);
  }

  std::array<std::vector<int>, kKinds> unit_free;
  for (std::size_t kind = 0; kind < kKinds; ++kind) {
    const Units& unit = units_for(static_cast<Operation>(kind), units);
    unit_free[kind].assign(static_cast<std::size_t>(unit.count), 0);
  }
  int end = 0;
  std::size_t started = 0;
  for (int cycle = 0; started < count; ++cycle) {
    const auto now = static_cast<std::size_t>(cycle);
    if (now < arriving.size()) {
      for (const std::size_t node : arriving[now]) {
        ready[static_cast<std::size_t>(dataflow.nodes[node].operation)].push({path[node], node});
      }
    }
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      const Units& unit = units_for(static_cast<Operation>(kind), units);
      for (int& free_at : unit_free[kind]) {
        if (free_at > cycle || ready[kind].empty()) continue;
        const std::size_t node = ready[kind].top().second;
        ready[kind].pop();
        ++started;
        free_at = cycle + unit.interval;
        const int done = cycle + unit.latency;
        end = std::max(end, done);
        for (const std::size_t user : users[node]) {
          operands_at[user] = std::max(operands_at[user], done);
          if (--waiting_for[user] == 0) arrive(operands_at[user], user);
        }
      }
    }
  }
  return end;
}

}  // namespace phongpipe
