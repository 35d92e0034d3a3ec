#include "sim/signals/block_signals.h"
#include "sim/signals/signal_list.h"

namespace phongpipe {
namespace {

class ControlTable : public SignalList {
 public:
  explicit ControlTable(const DatapathConfiguration& configuration)
      : SignalList(configuration),
        serial_(configuration.kind == DatapathKind::serial),
        stages_(datapath_stages(configuration)) {
    add_control();
    add_queue();
    add_span();
    if (f_.specular) add_span_flag("highlight", [](const Pixel& p) { return p.highlight; });
    if (f_.depth_cue) add_span_flag("first_pass", [](const Pixel& p) { return p.first_pass; });
    if (serial_) add_kept_for_digits();
  }

 private:
  void add_control() {
    const auto valid = [](const Pixel& p) { return p.valid; };
    if (serial_) add(0, "", "s0_valid", 1, valid);
    add_flag(serial_ ? kWholeStage : 0, stages_ - 1, "", "valid", valid);
    for (DatapathSignal& signal : signals_) signal.meaning = Meaning::always;
    if (!serial_) {
      add_flag(0, 3, "", "first", [](const Pixel& p) { return p.step == 0; });
      add_flag(1, 2, "", "restart", [](const Pixel& p) { return p.step <= 1; });
      add(0, "", "after_first", 1, [](const Pixel& p) { return p.step == 1; }).meaning =
          Meaning::further_pixels;
    }
    const char* const control = "control";
    add(0, control, "remaining", kLengthBits, [](const Pixel& p) { return p.remaining; });
    add(0, control, "ending", 1, [](const Pixel& p) { return p.remaining == 2; });
    add_register(0, control, "open", 1, [](const DatapathRegisters& r) {
      return r.between_spans();
    }).meaning = Meaning::always;
  }

  void add_queue() {
    const int last = stages_ - 1;
    const auto add_counter = [this](int stage, const char* name, int width, auto count) {
      add_register(stage, "queue", name, width, count).meaning = Meaning::always;
    };
    const auto add_negated = [&](int stage, const char* name, auto count) {
      add_counter(stage, name, kPixelQueueBits + 1, [count](const DatapathRegisters& r) {
        return -static_cast<std::int64_t>(count(r));
      });
      signals_.back().is_signed = true;
    };
    add_negated(0, "minus_free", [](const DatapathRegisters& r) { return r.free_slots(); });
    add_negated(last, "minus_colors", [](const DatapathRegisters& r) { return r.queued(); });
    add_counter(serial_ ? 0 : 1, "place_slot", kPixelQueueBits,
                [](const DatapathRegisters& r) { return r.place_slot(); });
    add_counter(last, "color_slot", kPixelQueueBits,
                [](const DatapathRegisters& r) { return r.color_slot(); });
    add_counter(last, "read_slot", kPixelQueueBits,
                [](const DatapathRegisters& r) { return r.read_slot(); });
    add_counter(0, "left", 1, [](const DatapathRegisters& r) { return r.left(); });
  }

  // What a span keeps while the digits of its pixels are read.
  void add_kept_for_digits() {
    add(0, "", "s0_step_diffuse", 1, [](const Pixel& p) { return p.step_diffuse; });
    if (f_.specular) {
      add(0, "", "s0_step_specular", 1, [](const Pixel& p) { return p.step_specular; });
      add(0, "", "s0_highlight", 1, [](const Pixel& p) { return p.highlight; });
    }
    if (f_.depth_cue) add(0, "", "s0_first_pass", 1, [](const Pixel& p) { return p.first_pass; });
  }

  void add_span() {
    const int place = serial_ ? 0 : 1;
    if (!serial_) add_input();
    add(place, "", at(place, "x"), kCoordinateBits, [](const Pixel& p) { return p.x; });
    add(place, "", at(place, "y"), kCoordinateBits, [](const Pixel& p) { return p.y; });
    for (int c = 0; c < f_.channels; ++c) {
      for (int stage = serial_ ? kWholeStage : 1; stage <= 3; ++stage) {
        DatapathSignal& level =
            add(stage, fmt::format("channel[{}]", c), at(stage, "level"), f_.diffuse_width(),
                [c](const Pixel& p) { return p.level[static_cast<std::size_t>(c)]; });
        in_units(level, "LSB", f_.diffuse_fraction_bits, true);
        level.packed = level.name;
        level.rtl_lsb = c * f_.diffuse_width();
      }
    }
  }

  // What was at the input in the clock in which a span was taken.
  void add_input() {
    add_register(0, "", "s0_x_term", kCoordinateBits, [](const DatapathRegisters& r) -> int {
      const Pixel& p = r.in_stage(0);
      return p.step == 0 ? p.x : r.x_step();
    });
    int lsb = 0;
    const auto add_kept = [&](const std::string& scope, const char* name, int width, auto value) {
      DatapathSignal& signal = add(0, "of_span" + scope, name, width, value);
      signal.meaning = Meaning::first_pixel;
      signal.packed = "s0_start";
      signal.rtl_lsb = lsb;
      lsb += width;
    };
    for (int c = 0; c < f_.channels; ++c) {
      add_kept(fmt::format(".channel[{}]", c), "s0_level", f_.diffuse_width(),
               [c](const Pixel& p) { return p.level[static_cast<std::size_t>(c)]; });
      in_units(signals_.back(), "LSB", f_.diffuse_fraction_bits, true);
    }
    add_kept("", "s0_first_pass", 1, [](const Pixel& p) { return p.first_pass; });
    add_kept("", "s0_highlight", 1, [](const Pixel& p) { return p.highlight; });
    add_kept("", "s0_y", kCoordinateBits, [](const Pixel& p) { return p.y; });
  }

  // What a span keeps for all its pixels, until color_pipeline has it.
  template <typename Value>
  void add_span_flag(const char* name, Value value) {
    if (serial_) {
      add(kWholeStage, "", at(kWholeStage, name), 1, value);
    } else {
      add(1, "", at(1, name), 1, value);
      add_flag(2, 3, "", name, value);
    }
  }

  bool serial_;
  int stages_;
};

}  // namespace

std::vector<DatapathSignal> control_signals(const DatapathConfiguration& configuration) {
  return ControlTable(configuration).take();
}

}  // namespace phongpipe
