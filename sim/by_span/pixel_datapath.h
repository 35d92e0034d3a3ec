// pixel_datapath, span by span: the model's values, and the time of each pixel in closed form.
#pragma once

#include "model/fixed/pixel_datapath.h"
#include "sim/by_span/framebuffer.h"
#include "sim/datapath_blocks.h"
#include "sim/pixel_timing.h"

namespace phongpipe::by_span {

class PixelDatapath : public sc_core::sc_module {
 public:
  PixelDatapath(const sc_core::sc_module_name& name, FrameContext& context,
                TimestampedFifo<Span>& spans, Framebuffer& framebuffer)
      : sc_core::sc_module(name),
        context_(context),
        spans_(spans),
        framebuffer_(framebuffer),
        blocks_(context.frame.configuration),
        values_(context.frame.configuration, best_evaluation(), context.frame.cue_color),
        timing_(context.frame.configuration, context.configuration.pixel_fifo),
        lanes_(static_cast<std::size_t>(context.frame.configuration.lanes())) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(PixelDatapath);

 private:
  void run();
  bool needs_table(const Span& span) const { return span.highlight && span.table != loaded_; }
  // Empties the datapath and loads the table; returns the cycle from which the span may enter.
  Cycle load_table(std::uint32_t table, Cycle asked);
  // Shades the waiting spans that are contiguous in the queue and whose table is loaded; returns
  // their number, at least 1.
  std::size_t shade_waiting();
  // Times the next `length` pixels, of which the first may enter from cycle `asked`. `cycles` is
  // input and output: the cycles that each group of pixels side by side occupies the framebuffer,
  // then the cycle in which each pixel leaves the datapath. Returns the cycle in which their span
  // is taken.
  Cycle time_pixels(Cycle asked, std::size_t length, Cycle* cycles);

  FrameContext& context_;
  TimestampedFifo<Span>& spans_;
  Framebuffer& framebuffer_;
  DatapathBlocks blocks_;
  phongpipe::PixelDatapath values_;
  PixelTiming timing_;
  std::size_t lanes_;
  std::uint32_t loaded_ = ~std::uint32_t{0};
  // Of the pixels of the spans shaded last.
  std::vector<std::uint32_t> colors_;
  std::vector<Cycle> cycles_;
  std::vector<ShadedPixel> pixels_;
};

}  // namespace phongpipe::by_span
