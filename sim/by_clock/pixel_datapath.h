// pixel_datapath, clock by clock: a ClockedDatapath, the model's or the RTL's, between two queues.
#pragma once

#include <deque>

#include "sim/clocked_fifo.h"
#include "sim/datapath_blocks.h"
#include "sim/datapath_driver.h"
#include "sim/frame_context.h"

namespace phongpipe::by_clock {

class PixelDatapath : public sc_core::sc_module {
 public:
  PixelDatapath(const sc_core::sc_module_name& name, FrameContext& context, sc_core::sc_clock& clk,
                ClockedFifo<Span>& spans, ClockedFifo<DepthPixels>& pixels,
                ClockedDatapath& datapath)
      : sc_core::sc_module(name),
        context_(context),
        spans_(spans),
        pixels_(pixels),
        driver_(context.frame, datapath),
        blocks_(context.frame.configuration) {
    SC_METHOD(clock);
    sensitive << clk.posedge_event();
    dont_initialize();
  }
  SC_HAS_PROCESS(PixelDatapath);

  std::int64_t in_flight() const { return driver_.pixels_in_flight(); }
  std::string in_flight_text() const { return driver_.in_flight_text(); }
  std::uint64_t moved() const { return moved_; }
  std::string misbehaviour(std::int64_t patience_clocks) const {
    return driver_.misbehaviour(patience_clocks);
  }
  PixelOperations operations() const { return blocks_.operations(); }

 private:
  void clock() {
    const Cycle cycle = cycle_++;
    const DatapathDriver::Outcome outcome =
        driver_.clock(spans_.empty() ? nullptr : &spans_.front(), !pixels_.full());
    tell_state(outcome);
    if (outcome.span_taken) {
      in_flight_.push_back(spans_.front());
      blocks_.shade(spans_.front());
      spans_.pop();
    }
    if (outcome.pixel_taken) deliver(outcome.outputs, cycle);
    if (outcome.loading) ++context_.result.rom_load_cycles;
    context_.result.datapath_busy_cycles = driver_.busy_clocks();
    if (outcome.span_taken || outcome.pixel_taken || outcome.loading) ++moved_;
  }

  // Busy is a datapath with a pixel for as many clocks as it takes from one to the next.
  void tell_state(const DatapathDriver::Outcome& outcome) {
    const bool has_work = !spans_.empty() || driver_.pixels_in_flight() > 0;
    busy_ = outcome.pixel_taken ? context_.frame.configuration.interval_cycles()
                                : std::max(0, busy_ - 1);
    const bool busy = outcome.pixel_taken || (has_work && busy_ > 0);
    const ModuleState state = outcome.loading      ? ModuleState::loading
                              : outcome.pixel_held ? ModuleState::stalled
                              : busy               ? ModuleState::busy
                              : has_work           ? ModuleState::filling
                                                   : ModuleState::waiting;
    context_.tell(Module::pixel_datapath, state,
                  in_flight_.empty() ? 0 : in_flight_.front().triangle, spans_.size());
  }

  void deliver(const DatapathOutputs& outputs, Cycle cycle) {
    for (int i = 0; i < outputs.pixels(); ++i) context_.record(outputs[i], cycle);
    if (in_flight_.empty()) return;  // the pixels belong to no span; the comparison reports it
    const Span& span = in_flight_.front();
    DepthPixels pixels;
    pixels.triangle = span.triangle;
    pixels.first_pass = span.first_pass;
    while (pixels.count < outputs.pixels() && delivered_ < span.row.length) {
      const auto i = static_cast<std::size_t>(pixels.count);
      pixels.pixel[i] = outputs[pixels.count];
      pixels.depth[i] = phongpipe::Framebuffer::depth(context_.frame, span, delivered_++);
      ++pixels.count;
    }
    pixels_.push(pixels);
    if (delivered_ == span.row.length) {
      in_flight_.pop_front();
      delivered_ = 0;
    }
  }

  FrameContext& context_;
  ClockedFifo<Span>& spans_;
  ClockedFifo<DepthPixels>& pixels_;
  DatapathDriver driver_;
  DatapathBlocks blocks_;
  Cycle cycle_ = 0;
  int busy_ = 0;                // clocks left of the pixel that was delivered last
  std::deque<Span> in_flight_;  // spans whose pixels are in the datapath
  int delivered_ = 0;           // pixels delivered of the first span in flight
  std::uint64_t moved_ = 0;
};

}  // namespace phongpipe::by_clock
