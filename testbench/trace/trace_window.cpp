#include "testbench/trace/trace_window.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "model/fixed/model_frame.h"
#include "model/scene/input_error.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {

// Sent by the process that looks for them.
struct FoundWindows {
  std::vector<CycleWindow> windows;
  std::int64_t frame_cycles = 0, last_span = 0;

  static constexpr auto fields() {
    using F = FoundWindows;
    return std::make_tuple(field("windows", &F::windows), field("frame_cycles", &F::frame_cycles),
                           field("last_span", &F::last_span));
  }
};

namespace {

// Sorts windows, cuts them to the frame, and joins those that touch.
std::vector<CycleWindow> joined(std::vector<CycleWindow> windows, std::int64_t frame_cycles) {
  std::sort(windows.begin(), windows.end(),
            [](const CycleWindow& a, const CycleWindow& b) { return a.first < b.first; });
  std::vector<CycleWindow> result;
  for (CycleWindow& window : windows) {
    window.first = std::max<std::int64_t>(window.first, 0);
    window.last = std::min(window.last, frame_cycles - 1);
    if (!result.empty() && window.first <= result.back().last + 1) {
      result.back().last = std::max(result.back().last, window.last);
    } else {
      result.push_back(window);
    }
  }
  return result;
}

// Looks at every pixel of the stream for the target.
class WindowFinder {
 public:
  WindowFinder(const PreparedFrame& frame, const TraceTarget& target, int slowest_output_cycles)
      : target_(target),
        whole_(frame.subdivision().whole),
        latency_(frame.setup.configuration.latency_cycles()),
        spans_(frame.setup),
        slowest_output_cycles_(slowest_output_cycles) {}

  void observe(const ShadedPixel& pixel, std::int64_t cycle) {
    add_leaving(cycle);
    if (left_in_span_ == 0) {
      if (!spans_.next()) return;
      left_in_span_ = spans_.span().row.length;
      ++span_;
    }
    --left_in_span_;
    const std::array<int, 2> place = {pixel.x, pixel.y};
    const auto& pixels = target_.pixels;
    const CycleWindow window = {entered_from_ - target_.margin_cycles,
                                cycle + target_.margin_cycles};
    if (std::find(pixels.begin(), pixels.end(), place) != pixels.end()) windows_.push_back(window);
    const bool in_triangle =
        target_.triangle && whole_[spans_.span().triangle] == *target_.triangle;
    const bool in_span = target_.span && span_ == static_cast<std::int64_t>(*target_.span);
    if (!in_triangle && !in_span) return;
    if (windows_.empty()) windows_.push_back(window);
    windows_.back().last = window.last;
  }

  const std::vector<CycleWindow>& windows() const { return windows_; }
  std::int64_t last_span() const { return span_; }

 private:
  // Pixels that leave in one cycle left a wide datapath together.
  void add_leaving(std::int64_t cycle) {
    if (!leaving_.empty() && leaving_.back() == cycle) return;
    // A pixel that waits for the framebuffer leaves soon after the one before it.
    const bool waits = slowest_output_cycles_ > 1 && !leaving_.empty() &&
                       cycle - leaving_.back() <= slowest_output_cycles_;
    if (!waits) entered_from_ = cycle - latency_;
    leaving_.push_back(cycle);
    if (leaving_.size() <= kMostInside) return;
    // A pixel enters after that has left which is so many places before it.
    entered_from_ = std::max(entered_from_, leaving_.front());
    leaving_.pop_front();
  }

  static constexpr std::size_t kMostInside = kPixelQueueSlots + 1;
  const TraceTarget& target_;
  const std::vector<std::uint32_t>& whole_;
  std::int64_t latency_;
  SpanStream spans_;
  int slowest_output_cycles_;
  std::deque<std::int64_t> leaving_;  // cycles in which the last kMostInside pixels left
  std::int64_t entered_from_ = 0;     // in which the last one entered, at the earliest
  int left_in_span_ = 0;
  std::int64_t span_ = -1;
  std::vector<CycleWindow> windows_;
};

[[noreturn]] void refuse_target(const PreparedFrame& frame, const TraceTarget& target,
                                const FoundWindows& found) {
  const std::string& scene = frame.scene().source;
  if (target.cycles) {
    throw InputError(fmt::format("{}: cycles {}:{}: the frame has the cycles 0:{}", scene,
                                 target.cycles->first, target.cycles->last,
                                 found.frame_cycles - 1));
  }
  if (target.span) {
    throw InputError(fmt::format("{}: span {}: the frame has the spans 0 to {}", scene,
                                 *target.span, found.last_span));
  }
  const std::vector<std::uint32_t>& whole = frame.subdivision().whole;
  const std::uint32_t last = *std::max_element(whole.begin(), whole.end());
  throw InputError(
      *target.triangle > last
          ? fmt::format("{}: triangle {}: the scene has the triangles 0 to {}", scene,
                        *target.triangle, last)
          : fmt::format("{}: triangle {}: no pixel of it is shaded", scene, *target.triangle));
}

}  // namespace

std::vector<CycleWindow> find_windows(const PreparedFrame& frame, const Hardware& hardware,
                                      const TraceTarget& target, const TraceOptions& options) {
  Child child([&] {
    SimulationOptions simulation = options.simulation;
    WindowFinder finder(frame, target, slowest_output_cycles(hardware.pipeline, simulation));
    simulation.observe = [&](const ShadedPixel* pixels, const std::int64_t* cycles,
                             std::size_t count) {
      for (std::size_t i = 0; i < count; ++i) finder.observe(pixels[i], cycles[i]);
    };
    FoundWindows found;
    found.frame_cycles = simulate(frame.setup, hardware.pipeline, simulation).frame_cycles;
    found.windows = finder.windows();
    found.last_span = finder.last_span();
    return to_bytes(found);
  });
  FoundWindows found = from_bytes<FoundWindows>(child.get());
  const std::int64_t cycles = found.frame_cycles;
  if (target.frame) found.windows.push_back({0, cycles - 1});
  if (target.cycles && target.cycles->first <= target.cycles->last && target.cycles->first >= 0 &&
      target.cycles->last < cycles) {
    found.windows.push_back(
        {target.cycles->first - target.margin_cycles, target.cycles->last + target.margin_cycles});
  }
  if (found.windows.empty()) refuse_target(frame, target, found);
  return joined(std::move(found.windows), cycles);
}

}  // namespace phongpipe
