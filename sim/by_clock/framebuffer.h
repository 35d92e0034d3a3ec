// framebuffer by the clock.
#pragma once

#include "sim/clocked_fifo.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class Framebuffer : public sc_core::sc_module {
 public:
  Framebuffer(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
              ClockedFifo<DepthPixel>& pixels)
      : sc_core::sc_module(name), context_(context), pixels_(pixels), memory_(context.frame) {
    SC_METHOD(clock);
    sensitive << clk.posedge_event();
    dont_initialize();
  }
  SC_HAS_PROCESS(Framebuffer);

  phongpipe::Framebuffer take_memory() { return std::move(memory_); }
  bool busy() const { return busy_ > 0; }
  std::uint64_t moved() const { return place_; }

 private:
  void clock() {
    const Cycle cycle = cycle_++;
    if (busy_ > 0) --busy_;
    if (busy_ > 0 || pixels_.empty()) return;
    const DepthPixel& pixel = pixels_.front();
    // A wrong place must not write outside the image; the comparison of streams will tell it.
    const bool inside =
        pixel.pixel.x < context_.frame.width && pixel.pixel.y < context_.frame.height;
    const bool written =
        inside && memory_.write(pixel.pixel.x, pixel.pixel.y, pixel.depth, pixel.pixel.color);
    busy_ = context_.framebuffer_cycles(written, place_++);
    context_.result.frame_cycles = cycle + busy_;
    pixels_.pop();
  }

  FrameContext& context_;
  ClockedFifo<DepthPixel>& pixels_;
  phongpipe::Framebuffer memory_;
  Cycle cycle_ = 0, busy_ = 0;
  std::uint32_t place_ = 0;
};

}  // namespace phongpipe::by_clock
