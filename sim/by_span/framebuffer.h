// framebuffer, span by span: takes pixels, and returns the cycles that each occupies it.
#pragma once

#include "sim/frame_context.h"

namespace phongpipe::by_span {

class Framebuffer : public sc_core::sc_module {
 public:
  Framebuffer(const sc_core::sc_module_name& name, FrameContext& context)
      : sc_core::sc_module(name), context_(context), memory_(context.frame) {
    if (context.frame.depth_test) depth_test_ = std::make_unique<DatapathBlock>("depth_test");
  }

  // Takes the next pixel of the stream; returns its cycles.
  Cycle take(const Span& span, int i, const ShadedPixel& pixel) {
    count_test(span, 1);
    return take(span, i, pixel.x, pixel.y, pixel.color);
  }
  // The same for each pixel of a span.
  void take(const Span& span, const std::uint32_t* colors, Cycle* cycles) {
    count_test(span, static_cast<std::size_t>(span.row.length));
    for (int i = 0; i < span.row.length; ++i) {
      cycles[i] = take(span, i, span.row.x + i, span.row.y, colors[i]);
    }
  }

  bool contains(int x, int y) const { return memory_.contains(x, y); }
  void prefetch(const Span& span) const { memory_.prefetch(span.row); }

  phongpipe::Framebuffer take_memory() {
    if (depth_test_) context_.result.depth_additions = depth_test_->operations.additions;
    return std::move(memory_);
  }

 private:
  Cycle take(const Span& span, int i, int x, int y, std::uint32_t color) {
    const std::uint32_t depth = phongpipe::Framebuffer::depth(context_.frame, span, i);
    const bool taken = memory_.take(span.first_pass, x, y, depth, span.triangle, color);
    return context_.framebuffer_cycles(span.first_pass, taken, stream_index_++);
  }
  void count_test(const Span& span, std::size_t pixels) {
    if (depth_test_ && span.first_pass) depth_test_->operations.additions += pixels;
  }

  std::unique_ptr<DatapathBlock> depth_test_;  // steps depth; null without depth test
  FrameContext& context_;
  phongpipe::Framebuffer memory_;
  std::uint32_t stream_index_ = 0;
};

}  // namespace phongpipe::by_span
