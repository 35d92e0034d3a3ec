#include "testbench/hardware/technology.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/files/toml_reader.h"
#include "model/fixed/constants.h"
#include "model/scene/input_error.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

constexpr double kLeastClockNs = 0.001, kMostClockNs = 1e6;
constexpr int kMostCells = 10'000'000;

FittedModel read_model(const TomlTable& models, std::string_view name) {
  const TomlTable table = models.table(name);
  FittedModel model;
  model.relative_error = table.number("relative_error", {0, 10});
  for (const auto& [feature, value] : synthesis_features({})) {
    const NumberRange any = {-1e6, 1e6};
    model.coefficients.push_back(feature == "constant" ? table.number(feature, any)
                                                       : table.number(feature, any, 0));
  }
  table.finish();
  return model;
}

MeasuredDesign read_design(const TomlTable& table) {
  MeasuredDesign design;
  design.parameters = table.text("parameters");
  design.clock_ns = table.number("clock_ns", {kLeastClockNs, kMostClockNs});
  design.slowest_ns = table.number("slowest_ns", {kLeastClockNs, kMostClockNs});
  design.limited_by = table.text("limited_by");
  design.luts = table.integer("luts", 1, kMostCells);
  design.registers = table.integer("registers", 1, kMostCells);
  design.carries = table.integer("carries", 0, kMostCells);
  design.block_rams = table.integer("block_rams", 0, kMostCells);
  table.finish();
  return design;
}

MeasuredUnit read_unit(const TomlTable& table) {
  MeasuredUnit unit;
  unit.operation = table.text("operation");
  unit.module = table.text("module");
  unit.latency_cycles = table.integer("latency_cycles", 1, 1000);
  unit.design = read_design(table);
  return unit;
}

// How many of the parameters two designs have in common.
std::ptrdiff_t in_common(std::string_view a, std::string_view b) {
  const auto parts = [](std::string_view text) {
    std::vector<std::string_view> all;
    for (std::size_t end = 0; end != std::string_view::npos;) {
      end = text.find('-');
      all.push_back(text.substr(0, end));
      if (end != std::string_view::npos) text.remove_prefix(end + 1);
    }
    return all;
  };
  const std::vector<std::string_view> known = parts(b);
  const std::vector<std::string_view> asked = parts(a);
  return std::count_if(asked.begin(), asked.end(), [&](std::string_view part) {
    return std::find(known.begin(), known.end(), part) != known.end();
  });
}

}  // namespace

std::string_view name(FigureKind kind) {
  constexpr std::string_view kNames[] = {"measured", "fitted", "assumed"};
  return kNames[static_cast<std::size_t>(kind)];
}

std::string kind_text(const ClockFigure& clock) {
  if (clock.kind != FigureKind::fitted) return std::string(name(clock.kind));
  return fmt::format("fitted ± {:.1f} %{}", std::ceil(1000 * clock.relative_error) / 10,
                     clock.too_large ? ", but the design is too large for the device" : "");
}

std::vector<std::pair<std::string_view, double>> synthesis_features(
    const DatapathConfiguration& c) {
  const int diffuse = c.diffuse ? c.channels : 0, specular = c.specular ? 1 : 0;
  const int gate = c.has_gate_series() ? 1 : 0, cue = c.depth_cue ? 1 : 0;
  // In a clock, a carry runs through the low bits of a sum. Up to about 20 bits, control is slower:
  // the designs of the cards are as fast at 24 fraction bits as at 4, and slower from 26 on.
  constexpr int kCarryOfControl = 20;
  int widest = c.diffuse_width();
  if (specular != 0) widest = std::max(widest, c.specular_width());
  if (cue != 0) widest = std::max(widest, kCueWidth);
  const bool plain = c.rom_layout == RomLayout::plain;
  const int lanes = c.lanes();
  constexpr int kBankBits = 11;
  const int banks =
      plain && c.rom_address_bits > kBankBits ? 1 << (c.rom_address_bits - kBankBits) : 1;
  const int word_bits = specular * lanes * c.channels * c.rom_data_bits;
  return {{"constant", 1},
          {"lanes", lanes},
          {"channels", lanes * c.channels},
          {"widest_series_bits", widest},
          {"long_carry_bits", std::max(0, low_bits(widest) - kCarryOfControl)},
          {"series_bits", lanes * ((diffuse + gate) * c.diffuse_width() +
                                   specular * c.specular_width() + cue * kCueWidth)},
          {"level_bits", lanes * c.channels * c.diffuse_width()},
          {"word_bits", word_bits},
          {"bank_bits", word_bits * (banks - 1)},
          {"octave_address_bits", plain ? 0 : lanes * specular * c.rom_address_bits},
          {"increment_bits", c.rom_layout == RomLayout::bipartite ? word_bits : 0},
          {"specular", lanes * specular},
          {"gate_series", lanes * gate},
          {"depth_cue", lanes * cue},
          {"depth_cue_channels", lanes * cue * c.channels}};
}

