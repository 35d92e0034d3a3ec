// A bounded queue between modules that run ahead of the kernel's clock (temporal decoupling).
//
// Every item carries the cycle it was written in, and every place the cycle it was read in, so that
// the cycles come out as in a clocked queue: an item is seen from the cycle after its writing, a
// place can be used again from the cycle after its reading. Modules only wait for each other when
// there is no item, or no place, at all.
#pragma once

#include <cstdint>
#include <deque>
#include <systemc>
#include <vector>

namespace phongpipe {

using Cycle = std::int64_t;

template <typename T>
class TimestampedFifo : public sc_core::sc_prim_channel {
 public:
  TimestampedFifo(const char* name, int depth)
      : sc_core::sc_prim_channel(name), read_at_(static_cast<std::size_t>(depth), -1) {}

  // Writes no earlier than `earliest`; returns the cycle of the writing. Waits for a place.
  Cycle write(T item, Cycle earliest) {
    while (items_.size() == read_at_.size()) wait(read_event_);
    const Cycle cycle = std::max(earliest, read_at_[written_ % read_at_.size()] + 1);
    ++written_;
    items_.push_back({std::move(item), cycle});
    written_event_.notify(sc_core::SC_ZERO_TIME);
    return cycle;
  }

  // No more items will come.
  void close() {
    closed_ = true;
    written_event_.notify(sc_core::SC_ZERO_TIME);
  }

  // Waits for an item; false where there will be none.
  bool wait_for_item() {
    while (items_.empty() && !closed_) wait(written_event_);
    return !items_.empty();
  }
  const T& front() const { return items_.front().item; }
  Cycle front_seen_from() const { return items_.front().written_at + 1; }

  // Takes the front item in the given cycle.
  T pop(Cycle cycle) {
    T item = std::move(items_.front().item);
    items_.pop_front();
    read_at_[read_ % read_at_.size()] = cycle;
    ++read_;
    read_event_.notify(sc_core::SC_ZERO_TIME);
    return item;
  }

  std::size_t size() const { return items_.size(); }
  std::size_t depth() const { return read_at_.size(); }

 private:
  struct Entry {
    T item;
    Cycle written_at;
  };
  std::deque<Entry> items_;
  std::vector<Cycle> read_at_;  // of the item `depth` before, in the place of each
  std::uint64_t written_ = 0, read_ = 0;
  bool closed_ = false;
  sc_core::sc_event written_event_, read_event_;
};

}  // namespace phongpipe
