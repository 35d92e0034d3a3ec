// A technology card: clock period and area of pixel_datapath in a technology. Cards of devices hold
// what was placed and routed, and a linear model of it for all other configurations; cards of other
// technologies hold one clock, which is assumed.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/fixed/datapath_configuration.h"

namespace phongpipe {

// How a figure is known: placed and routed, fitted to such figures, or set by the card.
enum class FigureKind { measured, fitted, assumed };
std::string_view name(FigureKind kind);

struct ClockFigure {
  double ns = 0;
  FigureKind kind = FigureKind::assumed;
  double relative_error = 0;  // largest of the fitted model, leaving one out; 0 if not fitted
  std::string limited_by;     // block whose path is the longest, as far as it is known
  bool too_large = false;     // the design takes more cells than the device has
};
// "measured", "fitted ± 7.2 %" or "assumed"; and whether the design is too large for the device.
std::string kind_text(const ClockFigure& clock);

struct AreaFigure {
  FigureKind kind = FigureKind::measured;
  int luts = 0, registers = 0;
  std::optional<int> block_rams;  // only measured
};

// A configuration that was placed and routed.
struct MeasuredDesign {
  std::string parameters;  // of the RTL, as rtl_parameters_text() has them
  double clock_ns = 0;     // median of the seeds
  double slowest_ns = 0;   // of the seeds
  std::string limited_by;  // block at the end of the longest path, of the seed with the median
  int luts = 0, registers = 0, carries = 0, block_rams = 0;
};

// A pipelined unit for one operation of a shading method, which takes operands in every clock.
struct MeasuredUnit {
  std::string operation;   // "add", "multiply", "divide", "rsqrt", "power"
  std::string module;      // of hw/
  int latency_cycles = 0;  // from operands to result
  MeasuredDesign design;
};

// What the figures of a configuration depend on, as a linear model sees it: names and values. Of a
// wide datapath, what all its lanes have together.
std::vector<std::pair<std::string_view, double>> synthesis_features(
    const DatapathConfiguration& configuration);

// A sum of features with coefficients.
struct FittedModel {
  double relative_error = 0;         // largest, leaving one measured design out after the other
  std::vector<double> coefficients;  // in the order of synthesis_features(); 0: not used
  double value(const DatapathConfiguration& configuration) const;
};

// Those of one module of datapath.
struct FittedModels {
  FittedModel clock_ns, luts, registers;
};

struct Technology {
  std::string name;
  std::string source;           // where the figures come from
  std::string device, package;  // for nextpnr; empty if it cannot be placed and routed
  int logic_cells = 0;          // of the device, a LUT and a register each; 0: not known
  std::vector<MeasuredDesign> measured;
  std::map<std::string, FittedModels, std::less<>> fitted;  // by module, if `measured`
  ClockFigure fixed;                                        // if not `measured`
  std::vector<MeasuredUnit> units;                          // if `measured`

  ClockFigure clock(const DatapathConfiguration& configuration) const;
  // None if the card has no areas.
  std::optional<AreaFigure> area(const DatapathConfiguration& configuration) const;
  const MeasuredDesign* find(const DatapathConfiguration& configuration) const;  // or null

 private:
  // Throws InputError if the card has none of this module.
  const FittedModels& models_of(const DatapathConfiguration& configuration) const;
};

// Loads a card from a file, or by its name. Throws InputError.
Technology load_technology(const std::string& name);

}  // namespace phongpipe
