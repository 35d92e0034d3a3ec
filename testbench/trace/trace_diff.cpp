#include "testbench/trace/trace_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <deque>
#include <map>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "sim/datapath_registers.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/wave_file.h"

namespace phongpipe {
namespace {

constexpr std::string_view kDatapath = "pixel_datapath";

// Of a lane of a wide datapath, too.
std::string without_lane(const std::string& name) {
  const std::string lane = fmt::format("{}.lane[", kDatapath);
  const std::size_t end = name.find("].datapath.");
  if (!starts_with(name, lane) || end == std::string::npos) return name;
  return fmt::format("{}.{}", kDatapath, name.substr(end + std::strlen("].datapath.")));
}

// Names of registers by their full name, with the stage that they belong to: those of the tables of
// signals for datapaths with everything, and those that they are packed in. Of a wide datapath,
// without the lane.
const std::map<std::string, int>& stages_of_signals() {
  static const std::map<std::string, int> all = [] {
    std::map<std::string, int> stages;
    DatapathConfiguration everything;
    everything.diffuse = everything.specular = everything.depth_cue = true;
    everything.gate = GateSource::series;
    constexpr int kMostAddressBits = 13;
    constexpr std::pair<RomLayout, int> kTables[] = {{RomLayout::plain, 11},  // a bank
                                                     {RomLayout::plain, kMostAddressBits},
                                                     {RomLayout::bipartite, kMostAddressBits}};
    const auto add_signals = [&] {
      for (const DatapathSignal& signal : datapath_signals(everything)) {
        if (signal.only_first) continue;
        stages.emplace(signal.full_name(), signal.stage);
        // Words that are packed with those of other stages are no signals of a pixel.
        const bool of_one_stage =
            signal.packed == signal.name || signal.packed == signal.name + "s";
        if (of_one_stage) {
          stages.emplace(fmt::format("{}.{}", kDatapath, signal.packed), signal.stage);
        }
      }
    };
    for (const DatapathKind kind : {DatapathKind::pipelined, DatapathKind::serial}) {
      for (const int channels : {1, 3}) {
        for (const auto& [layout, address_bits] : kTables) {
          everything.kind = kind;
          everything.channels = channels;
          everything.rom_layout = layout;
          everything.rom_address_bits = address_bits;
          add_signals();
        }
      }
    }
    return stages;
  }();
  return all;
}

// Ports that show a pixel when it leaves, in the place of a stage behind the last one.
constexpr int kOutputStage = kMostStages;
constexpr std::array<std::string_view, 4> kOutputs = {"pixel_valid", "pixel_x", "pixel_y",
                                                      "pixel_color"};

// The stage that a signal belongs to, by its full name; none if it is not one of a pixel.
std::optional<int> stage_of(const std::string& name) {
  const std::string known = without_lane(name);
  const auto found = stages_of_signals().find(known);
  if (found != stages_of_signals().end()) return found->second;
  for (const std::string_view output : kOutputs) {
    if (known == fmt::format("{}.{}", kDatapath, output)) return kOutputStage;
  }
  return std::nullopt;
}

// What a trace shows of one pixel, or of those that a wide datapath takes together.
struct TracedPixel {
  int x = 0, y = 0;
  // When each stage took it; 0: it was not seen there.
  std::array<std::uint64_t, kMostStages + 1> ps{};
  std::map<std::string, std::string> signals;  // bits, by full name
  std::optional<int> entered, left;            // clocks
};

// Follows pixels through one pixel_datapath of a file, clock by clock.
class Follower {
 public:
  explicit Follower(std::string scope) : scope_(std::move(scope)) {}

