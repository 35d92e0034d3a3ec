// pixel_datapath by the span: the model's values, and the time of each pixel in closed form.
#pragma once

#include "model/fixed/pixel_datapath.h"
#include "sim/by_span/framebuffer.h"
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
        values_(context.frame.configuration),
        timing_(context.configuration.pixel_fifo) {
    SC_THREAD(run);
  }
  SC_HAS_PROCESS(PixelDatapath);

 private:
  void run();
  // Empties the datapath and loads the table; the cycle from which the span may enter.
  Cycle load_material(std::uint32_t material, Cycle asked);

  FrameContext& context_;
  TimestampedFifo<Span>& spans_;
  Framebuffer& framebuffer_;
  phongpipe::PixelDatapath values_;
  PixelTiming timing_;
  std::uint32_t loaded_ = ~std::uint32_t{0};
};

}  // namespace phongpipe::by_span
