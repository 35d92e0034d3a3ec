#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "sim/datapath_registers.h"
#include "sim/digit_signals.h"
#include "sim/lane_start_signals.h"

namespace phongpipe {

std::string DatapathSignal::block() const {
  return scope.empty() ? "pixel_datapath" : "pixel_datapath." + scope;
}

std::string lane_scope(int k) {
  return fmt::format("lane[{}].datapath", k);
}

bool DatapathSignal::counts(const DatapathRegisters& registers) const {
  if (meaning == Meaning::always) return true;
  if (stage < 0) return registers.before_lanes(stage).has_value();
  const DatapathPixel& pixel = registers.in_stage(stage);
  return pixel.valid && (meaning == Meaning::every_pixel ||
                         (meaning == Meaning::first_pixel) == (pixel.step == 0));
}

double DatapathSignal::real(std::int64_t bits) const {
  return std::ldexp(static_cast<double>(bits), -fraction_bits);
}

namespace {

using Pixel = DatapathPixel;
using Series = DatapathPixel::Series;

void sort_by_stage(std::vector<DatapathSignal>& signals) {
  std::stable_sort(
      signals.begin(), signals.end(),
      [](const DatapathSignal& a, const DatapathSignal& b) { return a.stage < b.stage; });
}

class SignalTable {
 public:
  explicit SignalTable(const DatapathConfiguration& configuration)
      : f_(configuration),
        serial_(configuration.kind == DatapathKind::serial),
        stages_(datapath_stages(configuration)) {}

  std::vector<DatapathSignal> all() {
    add_control();
    add_span();
    add_all_series();
    add_specular();
    for (int c = 0; c < f_.channels; ++c) add_light(c);
    if (f_.depth_cue) add_cueing();
    if (serial_) add_digits();
    sort_by_stage(signals_);
    return std::move(signals_);
  }

 private:
  template <typename Value>
  DatapathSignal& add(int stage, const std::string& scope, const std::string& name, int width,
                      Value value) {
    DatapathSignal signal;
    signal.scope = scope;
    signal.name = name;
    signal.stage = stage;
    signal.width = width;
    signal.value = [value, stage](const DatapathRegisters& r) {
      return static_cast<std::int64_t>(value(r.in_stage(stage)));
    };
    return signals_.emplace_back(std::move(signal));
  }
  static std::string at(int stage, const char* name) { return fmt::format("s{}_{}", stage, name); }
  static void in_units(DatapathSignal& signal, const char* unit, int fraction_bits,
                       bool is_signed) {
    signal.unit = unit;
    signal.fraction_bits = fraction_bits;
    signal.is_signed = is_signed;
  }
  // One bit of a pixel in stages `first` to `last`, which RTL keeps in a word that begins at
  // `first`.
  template <typename Value>
  void add_flag(int first, int last, const std::string& scope, const char* name, Value value) {
    for (int stage = first; stage <= last; ++stage) {
      DatapathSignal& flag = add(stage, scope, at(stage, name), 1, value);
      flag.packed = name;
      flag.rtl_lsb = stage - first;
    }
  }

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
    DatapathSignal& open = add(0, control, "open", 1, [](const Pixel&) { return 0; });
    open.value = [](const DatapathRegisters& r) -> std::int64_t { return r.between_spans(); };
    open.meaning = Meaning::always;
    add_queue();
  }