  const std::string& scope() const { return scope_; }
  void add(const std::string& name, std::size_t variable, int width) {
    variables_[name] = variable;
    // What follows pixels is in the first lane, for all are in step.
    const std::string first_lane = fmt::format("{}.{}", kDatapath, lane_scope(0));
    const bool in_first_lane = starts_with(name, first_lane + ".");
    if (in_first_lane) control_ = first_lane;
    while (starts_with(name, fmt::format("{}.{}.", kDatapath, lane_scope(lanes_)))) ++lanes_;
    const std::string own = in_first_lane ? without_lane(name) : name;
    for (int stage = 0; stage < kMostStages; ++stage) {
      if (own == fmt::format("{}.s{}_valid", kDatapath, stage)) valid_[index(stage)] = variable;
    }
    if (own == fmt::format("{}.valid", kDatapath)) valid_width_ = width;
    if (own == fmt::format("{}.s0_x", kDatapath)) serial_ = true;
    const std::optional<int> stage = stage_of(name);
    if (stage) registers_[index(*stage)].push_back({name, variable, width});
  }
  const std::map<std::string, std::size_t>& variables() const { return variables_; }
  int lanes() const { return std::max(1, lanes_); }
  std::string kind() const {
    return serial_ ? "serial" : lanes() > 1 ? fmt::format("wide{}", lanes_) : "pipelined";
  }
  const std::vector<TracedPixel>& pixels() const { return pixels_; }
  bool is_clock(std::size_t variable) const {
    const auto found = variables_.find(fmt::format("{}.clk", kDatapath));
    return found != variables_.end() && found->second == variable;
  }

  // Values as they are before a rising edge of the clock. A pixel moves on a stage in each, then
  // waits in the queue.
  void edge(std::uint64_t ps, const std::vector<std::string>& values) {
    const bool leaves = bit(values, fmt::format("{}.pixel_valid", kDatapath)) &&
                        bit(values, fmt::format("{}.pixel_ready", kDatapath));
    if (began_) {
      began_ = false;
      unknown_ = pixels_inside(values);
    }
    std::array<bool, kMostStages> valid{};
    for (int stage = 0; stage < kMostStages; ++stage) {
      valid[index(stage)] = is_valid(values, stage);
    }
    if (valid[0]) {
      held_[0] = pixels_.size();
      pixels_.emplace_back();
      pixels_.back().entered = clock_;
    }
    if (serial_ && valid[kWholeStage]) {
      if (entered_.empty()) {
        ++unknown_;
      } else {
        held_[kWholeStage] = entered_.front();
        entered_.pop_front();
      }
    }
    for (int stage = 0; stage < kMostStages; ++stage) {
      if (!valid[index(stage)]) held_[index(stage)].reset();
      if (held_[index(stage)]) look(stage, pixels_[*held_[index(stage)]], values);
    }
    if (leaves && unknown_ > 0) {
      --unknown_;
    } else if (leaves && !queue_.empty()) {
      pixels_[queue_.front()].left = clock_;
      look(kOutputStage, pixels_[queue_.front()], values);
      queue_.pop_front();
    }
    for (int stage = kMostStages - 1; stage >= 0; --stage) {
      std::optional<std::size_t>& held = held_[index(stage)];
      if (!held) continue;
      const bool last = stage + 1 == kMostStages || !has_stage(stage + 1);
      if (serial_ && stage == 0) {
        entered_.push_back(*held);
      } else if (last) {
        queue_.push_back(*held);
      } else {
        held_[index(stage + 1)] = held;
      }
      held.reset();
    }
    ++clock_;
    since_ps_ = ps;
  }
  // What was recorded ends here for a while.
  void gap() {
    if (!pixels_.empty() && pixels_.back().ps[index(place_stage())] == 0) pixels_.pop_back();
    held_ = {};
    entered_.clear();
    queue_.clear();
    began_ = true;
  }

