#include "testbench/trace/traced_datapath.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/wave_file.h"

namespace phongpipe {
namespace {

// Of a lane of a wide datapath, too.
std::string without_lane(const std::string& name) {
  const std::string lane = fmt::format("{}.lane[", kTracedScope);
  const std::size_t end = name.find("].datapath.");
  if (!starts_with(name, lane) || end == std::string::npos) return name;
  return fmt::format("{}.{}", kTracedScope, name.substr(end + std::strlen("].datapath.")));
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
        if (signal.meaning != Meaning::every_pixel || signal.of_digit) continue;
        stages.emplace(signal.full_name(), signal.stage);
        // Words that are packed with those of other stages are no signals of a pixel.
        const bool of_one_stage =
            signal.packed == signal.name || signal.packed == signal.name + "s";
        if (of_one_stage) {
          stages.emplace(fmt::format("{}.{}", kTracedScope, signal.packed), signal.stage);
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

// Ports that show a pixel when it leaves.
constexpr std::array<std::string_view, 4> kOutputs = {"pixel_valid", "pixel_x", "pixel_y",
                                                      "pixel_color"};

// VCD leaves out leading zeros.
std::string padded(const std::string& bits, int width) {
  const auto all = static_cast<std::size_t>(width);
  if (bits.size() >= all) return bits.substr(bits.size() - all);
  const char fill = bits.empty() || bits.front() == 'x' || bits.front() == 'z' ? 'x' : '0';
  return std::string(all - bits.size(), fill) + bits;
}

}  // namespace

std::optional<int> stage_of(const std::string& name) {
  const std::string known = without_lane(name);
  const auto found = stages_of_signals().find(known);
  if (found != stages_of_signals().end()) return found->second;
  for (const std::string_view output : kOutputs) {
    if (known == fmt::format("{}.{}", kTracedScope, output)) return kOutputStage;
  }
  return std::nullopt;
}

void TracedDatapath::add(const std::string& name, std::size_t variable, int width) {
  variables_[name] = variable;
  // What follows pixels is in the first lane, for all are in step.
  const std::string first_lane = fmt::format("{}.{}", kTracedScope, lane_scope(0));
  const bool in_first_lane = starts_with(name, first_lane + ".");
  if (in_first_lane) control_ = first_lane;
  while (starts_with(name, fmt::format("{}.{}.", kTracedScope, lane_scope(lanes_)))) ++lanes_;
  const std::string own = in_first_lane ? without_lane(name) : name;
  for (int stage = 0; stage < kMostStages; ++stage) {
    if (own == fmt::format("{}.s{}_valid", kTracedScope, stage)) valid_[index(stage)] = variable;
  }
  if (own == fmt::format("{}.valid", kTracedScope)) valid_width_ = width;
  if (own == fmt::format("{}.s0_x", kTracedScope)) serial_ = true;
  const std::optional<int> stage = stage_of(name);
  if (stage) registers_[index(*stage)].push_back({name, variable, width});
}

std::string TracedDatapath::kind() const {
  return serial_ ? "serial" : lanes() > 1 ? fmt::format("wide{}", lanes_) : "pipelined";
}

bool TracedDatapath::is_clock(std::size_t variable) const {
  const auto found = variables_.find(fmt::format("{}.clk", kTracedScope));
  return found != variables_.end() && found->second == variable;
}

void TracedDatapath::edge(std::uint64_t ps, const std::vector<std::string>& values) {
  const bool leaves = bit(values, fmt::format("{}.pixel_valid", kTracedScope)) &&
                      bit(values, fmt::format("{}.pixel_ready", kTracedScope));
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

void TracedDatapath::gap() {
  if (!pixels_.empty() && pixels_.back().ps[index(place_stage())] == 0) pixels_.pop_back();
  held_ = {};
  entered_.clear();
  queue_.clear();
  began_ = true;
}

bool TracedDatapath::is_valid(const std::vector<std::string>& values, int stage) const {
  if (const auto& own = valid_[index(stage)]) return values[*own] == "1";
  const int of_word = bit_of_word(stage);
  if (of_word < 0 || of_word >= valid_width_) return false;
  const int all = number(values, control_ + ".valid", valid_width_);
  return (all >> of_word & 1) != 0;
}

bool TracedDatapath::bit(const std::vector<std::string>& values, const std::string& name) const {
  const auto found = variables_.find(name);
  if (found == variables_.end()) return false;
  const std::string& bits = values[found->second];
  return !bits.empty() && bits.back() == '1';  // of the first lane
}

int TracedDatapath::number(const std::vector<std::string>& values, const std::string& name,
                           int width) const {
  const auto found = variables_.find(name);
  if (found == variables_.end()) return 0;
  int number = 0;
  for (const char c : padded(values[found->second], width))
    number = 2 * number + (c == '1' ? 1 : 0);
  return number;
}

int TracedDatapath::pixels_inside(const std::vector<std::string>& values) const {
  constexpr int kBits = kPixelQueueBits + 1;
  const int minus_colors = number(values, control_ + ".queue.minus_colors", kBits);
  int pixels = ((1 << kBits) - minus_colors) % (1 << kBits);
  pixels += bit(values, fmt::format("{}.pixel_valid", kTracedScope)) ? 1 : 0;
  for (int stage = 1; stage < kMostStages; ++stage) {
    pixels += is_valid(values, stage) ? 1 : 0;
  }
  return pixels;
}

void TracedDatapath::look(int stage, TracedPixel& pixel, const std::vector<std::string>& values) {
  if (stage == place_stage()) {
    pixel.x = number(values, fmt::format("{}.s{}_x", control_, stage), kCoordinateBits);
    pixel.y = number(values, fmt::format("{}.s{}_y", control_, stage), kCoordinateBits);
  }
  pixel.ps[index(stage)] = since_ps_;
  for (const auto& [name, variable, width] : registers_[index(stage)]) {
    pixel.signals[name] = padded(values[variable], width);
  }
}

TracedDatapaths read_datapaths(const std::filesystem::path& file) {
  struct Change {
    std::size_t variable;
    std::string value;
  };
  TracedDatapaths content;
  std::vector<std::string> values;
  const auto declare = [&](const std::vector<WaveVariable>& variables) {
    values.resize(variables.size());
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const WaveVariable& variable = variables[i];
      const std::size_t at = variable.scope.find(kTracedScope);
      if (variable.real || at == std::string::npos) continue;
      const std::string scope = at == 0 ? std::string() : variable.scope.substr(0, at - 1);
      auto datapath = std::find_if(content.datapaths.begin(), content.datapaths.end(),
                                   [&](const TracedDatapath& f) { return f.scope() == scope; });
      if (datapath == content.datapaths.end()) {
        datapath = content.datapaths.insert(datapath, TracedDatapath(scope));
      }
      datapath->add(variable.scope.substr(at) + "." + variable.name, i, variable.width);
    }
    if (content.datapaths.empty()) {
      throw InputError(fmt::format("{}: no scope pixel_datapath in it", printable(file.string())));
    }
  };
  std::vector<Change> changes;      // of one time, one for each variable
  std::vector<std::size_t> places;  // in `changes`, by variable; kNone: it has not changed
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::uint64_t now = 0;
  const auto apply = [&] {
    for (TracedDatapath& datapath : content.datapaths) {
      for (const Change& change : changes) {
        if (!datapath.is_clock(change.variable)) continue;
        if (change.value == "1" && values[change.variable] == "0") datapath.edge(now, values);
        if (change.value == "x") datapath.gap();
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
  for (TracedDatapath& datapath : content.datapaths) datapath.gap();
  return content;
}

}  // namespace phongpipe
