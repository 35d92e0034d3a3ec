// framebuffer by the span: takes pixels as they come and says how long each keeps it busy.
#pragma once

#include "sim/frame_context.h"

namespace phongpipe::by_span {

class Framebuffer : public sc_core::sc_module {
 public:
  Framebuffer(const sc_core::sc_module_name& name, FrameContext& context)
      : sc_core::sc_module(name), context_(context), memory_(context.frame) {}

  // The cycles the next pixel of the stream takes.
  Cycle take(const Span& span, int i, const ShadedPixel& pixel) {
    const bool written = memory_.write(
        pixel, phongpipe::Framebuffer::depth(context_.frame, span, i), place_);
    return context_.framebuffer_cycles(written, place_++);
  }

  phongpipe::Framebuffer take_memory() { return std::move(memory_); }

 private:
  FrameContext& context_;
  phongpipe::Framebuffer memory_;
  std::uint32_t place_ = 0;
};

}  // namespace phongpipe::by_span