 private:
  static std::size_t index(int stage) { return static_cast<std::size_t>(stage); }
  // Where a pixel gets its place.
  int place_stage() const { return serial_ ? 0 : 1; }
  // Our own traces have a bit for each stage, those of other tools RTL's word.
  int bit_of_word(int stage) const { return serial_ ? stage - kWholeStage : stage; }
  bool has_stage(int stage) const {
    return valid_[index(stage)].has_value() || bit_of_word(stage) < valid_width_;
  }
  bool is_valid(const std::vector<std::string>& values, int stage) const {
    if (const auto& own = valid_[index(stage)]) return values[*own] == "1";
    const int of_word = bit_of_word(stage);
    if (of_word < 0 || of_word >= valid_width_) return false;
    const int all = number(values, control_ + ".valid", valid_width_);
    return (all >> of_word & 1) != 0;
  }
  bool bit(const std::vector<std::string>& values, const std::string& name) const {
    const auto found = variables_.find(name);
    if (found == variables_.end()) return false;
    const std::string& bits = values[found->second];
    return !bits.empty() && bits.back() == '1';  // of the first lane
  }
  int number(const std::vector<std::string>& values, const std::string& name, int width) const {
    const auto found = variables_.find(name);
    if (found == variables_.end()) return 0;
    int number = 0;
    for (const char c : padded(values[found->second], width))
      number = 2 * number + (c == '1' ? 1 : 0);
    return number;
  }
  // Pixels that entered before the record began and have not left.
  int pixels_inside(const std::vector<std::string>& values) const {
    constexpr int kBits = kPixelQueueBits + 1;
    const int minus_colors = number(values, control_ + ".queue.minus_colors", kBits);
    int pixels = ((1 << kBits) - minus_colors) % (1 << kBits);
    pixels += bit(values, fmt::format("{}.pixel_valid", kDatapath)) ? 1 : 0;
    for (int stage = 1; stage < kMostStages; ++stage) {
      pixels += is_valid(values, stage) ? 1 : 0;
    }
    return pixels;
  }
  // Takes the signals that a stage has of the pixel.
  void look(int stage, TracedPixel& pixel, const std::vector<std::string>& values) {
    if (stage == place_stage()) {
      pixel.x = number(values, fmt::format("{}.s{}_x", control_, stage), kCoordinateBits);
      pixel.y = number(values, fmt::format("{}.s{}_y", control_, stage), kCoordinateBits);
    }
    pixel.ps[index(stage)] = since_ps_;
    for (const auto& [name, variable, width] : registers_[index(stage)]) {
      pixel.signals[name] = padded(values[variable], width);
    }
  }
  // VCD leaves out leading zeros.
  static std::string padded(const std::string& bits, int width) {
    const auto all = static_cast<std::size_t>(width);
    if (bits.size() >= all) return bits.substr(bits.size() - all);
    const char fill = bits.empty() || bits.front() == 'x' || bits.front() == 'z' ? 'x' : '0';
    return std::string(all - bits.size(), fill) + bits;
  }

