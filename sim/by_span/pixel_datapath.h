// pixel_datapath by the span: the model's values, and the time of each pixel in closed form.
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
        timing_(context.frame.configuration.latency_cycles(), context.configuration.pixel_fifo) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(PixelDatapath);

 private:
  void run();
  // Empties the datapath and loads the table; the cycle from which the span may enter.
  Cycle load_table(std::uint32_t table, Cycle asked);

  FrameContext& context_;
  TimestampedFifo<Span>& spans_;
  Framebuffer& framebuffer_;
  DatapathBlocks blocks_;
  phongpipe::PixelDatapath values_;
  PixelTiming timing_;
  std::uint32_t loaded_ = ~std::uint32_t{0};
};

}  // namespace phongpipe::by_span
