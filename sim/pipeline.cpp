#include "sim/pipeline.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include "sim/by_clock/watchdog.h"
#include "sim/by_span/clocked_pixel_datapath.h"
#include "sim/by_span/pixel_datapath.h"
#include "sim/by_span/setup_engine.h"
#include "sim/by_span/span_walker.h"
#include "sim/datapath_registers.h"
#include "sim/schedule.h"

namespace phongpipe {
namespace {

// The names of the modules below `objects`, in the order of elaboration.
void list_modules(const std::vector<sc_core::sc_object*>& objects,
                  std::vector<std::string>& names) {
  for (const sc_core::sc_object* object : objects) {
    if (dynamic_cast<const sc_core::sc_module*>(object) == nullptr) continue;
    names.emplace_back(object->name());
    list_modules(object->get_child_objects(), names);
  }
}

void simulate_by_span(FrameContext& context) {
  const PipelineConfiguration& configuration = context.configuration;
  TimestampedFifo<WorkHandle> triangles("triangles", configuration.triangle_fifo);
  TimestampedFifo<Span> spans("spans", configuration.span_fifo);
  by_span::SetupEngine setup_engine("setup_engine", context, triangles);
  by_span::SpanWalker span_walker("span_walker", context, triangles, spans);
  by_span::Framebuffer framebuffer("framebuffer", context);
  std::unique_ptr<sc_core::sc_module> pixel_datapath;
  if (context.options.datapath == nullptr) {
    pixel_datapath =
        std::make_unique<by_span::PixelDatapath>("pixel_datapath", context, spans, framebuffer);
  } else {
    pixel_datapath = std::make_unique<by_span::ClockedPixelDatapath>(
        "pixel_datapath", context, spans, framebuffer, *context.options.datapath);
  }
  list_modules(sc_core::sc_get_top_level_objects(), context.result.modules);
  sc_core::sc_start();
  context.result.framebuffer = framebuffer.take_memory();
}

void simulate_by_clock(FrameContext& context) {
  const PipelineConfiguration& configuration = context.configuration;
  const sc_core::sc_time period(1, sc_core::SC_NS);  // stands for one clock, whatever its length
  // The first edge comes after the initialisation, so that every module sees all of them.
  sc_core::sc_clock clk("clk", period, 0.5, period);
  ClockedFifo<WorkHandle> triangles("triangles", configuration.triangle_fifo);
  ClockedFifo<Span> spans("spans", configuration.span_fifo);
  ClockedFifo<DepthPixels> pixels("pixels", configuration.pixel_fifo);
  DatapathRegisters own_datapath(context.frame.configuration, context.frame.cue_color);
  ClockedDatapath& datapath =
      context.options.datapath != nullptr ? *context.options.datapath : own_datapath;
  by_clock::SetupEngine setup_engine("setup_engine", context, clk, triangles);
  by_clock::SpanWalker span_walker("span_walker", context, clk, triangles, spans);
  by_clock::PixelDatapath pixel_datapath("pixel_datapath", context, clk, spans, pixels, datapath);
  by_clock::Framebuffer framebuffer("framebuffer", context, clk, pixels);
  const by_clock::Watchdog watchdog(
      "watchdog", context, period,
      {setup_engine, span_walker, pixel_datapath, framebuffer, triangles, spans, pixels});
  list_modules(sc_core::sc_get_top_level_objects(), context.result.modules);
  sc_core::sc_start();
  context.result.pixel_operations = pixel_datapath.operations();
  context.result.framebuffer = framebuffer.take_memory();
  if (context.options.activity != nullptr) {
    context.options.activity->finish(context.result.frame_cycles);
  }
}

}  // namespace

int slowest_output_cycles(const PipelineConfiguration& configuration,
                          const SimulationOptions& options) {
  // A queue of one pixel takes the next one only when it is empty, see pixel_timing.h.
  const int slowest =
      std::max({configuration.framebuffer_write_cycles, configuration.framebuffer_test_cycles,
                configuration.framebuffer_add_cycles, configuration.pixel_fifo < 2 ? 2 : 1});
  return slowest + (options.stall_percent > 0 ? kMostStallCycles : 0);
}

void stop_simulation() {
  static bool stopped = false;  // one simulation a process
  if (!stopped) sc_core::sc_stop();
  stopped = true;
}

SimulationResult simulate(const FrameSetup& frame, const PipelineConfiguration& configuration,
                          const SimulationOptions& options) {
  static bool simulated = false;
  if (simulated) throw std::logic_error("SystemC elaborates once a process; simulate in a child");
  simulated = true;
  // That the simulation ends by sc_stop is no news.
  sc_core::sc_report_handler::set_actions("/OSCI/SystemC", sc_core::SC_INFO,
                                          sc_core::SC_DO_NOTHING);
  configuration.check();
  if (options.activity != nullptr && options.detail != Detail::cycle) {
    throw std::logic_error("what modules do in each clock is known by the clock only");
  }

  SimulationResult result(frame);
  FrameContext context{frame,           configuration, options,
                       FrontEnd(frame), result,        SetupTimes(configuration)};
  if (options.detail == Detail::span) {
    simulate_by_span(context);
  } else {
    simulate_by_clock(context);
  }
  for (const SetupTimes::Cost& cost : context.setup_times.known()) {
    result.setup_uses.push_back({cost.plan, cost.triangles});
  }
  return result;
}

}  // namespace phongpipe
