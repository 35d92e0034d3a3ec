#include "sim/signals/block_signals.h"
#include "sim/signals/signal_list.h"

namespace phongpipe {
namespace {

class LaneStartTable : public SignalList {
 public:
  explicit LaneStartTable(const DatapathConfiguration& configuration) : SignalList(configuration) {
    for (int number = 1; number <= kLaneStages; ++number) add_kept(number);
    add_place();
    for (int c = 0; c < f_.channels && f_.diffuse; ++c) {
      add_series(fmt::format("channel[{}].diffuse_lanes", c), "LSB", f_.diffuse_width(),
                 f_.diffuse_fraction_bits, [c](const Span& span) {
                   return span.diffuse[static_cast<std::size_t>(c)].stepped(span.step_diffuse);
                 });
    }
    if (f_.specular) {
      add_series("specular_lanes", "address", f_.specular_width(), f_.specular_fraction_bits,
                 [](const Span& span) { return span.specular.stepped(span.step_specular); });
    }
    if (f_.has_gate_series()) {
      add_series("gate_lanes", "LSB", f_.diffuse_width(), f_.diffuse_fraction_bits,
                 [](const Span& span) { return span.gate.stepped(span.step_diffuse); });
    }
    if (f_.depth_cue) {
      add_series("cue_lanes", "", kCueWidth, kCueFraction, [](const Span& span) {
        return SeriesStart{span.cue.v, span.cue.d1, 0};
      });
    }
  }

 private:
  // `number`: of the stage, in RTL's names. `value`: of the span in it.
  template <typename Value>
  DatapathSignal& add_start(int number, const std::string& scope, const std::string& name,
                            int width, Value value) {
    const int stage = number - kLaneStages - 1;
    DatapathSignal& signal =
        add_register(stage, scope, name, width, [stage, value](const DatapathRegisters& registers) {
          const std::optional<Span>& span = registers.before_lanes(stage);
          return span ? static_cast<std::int64_t>(value(*span)) : 0;
        });
    signal.meaning = Meaning::first_pixel;
    return signal;
  }
  static std::string at_lanes(int number, const char* name) {
    return fmt::format("l{}_{}", number, name);
  }

  // What the lanes take as it is: one word of RTL, the levels in its low bits.
  void add_kept(int number) {
    int lsb = 0;
    const auto kept = [&](const std::string& scope, const char* name, int width,
                          auto value) -> DatapathSignal& {
      DatapathSignal& signal = add_start(number, scope, at_lanes(number, name), width, value);
      signal.packed = at_lanes(number, "kept");
      signal.rtl_lsb = lsb;
      lsb += width;
      return signal;
    };
    for (int c = 0; c < f_.channels; ++c) {
      const int width = f_.diffuse_width();
      DatapathSignal& level =
          kept(fmt::format("channel[{}]", c), "level", width, [c, width](const Span& span) {
            return wrap_to(span.level[static_cast<std::size_t>(c)], width);
          });
      in_units(level, "LSB", f_.diffuse_fraction_bits, true);
    }
    kept("", "highlight", 1, [](const Span& span) { return span.highlight; });
    kept("", "step_specular", 1, [](const Span& span) { return span.step_specular; });
    kept("", "step_diffuse", 1, [](const Span& span) { return span.step_diffuse; });
    kept("", "first_pass", 1, [](const Span& span) { return span.first_pass; });
    kept("", "y", kCoordinateBits, [](const Span& span) { return span.row.y; });

    DatapathSignal& held =
        add_start(number, "", at_lanes(number, "held"), 1, [](const Span&) { return 1; });
    held.packed = "held";
    held.rtl_lsb = number - 1;
    held.meaning = Meaning::always;
  }

  void add_place() {
    const int lanes = f_.lanes();
    for (int number = 1; number <= kLaneStages; ++number) {
      add_start(number, "", at_lanes(number, "x"), kCoordinateBits,
                [](const Span& span) { return span.row.x; });
    }
    add_start(1, "", "l1_length", kLengthBits, [](const Span& span) { return span.row.length; });
    add_start(2, "", "l2_rest", kCoordinateBits,
              [](const Span& span) { return span.row.length - 1; });
    add_start(3, "", "l3_groups", kLengthBits,
              [lanes](const Span& span) { return pixels_of_lane(span.row.length, 0, lanes); });
    for (int k = 1; k < lanes; ++k) {
      DatapathSignal& x = add_start(
          3, fmt::format("lane[{}]", k), "x", kCoordinateBits,
          [k, lanes](const Span& span) { return -pixels_of_lane(span.row.length, k, lanes); });
      x.is_signed = true;
      x.unit = kMinusPixelsToCome;
    }
  }

  // `of`: the series of a span. Names and sums as in hw/series_lanes.sv.
  template <typename Of>
  void add_series(const std::string& scope, const char* unit, int width, int fraction_bits, Of of) {
    const auto word = [&](int number, const std::string& block, const char* name, auto sum) {
      DatapathSignal& signal =
          add_start(number, block, at_lanes(number, name), width,
                    [of, sum, width](const Span& span) { return wrap_to(sum(of(span)), width); });
      in_units(signal, unit, fraction_bits, true);
    };
    using Start = const SeriesStart&;
    for (int number = 1; number <= kLaneStages; ++number) {
      word(number, scope, "v", [](Start s) { return s.v; });
      word(number, scope, "d2", [](Start s) { return s.d2; });
    }
    word(1, scope, "d1", [](Start s) { return s.d1; });
    for (const int number : {2, 3}) {
      word(number, scope, "lane_1", [](Start s) { return s.v + s.d1; });
    }
    word(2, scope, "two", [](Start s) { return 2 * s.d1 + s.d2; });
    word(3, scope, "two_1", [](Start s) { return 2 * s.d1 + 3 * s.d2; });
    if (f_.lanes() == 2) {
      word(3, scope + ".lanes_2", "two", [](Start s) { return 2 * s.d1 + s.d2; });
      return;
    }
    const std::string block = scope + ".lanes_4";
    word(2, block, "both", [](Start s) { return s.d1 + s.d2; });
    for (const int number : {2, 3}) {
      word(number, block, "thrice", [](Start s) { return 3 * s.d2; });
    }
    word(3, block, "lane_2", [](Start s) { return s.v + 2 * s.d1 + s.d2; });
    word(3, block, "both_and_d2", [](Start s) { return s.d1 + 2 * s.d2; });
  }
};

}  // namespace

std::vector<DatapathSignal> lane_start_signals(const DatapathConfiguration& configuration) {
  return LaneStartTable(configuration).take();
}

}  // namespace phongpipe
