// pixel_datapath, clock by clock and register by register: what hw/pixel_datapath.sv holds in every
// clock, computed by the model's blocks. All registers start at 0.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "model/fixed/frame_setup.h"
#include "sim/clocked_datapath.h"

namespace phongpipe {

// The stages of the pipeline, each with its own valid bit: `step` steps the series (fd_* in RTL),
// `compare` compares and forms the address (s1_*), `read` reads the table and clamps (s2_*), `add`
// adds (s3_*), `fade` moves towards the colour of depth cueing (s4_*), where there is one.
enum class DatapathStage { step, compare, read, add, fade };

// Registers that follow a pixel through all stages behind the first.
struct StageRegisters {
  bool valid = false;
  std::uint16_t x = 0, y = 0;
  std::int32_t cue_factor = 0;  // not in `fade`
  bool first_pass = false;      // not in `fade`
};

class DatapathRegisters : public ClockedDatapath {
 public:
  explicit DatapathRegisters(const DatapathConfiguration& configuration,
                             const OutputColor& cue_color = {});

  void reset() override;
  DatapathOutputs clock(const DatapathInputs& inputs) override;

  // The outputs in this clock, before its edge.
  DatapathOutputs outputs(const DatapathInputs& inputs) const;

  // Names as in RTL. Arrays: channel by channel.
  struct Step {
    bool valid = false;
    std::uint16_t x = 0, y = 0;
    int remaining = 0;
    bool step_diffuse = false, step_specular = false, highlight = false, first_pass = false;
    std::array<std::int64_t, 3> level = {};
    std::array<ForwardDifferencer, 3> diffuse;
    ForwardDifferencer specular, gate, cue;
  };
  struct Compare : StageRegisters {
    std::array<bool, 3> lit = {};
    std::array<std::int32_t, 3> diffuse_cut = {}, level_cut = {};
    int address = 0;
    bool highlight = false, open = false;  // open: of a separate gate series
  };
  struct Read : StageRegisters {
    std::array<std::int32_t, 3> word = {}, increment = {}, clamped = {};
    bool open = false;
  };
  struct Add : StageRegisters {
    std::array<std::int32_t, 3> sum = {};
  };
  struct Fade : StageRegisters {
    std::array<std::uint8_t, 3> color = {};
  };
  const Step& step() const { return step_; }
  const Compare& compare() const { return compare_; }
  const Read& read() const { return read_; }
  const Add& add() const { return add_; }
  const Fade& fade() const { return fade_; }
  // Words of a channel's table.
  const std::vector<std::int32_t>& table(std::size_t channel) const { return table_[channel]; }

  bool valid(DatapathStage stage) const;

 private:
  struct Ready {
    bool compare, read, add, fade;  // whether the stage takes what the one before it has
  };
  Ready ready(bool pixel_ready) const;
  std::size_t channels() const { return static_cast<std::size_t>(configuration_.channels); }
  std::int64_t diffuse_value(std::size_t channel) const;
  void load(const Span& span);
  void advance(const Ready& ready);
  std::uint32_t color(std::size_t channel) const;

  DatapathConfiguration configuration_;
  OutputColor cue_color_;
  std::array<std::vector<std::int32_t>, 3> table_;
  Step step_;
  Compare compare_;
  Read read_;
  Add add_;
  Fade fade_;
};

// A register of pixel_datapath: where it is in RTL and here, and how to read it. Waveforms, views,
// comparisons of registers and the life of a pixel are made from these descriptions.
struct DatapathSignal {
  std::string scope;  // the block below pixel_datapath, as "specular.rom"; empty: pixel_datapath
  std::string name;   // as "address"
  DatapathStage stage = DatapathStage::step;
  int width = 1;          // bits
  int fraction_bits = 0;  // of them, below one unit
  bool is_signed = false;
  std::string unit;    // of the value: "LSB", "address" (of the table), or empty for a plain number
  int rtl_lsb = 0;     // the bit of the RTL's signal that the register begins at
  std::string packed;  // name of the RTL's signal in pixel_datapath, if it is packed with others
  std::function<std::int64_t(const DatapathRegisters&)> value;

  // "pixel_datapath.specular.rom.address".
  std::string block() const;
  std::string full_name() const { return block() + "." + name; }
  // In units.
  double real(std::int64_t bits) const;
};

// All registers of a configuration, stage by stage, from the input to the output.
std::vector<DatapathSignal> datapath_signals(const DatapathConfiguration& configuration);

}  // namespace phongpipe
