#include "testbench/cosim/lockstep.h"

#include <fmt/format.h>

#include <algorithm>

#include "sim/datapath_driver.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {

std::string hex_text(std::int64_t value, int width) {
  const std::uint64_t mask = ~std::uint64_t{0} >> (64 - width);
  return fmt::format("0x{:0{}x}", static_cast<std::uint64_t>(value) & mask, (width + 3) / 4);
}

Lockstep::Lockstep(const DatapathConfiguration& configuration, const OutputColor& cue_color,
                   RtlDatapath& rtl, std::optional<std::uint64_t> stream_index)
    : configuration_(configuration),
      model_(configuration, cue_color),
      rtl_(rtl),
      signals_(rtl),
      stream_index_(stream_index) {
  for (DatapathSignal& signal : datapath_signals(configuration)) {
    const auto found = RtlRegister::find(signals_, signal);
    if (!found) continue;  // only the ports of somebody else's RTL are known
    registers_.push_back({std::move(signal), *found});
  }
  rtl_.before_edge([this] {
    compare_table();
    compare_registers();
  });
}

void Lockstep::reset() {
  rtl_.reset();
  model_.reset();
}

void Lockstep::differs(std::uint64_t pixel, SignalDivergence difference) {
  if (difference.model != difference.other && pixel >= kept_from_) {
    differences_.emplace(pixel, std::move(difference));
  }
}

std::uint64_t Lockstep::pixel_in(int stage) const {
  return delivered_ + model_.pixels_after(stage);
}

void Lockstep::compare_registers() {
  for (const Register& r : registers_) {
    if (!r.signal.counts(model_)) continue;
    const std::int64_t model = r.signal.value(model_), other = r.rtl.value();
    if (model == other) continue;
    differs(pixel_in(r.signal.stage),
            {r.signal.block(), r.signal.name, r.signal.width, cycle_, model, other});
  }
}

void Lockstep::compare_table() {
  if (table_settles_ == 0 || --table_settles_ > 0) return;
  const int bits = configuration_.rom_data_bits;
  std::size_t place = 0;  // of the word in the table
  for (const RtlSignalView* const words : rom_memories(signals_)) {
    if (place == static_cast<std::size_t>(configuration_.rom_words())) place = 0;  // another lane
    if (place + static_cast<std::size_t>(words->elements) >
        static_cast<std::size_t>(configuration_.rom_words())) {
      return;
    }
    for (int i = 0; i < words->elements; ++i, ++place) {
      for (int c = 0; c < configuration_.channels; ++c) {
        differs(delivered_, {words->scope, fmt::format("{}[{}]", words->name, i), bits, cycle_,
                             model_.table(static_cast<std::size_t>(c))[place],
                             static_cast<std::int64_t>(words->bits(c * bits, bits, i))});
      }
    }
  }
}

void Lockstep::compare_outputs(const DatapathOutputs& rtl, const DatapathOutputs& model) {
  std::uint64_t pixel = delivered_;
  const auto port = [&](const char* name, int width, std::int64_t expected, std::int64_t found) {
    differs(pixel, {"pixel_datapath", name, width, cycle_, expected, found});
  };
  const int lanes = configuration_.lanes();
  port("pixel_valid", lanes, model.valid_bits(), rtl.valid_bits());
  if (model.pixel_valid) {
    port("pixel_x", kCoordinateBits, model.pixel.x, rtl.pixel.x);
    port("pixel_y", kCoordinateBits, model.pixel.y, rtl.pixel.y);
    for (int k = 0; k < std::min(model.pixels(), rtl.pixels()); ++k) {
      differs(pixel + static_cast<std::uint64_t>(k),
              {lanes == 1 ? "pixel_datapath" : fmt::format("pixel_datapath.{}", lane_scope(k)),
               "pixel_color", configuration_.channels * kOutputBits, cycle_, model[k].color,
               rtl[k].color});
    }
  }
  pixel = span_end_;
  port("span_ready", 1, model.span_ready, rtl.span_ready);
}

// What differs in a span may show in the next one only, as a pixel too many does.
void Lockstep::begin_span(int length) {
  if (stream_index_ && *stream_index_ >= span_end_) {
    kept_from_ = span_begin_;
    differences_.erase(differences_.begin(), differences_.lower_bound(kept_from_));
  }
  span_begin_ = span_end_;
  span_end_ += static_cast<std::uint64_t>(length);
}

std::optional<SignalDivergence> Lockstep::found() const {
  const auto earliest = std::min_element(
      differences_.begin(), differences_.end(),
      [](const auto& a, const auto& b) { return a.second.cycle < b.second.cycle; });
  if (earliest == differences_.end()) return std::nullopt;
  return earliest->second;
}

std::optional<SignalDivergence> Lockstep::found_in_pixel() const {
  if (!stream_index_) return std::nullopt;
  const auto difference = differences_.find(*stream_index_);
  if (difference == differences_.end()) return std::nullopt;
  return difference->second;
}

