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

#include "model/shading/fields.h"
#include "sim/datapath_registers.h"
#include "sim/pipeline.h"
#include "testbench/rtl/rtl_signals.h"

namespace phongpipe {

// A register or an output that differs.
struct SignalDivergence {
  std::string block;   // "pixel_datapath.specular.rom"
  std::string signal;  // "address", or "table_words[7]"
  int width = 1;       // bits
  std::int64_t cycle = 0;
  std::int64_t model = 0, other = 0;  // values, with their sign if they have one

  static constexpr auto fields() {
    using S = SignalDivergence;
    return std::make_tuple(field("block", &S::block), field("signal", &S::signal),
                           field("width", &S::width), field("cycle", &S::cycle),
                           field("model", &S::model), field("other", &S::other));
  }
  std::string name() const { return block + "." + signal; }
};
// A value in hexadecimal, with the digits of `width` bits, such as 0x1f3.
std::string hex_text(std::int64_t value, int width);

// Stands in for the RTL in a simulation by the clock, which it ends when it has found what differs.
class Lockstep : public ClockedDatapath {
 public:
  // `rtl`: built with signals. `stream_index`: the first pixel that differs, if known; what
  // differed only in spans long before it is no cause of it.
  Lockstep(const DatapathConfiguration& configuration, const OutputColor& cue_color,
           RtlDatapath& rtl, std::optional<std::uint64_t> stream_index);

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

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

// Simulates the frame in lockstep with the model, in a child process. `make_rtl`: creates the RTL,
// which was built with signals. `options`: those of the simulation that differed.
std::optional<SignalDivergence> find_signal_divergence(
    const FrameSetup& frame, const PipelineConfiguration& pipeline,
    const SimulationOptions& options, const std::function<std::unique_ptr<RtlDatapath>()>& make_rtl,
    std::optional<std::uint64_t> stream_index);

}  // namespace phongpipe