double FittedModel::value(const DatapathConfiguration& configuration) const {
  double sum = 0;
  std::size_t i = 0;
  for (const auto& [name, value] : synthesis_features(configuration)) {
    sum += coefficients[i++] * value;
  }
  return sum;
}

const MeasuredDesign* Technology::find(const DatapathConfiguration& configuration) const {
  const std::string parameters = rtl_parameters_text(configuration);
  const auto found =
      std::find_if(measured.begin(), measured.end(),
                   [&](const MeasuredDesign& design) { return design.parameters == parameters; });
  return found == measured.end() ? nullptr : &*found;
}

ClockFigure Technology::clock(const DatapathConfiguration& configuration) const {
  if (measured.empty()) return fixed;
  const MeasuredDesign* design = find(configuration);
  if (design != nullptr) return {design->clock_ns, FigureKind::measured, 0, design->limited_by};
  // The block that limits what is most like it.
  const std::string parameters = rtl_parameters_text(configuration);
  design = &*std::max_element(
      measured.begin(), measured.end(), [&](const MeasuredDesign& a, const MeasuredDesign& b) {
        return in_common(parameters, a.parameters) < in_common(parameters, b.parameters);
      });
  const FittedModels& models = models_of(configuration);
  const double cells =
      std::max(models.luts.value(configuration), models.registers.value(configuration));
  return {models.clock_ns.value(configuration), FigureKind::fitted, models.clock_ns.relative_error,
          design->limited_by, logic_cells > 0 && cells > logic_cells};
}

std::optional<AreaFigure> Technology::area(const DatapathConfiguration& configuration) const {
  if (measured.empty()) return {};
  if (const MeasuredDesign* const design = find(configuration)) {
    return AreaFigure{FigureKind::measured, design->luts, design->registers, design->block_rams};
  }
  const auto count = [&](const FittedModel& model) {
    return static_cast<int>(std::lround(model.value(configuration)));
  };
  const FittedModels& models = models_of(configuration);
  return AreaFigure{FigureKind::fitted, count(models.luts), count(models.registers), {}};
}

const FittedModels& Technology::models_of(const DatapathConfiguration& configuration) const {
  const auto found = fitted.find(traits(configuration.kind).rtl_module);
  if (found != fitted.end()) return found->second;
  throw InputError(
      fmt::format("technology {}: no [fitted.{}] in the card, for configurations that "
                  "it does not list; choose another technology",
                  name, traits(configuration.kind).rtl_module));
}

Technology load_technology(const std::string& name) {
  const auto file = find_named(name, installation().hardware / "technology", "technology card");
  const TomlTable table = TomlTable::read_file(file);
  Technology technology;
  technology.name = table.text("name");
  technology.source = table.text("source");
  if (table.has("clock_ns")) {
    table.refuse("measured", "a card has either clock_ns or [[measured]] designs");
    technology.fixed.ns = table.number("clock_ns", {kLeastClockNs, kMostClockNs});
    technology.fixed.limited_by = table.text("limited_by", "");
  } else {
    technology.device = table.text("device");
    technology.package = table.text("package");
    if (table.has("logic_cells")) {
      technology.logic_cells = table.integer("logic_cells", 1, kMostCells);
    }
    const TomlTable fitted = table.table("fitted");
    for (const DatapathKindTraits& kind : kDatapathKinds) {
      const std::string_view module = kind.rtl_module;
      if (!fitted.has(module) || technology.fitted.count(module) != 0) continue;
      const TomlTable models = fitted.table(module);
      technology.fitted[std::string(module)] = {read_model(models, "clock_ns"),
                                                read_model(models, "luts"),
                                                read_model(models, "registers")};
      models.finish();
    }
    fitted.finish();
    for (const TomlTable& design : table.tables("measured")) {
      technology.measured.push_back(read_design(design));
    }
    if (table.has("unit")) {
      for (const TomlTable& unit : table.tables("unit"))
        technology.units.push_back(read_unit(unit));
    }
  }
  table.finish();
  return technology;
}

}  // namespace phongpipe
