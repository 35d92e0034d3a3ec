// framebuffer, span by span: takes pixels, and tells the cycles that they occupy it.
#pragma once

#include "sim/frame_context.h"

namespace phongpipe::by_span {

class Framebuffer : public sc_core::sc_module {
 public:
  Framebuffer(const sc_core::sc_module_name& name, FrameContext& context)
      : sc_core::sc_module(name), context_(context), memory_(context.frame) {
    if (context.frame.depth_test) depth_test_ = std::make_unique<DatapathBlock>("depth_test");
  }

  // Takes `count` pixels that leave the datapath together, of which the first is number `i` of the
  // span; returns their cycles. A pixel outside the image is dropped.
  Cycle take(const Span& span, int i, int count, const DatapathOutputs& outputs) {
    Cycle slowest = 0;
    for (int k = 0; k < count; ++k) {
      const auto& [x, y, color] = outputs[k];
      bool taken = false;
      if (memory_.contains(x, y)) {
        count_test(span, 1);
        taken = take(span, i + k, x, y, color);
      }
      slowest = std::max(slowest, context_.framebuffer_cycles(span.first_pass, taken));
    }
    return next(slowest, count);
  }
  // Takes all pixels of a span, of which `lanes` leave the datapath together; writes the cycles of
  // each of these groups.
  void take(const Span& span, int lanes, const std::uint32_t* colors, Cycle* cycles) {
    count_test(span, static_cast<std::size_t>(span.row.length));
    for (int i = 0; i < span.row.length; i += lanes) {
      const int count = std::min(lanes, span.row.length - i);
      Cycle slowest = 0;
      for (int k = i; k < i + count; ++k) {
        const bool taken = take(span, k, span.row.x + k, span.row.y, colors[k]);
        slowest = std::max(slowest, context_.framebuffer_cycles(span.first_pass, taken));
      }
      *cycles++ = next(slowest, count);
    }
  }

  void prefetch(const Span& span) const { memory_.prefetch(span.row); }

  phongpipe::Framebuffer take_memory() {
    if (depth_test_) context_.result.depth_additions = depth_test_->operations.additions;
    return std::move(memory_);
  }

 private:
  bool take(const Span& span, int i, int x, int y, std::uint32_t color) {
    const std::uint32_t depth = phongpipe::Framebuffer::depth(context_.frame, span, i);
    return memory_.take(span.first_pass, x, y, depth, span.triangle, color);
  }
  Cycle next(Cycle cycles, int pixels) {
    const std::uint32_t first = stream_index_;
    stream_index_ += static_cast<std::uint32_t>(pixels);
    return context_.with_stalls(cycles, first);
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
