// Pixels as a waveform shows them: followed through each pixel_datapath of a file, clock by clock.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/signals/datapath_signals.h"

namespace phongpipe {

// The scope of a datapath, and the start of its signals' full names.
constexpr std::string_view kTracedScope = "pixel_datapath";

// The place of the output ports, which show a pixel when it leaves: that of a stage behind the
// last.
constexpr int kOutputStage = kMostStages;

// The stage that a signal belongs to, by its full name; none if it is not one of a pixel.
std::optional<int> stage_of(const std::string& name);

// What a trace shows of one pixel, or of those that a wide datapath takes together.
struct TracedPixel {
  int x = 0, y = 0;
  // When each stage took it; 0: it was not seen there.
  std::array<std::uint64_t, kMostStages + 1> ps{};
  std::map<std::string, std::string> signals;  // bits, by full name
  std::optional<int> entered, left;            // clocks
};

// One pixel_datapath of a file.
class TracedDatapath {
 public:
  explicit TracedDatapath(std::string scope) : scope_(std::move(scope)) {}

  const std::string& scope() const { return scope_; }  // "phongpipe.rtl"
  // A signal of it, by full name; `variable`: its place among the values of edge().
  void add(const std::string& name, std::size_t variable, int width);
  const std::map<std::string, std::size_t>& variables() const { return variables_; }
  int lanes() const { return std::max(1, lanes_); }
  std::string kind() const;  // as the setting datapath.kind has it
  const std::vector<TracedPixel>& pixels() const { return pixels_; }
  bool is_clock(std::size_t variable) const;

  // Values as they are before a rising edge of the clock. A pixel moves on a stage in each, then
  // waits in the queue.
  void edge(std::uint64_t ps, const std::vector<std::string>& values);
  // What was recorded ends here for a while.
  void gap();

 private:
  static std::size_t index(int stage) { return static_cast<std::size_t>(stage); }
  // Where a pixel gets its place.
  int place_stage() const { return serial_ ? 0 : 1; }
  // Our own traces have a bit for each stage, those of other tools RTL's word.
  int bit_of_word(int stage) const { return serial_ ? stage - kWholeStage : stage; }
  bool has_stage(int stage) const {
    return valid_[index(stage)].has_value() || bit_of_word(stage) < valid_width_;
  }
  bool is_valid(const std::vector<std::string>& values, int stage) const;
  bool bit(const std::vector<std::string>& values, const std::string& name) const;
  int number(const std::vector<std::string>& values, const std::string& name, int width) const;
  // Pixels that entered before the record began and have not left.
  int pixels_inside(const std::vector<std::string>& values) const;
  // Takes the signals that a stage has of the pixel.
  void look(int stage, TracedPixel& pixel, const std::vector<std::string>& values);

  std::string scope_;
  std::string control_ = std::string(kTracedScope);  // where what follows pixels is
  std::map<std::string, std::size_t> variables_;     // by full name
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

// All datapaths of a file.
struct TracedDatapaths {
  std::vector<TracedDatapath> datapaths;
  bool complete = true;  // false: the file was cut
};
// Throws InputError if the file is no waveform, or has no pixel_datapath.
TracedDatapaths read_datapaths(const std::filesystem::path& file);

}  // namespace phongpipe
