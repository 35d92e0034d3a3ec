// framebuffer, clock by clock.
#pragma once

#include "sim/clocked_fifo.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class Framebuffer : public sc_core::sc_module {
 public:
  Framebuffer(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
              ClockedFifo<DepthPixels>& pixels)
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
    if (busy_ == 0 && !pixels_.empty()) start_pixels(cycle);
    context_.tell(Module::framebuffer, busy() ? ModuleState::busy : ModuleState::waiting, triangle_,
                  pixels_.size());
  }

  void start_pixels(Cycle cycle) {
    const DepthPixels& pixels = pixels_.front();
    triangle_ = pixels.triangle;
    Cycle slowest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(pixels.count); ++i) {
      const Cycle cycles = context_.framebuffer_cycles(pixels.first_pass, take(pixels, i));
      slowest = std::max(slowest, cycles);
    }
    busy_ = context_.with_stalls(slowest, stream_index_);
    stream_index_ += static_cast<std::uint32_t>(pixels.count);
    context_.result.frame_cycles = cycle + busy_;
    pixels_.pop();
  }

  bool take(const DepthPixels& pixels, std::size_t i) {
    const auto& [x, y, color] = pixels.pixel[i];
    // A wrong coordinate must not write outside the image; the comparison of streams reports it.
    if (!memory_.contains(x, y)) return false;
    if (depth_test_ && pixels.first_pass) ++depth_test_->operations.additions;
    return memory_.take(pixels.first_pass, x, y, pixels.depth[i], pixels.triangle, color);
  }

  FrameContext& context_;
  ClockedFifo<DepthPixels>& pixels_;
  phongpipe::Framebuffer memory_;
  std::unique_ptr<DatapathBlock> depth_test_;  // steps depth; null without depth test
  Cycle cycle_ = 0, busy_ = 0;
  std::uint32_t triangle_ = 0;  // of the last pixel taken
  std::uint32_t stream_index_ = 0;
};

}  // namespace phongpipe::by_clock
