// Descriptions of registers, as the tables of the blocks add them.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "sim/signals/datapath_signals.h"

namespace phongpipe {

class SignalList {
 public:
  explicit SignalList(const DatapathConfiguration& configuration) : f_(configuration) {}

  std::vector<DatapathSignal> take() { return std::move(signals_); }

 protected:
  using Pixel = DatapathPixel;
  using Series = DatapathPixel::Series;

  // `value`: what the registers hold.
  template <typename Value>
  DatapathSignal& add_register(int stage, const std::string& scope, const std::string& name,
                               int width, Value value) {
    DatapathSignal signal;
    signal.scope = scope;
    signal.name = name;
    signal.stage = stage;
    signal.width = width;
    signal.value = [value](const DatapathRegisters& r) {
      return static_cast<std::int64_t>(value(r));
    };
    return signals_.emplace_back(std::move(signal));
  }
  // `value`: of the pixel in the stage.
  template <typename Value>
  DatapathSignal& add(int stage, const std::string& scope, const std::string& name, int width,
                      Value value) {
    return add_register(stage, scope, name, width, [value, stage](const DatapathRegisters& r) {
      return value(r.in_stage(stage));
    });
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
  static std::string at(int stage, const char* name) { return fmt::format("s{}_{}", stage, name); }
  static void in_units(DatapathSignal& signal, const char* unit, int fraction_bits,
                       bool is_signed) {
    signal.unit = unit;
    signal.fraction_bits = fraction_bits;
    signal.is_signed = is_signed;
  }

  const DatapathConfiguration& f_;
  std::vector<DatapathSignal> signals_;
};

}  // namespace phongpipe
