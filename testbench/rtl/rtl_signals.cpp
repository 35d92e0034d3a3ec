#include "testbench/rtl/rtl_signals.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace phongpipe {

RtlSignalView::RtlSignalView(const RtlSignal& signal)
    : scope(signal.scope),
      name(signal.name),
      width(static_cast<int>(signal.width)),
      elements(static_cast<int>(signal.elements)),
      data_(static_cast<unsigned char*>(signal.data)),
      bytes_(signal.bytes) {}

std::uint64_t RtlSignalView::bits(int lsb, int count, int element) const {
  const unsigned char* const data = data_ + static_cast<std::size_t>(element) * bytes_;
  std::uint64_t value = 0;
  for (int i = 0; i < count;) {
    const int bit = lsb + i, taken = std::min(8 - bit % 8, count - i);
    const auto byte = static_cast<std::uint64_t>(data[bit / 8]) >> (bit % 8);
    value |= (byte & ((std::uint64_t{1} << taken) - 1)) << i;
    i += taken;
  }
  return value;
}

std::string RtlSignalView::text(int element) const {
  std::string text;
  for (int bit = width - 1; bit >= 0; --bit) text += bits(bit, 1, element) != 0 ? '1' : '0';
  return text;
}

void RtlSignalView::set_bit(int bit, bool value, int element) const {
  unsigned char& byte =
      data_[static_cast<std::size_t>(element) * bytes_ + static_cast<std::size_t>(bit / 8)];
  const auto mask = static_cast<unsigned char>(1U << (bit % 8));
  byte = static_cast<unsigned char>(value ? byte | mask : byte & ~mask);
}

RtlSignals::RtlSignals(const RtlDatapath& datapath) {
  const RtlInterface& interface = datapath.interface();
  if (interface.visit_signals == nullptr) throw std::logic_error("RTL built without signals");
  interface.visit_signals(
      datapath.rtl(),
      [](void* all, const RtlSignal* signal) {
        static_cast<std::vector<RtlSignalView>*>(all)->emplace_back(*signal);
      },
      &all_);
  std::sort(all_.begin(), all_.end(), [](const RtlSignalView& a, const RtlSignalView& b) {
    return std::tie(a.scope, a.name) < std::tie(b.scope, b.name);
  });
}

const RtlSignalView* RtlSignals::find(std::string_view scope, std::string_view name) const {
  const auto found = std::find_if(all_.begin(), all_.end(), [&](const RtlSignalView& signal) {
    return signal.name == name && signal.scope == scope;
  });
  return found == all_.end() ? nullptr : &*found;
}

std::vector<const RtlSignalView*> rom_memories(const RtlSignals& signals) {
  std::vector<const RtlSignalView*> memories;
  for (const char* name : {"table_words", "table_increments"}) {
    for (const RtlSignalView& signal : signals.all()) {  // banks in order
      if (signal.name == name) memories.push_back(&signal);
    }
  }
  // Lane after lane of a wide datapath.
  const auto datapath_of = [](const RtlSignalView* memory) {
    const std::string_view scope = memory->scope;
    const std::size_t lane = scope.find(".lane[");
    return lane == scope.npos ? std::string_view() : scope.substr(0, scope.find(']', lane));
  };
  std::stable_sort(memories.begin(), memories.end(),
                   [&](const RtlSignalView* a, const RtlSignalView* b) {
                     return datapath_of(a) < datapath_of(b);
                   });
  return memories;
}

std::optional<RtlRegister> RtlRegister::find(const RtlSignals& signals,
                                             const DatapathSignal& signal) {
  RtlRegister found;
  const std::string& name = signal.packed.empty() ? signal.name : signal.packed;
  std::string scope = signal.block();
  found.view_ = signals.find(scope, name);
  // What is packed with others stands in a block around them.
  while (found.view_ == nullptr && !signal.packed.empty() &&
         scope.rfind('.') != std::string::npos) {
    scope.resize(scope.rfind('.'));
    found.view_ = signals.find(scope, name);
  }
  found.lsb_ = signal.rtl_lsb;
  found.width_ = signal.width;
  found.is_signed_ = signal.is_signed;
  if (found.view_ == nullptr || found.view_->width < found.lsb_ + found.width_) return {};
  return found;
}

std::int64_t RtlRegister::value() const {
  const auto bits = static_cast<std::int64_t>(view_->bits(lsb_, width_));
  return is_signed_ ? wrap_to(bits, width_) : bits;
}

}  // namespace phongpipe
