// A bounded queue between modules that run ahead of the kernel's clock (temporal decoupling).
//
// Every item carries the cycle in which it was written, and every slot the cycle in which it was
// read. So the cycles are those of a clocked queue: an item is visible from the cycle after its
// writing, and a slot is free from the cycle after its reading. Modules wait for each other only if
// there is no item, or no slot.
#pragma once

#include <algorithm>
#include <cstdint>
#include <systemc>
#include <vector>

namespace phongpipe {

using Cycle = std::int64_t;

template <typename T>
class TimestampedFifo : public sc_core::sc_prim_channel {
 public:
  TimestampedFifo(const char* name, int depth)
      : sc_core::sc_prim_channel(name),
        items_(static_cast<std::size_t>(depth)),
        times_(static_cast<std::size_t>(depth)) {}

  // Waits for a free slot; fill it, then call write().
  T& free_slot() {
    while (size_ == depth()) wait_for(read_event_, writer_waits_);
    return items_[free_];
  }
  // Writes the item in the free slot, in cycle `earliest` or later; returns the cycle of the
  // writing.
  Cycle write(Cycle earliest) {
    Times& times = times_[free_];
    times.written_at = std::max(earliest, times.read_at + 1);
    free_ = after(free_);
    ++size_;
    wake(written_event_, reader_waits_);
    return times.written_at;
  }
  Cycle write(T item, Cycle earliest) {
    free_slot() = std::move(item);
    return write(earliest);
  }

  // No more items will come.
  void close() {
    closed_ = true;
    wake(written_event_, reader_waits_);
  }

  // Waits for an item; false if none will come.
  bool wait_for_item() {
    while (size_ == 0 && !closed_) wait_for(written_event_, reader_waits_);
    return size_ > 0;
  }
  // The reference stays valid after pop(), until another item is written to the slot, which cannot
  // happen before the reader waits.
  const T& front() const { return items_[first_]; }
  Cycle front_seen_from() const { return times_[first_].written_at + 1; }
  // Number of items that are contiguous in memory, from the front one.
  std::size_t side_by_side() const { return std::min(size_, depth() - first_); }

  // Takes the front item in the given cycle.
  void pop(Cycle cycle) {
    times_[first_].read_at = cycle;
    first_ = after(first_);
    --size_;
    wake(read_event_, writer_waits_);
  }

  std::size_t size() const { return size_; }
  std::size_t depth() const { return items_.size(); }

 private:
  void wait_for(const sc_core::sc_event& event, bool& waiting) {
    waiting = true;
    wait(event);
  }
  // Notifies a module only if it waits: the kernel spends as much time on needless notifications.
  static void wake(sc_core::sc_event& event, bool& waiting) {
    if (waiting) event.notify(sc_core::SC_ZERO_TIME);
    waiting = false;
  }

  std::size_t after(std::size_t slot) const { return slot + 1 == depth() ? 0 : slot + 1; }

  struct Times {
    Cycle written_at = -1;
    Cycle read_at = -1;  // of the item that was in the slot before
  };
  std::vector<T> items_;
  std::vector<Times> times_;  // of the slots
  std::size_t first_ = 0, free_ = 0, size_ = 0;
  bool closed_ = false;
  bool writer_waits_ = false, reader_waits_ = false;
  sc_core::sc_event written_event_, read_event_;
};

}  // namespace phongpipe
