// The signals inside Verilated RTL that was built with RtlBuild::signals, by name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/signals/datapath_signals.h"
#include "testbench/rtl/rtl_library.h"

namespace phongpipe {

// A signal, or some of its bits. Valid as long as its RtlDatapath.
class RtlSignalView {
 public:
  std::string scope;  // "pixel_datapath.color.specular.rom"
  std::string name;
  int width = 1;     // bits of an element
  int elements = 1;  // more than 1: an array

  RtlSignalView(const RtlSignal& signal);

  // `count` bits, at most 64, of an element from bit `lsb`.
  std::uint64_t bits(int lsb, int count, int element = 0) const;
  // Bit by bit, from the highest: 0s and 1s.
  std::string text(int element = 0) const;
  // Replaces a bit, as a fault in the register would.
  void set_bit(int bit, bool value, int element = 0) const;

 private:
  unsigned char* data_;
  std::size_t bytes_;
};

class RtlSignals {
 public:
  // Throws std::logic_error if the library was built without signals.
  explicit RtlSignals(const RtlDatapath& datapath);

  const std::vector<RtlSignalView>& all() const { return all_; }  // by scope and name
  const RtlSignalView* find(std::string_view scope, std::string_view name) const;

 private:
  std::vector<RtlSignalView> all_;
};

// The memories of exponent_rom, in the order in which words are written to them; of a wide
// datapath, those of one lane after the other, which get the same words.
std::vector<const RtlSignalView*> rom_memories(const RtlSignals& signals);

// A register of the datapath in RTL.
class RtlRegister {
 public:
  // Empty if the RTL has no signal of this name, or one that is too narrow, as RTL of somebody
  // else's may.
  static std::optional<RtlRegister> find(const RtlSignals& signals, const DatapathSignal& signal);

  // The value, with its sign if it has one.
  std::int64_t value() const;
  const RtlSignalView& view() const { return *view_; }
  int lsb() const { return lsb_; }

 private:
  RtlRegister() = default;
  const RtlSignalView* view_ = nullptr;
  int lsb_ = 0, width_ = 1;
  bool is_signed_ = false;
};

}  // namespace phongpipe
