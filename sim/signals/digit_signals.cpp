#include "sim/signals/block_signals.h"
#include "sim/signals/signal_list.h"

namespace phongpipe {
namespace {

using Words = DatapathPixel::SerialWords;

class DigitTable : public SignalList {
 public:
  explicit DigitTable(const DatapathConfiguration& configuration)
      : SignalList(configuration), digits_(configuration.serial_digits()) {
    add_control();
    add_place(1, "s1_place");
    add_digit(1, "s1_first", 1, [](const DatapathRegisters& r) { return r.in_stage(1).step == 0; });
    // From the memory. Of a span's first pixel the digits are at the port instead.
    add_word("s1_word", 1, &Words::v, &Words::read_d1, Meaning::further_pixels);
    add_carry("v_carry", &Words::next_v, &Words::v);
    add_carry("d1_carry", &Words::next_d1, &Words::d1);
    add_place(2, "s2_place");
    add_word("s2_word", 2, &Words::next_v, &Words::next_d1, Meaning::every_pixel);
  }

 private:
  template <typename Value>
  DatapathSignal& add_digit(int stage, const char* name, int width, Value value) {
    DatapathSignal& signal = add_register(stage, "differencer", name, width, value);
    signal.of_digit = true;
    return signal;
  }

  void add_control() {
    const int digits = digits_, last = f_.interval_cycles() - 1;
    const auto control = [this](int stage, const char* name, int width, auto value) {
      add_digit(stage, name, width, value).meaning = Meaning::always;
    };
    control(0, "idle", 1, [](const DatapathRegisters& r) { return r.next_digit() == 0; });
    control(0, "series", kSeriesBits,
            [digits](const DatapathRegisters& r) { return r.next_digit() / digits; });
    control(0, "digit", kDigitPlaceBits,
            [digits](const DatapathRegisters& r) { return r.next_digit() % digits; });
    control(1, "s1_step", 1, [](const DatapathRegisters& r) { return r.in_stage(1).valid; });
    control(1, "s1_carries", 1, [digits](const DatapathRegisters& r) {
      return r.in_stage(1).valid && r.digit_in(1) % digits != digits - 1;
    });
    control(1, "s1_last", 1, [last](const DatapathRegisters& r) {
      return r.in_stage(1).valid && r.digit_in(1) == last;
    });
    control(2, "s2_step", 1, [](const DatapathRegisters& r) { return r.in_stage(2).valid; });
  }

  // Series and digit, in one word.
  void add_place(int stage, const char* name) {
    add_digit(stage, name, kSeriesBits + kDigitPlaceBits,
              [stage, digits = digits_](const DatapathRegisters& r) {
                const int number = r.digit_in(stage);
                return number / digits << kDigitPlaceBits | number % digits;
              });
  }

  // The words that the digit in a stage is of.
  auto words_in(int stage) const {
    return [stage, digits = digits_, f = f_](const DatapathRegisters& r) -> const Words& {
      const DatapathPixel& pixel = r.in_stage(stage);
      int series = r.digit_in(stage) / digits;
      if (f.specular && series-- == 0) return pixel.specular.serial;
      if (f.has_gate_series() && series-- == 0) return pixel.gate.serial;
      if (f.depth_cue && series-- == 0) return pixel.cue.serial;
      return pixel.diffuse[static_cast<std::size_t>(series)].serial;
    };
  }
  // Bits of a word below the digit in a stage.
  auto bits_below(int stage) const {
    return [stage, digits = digits_](const DatapathRegisters& r) {
      return r.digit_in(stage) % digits * kDigitBits;
    };
  }

  // A digit of v and one of d1 above it, in one word of RTL.
  void add_word(const char* name, int stage, std::int64_t Words::*v, std::int64_t Words::*d1,
                Meaning meaning) {
    int lsb = 0;
    for (const auto& [part, suffix] : {std::pair(v, "v"), std::pair(d1, "d1")}) {
      DatapathSignal& digit = add_digit(stage, "", kDigitBits,
                                        [part = part, words = words_in(stage),
                                         below = bits_below(stage)](const DatapathRegisters& r) {
                                          constexpr std::int64_t kDigitMask = (1 << kDigitBits) - 1;
                                          return words(r).*part >> below(r) & kDigitMask;
                                        });
      digit.name = fmt::format("{}_{}", name, suffix);
      digit.meaning = meaning;
      digit.packed = name;
      digit.rtl_lsb = lsb;
      lsb += kDigitBits;
    }
  }

  // What the digits before that of stage 1 carry: theirs of the sum are less than those of what was
  // added.
  void add_carry(const char* name, std::int64_t Words::*sum, std::int64_t Words::*added) {
    add_digit(1, name, 1,
              [=, words = words_in(1), below = bits_below(1)](const DatapathRegisters& r) {
                const std::int64_t mask = (std::int64_t{1} << below(r)) - 1;
                return (words(r).*sum & mask) < (words(r).*added & mask);
              });
  }

  int digits_;
};

}  // namespace

std::vector<DatapathSignal> digit_signals(const DatapathConfiguration& configuration) {
  return DigitTable(configuration).take();
}

}  // namespace phongpipe
