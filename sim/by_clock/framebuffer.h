// framebuffer, clock by clock.
#pragma once

#include "sim/clocked_fifo.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class Framebuffer : public sc_core::sc_module {
 public:
  Framebuffer(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
              ClockedFifo<DepthPixel>& pixels)
      : sc_core::sc_module(name), context_(context), pixels_(pixels), memory_(context.frame) {
    if (context.frame.depth_test) depth_test_ = std::make_unique<DatapathBlock>("depth_test");
    SC_METHOD(clock);
    sensitive << clk.posedge_event();
    dont_initialize();
  }
  SC_HAS_PROCESS(Framebuffer);

  phongpipe::Framebuffer take_memory() {
    if (depth_test_) context_.result.depth_additions = depth_test_->operations.additions;
    return std::move(memory_);
  }
  bool busy() const { return busy_ > 0; }
  std::uint64_t moved() const { return stream_index_; }

 private:
  void clock() {
    const Cycle cycle = cycle_++;
    if (busy_ > 0) --busy_;
    if (busy_ == 0 && !pixels_.empty()) start_pixel(cycle);
    context_.tell(Module::framebuffer, busy() ? ModuleState::busy : ModuleState::waiting, triangle_,
                  pixels_.size());
  }

  void start_pixel(Cycle cycle) {
    const DepthPixel& pixel = pixels_.front();
    triangle_ = pixel.triangle;
    // A wrong coordinate must not write outside the image; the comparison of streams reports it.
    const bool inside = memory_.contains(pixel.pixel.x, pixel.pixel.y);
    busy_ = context_.framebuffer_cycles(pixel.first_pass, inside && take(pixel), stream_index_++);
    context_.result.frame_cycles = cycle + busy_;
    pixels_.pop();
  }

  bool take(const DepthPixel& pixel) {
    if (depth_test_ && pixel.first_pass) ++depth_test_->operations.additions;
    const auto& [x, y, color] = pixel.pixel;
    return memory_.take(pixel.first_pass, x, y, pixel.depth, pixel.triangle, color);
  }

  FrameContext& context_;
  ClockedFifo<DepthPixel>& pixels_;
  phongpipe::Framebuffer memory_;
  std::unique_ptr<DatapathBlock> depth_test_;  // steps depth; null without depth test
  Cycle cycle_ = 0, busy_ = 0;
  std::uint32_t triangle_ = 0;  // of the last pixel taken
  std::uint32_t stream_index_ = 0;
};

}  // namespace phongpipe::by_clock
