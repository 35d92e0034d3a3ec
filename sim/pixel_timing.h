// Time of single pixels between the entrance of pixel_datapath and the framebuffer, in closed form.
//
// A pixel enters in cycle `in`, leaves the datapath in `out`, and is read by the framebuffer in
// `read`. The datapath holds kDatapathLatency pixels, the queue behind it `depth`:
//   in(j)   = max(asked, in(j−1) + 1, out(j − kDatapathLatency))
//   out(j)  = max(in(j) + kDatapathLatency, out(j−1) + 1, read(j − depth) + 1)
//   read(j) = max(out(j) + 1, read(j−1) + cost(j−1))
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "model/fixed/constants.h"
#include "sim/timestamped_fifo.h"

namespace phongpipe {

class PixelTiming {
 public:
  explicit PixelTiming(int depth) : read_(static_cast<std::size_t>(depth), -1) { out_.fill(-1); }

  // The next pixel, which may enter from cycle `asked` and takes the framebuffer `cost` cycles.
  void next(Cycle asked, Cycle cost) {
    in_ = std::max({asked, in_ + 1, out_[out_place_]});
    last_out_ = std::max({in_ + kDatapathLatency, last_out_ + 1, place_free_from()});
    out_[out_place_] = last_out_;
    out_place_ = (out_place_ + 1) % out_.size();
    read(last_out_, cost);
  }

  // The framebuffer's part alone: a pixel that left the datapath in cycle `out`.
  void read(Cycle out, Cycle cost) {
    const Cycle read = std::max(out + 1, free_from_);
    read_[read_place_] = read;
    if (++read_place_ == read_.size()) read_place_ = 0;
    free_from_ = read + cost;
  }

  // The first cycle in which the queue before the framebuffer has a place for the next pixel.
  Cycle place_free_from() const { return read_[read_place_] + 1; }

  Cycle in() const { return in_; }
  Cycle out() const { return last_out_; }
  Cycle end() const { return free_from_; }  // the framebuffer is done with all pixels so far

 private:
  Cycle in_ = -1, last_out_ = -1, free_from_ = 0;
  std::array<Cycle, kDatapathLatency> out_;
  std::size_t out_place_ = 0;
  std::vector<Cycle> read_;
  std::size_t read_place_ = 0;
};

}  // namespace phongpipe
