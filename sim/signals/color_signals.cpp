#include "sim/signals/block_signals.h"
#include "sim/signals/signal_list.h"

namespace phongpipe {
namespace {

class ColorTable : public SignalList {
 public:
  explicit ColorTable(const DatapathConfiguration& configuration) : SignalList(configuration) {
    if (f_.specular) add_specular();
    for (int c = 0; c < f_.channels; ++c) add_light(c);
    if (f_.depth_cue) add_cueing();
  }

 private:
  void add_specular() {
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
      DatapathSignal& word =
          add_register(stage, fmt::format("{}.channel[{}]", scope, c), at(stage, name),
                       f_.rom_data_bits, [=](const DatapathRegisters& r) {
                         return r.table(static_cast<std::size_t>(c))[place(r.in_stage(stage))];
                       });
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
    for (int later = stage; later < datapath_stages(f_) - 1; ++later) {
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

  inline static const std::string kColor = "color", kSpecular = "color.specular";
};

}  // namespace

std::vector<DatapathSignal> color_signals(const DatapathConfiguration& configuration) {
  return ColorTable(configuration).take();
}

}  // namespace phongpipe
