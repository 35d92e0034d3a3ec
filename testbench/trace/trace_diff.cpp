#include "testbench/trace/trace_diff.h"

#include <fmt/format.h>

#include <algorithm>

#include "model/scene/input_error.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/traced_datapath.h"

namespace phongpipe {
namespace {

bool same_place(const TracedPixel& a, const TracedPixel& b) {
  return a.x == b.x && a.y == b.y;
}

// Whether the pixels of b from `offset` on are those of a, as far as both go.
bool fits(const std::vector<TracedPixel>& a, std::size_t a_offset,
          const std::vector<TracedPixel>& b, std::size_t b_offset) {
  constexpr std::size_t kEnough = 64;
  const std::size_t common = std::min({a.size() - a_offset, b.size() - b_offset, kEnough});
  for (std::size_t i = 0; i < common; ++i) {
    if (!same_place(a[a_offset + i], b[b_offset + i])) return false;
  }
  return common > 0;
}

std::optional<int> least_latency(const std::vector<TracedPixel>& pixels) {
  std::optional<int> least;
  for (const TracedPixel& pixel : pixels) {
    if (!pixel.entered || !pixel.left) continue;
    const int latency = *pixel.left - *pixel.entered + 1;
    least = least ? std::min(*least, latency) : latency;
  }
  return least;
}

TraceComparison compare(const TracedDatapath& a, const TracedDatapath& b, bool same_record) {
  if (a.kind() != b.kind()) {
    throw InputError(fmt::format(
        "A is of a {} datapath, B of a {} one: their registers cannot be compared; verify compares "
        "the pixels of each with the model's",
        a.kind(), b.kind()));
  }
  TraceComparison result;
  result.lanes = a.lanes();
  result.same_record = same_record;
  result.a_scope = a.scope();
  result.b_scope = b.scope();
  result.a_pixels = a.pixels().size();
  result.b_pixels = b.pixels().size();
  result.a_latency_cycles = least_latency(a.pixels());
  result.b_latency_cycles = least_latency(b.pixels());
  std::vector<std::pair<int, std::string>> common;
  for (const auto& [name, variable] : a.variables()) {
    const std::optional<int> stage = stage_of(name);
    if (stage && b.variables().count(name) != 0) common.emplace_back(*stage, name);
  }
  std::stable_sort(common.begin(), common.end(),
                   [](const auto& x, const auto& y) { return x.first < y.first; });
  result.signals = common.size();

  // One may begin later than the other.
  std::size_t a_offset = 0, b_offset = 0;
  bool found = false;
  for (std::size_t i = 0; i < b.pixels().size() && !found; ++i) {
    if ((found = fits(a.pixels(), 0, b.pixels(), i))) b_offset = i;
  }
  for (std::size_t i = 0; i < a.pixels().size() && !found; ++i) {
    if ((found = fits(a.pixels(), i, b.pixels(), 0))) a_offset = i;
  }
  if (!found) return result;
  const std::size_t count = std::min(a.pixels().size() - a_offset, b.pixels().size() - b_offset);
  for (std::size_t i = 0; i < count; ++i) {
    const TracedPixel& one = a.pixels()[a_offset + i];
    const TracedPixel& other = b.pixels()[b_offset + i];
    for (const auto& [stage, name] : common) {
      const auto first = one.signals.find(name), second = other.signals.find(name);
      if (first == one.signals.end() || second == other.signals.end()) continue;
      if (first->second == second->second) continue;
      const auto s = static_cast<std::size_t>(stage);
      result.first = TraceDifference{
          i, one.x, one.y, name, first->second, second->second, one.ps[s], other.ps[s]};
      return result;
    }
    if (same_record && one.left.has_value() != other.left.has_value()) {
      const auto leaves = [](const TracedPixel& pixel) { return pixel.left ? "1" : "0"; };
      result.first = TraceDifference{i,
                                     one.x,
                                     one.y,
                                     fmt::format("{}.pixel_valid", kTracedScope),
                                     leaves(one),
                                     leaves(other),
                                     one.ps[kOutputStage],
                                     other.ps[kOutputStage]};
      return result;
    }
    ++result.compared;
  }
  return result;
}

void refuse_if_empty(const TraceDiff& diff, const std::filesystem::path& a_file) {
  const auto& all = diff.comparisons;
  if (std::any_of(all.begin(), all.end(),
                  [](const TraceComparison& c) { return c.a_pixels + c.b_pixels > 0; })) {
    return;
  }
  throw InputError(fmt::format("{}: no pixel enters pixel_datapath there, nothing is to compare",
                               printable(a_file.string())));
}

// Of a file that was cut before a pixel that both have, nothing can be said.
void refuse_if_too_short(const TraceDiff& diff, const std::filesystem::path& file, bool complete) {
  const bool nothing =
      std::all_of(diff.comparisons.begin(), diff.comparisons.end(),
                  [](const TraceComparison& c) { return c.compared == 0 && !c.first.has_value(); });
  if (complete || !nothing) return;
  throw InputError(
      fmt::format("{}: cut before a pixel that both traces have", printable(file.string())));
}

}  // namespace

bool TraceDiff::same() const {
  return std::all_of(comparisons.begin(), comparisons.end(),
                     [](const TraceComparison& c) { return c.same(); });
}

TraceDiff diff_traces(const std::filesystem::path& a_file, const std::filesystem::path& b_file) {
  const TracedDatapaths a = read_datapaths(a_file);
  TraceDiff diff;
  diff.a_complete = a.complete;
  std::error_code none;
  if (std::filesystem::equivalent(a_file, b_file, none)) {
    diff.b_complete = a.complete;
    if (a.datapaths.size() < 2) {
      throw InputError(fmt::format("{}: one pixel_datapath only; give another file to compare with",
                                   printable(a_file.string())));
    }
    for (std::size_t i = 1; i < a.datapaths.size(); ++i) {
      diff.comparisons.push_back(compare(a.datapaths.front(), a.datapaths[i], true));
    }
    if (a.complete) refuse_if_empty(diff, a_file);
    return diff;
  }
  const TracedDatapaths b = read_datapaths(b_file);
  diff.b_complete = b.complete;
  for (const TracedDatapath& one : a.datapaths) {
    for (const TracedDatapath& other : b.datapaths) {
      if (one.scope() == other.scope()) diff.comparisons.push_back(compare(one, other, false));
    }
  }
  if (diff.comparisons.empty()) {
    diff.comparisons.push_back(compare(a.datapaths.front(), b.datapaths.front(), false));
  }
  refuse_if_too_short(diff, a_file, a.complete);
  refuse_if_too_short(diff, b_file, b.complete);
  refuse_if_empty(diff, a_file);
  return diff;
}

}  // namespace phongpipe
