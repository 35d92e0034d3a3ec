// Time of single pixels between the entrance of pixel_datapath and the framebuffer, in closed form.
//
// A pixel enters in cycle `in`, leaves the datapath in `out`, and is read by the framebuffer in
// `read`. The datapath holds as many pixels as its latency, the queue behind it `depth`:
//   in(j)   = max(asked, in(j−1) + 1, out(j − latency))
//   out(j)  = max(in(j) + latency, out(j−1) + 1, read(j − depth) + 1)
//   read(j) = max(out(j) + 1, read(j−1) + cost(j−1))
#pragma once

#include <algorithm>
#include <vector>

#include "sim/timestamped_fifo.h"

namespace phongpipe {

class PixelTiming {
 public:
  PixelTiming(int latency, int depth)
      : latency_(latency),
        out_(static_cast<std::size_t>(latency), -1),
        read_(static_cast<std::size_t>(depth), -1) {}

  // The next `count` pixels, the first of which may enter from cycle `asked`. `cycles` holds what
  // each takes the framebuffer, and is overwritten by the cycle each leaves in. Returns the cycle
  // the first one enters in.
  Cycle next(Cycle asked, std::size_t count, Cycle* cycles) {
    // What cycles[i] may alias, as far as the compiler can tell, is kept in locals meanwhile.
    Cycle in = in_, last_out = last_out_, free_from = free_from_, taken = 0;
    std::size_t slot = read_slot_, out_slot = out_slot_;
    Cycle* const reads = read_.data();
    Cycle* const out = out_.data();
    const std::size_t depth = read_.size(), held = out_.size();
    const Cycle latency = latency_;
    for (std::size_t i = 0; i < count; ++i) {
      in = std::max({asked, in + 1, out[out_slot]});
      if (i == 0) taken = in;
      last_out = std::max({in + latency, last_out + 1, reads[slot] + 1});
      out[out_slot] = last_out;
      if (++out_slot == held) out_slot = 0;
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

  // The framebuffer's part alone: a pixel that left the datapath in cycle `out`.
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
  Cycle in_ = -1, last_out_ = -1, free_from_ = 0;
  Cycle latency_;
  std::vector<Cycle> out_;    // of the last pixels
  std::size_t out_slot_ = 0;  // of the earliest of them
  std::vector<Cycle> read_;
  std::size_t read_slot_ = 0;
};

}  // namespace phongpipe