  void add_queue() {
    const int last = stages_ - 1;
    const auto add_counter = [this](int stage, const char* name, int width, auto count) {
      DatapathSignal& signal = add(stage, "queue", name, width, [](const Pixel&) { return 0; });
      signal.meaning = Meaning::always;
      signal.value = [count](const DatapathRegisters& r) -> std::int64_t { return count(r); };
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

  // What a span keeps while the digits of its pixels are read, and these digits.
  void add_digits() {
    add(0, "", "s0_step_diffuse", 1, [](const Pixel& p) { return p.step_diffuse; });
    if (f_.specular) {
      add(0, "", "s0_step_specular", 1, [](const Pixel& p) { return p.step_specular; });
      add(0, "", "s0_highlight", 1, [](const Pixel& p) { return p.highlight; });
    }
    if (f_.depth_cue) add(0, "", "s0_first_pass", 1, [](const Pixel& p) { return p.first_pass; });
    for (DatapathSignal& signal : digit_signals(f_)) signals_.push_back(std::move(signal));
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
    DatapathSignal& x_term =
        add(0, "", "s0_x_term", kCoordinateBits, [](const Pixel& p) { return p.x; });
    x_term.value = [](const DatapathRegisters& r) -> std::int64_t {
      const Pixel& p = r.in_stage(0);
      return p.step == 0 ? p.x : r.x_step();
    };
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

  // `of`: the series of a pixel. `stepping`: whether it steps along the span.
  template <typename Of, typename Stepping>
  void add_series(const std::string& scope, const char* unit, int width, int fraction_bits, Of of,
                  Stepping stepping) {
    const auto whole = [&](int stage, const char* name, std::int64_t Series::*part) {
      in_units(add(stage, scope, at(stage, name), width,
                   [of, part](const Pixel& p) { return of(p).*part; }),
               unit, fraction_bits, true);
    };
    const int low = low_bits(width);
    const auto lower = [&](int stage, const char* name, std::int64_t Series::*part) {
      add(stage, scope, at(stage, name), low,
          [of, part, low](const Pixel& p) { return of(p).*part & ((std::int64_t{1} << low) - 1); });
    };
    const auto upper = [&](int stage, const char* name, std::int64_t Series::*part) {
      add(stage, scope, at(stage, name), width - low, [of, part, low](const Pixel& p) {
        return of(p).*part >> low;
      }).is_signed = true;
    };
    if (serial_) {
      whole(kWholeStage, "v", &Series::v);
      whole(kSeriesStage, "v", &Series::v);
      return;
    }
    // Terms of the first pixel, at the input.
    const auto add_start = [&](const std::string& block, const char* name, auto value) {
      in_units(add(0, block, name, width,
                   [of, value, width](const Pixel& p) { return wrap_to(value(of(p)), width); }),
               unit, fraction_bits, true);
      signals_.back().meaning = Meaning::first_pixel;
    };
    add_start(scope, "s0_start_v", [](const Series& s) { return s.start.v; });
    add_start(scope, "s0_start_d1", [](const Series& s) { return s.start.d1; });
    add_start(scope + ".last_term", "s0_start", [](const Series& s) { return s.last_term; });
    add(0, scope, "s0_stepping", 1, stepping).meaning = Meaning::first_pixel;
    whole(1, "term", &Series::term);
    whole(1, "next_term", &Series::next_term);
    whole(1, "last_term", &Series::last_term);
    // The carry of a sum of low bits is 1 if the sum is less than what was added. A sum that starts
    // over, after `steps` pixels of a span, has none.
    const auto carry = [&](int stage, std::int64_t Series::*sum, std::int64_t Series::*added,
                           int steps) {
      const std::int64_t mask = (std::int64_t{1} << low) - 1;
      add(stage, scope, at(stage, "carry"), 1, [=](const Pixel& p) {
        return p.step >= steps && (of(p).*sum & mask) < (of(p).*added & mask);
      });
    };
    lower(2, "difference_low", &Series::difference);
    upper(2, "term_high", &Series::term);
    carry(2, &Series::difference, &Series::term, 2);
    upper(3, "difference_high", &Series::difference);
    lower(3, "v_low", &Series::v);
    carry(3, &Series::v, &Series::difference, 1);
    whole(kSeriesStage, "v", &Series::v);
  }
  void add_all_series() {
    for (int c = 0; c < f_.channels && f_.diffuse; ++c) {
      add_series(
          fmt::format("channel[{}].diffuse.diffuse_series", c), "LSB", f_.diffuse_width(),
          f_.diffuse_fraction_bits,
          [c](const Pixel& p) -> const Series& { return p.diffuse[static_cast<std::size_t>(c)]; },
          [](const Pixel& p) { return p.step_diffuse; });
    }
    if (f_.specular) {
      add_series(
          "specular.specular_series", "address", f_.specular_width(), f_.specular_fraction_bits,
          [](const Pixel& p) -> const Series& { return p.specular; },
          [](const Pixel& p) { return p.step_specular; });
    }
    if (f_.has_gate_series()) {
      add_series(
          "gate.gate_series", "LSB", f_.diffuse_width(), f_.diffuse_fraction_bits,
          [](const Pixel& p) -> const Series& { return p.gate; },
          [](const Pixel& p) { return p.step_diffuse; });
    }
    if (f_.depth_cue) {
      add_series(
          "cueing.cue_series", "", kCueWidth, kCueFraction,
          [](const Pixel& p) -> const Series& { return p.cue; }, [](const Pixel&) { return true; });
    }
  }

  void add_specular() {
    if (!f_.specular) return;
    add_span_flag("highlight", [](const Pixel& p) { return p.highlight; });
    add_flag(4, 6, kColor, "highlight", [](const Pixel& p) { return p.highlight; });
    add(5, kSpecular + ".rom", "s5_address", f_.rom_address_bits, [](const Pixel& p) {
      return p.address;
    }).unit = "address";
    if (f_.has_gate_series()) {
      const std::string gate = kSpecular + ".gate";
      add(5, gate, "s5_negative", 1, [](const Pixel& p) { return p.gate.v < 0; });
      add(5, gate, "s5_zero", 1, [](const Pixel& p) { return p.gate.v == 0; });
      add(6, kSpecular, "s6_facing", 1, [](const Pixel& p) { return p.gate.v > 0; });
    }
    if (f_.rom_layout == RomLayout::plain) {
      add_plain_table();
    } else {
      add_octave_tables();
    }
    add(7, kSpecular, "s7_open", 1, [](const Pixel& p) { return p.open; });
    add(8, kColor, "s8_open", 1, [](const Pixel& p) { return p.open; });
    for (int c = 0; c < f_.channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      add_word(c, "s8_word", [i](const Pixel& p) { return p.word[i]; });
      if (f_.rom_layout == RomLayout::bipartite) {
        add_word(c, "s8_increment", [i](const Pixel& p) { return p.increment[i]; });
      }
    }
  }
  // Words of a table on their way out of it, channel by channel. `packed`: the RTL's signal, in
  // which they begin at `first_bit`. `place`: of them in the table.
  template <typename Place>
  void add_table_words(int stage, const std::string& scope, const char* name, const char* packed,
                       int first_bit, Place place) {
    for (int c = 0; c < f_.channels; ++c) {
      DatapathSignal& word = add(stage, fmt::format("{}.channel[{}]", scope, c), at(stage, name),
                                 f_.rom_data_bits, [](const Pixel&) { return 0; });
      word.value = [=](const DatapathRegisters& r) -> std::int64_t {
        return r.table(static_cast<std::size_t>(c))[place(r.in_stage(stage))];
      };
      in_units(word, "LSB", f_.rom_data_bits - kOutputBits, false);
      word.packed = packed;
      word.rtl_lsb = first_bit + c * f_.rom_data_bits;
    }
  }
  // All banks of a plain table are read.
  void add_plain_table() {
    constexpr int kMostBankBits = 11;
    const int bank_bits = std::min(f_.rom_address_bits, kMostBankBits);
    const int banks = f_.rom_addresses() >> bank_bits;
    const std::string scope = kSpecular + ".rom.plain";
    for (int bank = 0; bank < banks; ++bank) {
      const auto place = [=](const Pixel& p) {
        return static_cast<std::size_t>(bank << bank_bits | (p.address & ((1 << bank_bits) - 1)));
      };
      const std::string own = fmt::format("{}.bank[{}]", scope, bank);
      add_table_words(6, own, "word", "s6_word", 0, place);
      add_table_words(7, own, "word", "s7_words", bank * f_.channels * f_.rom_data_bits, place);
    }
    for (int stage = 6; banks > 1 && stage <= 7; ++stage) {
      add(stage, scope, at(stage, "bank"), f_.rom_address_bits - bank_bits,
          [bank_bits](const Pixel& p) { return p.address >> bank_bits; });
    }
  }
  void add_octave_tables() {
    const std::string scope = kSpecular + ".rom.octave";
    int place_bits = 0;
    while (1 << place_bits < f_.rom_bases()) ++place_bits;
    const auto base = [](const Pixel& p) { return p.places.base; };
    add(6, scope, "s6_place", place_bits, base);
    add_table_words(7, scope, "word", "s7_word", 0, base);
    if (f_.rom_layout != RomLayout::bipartite) return;
    const std::string second = scope + ".second_table";
    const auto increment = [](const Pixel& p) { return p.places.increment.value_or(0); };
    const auto bases = static_cast<std::size_t>(f_.rom_bases());
    add(6, second, "s6_increment_place", place_bits,
        [=](const Pixel& p) { return increment(p) - bases; });
    add_table_words(7, second, "increment", "s7_increment", 0, increment);
  }
  template <typename Value>
  void add_word(int channel, const std::string& name, Value value) {
    const int bits = f_.rom_data_bits;
    DatapathSignal& word =
        add(8, fmt::format("{}.channel[{}]", kColor, channel), name, bits, value);
    in_units(word, "LSB", bits - kOutputBits, false);
    word.packed = name + "s";
    word.rtl_lsb = channel * bits;
  }

  // The blocks of a channel from the comparison to the sum.
  void add_light(int channel) {
    const std::string scope = fmt::format("{}.channel[{}].summation", kColor, channel);
    const auto c = static_cast<std::size_t>(channel);
    const int width = f_.diffuse_width(), low = low_bits(width);
    if (!f_.diffuse) {
      in_units(add(4, fmt::format("{}.channel[{}]", kColor, channel), "s4_light", width,
                   [c](const Pixel& p) { return p.level[c]; }),
               "LSB", f_.diffuse_fraction_bits, true);
    }
    add(4, scope, "s4_level_complement", width - 1, [c, width](const Pixel& p) {
      return ~p.level[c] & ((std::int64_t{1} << (width - 1)) - 1);
    });
    add(5, scope, "s5_level_complement", width - 1 - low, [c, width, low](const Pixel& p) {
      return (~p.level[c] & ((std::int64_t{1} << (width - 1)) - 1)) >> low;
    });
    // diffuse > level, as far as the low bits tell: the carry of diffuse + ~level.
    add(5, scope, "s5_low_above", 1, [c, low](const Pixel& p) {
      const std::int64_t mask = (std::int64_t{1} << low) - 1;
      const std::int64_t diffuse = p.diffuse[c].v;
      return diffuse >= 0 && (diffuse & mask) > (p.level[c] & mask);
    });
    add(5, scope, "s5_diffuse", width - low, [c, low](const Pixel& p) {
      return p.diffuse[c].v >> low;
    }).is_signed = true;
    for (const int stage : {5, 6}) {
      add_cut(stage, scope, "diffuse_cut", [c](const Pixel& p) { return p.diffuse_cut[c]; });
      add_cut(stage, scope, "level_cut", [c](const Pixel& p) { return p.level_cut[c]; });
    }
    add(6, scope, "s6_lit", 1, [c](const Pixel& p) { return p.lit[c]; });
    for (const int stage : {7, 8, 9}) {
      add_cut(stage, scope, "clamped", [c](const Pixel& p) { return p.clamped[c]; });
    }
    if (f_.specular) {
      in_units(
          add(9, scope, "s9_addend", f_.rom_data_bits, [c](const Pixel& p) { return p.addend[c]; }),
          "LSB", f_.rom_data_bits - kOutputBits, false);
    }
    add(kSumStage, scope, at(kSumStage, "sum"), kGuardBits + kOutputBits + 1, [c](const Pixel& p) {
      return p.sum[c];
    }).unit = "LSB";
  }
  template <typename Value>
  void add_cut(int stage, const std::string& scope, const char* name, Value value) {
    const int fraction = f_.sum_fraction_bits();
    in_units(add(stage, scope, at(stage, name), kGuardBits + kOutputBits + fraction, value), "LSB",
             fraction, false);
  }

  void add_cueing() {
    add_span_flag("first_pass", [](const Pixel& p) { return p.first_pass; });
    const std::string cueing = kColor + ".cueing";
    add_flag(4, kSumStage, cueing, "first_pass", [](const Pixel& p) { return p.first_pass; });
    for (int stage = kSeriesStage + 1; stage <= kSumStage; ++stage) {
      add(stage, cueing, at(stage, "factor"), kCueFactorBits + 1, [](const Pixel& p) {
        return p.cue_factor;
      }).fraction_bits = kCueFactorBits;
    }
    for (int channel = 0; channel < f_.channels; ++channel) add_multiplier(channel);
  }

  // hw/depth_cue.sv: products of pairs of the factor's bits, and their sums.
  void add_multiplier(int channel) {
    const std::string scope = fmt::format("{}.cueing.channel[{}].multiplier", kColor, channel);
    const auto c = static_cast<std::size_t>(channel);
    constexpr int kOwnBits = kGuardBits + kOutputBits + 2;
    constexpr int kPartBits = kOwnBits + 2, kProductBits = kOwnBits + kCueFactorBits;
    constexpr int kParts = (kCueFactorBits + 2) / 2, kPairs = kParts / 2;
    constexpr int kHalf = 1 << (kCueFactorBits - 1);  // that rounds
    const auto own = [c](const Pixel& p) { return std::int64_t{p.own[c]}; };
    // The product with `count` bits of the factor, from bit `lsb` on, in its place.
    const auto partial = [own](const Pixel& p, int lsb, int count) {
      return own(p) * (p.cue_factor & ((1 << count) - 1) << lsb);
    };
    int stage = kSumStage + 1;
    for (int later = stage; later < stages_ - 1; ++later) {
      add(later, scope, at(later, "cue"), kOutputBits, [c](const Pixel& p) {
        return p.sum[c] - p.own[c];
      }).unit = "LSB";
    }
    in_units(add(stage, scope, at(stage, "own"), kOwnBits, own), "LSB", 0, true);
    add(stage, scope, at(stage, "factor"), 2 * kParts, [](const Pixel& p) {
      return p.cue_factor;
    }).fraction_bits = kCueFactorBits;
    // Words side by side in one signal of RTL.
    const auto add_word = [&](const char* name, int i, int width, int fraction_bits, auto value) {
      DatapathSignal& word =
          add(stage, scope, fmt::format("{}_{}", at(stage, name), i), width, value);
      in_units(word, "LSB", fraction_bits, true);
      word.packed = at(stage, name) + "s";
      word.rtl_lsb = i * width;
    };
    ++stage;
    for (int i = 0; i < kParts; ++i) {
      add_word("part", i, kPartBits, kCueFactorBits - 2 * i,
               [partial, i](const Pixel& p) { return partial(p, 2 * i, 2) >> 2 * i; });
    }
    ++stage;
    for (int i = 0; i < kPairs; ++i) {
      add_word("pair", i, kProductBits, kCueFactorBits,
               [partial, i](const Pixel& p) { return partial(p, 4 * i, 4); });
    }
    ++stage;
    add_word("sum", 0, kProductBits, kCueFactorBits,
             [partial](const Pixel& p) { return partial(p, 0, 8); });
    add_word("sum", 1, kProductBits, kCueFactorBits,
             [partial](const Pixel& p) { return partial(p, 8, 4) + kHalf; });
    ++stage;
    in_units(add(stage, scope, at(stage, "product"), kProductBits,
                 [own](const Pixel& p) { return own(p) * p.cue_factor + kHalf; }),
             "LSB", kCueFactorBits, true);
    ++stage;
    add(stage, scope, at(stage, "color"), kOutputBits, [c](const Pixel& p) {
      return p.color >> (c * kOutputBits) & kOutputMax;
    }).unit = "LSB";
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

  inline static const std::string kColor = "color", kSpecular = "color.specular";

  const DatapathConfiguration& f_;
  bool serial_;
  int stages_;
  std::vector<DatapathSignal> signals_;
};

}  // namespace

std::vector<DatapathSignal> datapath_signals(const DatapathConfiguration& configuration) {
  if (configuration.lanes() == 1) return SignalTable(configuration).all();
  std::vector<DatapathSignal> all = lane_start_signals(configuration);
  for (int k = 0; k < configuration.lanes(); ++k) {
    for (DatapathSignal& signal : SignalTable(configuration).all()) {
      signal.scope = lane_scope(k) + (signal.scope.empty() ? "" : "." + signal.scope);
      if (k > 0 && signal.name == "s1_x") {
        signal.is_signed = true;
        signal.unit = kMinusPixelsToCome;
        signal.value = [x = std::move(signal.value)](const DatapathRegisters& r) {
          return wrap_to(x(r), kCoordinateBits);
        };
      }
      signal.value = [value = std::move(signal.value), k](const DatapathRegisters& r) {
        return value(r.lane(static_cast<std::size_t>(k)));
      };
      all.push_back(std::move(signal));
    }
  }
  sort_by_stage(all);
  return all;
}

}  // namespace phongpipe
