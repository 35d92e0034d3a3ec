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
  const TriangleBounds<Recorded> bounds = bound_triangle(plan, triangle, light);
  if (plan.certify) {  // what each of the two candidates errs by
    const ErrorScales<Recorded> scales;
    const Recorded taylor = taylor_error(Recorded());
    quadratic_errors(*bounds.certified, scales, taylor, taylor);
    quadratic_errors(*bounds.certified, scales, Recorded(kSixPointError), Recorded(kSixPointError));
  }
  setup_triangle(plan, triangle, light, bounds);
  if (plan.exact_path) {  // the vectors that it steps
    const Interpolator<Recorded> interpolate(triangle.x, triangle.y);
    const auto interpolated = [&](const Corners<Recorded>& v) { interpolate(v[0], v[1], v[2]); };
    interpolated(triangle.normal);
    if (plan.form.local_viewer) interpolated(triangle.eye);
    if (plan.form.point_light) interpolated(triangle.light);
  }
  return recording.dataflow();
}

SetupTimes::Cost& SetupTimes::of(const SeriesPlan& plan) {
  for (Cost& cost : known_) {
    if (cost.plan == plan) return cost;
  }
  const Dataflow dataflow = record_setup(plan);
  known_.push_back({plan, dataflow.counts(), schedule_cycles(dataflow, *units_), 0});
  return known_.back();
}

Dataflow record_exact_pixel(const std::vector<ExactLight<double>>& lights, bool depth_cue,
                            int channels) {
  using Vector = Vector3<Recorded>;
  Recording recording;
  const auto stepped = [] {
    return Vector(Vector(Recorded(), Recorded(), Recorded()) +
                  Vector(Recorded(), Recorded(), Recorded()));
  };
  PointVectors<Recorded> at;
  at.normal = stepped();
  if (std::any_of(lights.begin(), lights.end(),
                  [](const ExactLight<double>& light) { return light.form.local_viewer; })) {
    at.eye = stepped();
  }
  std::array<Recorded, 3> color;
  for (const ExactLight<double>& source : lights) {
    ExactLight<Recorded> light;
    light.form = source.form;
    light.cone = source.cone;
    if (light.form.point_light) at.light = stepped();
    add_light(light, exact_point(light, at), channels, color);
  }
  if (depth_cue) {
    const Recorded own = Recorded() + Recorded();  // steps, too
    fade_to_cue({}, own, channels, color);
  }
  return recording.dataflow();
}

ExactPathTimes::ExactPathTimes(const PipelineConfiguration& configuration) : units_(configuration) {
  units_.adders.count = configuration.exact_adders;
  units_.multipliers.count = configuration.exact_multipliers;
}

const ExactPathTimes::Cost& ExactPathTimes::of(const FrameSetup& frame, const Material& material,
                                               std::uint32_t index) {
  const auto [place, added] = known_.try_emplace(index);
  Cost& cost = place->second;
  if (!added) return cost;
  const Dataflow dataflow = record_exact_pixel(
      exact_lights(frame, material), frame.configuration.depth_cue, frame.configuration.channels);
  cost.operations = dataflow.counts();
  cost.latency_cycles = schedule_cycles(dataflow, units_);
  const auto interval = [](std::size_t operations, const Units& units) {
    const int busy = static_cast<int>(operations) * units.interval;
    return (busy + units.count - 1) / units.count;
  };
  cost.interval_cycles = std::max({1, interval(cost.operations.add, units_.adders),
                                   interval(cost.operations.multiply, units_.multipliers),
                                   interval(cost.operations.rsqrt, units_.rsqrt),
                                   interval(cost.operations.power, units_.power)});
  return cost;
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