bool Lockstep::complete() const {
  return !differences_.empty() && (!stream_index_ || delivered_ > *stream_index_);
}

DatapathOutputs Lockstep::clock(const DatapathInputs& inputs) {
  const DatapathOutputs rtl = rtl_.clock(inputs);  // compares registers before the edge
  const DatapathOutputs model = model_.clock(inputs);
  compare_outputs(rtl, model);
  if (model.pixel_valid && inputs.pixel_ready) {
    delivered_ += static_cast<std::uint64_t>(model.pixels());
  }
  if (inputs.table != nullptr && inputs.rom_address + 1 == configuration_.rom_words()) {
    table_settles_ = 2;
  }
  if (inputs.span != nullptr && rtl.span_ready) begin_span(inputs.span->row.length);
  ++cycle_;
  return rtl;
}

namespace {

// Ends the simulation of a frame when enough is known.
class EndingLockstep : public Lockstep {
 public:
  using Lockstep::Lockstep;
  DatapathOutputs clock(const DatapathInputs& inputs) override {
    const DatapathOutputs outputs = Lockstep::clock(inputs);
    if (complete()) stop_simulation();
    return outputs;
  }
};

// The span with a number, in the order of pixel_datapath, and the place of its first pixel in the
// stream.
std::pair<Span, std::uint64_t> span_of(const FrameSetup& frame, std::uint64_t number) {
  SpanStream stream(frame);
  stream.next();
  std::uint64_t begin = 0;
  for (std::uint64_t i = 0; i < number; ++i) {
    begin += static_cast<std::uint64_t>(stream.span().row.length);
    stream.next();
  }
  return {stream.span(), begin};
}

// Replays the pixel's span alone, after a reset. Nothing is found if the cause lies before it.
std::optional<SignalDivergence> find_in_span(const FrameSetup& frame, RtlDatapath& rtl,
                                             const Divergence& pixel) {
  const auto [span, begin] = span_of(frame, pixel.span);
  const std::uint64_t index = pixel.stream_index - begin;
  Lockstep lockstep(frame.configuration, frame.cue_color, rtl, index);
  DatapathDriver driver(frame, lockstep);
  std::int64_t taken_cycle = -1, delivered_cycle = -1;
  std::uint64_t delivered = 0;
  constexpr std::int64_t kPatience = 1000;
  for (std::int64_t cycle = 0; delivered_cycle < 0; ++cycle) {
    const auto outcome = driver.clock(taken_cycle < 0 ? &span : nullptr, true);
    if (outcome.span_taken) taken_cycle = cycle;
    if (outcome.pixel_taken) delivered += static_cast<std::uint64_t>(outcome.outputs.pixels());
    if (delivered_cycle < 0 && delivered > index) delivered_cycle = cycle;
    const bool empty = taken_cycle >= 0 && driver.pixels_in_flight() <= 0;
    if (empty || !driver.misbehaviour(kPatience).empty()) break;
  }
  std::optional<SignalDivergence> found = lockstep.found();
  if (delivered_cycle < 0 || !found || !lockstep.complete() || found->cycle < taken_cycle)
    return {};
  found->cycle += pixel.cycle - delivered_cycle;
  return found;
}

}  // namespace

std::optional<SignalDivergence> find_signal_divergence(
    const FrameSetup& frame, const PipelineConfiguration& pipeline,
    const SimulationOptions& simulation,
    const std::function<std::unique_ptr<RtlDatapath>()>& make_rtl,
    const std::optional<Divergence>& pixel) {
  Child child([&] {
    std::optional<SignalDivergence> found;
    if (pixel && !pixel->missing) {
      const std::unique_ptr<RtlDatapath> rtl = make_rtl();
      found = find_in_span(frame, *rtl, *pixel);
    }
    if (!found || slowest_output_cycles(pipeline, simulation) > 1) {
      const std::unique_ptr<RtlDatapath> rtl = make_rtl();
      std::optional<std::uint64_t> stream_index;
      if (pixel) stream_index = pixel->stream_index;
      EndingLockstep lockstep(frame.configuration, frame.cue_color, *rtl, stream_index);
      SimulationOptions options = simulation;
      options.detail = Detail::cycle;  // its clocks are the frame's cycles
      options.datapath = &lockstep;
      options.observe = [](const ShadedPixel*, const std::int64_t*, std::size_t) {};
      simulate(frame, pipeline, options);
      // The span alone shows the fault, so that no other pixel is the cause; its cycle is not known
      // where the output waits.
      if (found) found = lockstep.found_in_pixel();
      if (!found) found = lockstep.found();
    }
    return nlohmann::json(found).dump();
  });
  return nlohmann::json::parse(child.get()).get<std::optional<SignalDivergence>>();
}

}  // namespace phongpipe
