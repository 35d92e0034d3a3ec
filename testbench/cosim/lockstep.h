// Finds the register at which RTL first differs from the model: both run on the same inputs, clock
// by clock, and their registers are compared.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sim/pipeline.h"
#include "sim/signals/datapath_signals.h"
#include "testbench/cosim/divergence.h"
#include "testbench/rtl/rtl_signals.h"

namespace phongpipe {

// Stands in for the RTL where a simulation runs clock by clock.
class Lockstep : public ClockedDatapath {
 public:
  // `rtl`: built with signals. `stream_index`: the first pixel that differs, if known; what
  // differed only in spans long before it is no cause of it.
  Lockstep(const DatapathConfiguration& configuration, const OutputColor& cue_color,
           RtlDatapath& rtl, std::optional<std::uint64_t> stream_index);

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

  // Whether enough is known: something differs, and the pixel that does has been delivered.
  bool complete() const;
  // The earliest difference of the pixel that differs, if there is one and it is known.
  std::optional<SignalDivergence> found_in_pixel() const;
  // The earliest difference; of several in one clock, the one in the earliest stage.
  std::optional<SignalDivergence> found() const;

 private:
  struct Register {
    DatapathSignal signal;
    RtlRegister rtl;
  };
  // The pixel of the stream that a stage holds, or will hold next, in the model.
  std::uint64_t pixel_in(int stage) const;
  void compare_registers();
  void compare_table();
  void compare_outputs(const DatapathOutputs& rtl, const DatapathOutputs& model);
  void differs(std::uint64_t pixel, SignalDivergence difference);
  void begin_span(int length);

  DatapathConfiguration configuration_;
  DatapathRegisters model_;
  RtlDatapath& rtl_;
  RtlSignals signals_;
  std::vector<Register> registers_;
  std::optional<std::uint64_t> stream_index_;
  std::uint64_t span_begin_ = 0, span_end_ = 0;  // pixels of the stream, of the span taken last
  std::uint64_t delivered_ = 0;                  // by the model
  // Clocks until the RTL's table is complete, after its last word was written; 0: it was compared.
  int table_settles_ = 0;
  std::int64_t cycle_ = 0;
  // What differed first of each pixel, from the span before the last on.
  std::uint64_t kept_from_ = 0;
  std::map<std::uint64_t, SignalDivergence> differences_;
};

// Simulates in lockstep with the model, in a child process: if `pixel` is known, its span alone,
// and the frame from its beginning where the cause lies before this span. `make_rtl`: creates the
// RTL, which was built with signals. `options`: those of the simulation that differed.
//
// The cycle is the frame's. A register that waits in the frame may differ some cycles earlier.
std::optional<SignalDivergence> find_signal_divergence(
    const FrameSetup& frame, const PipelineConfiguration& pipeline,
    const SimulationOptions& options, const std::function<std::unique_ptr<RtlDatapath>()>& make_rtl,
    const std::optional<Divergence>& pixel);

}  // namespace phongpipe
