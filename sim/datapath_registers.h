// pixel_datapath, clock by clock and register by register: what hw/pixel_datapath.sv and
// hw/pixel_datapath_serial.sv hold in every clock, and the lanes of hw/pixel_datapath_wide.sv,
// computed by the model's blocks.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "model/fixed/exponent_rom.h"
#include "model/fixed/frame_setup.h"
#include "sim/clocked_datapath.h"

namespace phongpipe {

// Stages of the pipeline, by the number that RTL's names have: 0 takes the input, 1 the terms of
// the series, which are whole in 4; 5 has the address, 6 whether the pixel is lit, 8 the words, 10
// the sum, and the last one the faded colour under depth cueing. The serial datapath has stage 0,
// takes interval_cycles() clocks from there to stage 3, and has the same stages from there on.
constexpr int kWholeStage = 3;  // of the serial datapath: all digits are there
constexpr int kSeriesStage = 4;
constexpr int kSumStage = kDatapathLatency - 3;  // the queue takes 3 clocks
constexpr int kMostStages = kSumStage + kDepthCueLatency + 1;

constexpr int datapath_stages(const DatapathConfiguration& configuration) {
  return kSumStage + 1 + (configuration.depth_cue ? kDepthCueLatency : 0);
}

// What the registers of all stages hold of a pixel. Arrays: channel by channel.
struct DatapathPixel {
  bool valid = false;
  std::uint16_t x = 0, y = 0;
  int step = 0;       // in its span, from 0
  int remaining = 0;  // pixels of its span, itself among them
  bool highlight = false, first_pass = false, step_diffuse = false, step_specular = false;
  std::array<std::int64_t, 3> level = {};

  // Of the serial datapath, in whole digits; see hw/serial_differencer.sv. d1 is 0 if the series
  // does not step. read_d1 is what the memory has for it.
  struct SerialWords {
    std::int64_t v = 0, d1 = 0, read_d1 = 0, next_v = 0, next_d1 = 0;
  };
  struct Series {  // see hw/forward_differencer.sv
    std::int64_t term = 0, next_term = 0, last_term = 0, difference = 0, v = 0;
    SeriesStart start;  // of the span, whether the series steps or not
    SerialWords serial;
  };
  std::array<Series, 3> diffuse;
  Series specular, gate, cue;

  std::array<std::int32_t, 3> diffuse_cut = {}, level_cut = {}, clamped = {};
  std::array<bool, 3> lit = {};
  int address = 0;
  RomPlaces places;
  std::array<std::int32_t, 3> word = {}, increment = {}, addend = {};
  bool open = false;  // whether the word counts
  std::array<std::int32_t, 3> sum = {};
  std::int32_t cue_factor = 0;
  std::array<std::int32_t, 3> own = {};  // its own light less the colour it fades to
  std::uint32_t color = 0;               // as it leaves; channel 0 in the low byte
};

class DatapathRegisters : public ClockedDatapath {
 public:
  explicit DatapathRegisters(const DatapathConfiguration& configuration,
                             const OutputColor& cue_color = {});

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

  // The outputs in this clock, before its edge.
  DatapathOutputs outputs() const;

