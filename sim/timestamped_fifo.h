// A bounded queue between modules that run ahead of the kernel's clock (temporal decoupling).
//
// Every item carries the cycle it was written in, and every place the cycle it was read in, so that
// the cycles come out as in a clocked queue: an item is seen from the cycle after its writing, a
// place can be used again from the cycle after its reading. Modules only wait for each other when
// there is no item, or no place, at all.
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
      : sc_core::sc_prim_channel(name), places_(static_cast<std::size_t>(depth)) {}

  // Writes no earlier than `earliest`; returns the cycle of the writing. Waits for a place.
  Cycle write(T item, Cycle earliest) {
    while (size_ == places_.size()) wait_for(read_event_, writer_waits_);
    Place& place = places_[(first_ + size_) % places_.size()];
    place.item = std::move(item);
    place.written_at = std::max(earliest, place.read_at + 1);
    ++size_;
    wake(written_event_, reader_waits_);
    return place.written_at;
  }

  // No more items will come.
  void close() {
    closed_ = true;
    wake(written_event_, reader_waits_);
  }

  // Waits for an item; false where there will be none.
  bool wait_for_item() {
    while (size_ == 0 && !closed_) wait_for(written_event_, reader_waits_);
    return size_ > 0;
  }
  // The front item stays where it is until another one is written to its place, that is, as long as
  // its reader does not wait.
  const T& front() const { return places_[first_].item; }
  Cycle front_seen_from() const { return places_[first_].written_at + 1; }

  // Takes the front item in the given cycle.
  void pop(Cycle cycle) {
    places_[first_].read_at = cycle;
    first_ = (first_ + 1) % places_.size();
    --size_;
    wake(read_event_, writer_waits_);
  }

  std::size_t size() const { return size_; }
  std::size_t depth() const { return places_.size(); }

 private:
  void wait_for(const sc_core::sc_event& event, bool& waiting) {
    waiting = true;
    wait(event);
  }
  // A notification nobody waits for would cost the kernel as much as one that somebody does.
  static void wake(sc_core::sc_event& event, bool& waiting) {
    if (waiting) event.notify(sc_core::SC_ZERO_TIME);
    waiting = false;
  }

  struct Place {
    T item{};
    Cycle written_at = -1;
    Cycle read_at = -1;  // of the item before
  };
  std::vector<Place> places_;
  std::size_t first_ = 0, size_ = 0;
  bool closed_ = false;
  bool writer_waits_ = false, reader_waits_ = false;
  sc_core::sc_event written_event_, read_event_;
};

}  // namespace phongpipe
