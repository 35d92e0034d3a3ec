// Time of each pixel between the entrance of pixel_datapath and the framebuffer, in closed form.
//
// A pixel enters in cycle `in`, leaves the datapath in `out`, and is read by the framebuffer in
// `read`. It may enter from cycle `asked`, `interval` cycles after the one before, and occupies the
// framebuffer for `cost` cycles. The datapath has a queue of `slots` pixels, the framebuffer one of
// `depth` pixels:
//   next(j) = max(asked, in(j−1) + interval)
//   in(j)   = next(j) if that is in(j−1) + 1 and not before out(j − slots − 1) + 2,
//             else max(next(j), out(j − slots) + 2)
//   out(j)  = max(in(j) + latency, out(j−1) + 1, read(j − depth) + 1)
//   read(j) = max(out(j) + 1, read(j−1) + cost(j−1))
// Pixels that a wide datapath delivers together are one pixel here. A span of it passes kLaneStages
// stages, of which the last one waits for the lanes, and all others with it; so a span is taken in
// the first cycle from `asked` on in which none waits, and waits with those before it, each from
// its arrival at the last stage until its first pixel enters.
//
// A slot is free 2 cycles after its pixel left. A pixel that entered in the cycle before is not
// counted yet; what is one too many waits at the output of the queue.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "model/fixed/datapath_configuration.h"
#include "sim/timestamped_fifo.h"

namespace phongpipe {

class PixelTiming {
 public:
  PixelTiming(const DatapathConfiguration& datapath, int depth)
      : in_(-datapath.interval_cycles()),
        interval_(datapath.interval_cycles()),
        latency_(datapath.latency_cycles() - datapath.lane_stages()),
        is_wide_(datapath.lanes() > 1),
        out_(static_cast<std::size_t>(kPixelQueueSlots) + 1, -kSlotFree),
        read_(static_cast<std::size_t>(depth), -1) {}

  // Times the next `count` pixels, of which the first may enter from cycle `asked`. `cycles` is
  // input and output: the cycles each pixel occupies the framebuffer, then the cycle in which it
  // leaves the datapath. Returns the cycle in which their span is taken.
  Cycle next(Cycle asked, std::size_t count, Cycle* cycles) {
    if (!is_wide_) return enter(asked, count, cycles);
    span_taken_ = std::max(asked, span_taken_ + 1);
    for (const Wait& wait : waits_) {  // the earliest first
      if (wait.arrived <= span_taken_ && span_taken_ < wait.entered) span_taken_ = wait.entered;
    }
    Cycle arrived = span_taken_ + kLaneStages;
    for (const Wait& wait : waits_) {
      if (wait.entered > span_taken_) arrived += wait.entered - wait.arrived;
    }
    std::rotate(waits_.begin(), waits_.begin() + 1, waits_.end());
    waits_.back() = {arrived, enter(arrived, count, cycles)};
    return span_taken_;
  }

  // Times the framebuffer alone, for a pixel that left the datapath in cycle `out`.
  void read(Cycle out, Cycle cost) {
    const Cycle read = std::max(out + 1, free_from_);
    read_[read_slot_] = read;
    if (++read_slot_ == read_.size()) read_slot_ = 0;
    free_from_ = read + cost;
  }

  // The first cycle in which the queue before the framebuffer has a slot for the next pixel.
  Cycle slot_free_from() const { return read_[read_slot_] + 1; }

  Cycle out() const { return last_out_; }
  Cycle end() const { return free_from_; }  // the framebuffer is done with all pixels so far

 private:
  static constexpr Cycle kSlotFree = 2;  // cycles after its pixel left

  // As next(); returns the cycle in which the first pixel enters.
  Cycle enter(Cycle asked, std::size_t count, Cycle* cycles) {
    if (unhindered() &&
        std::count(cycles, cycles + count, Cycle{1}) == static_cast<std::ptrdiff_t>(count)) {
      return next_unhindered(asked, count, cycles);
    }
    // Local copies, because for all the compiler knows cycles[i] may alias the members.
    Cycle in = in_, last_out = last_out_, free_from = free_from_, taken = 0;
    std::size_t slot = read_slot_, out_slot = out_slot_;
    Cycle* const reads = read_.data();
    Cycle* const out = out_.data();
    const std::size_t depth = read_.size(), held = out_.size();
    const Cycle latency = latency_, interval = interval_;
    for (std::size_t i = 0; i < count; ++i) {
      const Cycle next = std::max(asked, in + interval);
      const std::size_t after = out_slot + 1 == held ? 0 : out_slot + 1;
      const bool follows = next == in + 1 && out[out_slot] + kSlotFree <= next;
      in = follows ? next : std::max(next, out[after] + kSlotFree);
      if (i == 0) taken = in;
      last_out = std::max({in + latency, last_out + 1, reads[slot] + 1});
      out[out_slot] = last_out;
      out_slot = after;
      reads[slot] = std::max(last_out + 1, free_from);
      free_from = reads[slot] + cycles[i];
      if (++slot == depth) slot = 0;
      cycles[i] = last_out;
    }
    in_ = in;
    last_out_ = last_out;
    free_from_ = free_from;
    read_slot_ = slot;
    out_slot_ = out_slot;
    return taken;
  }

  // Whether the last pixel went through without waiting and occupied the framebuffer for 1 cycle.
  // Nothing before it can then delay a later pixel that enters in order. For out grows by at least
  // 1 a pixel, by `interval` where nothing waits, and in by at least `interval`:
  //   out(j − slots) + 2 ≤ out(j−1) − slots + 3 = in(j−1) + latency − slots + 3 ≤ in(j−1) +
  //   interval
  // as latency − interval ≤ slots − 3 for every kind of datapath; and, where depth ≥ 2,
  //   read(j − depth) + 1 ≤ read(j−1) = out(j−1) + 1.
  // The same holds for all j after it, so that the earlier values kept in `out_` and `read_` need
  // not be replaced.
  bool unhindered() const {
    return read_.size() >= 2 && last_out_ == in_ + latency_ && free_from_ == last_out_ + 2;
  }
  // next(), if unhindered() and if each pixel occupies the framebuffer for 1 cycle.
  Cycle next_unhindered(Cycle asked, std::size_t count, Cycle* cycles) {
    const Cycle first = std::max(asked, in_ + interval_);
    for (std::size_t i = 0; i < count; ++i) {
      cycles[i] = first + latency_ + static_cast<Cycle>(i) * interval_;
    }
    in_ = first + (static_cast<Cycle>(count) - 1) * interval_;
    last_out_ = in_ + latency_;
    free_from_ = last_out_ + 2;
    return first;
  }

  Cycle in_, last_out_ = -1, free_from_ = 0;
  Cycle interval_, latency_;
  bool is_wide_;
  Cycle span_taken_ = -1;
  struct Wait {
    Cycle arrived = 0, entered = 0;  // at the last stage before the lanes, in the lanes
  };
  std::array<Wait, kLaneStages> waits_;  // of the last spans
  std::vector<Cycle> out_;               // of the last slots + 1 pixels
  std::size_t out_slot_ = 0;             // of the earliest of these
  std::vector<Cycle> read_;
  std::size_t read_slot_ = 0;
};

}  // namespace phongpipe