  std::string scope_;
  std::string control_ = std::string(kDatapath);  // where what follows pixels is
  std::map<std::string, std::size_t> variables_;  // by full name
  struct Register {
    std::string name;
    std::size_t variable;
    int width;
  };
  std::array<std::vector<Register>, kMostStages + 1> registers_;  // by the stage they belong to
  std::array<std::optional<std::size_t>, kMostStages> held_{};
  int lanes_ = 0;  // of a wide datapath
  bool serial_ = false;
  // Of the serial datapath: pixels whose digits are read.
  std::deque<std::size_t> entered_;
  std::deque<std::size_t> queue_;
  std::array<std::optional<std::size_t>, kMostStages> valid_{};  // variables of the stages' bits
  int valid_width_ = 0;                                          // of RTL's word
  bool began_ = true;  // the next clock is the first of a record
  int unknown_ = 0;    // pixels inside that entered before
  std::vector<TracedPixel> pixels_;
  int clock_ = 0;
  std::uint64_t since_ps_ = 0;  // the last edge, from which on the values are what they are
};

// All implementations of pixel_datapath in a file.
struct TraceContent {
  std::vector<Follower> followers;
  bool complete = true;
};

TraceContent read_trace(const std::filesystem::path& file) {
  struct Change {
    std::size_t variable;
    std::string value;
  };
  TraceContent content;
  std::vector<std::string> values;
  const auto declare = [&](const std::vector<WaveVariable>& variables) {
    values.resize(variables.size());
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const WaveVariable& variable = variables[i];
      const std::size_t at = variable.scope.find(kDatapath);
      if (variable.real || at == std::string::npos) continue;
      const std::string scope = at == 0 ? std::string() : variable.scope.substr(0, at - 1);
      auto follower = std::find_if(content.followers.begin(), content.followers.end(),
                                   [&](const Follower& f) { return f.scope() == scope; });
      if (follower == content.followers.end()) {
        follower = content.followers.insert(follower, Follower(scope));
      }
      follower->add(variable.scope.substr(at) + "." + variable.name, i, variable.width);
    }
    if (content.followers.empty()) {
      throw InputError(fmt::format("{}: no scope pixel_datapath in it", printable(file.string())));
    }
  };
  std::vector<Change> changes;      // of one time, one for each variable
  std::vector<std::size_t> places;  // in `changes`, by variable; kNone: it has not changed
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::uint64_t now = 0;
  const auto apply = [&] {
    for (Follower& follower : content.followers) {
      for (const Change& change : changes) {
        if (!follower.is_clock(change.variable)) continue;
        if (change.value == "1" && values[change.variable] == "0") follower.edge(now, values);
        if (change.value == "x") follower.gap();
      }
    }
    for (Change& change : changes) {
      places[change.variable] = kNone;
      values[change.variable] = std::move(change.value);
    }
    changes.clear();
  };
  const auto visit = [&](std::uint64_t ps, std::size_t variable, const std::string& value) {
    if (ps != now) {
      apply();
      now = ps;
    }
    places.resize(values.size(), kNone);
    if (places[variable] == kNone) {
      places[variable] = changes.size();
      changes.push_back({variable, value});
    } else {
      changes[places[variable]].value = value;
    }
  };
  content.complete = WaveReader::read(file, declare, visit).complete;
  apply();
  for (Follower& follower : content.followers) follower.gap();
  return content;
}

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

TraceComparison compare(const Follower& a, const Follower& b, bool same_record) {
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
                                     fmt::format("{}.pixel_valid", kDatapath),
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

}  // namespace

bool TraceDiff::same() const {
  return std::all_of(comparisons.begin(), comparisons.end(),
                     [](const TraceComparison& c) { return c.same(); });
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

TraceDiff diff_traces(const std::filesystem::path& a_file, const std::filesystem::path& b_file) {
  const TraceContent a = read_trace(a_file);
  TraceDiff diff;
  diff.a_complete = a.complete;
  std::error_code none;
  if (std::filesystem::equivalent(a_file, b_file, none)) {
    diff.b_complete = a.complete;
    if (a.followers.size() < 2) {
      throw InputError(fmt::format("{}: one pixel_datapath only; give another file to compare with",
                                   printable(a_file.string())));
    }
    for (std::size_t i = 1; i < a.followers.size(); ++i) {
      diff.comparisons.push_back(compare(a.followers.front(), a.followers[i], true));
    }
    return diff;
  }
  const TraceContent b = read_trace(b_file);
  diff.b_complete = b.complete;
  for (const Follower& one : a.followers) {
    for (const Follower& other : b.followers) {
      if (one.scope() == other.scope()) diff.comparisons.push_back(compare(one, other, false));
    }
  }
  if (diff.comparisons.empty()) {
    diff.comparisons.push_back(compare(a.followers.front(), b.followers.front(), false));
  }
  refuse_if_too_short(diff, a_file, a.complete);
  refuse_if_too_short(diff, b_file, b.complete);
  return diff;
}

}  // namespace phongpipe
