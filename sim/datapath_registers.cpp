#include "sim/datapath_registers.h"

#include <algorithm>

#include "model/fixed/color_sum.h"
#include "model/fixed/depth_cue.h"

namespace phongpipe {

DatapathRegisters::DatapathRegisters(const DatapathConfiguration& configuration,
                                     const OutputColor& cue_color)
    : configuration_(configuration),
      cue_color_(cue_color),
      serial_clocks_(configuration.kind == DatapathKind::serial
                         ? configuration.interval_cycles() - kSerialStages
                         : 0),
      stages_(static_cast<std::size_t>(datapath_stages(configuration) + serial_clocks_)) {
  if (configuration.lanes() > 1) {
    DatapathConfiguration of_lane = configuration;
    of_lane.kind = DatapathKind::pipelined;
    lanes_.assign(static_cast<std::size_t>(configuration.lanes()),
                  DatapathRegisters(of_lane, cue_color));
    lanes_[0].x_step_ = configuration.lanes();
    return;
  }
  const auto set_width = [&](Stepper& stepper, int width) {
    stepper.set_width(width, is_serial() ? configuration.serial_digits() : 0);
  };
  for (Stepper& stepper : diffuse_) set_width(stepper, configuration.diffuse_width());
  set_width(specular_, configuration.specular_width());
  set_width(gate_, configuration.diffuse_width());
  set_width(cue_, kCueWidth);
  if (!configuration.specular) return;
  for (std::size_t c = 0; c < channels(); ++c) {
    table_[c].resize(static_cast<std::size_t>(configuration.rom_words()));
  }
}

void DatapathRegisters::reset() {
  for (DatapathRegisters& lane : lanes_) lane.reset();
  before_lanes_ = {};
  pixels_in_lanes_ = 0;
  for (DatapathPixel& pixel : stages_) pixel.valid = false;
  last_ = {};
  until_next_ = 0;
  queue_.clear();
  free_ = kPixelQueueSlots;
  slots_ = {};
  left_ = pixel_valid_ = false;
}

std::size_t DatapathRegisters::pixels_after(int stage) const {
  if (!lanes_.empty()) return wide_pixels_after(stage);
  std::size_t pixels = queue_.size() + (pixel_valid_ ? 1 : 0);
  for (int clocks = clocks_since_entry(stage) + 1; clocks <= last_clock(); ++clocks) {
    pixels += after_clocks(clocks).valid ? 1 : 0;
  }
  return pixels;
}

DatapathOutputs DatapathRegisters::outputs() const {
  if (!lanes_.empty()) return wide_outputs();
  const bool open = last_.remaining <= 1;  // the next pixel is of another span
  return {free_ > 0 && until_next_ == 0 && open, pixel_valid_, output_, 0, {}};
}

int DatapathRegisters::clocks_since_entry(int stage) const {
  const int first = clocks_to(stage);
  if (!is_serial() || stage < 1 || stage >= kWholeStage) return first;
  // A digit a clock: the first one comes to stage 1 as the pixel enters.
  for (int clocks = first - 1; clocks < first - 1 + configuration_.interval_cycles(); ++clocks) {
    if (after_clocks(clocks).valid) return clocks;
  }
  return first - 1;
}

void DatapathRegisters::Stepper::set_width(int register_width, int digits) {
  width = register_width;
  serial = digits > 0;
  now = ForwardDifferencer(serial ? digits * kDigitBits : width);
}

void DatapathRegisters::Stepper::load(const SeriesStart& start, bool stepping) {
  now.load(start.stepped(stepping));
  const std::int64_t v = wrap_to(now.v(), width);
  pixel = {v, now.d1(), now.d2(), v, v, start, {}};
  set_serial_words();
}

void DatapathRegisters::Stepper::set_serial_words() {
  if (!serial) return;
  DatapathPixel::SerialWords& words = pixel.serial;
  words.v = now.v();
  words.d1 = now.d1();
  words.next_v = wrap_add(words.v, words.d1);
  words.read_d1 = words.next_d1;
  words.next_d1 = wrap_add(words.d1, pixel.start.d2);
}

void DatapathRegisters::Stepper::step(bool second) {
  pixel.term = second ? now.d1() : now.d2();
  pixel.next_term = now.d2();
  pixel.difference = now.d1();
  now.step();
  pixel.v = wrap_to(now.v(), width);
  set_serial_words();
}

void DatapathRegisters::load(const Span& span) {
  last_ = {};
  last_.valid = true;
  last_.x = static_cast<std::uint16_t>(span.row.x);
  last_.y = static_cast<std::uint16_t>(span.row.y);
  last_.remaining = span.row.length;
  last_.highlight = span.highlight;
  last_.first_pass = span.first_pass;
  last_.step_diffuse = span.step_diffuse;
  last_.step_specular = span.step_specular;
  for (std::size_t c = 0; c < channels(); ++c) {
    last_.level[c] = wrap_to(span.level[c], configuration_.diffuse_width());
    diffuse_[c].load(span.diffuse[c], span.step_diffuse);
  }
  specular_.load(span.specular, span.step_specular);
  gate_.load(span.gate, span.step_diffuse);
  cue_.load({span.cue.v, span.cue.d1, 0}, true);
}

void DatapathRegisters::step() {
  ++last_.step;
  --last_.remaining;
  last_.x = static_cast<std::uint16_t>((last_.x + x_step_) & ((1 << kCoordinateBits) - 1));
  const bool second = last_.step == 1;
  for (std::size_t c = 0; c < channels(); ++c) diffuse_[c].step(second);
  for (Stepper* const stepper : {&specular_, &gate_, &cue_}) stepper->step(second);
}

// All that follows from the series.
void DatapathRegisters::shade(DatapathPixel& pixel) const {
  const DatapathConfiguration& f = configuration_;
  bool facing = f.gate == GateSource::off;
  for (std::size_t c = 0; c < channels(); ++c) {
    pixel.diffuse[c] = diffuse_[c].pixel;
    // Without its diffuse series a channel's light is the level.
    if (!f.diffuse) pixel.diffuse[c].v = pixel.level[c];
    const std::int64_t diffuse = pixel.diffuse[c].v, level = pixel.level[c];
    pixel.lit[c] = is_lit(diffuse, level);
    facing = facing || (f.gate == GateSource::diffuse && pixel.lit[c]);
    // What color_sum keeps of a value that is not below the level.
    const auto cut = [&f](std::int64_t value) {
      constexpr std::int32_t kIntegerMask = (1 << (kGuardBits + kOutputBits)) - 1;
      const std::int32_t mask = (kIntegerMask + 1) * (1 << f.sum_fraction_bits()) - 1;
      return clamped_diffuse(f, value, value) & mask;
    };
    pixel.diffuse_cut[c] = cut(diffuse);
    pixel.level_cut[c] = cut(level);
    pixel.clamped[c] = pixel.lit[c] ? pixel.diffuse_cut[c] : pixel.level_cut[c];
  }
  pixel.specular = specular_.pixel;
  pixel.gate = gate_.pixel;
  pixel.cue = cue_.pixel;
  if (f.has_gate_series()) facing = is_lit(pixel.gate.v, 0);
  if (f.specular) {
    pixel.open = facing && pixel.highlight;
    pixel.address = ExponentRom::address(f, pixel.specular.v);
    pixel.places = ExponentRom::places(f, pixel.address);
  }
  pixel.cue_factor = cue_factor(pixel.cue.v);
  for (std::size_t c = 0; c < channels(); ++c) {
    if (f.specular) {
      pixel.word[c] = table_[c][pixel.places.base];
      if (pixel.places.increment) pixel.increment[c] = table_[c][*pixel.places.increment];
    }
    const std::int32_t mask = (1 << f.rom_data_bits) - 1;
    if (pixel.open) pixel.addend[c] = (pixel.word[c] + pixel.increment[c]) & mask;
    pixel.sum[c] = light_sum(f, pixel.clamped[c], aligned_word(f, pixel.addend[c]));
    const std::int32_t cue = pixel.first_pass ? cue_color_[c] : 0;
    pixel.own[c] = pixel.sum[c] - cue;
    const std::int32_t color = f.depth_cue ? depth_cue(pixel.sum[c], cue, pixel.cue_factor)
                                           : std::min(pixel.sum[c], kOutputMax);
    pixel.color |= static_cast<std::uint32_t>(color) << (c * kOutputBits);
  }
}

DatapathOutputs DatapathRegisters::clock(const DatapathInputs& inputs) {
  if (!lanes_.empty()) return wide_clock(inputs);
  const DatapathOutputs before = outputs();
  const bool read = !queue_.empty() && (!pixel_valid_ || inputs.pixel_ready);
  const bool leaves = pixel_valid_ && inputs.pixel_ready;
  const bool room = free_ > 0 && until_next_ == 0;
  if (read) {
    output_ = queue_.front();
    queue_.pop_front();
  }
  pixel_valid_ = read || (pixel_valid_ && !inputs.pixel_ready);
  const DatapathPixel& whole = after_clocks(last_clock());
  if (whole.valid) queue_.push_back({whole.x, whole.y, whole.color});
  const auto advance = [](int& slot, bool used) {
    slot = (slot + (used ? 1 : 0)) % kPixelQueueSlots;
  };
  advance(slots_.place, in_stage(is_serial() ? 0 : 1).valid);
  advance(slots_.color, whole.valid);
  advance(slots_.read, read);
  free_ += (left_ ? 1 : 0) - (in_stage(0).valid ? 1 : 0);
  left_ = leaves;

  bool enters = true;
  if (before.span_ready && inputs.span != nullptr) {
    load(*inputs.span);
  } else if (room && last_.remaining > 1) {
    step();
  } else {
    enters = false;
  }
  until_next_ = enters ? configuration_.interval_cycles() - 1 : std::max(0, until_next_ - 1);
  head_ = (head_ + stages_.size() - 1) % stages_.size();
  if (enters) {
    stages_[head_] = last_;
    shade(stages_[head_]);
  } else {
    stages_[head_].valid = false;
  }
  if (inputs.table != nullptr && configuration_.specular) {
    for (std::size_t c = 0; c < inputs.table->roms.size(); ++c) {
      const auto address = static_cast<std::size_t>(inputs.rom_address);
      table_[c][address] = inputs.table->roms[c].contents()[address];
    }
  }
  return before;
}

// What lane k of `lanes` takes of a span; of the place, what hw/pixel_datapath_wide.sv says.
static Span span_of_lane(const Span& span, int k, int lanes) {
  Span own = span;
  if (k > 0) {
    own.row.x = -pixels_of_lane(span.row.length, k, lanes) & ((1 << kCoordinateBits) - 1);
    own.row.y = 0;
  }
  own.row.length = pixels_of_lane(span.row.length, 0, lanes);
  const auto start = [&](const SeriesStart& series, bool stepping) {
    return lane_start(series.stepped(stepping), k, lanes);
  };
  for (SeriesStart& series : own.diffuse) series = start(series, span.step_diffuse);
  own.specular = start(span.specular, span.step_specular);
  own.gate = start(span.gate, span.step_diffuse);
  own.cue = start({span.cue.v, span.cue.d1, 0}, true);
  return own;
}

std::size_t DatapathRegisters::wide_pixels_after(int stage) const {
  if (stage < 0) {
    std::size_t all = pixels_in_lanes_;
    for (int later = stage + 1; later < 0; ++later) {
      if (before_lanes(later)) all += static_cast<std::size_t>(before_lanes(later)->row.length);
    }
    return all;
  }
  const DatapathRegisters& first = lanes_[0];
  int pixels = 0;
  if (first.pixel_valid_) {
    pixels += pixels_side_by_side([](const DatapathRegisters& lane) { return lane.output_.x; });
  }
  for (std::size_t i = 0; i < first.queue_.size(); ++i) {
    pixels += pixels_side_by_side([i](const DatapathRegisters& lane) { return lane.queue_[i].x; });
  }
  for (int later = stage + 1; later < datapath_stages(configuration_); ++later) {
    if (first.in_stage(later).valid) pixels += pixels_in(later);
  }
  return static_cast<std::size_t>(pixels);
}

DatapathOutputs DatapathRegisters::wide_outputs() const {
  DatapathOutputs outputs = lanes_[0].outputs();
  outputs.span_ready = outputs.span_ready || !before_lanes_.back().has_value();
  if (!outputs.pixel_valid) return outputs;
  outputs.others =
      pixels_side_by_side([](const DatapathRegisters& lane) { return lane.output_.x; }) - 1;
  for (int k = 1; k <= outputs.others; ++k) {
    outputs.other[static_cast<std::size_t>(k) - 1] = {
        static_cast<std::uint16_t>(outputs.pixel.x + k), outputs.pixel.y,
        lanes_[static_cast<std::size_t>(k)].output_.color};
  }
  return outputs;
}

DatapathOutputs DatapathRegisters::wide_clock(const DatapathInputs& inputs) {
  const DatapathOutputs before = wide_outputs();
  const std::optional<Span>& next = before_lanes_.back();
  const bool taken = next && lanes_[0].outputs().span_ready;
  for (std::size_t k = 0; k < lanes_.size(); ++k) {
    DatapathInputs own = inputs;
    own.span = nullptr;
    Span span;
    if (taken) {
      span = span_of_lane(*next, static_cast<int>(k), static_cast<int>(lanes_.size()));
      own.span = &span;
    }
    lanes_[k].clock(own);
  }
  if (taken) pixels_in_lanes_ += static_cast<std::size_t>(next->row.length);
  if (before.pixel_valid && inputs.pixel_ready) {
    pixels_in_lanes_ -= static_cast<std::size_t>(before.pixels());
  }
  if (!before.span_ready) return before;
  std::rotate(before_lanes_.begin(), before_lanes_.end() - 1, before_lanes_.end());
  before_lanes_[0].reset();
  if (inputs.span != nullptr) before_lanes_[0] = *inputs.span;
  return before;
}

}  // namespace phongpipe