  // Of a wide datapath: of its first lane; all lanes are in step. The serial datapath has a pixel
  // in stages 1 and 2 for interval_cycles() clocks, a digit after the other.
  const DatapathPixel& in_stage(int stage) const {
    return lanes_.empty() ? after_clocks(clocks_since_entry(stage)) : lanes_[0].in_stage(stage);
  }
  // Which digit of its pixel stage 1 or 2 of the serial datapath has: series · digits + digit.
  int digit_in(int stage) const { return clocks_since_entry(stage) - clocks_to(stage) + 1; }
  // Which digit the serial datapath reads in this clock: 0 if it waits for a pixel.
  int next_digit() const {
    return until_next_ == 0 ? 0 : configuration_.interval_cycles() - until_next_;
  }
  // Clocks from stage 0 to another one; negative to one before the lanes.
  int clocks_to(int stage) const { return stage < kWholeStage ? stage : stage + serial_clocks_; }
  // Pixels that entered before that of a stage, or before the one that will be next in it, and have
  // not left. Of a stage before the lanes: before the first pixel of its span.
  std::size_t pixels_after(int stage) const;
  // Pixels side by side in a stage that holds one.
  int pixels_in(int stage) const {
    return pixels_side_by_side(
        [&](const DatapathRegisters& lane) { return lane.in_stage(stage).x; });
  }
  // A datapath of a wide one.
  const DatapathRegisters& lane(std::size_t k) const { return lanes_[k]; }
  // The span in a stage before the lanes of a wide datapath: -kLaneStages takes the input, -1 is
  // before stage 0.
  const std::optional<Span>& before_lanes(int stage) const {
    const int place = stage + kLaneStages;
    return before_lanes_[static_cast<std::size_t>(place)];
  }
  // Pixels that are known whole and wait in the queue, without the one at the output.
  std::size_t queued() const { return queue_.size(); }
  // Free slots of the queue, as RTL counts them.
  int free_slots() const { return free_; }
  // Slots of the queue that are next.
  int place_slot() const { return slots_.place; }
  int color_slot() const { return slots_.color; }
  int read_slot() const { return slots_.read; }
  // Whether a pixel left in the clock before.
  bool left() const { return left_; }
  // What is added to x from pixel to pixel.
  int x_step() const { return x_step_; }
  // Whether the next pixel that enters is of another span.
  bool between_spans() const { return last_.remaining <= 1; }
  // Words of a channel's table.
  const std::vector<std::int32_t>& table(std::size_t channel) const {
    return lanes_.empty() ? table_[channel] : lanes_[0].table(channel);
  }

 private:
  // A series at the pixel that entered last.
  struct Stepper {
    int width = 0;           // of the register
    ForwardDifferencer now;  // of the serial datapath: of whole digits
    DatapathPixel::Series pixel;
    bool serial = false;
    // `digits`: of the serial datapath; 0 in the others.
    void set_width(int register_width, int digits);
    void load(const SeriesStart& start, bool stepping);
    void step(bool second);
    void set_serial_words();
  };
  bool is_serial() const { return configuration_.kind == DatapathKind::serial; }
  // Of the pixel in a stage.
  int clocks_since_entry(int stage) const;
  // The pixel that was in stage 0 so many clocks ago.
  const DatapathPixel& after_clocks(int clocks) const {
    return stages_[(head_ + static_cast<std::size_t>(clocks)) % stages_.size()];
  }
  int last_clock() const { return static_cast<int>(stages_.size()) - 1; }
  std::size_t wide_pixels_after(int stage) const;
  DatapathOutputs wide_outputs() const;
  DatapathOutputs wide_clock(const DatapathInputs& inputs);
  // Of a group: lanes 1 and up have x negative if they have a pixel of it.
  template <typename X>
  int pixels_side_by_side(X x_of_lane) const {
    int pixels = 1;
    for (std::size_t k = 1; k < lanes_.size(); ++k) {
      pixels += x_of_lane(lanes_[k]) >> (kCoordinateBits - 1) & 1;
    }
    return pixels;
  }
  std::size_t channels() const { return static_cast<std::size_t>(configuration_.channels); }
  void load(const Span& span);
  void step();
  void shade(DatapathPixel& pixel) const;

  std::vector<DatapathRegisters> lanes_;  // of a wide datapath; they hold what is below x_step_
  std::array<std::optional<Span>, kLaneStages> before_lanes_;  // spans, the last one goes on first
  std::size_t pixels_in_lanes_ = 0;  // of spans that the lanes have taken, and not delivered
  int x_step_ = 1;
  DatapathConfiguration configuration_;
  OutputColor cue_color_;
  std::array<std::vector<std::int32_t>, 3> table_;
  int serial_clocks_;  // from stage 0 to kWholeStage, more than in the pipelined datapath
  std::vector<DatapathPixel> stages_;  // a ring, by the clocks since a pixel entered
  std::size_t head_ = 0;               // stage 0
  int until_next_ = 0;                 // clocks in which no pixel can enter
  DatapathPixel last_;                 // that entered
  std::array<Stepper, 3> diffuse_;
  Stepper specular_, gate_, cue_;
  std::deque<ShadedPixel> queue_;
  int free_ = kPixelQueueSlots;
  struct Slots {
    int place = 0, color = 0, read = 0;
  } slots_;
  bool left_ = false;
  bool pixel_valid_ = false;
  ShadedPixel output_;
};

// Of a span's pixels, how many lane k of `lanes` has.
inline int pixels_of_lane(int length, int k, int lanes) {
  return (length + lanes - 1 - k) / lanes;
}

}  // namespace phongpipe
