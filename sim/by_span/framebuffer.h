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
    const std::uint32_t depth = phongpipe::Framebuffer::depth(context_.frame, span, i);
    const bool written = memory_.write(pixel.x, pixel.y, depth, pixel.color);
    return context_.framebuffer_cycles(written, place_++);
  }
  // The same for each pixel of a span.
  void take(const Span& span, const std::uint32_t* colors, Cycle* cycles) {
    const auto length = static_cast<std::size_t>(span.row.length);
    written_.resize(std::max(written_.size(), length));
    memory_.write_span(context_.frame, span, colors, written_.data());
    for (std::size_t i = 0; i < length; ++i) {
      cycles[i] = context_.framebuffer_cycles(written_[i] != 0, place_++);
    }
  }

  phongpipe::Framebuffer take_memory() { return std::move(memory_); }

 private:
  FrameContext& context_;
  phongpipe::Framebuffer memory_;
  std::uint32_t place_ = 0;
  std::vector<std::uint8_t> written_;
};

}  // namespace phongpipe::by_span
