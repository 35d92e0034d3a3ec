// synthesize_cards FOLDER: places and routes pixel_datapath in many configurations and writes the
// technology cards of the iCE40 devices to FOLDER.
// synthesize_cards --fit FOLDER: writes the installed cards there, with their models fitted anew.
// synthesize_cards --units FOLDER: the same, with the units of hw/units/ placed and routed anew.
// synthesize_cards --check: places and routes the presets again; fails where one is slower or
// larger than its card says.
#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>

#include "model/scene/input_error.h"
#include "testbench/hardware/hardware.h"
#include "testbench/synthesis/fitted_model.h"
#include "testbench/synthesis/place_and_route.h"
#include "testbench/synthesis/unit_targets.h"
#include "testbench/system/installation.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct Device {
  const char *card, *title, *device, *package;
  int logic_cells;
  int most_lanes;  // with more, a design does not fit, or is not placed within minutes
};
// The largest first: what it takes, the others take, or less.
constexpr Device kDevices[] = {{"ice40-hx8k", "Lattice iCE40-HX8K", "hx8k", "ct256", 7680, 4},
                               {"ice40-up5k", "Lattice iCE40-UP5K", "up5k", "sg48", 5280, 2}};

DatapathConfiguration of_preset(const char* preset, int channels) {
  DatapathConfiguration datapath{load_hardware(preset, {"technology=generic"}).formats, {}};
  datapath.channels = channels;
  datapath.specular_guard_bits = least_specular_guard_bits(datapath.rom_layout);
  return datapath;
}

// The presets first. Then the paper's formats and the default's, changed in one setting at a time,
// and some that differ in many.
std::vector<DatapathConfiguration> configurations() {
  std::vector<DatapathConfiguration> all;
  for (const int channels : {1, 3}) {
    for (const char* preset : {"default", "paper-1k", "paper-8k"}) {
      all.push_back(of_preset(preset, channels));
    }
  }
  const DatapathConfiguration usual = of_preset("default", 1), paper = of_preset("paper-1k", 1);
  const auto add = [&all](DatapathConfiguration base, auto change) {
    change(base);
    all.push_back(base);
  };
  for (const int bits : {4, 8, 12, 20, 24, 26, 28, 30}) {
    add(paper, [&](auto& c) { c.diffuse_fraction_bits = bits; });
  }
  for (const int bits : {10, 20, 24, 27, 30}) {
    add(usual, [&](auto& c) { c.diffuse_fraction_bits = bits; });
  }
  for (const int bits : {4, 8, 18, 24}) {
    add(paper, [&](auto& c) { c.specular_fraction_bits = bits; });
  }
  for (const int bits : {6, 8, 11, 12}) {
    add(paper, [&](auto& c) { c.rom_address_bits = bits; });
  }
  for (const int bits : {4, 10, 12}) {
    add(paper, [&](auto& c) { c.rom_data_bits = bits; });
  }
  for (const int bits : {9, 11}) {
    add(usual, [&](auto& c) { c.rom_address_bits = bits; });
  }
  for (const int bits : {2 * kSpecularGuardStep, 3 * kSpecularGuardStep}) {
    add(usual, [&](auto& c) { c.specular_guard_bits = bits; });
  }
  for (const int octaves : {1, 3}) {
    add(usual, [&](auto& c) { c.rom_octaves = octaves; });
  }
  for (const int bits : {8, 10}) {
    add(usual, [&](auto& c) {
      c.rom_layout = RomLayout::octave;
      c.rom_address_bits = bits;
    });
  }
  for (const DatapathConfiguration& base : {paper, usual}) {
    for (const int channels : {1, 3}) {
      add(base, [&](auto& c) {
        c.channels = channels;
        c.specular = false;
      });
      add(base, [&](auto& c) {
        c.channels = channels;
        c.gate = GateSource::series;
      });
      add(base, [&](auto& c) {
        c.channels = channels;
        c.depth_cue = true;
      });
    }
  }
  add(usual, [](auto& c) {
    c.channels = 3;
    c.diffuse_fraction_bits = 24;
    c.depth_cue = true;
    c.gate = GateSource::series;
  });
  for (const DatapathKind kind : {DatapathKind::serial, DatapathKind::wide2, DatapathKind::wide4}) {
    const auto add_kind = [&](DatapathConfiguration base, auto change) {
      base.kind = kind;
      add(base, change);
    };
    for (const DatapathConfiguration& base : {usual, paper}) {
      add_kind(base, [](auto&) {});
      add_kind(base, [](auto& c) { c.channels = 3; });
    }
    if (kind == DatapathKind::wide4) continue;
    for (const int bits : {20, 24, 28}) {
      add_kind(paper, [&](auto& c) { c.diffuse_fraction_bits = bits; });
    }
    add_kind(usual, [](auto& c) { c.gate = GateSource::series; });
    if (kind == DatapathKind::wide2) continue;
    add_kind(usual, [](auto& c) {
      c.gate = GateSource::series;
      c.channels = 3;
    });
    for (const DatapathConfiguration& base : {usual, paper}) {
      for (const int channels : {1, 3}) {
        add_kind(base, [&](auto& c) {
          c.depth_cue = true;
          c.channels = channels;
        });
      }
    }
    for (const int channels : {1, 3}) {
      for (const int bits : {paper.diffuse_fraction_bits, 24}) {
        add_kind(paper, [&](auto& c) {
          c.specular = false;
          c.channels = channels;
          c.diffuse_fraction_bits = bits;
        });
      }
    }
    for (const int bits : {8, 12, 13}) {
      add_kind(paper, [&](auto& c) { c.rom_address_bits = bits; });
    }
    add_kind(usual, [](auto& c) { c.rom_address_bits = 9; });
  }
  return all;
}

std::string model_text(std::string_view module, const char* name, const FittedModel& model) {
  std::string text = fmt::format("\n[fitted.{}.{}]\nrelative_error = {:.4f}\n", module, name,
                                 model.relative_error);
  std::size_t i = 0;
  for (const auto& [feature, value] : synthesis_features({})) {
    const double coefficient = model.coefficients[i++];
    if (coefficient != 0) text += fmt::format("{} = {:.6g}\n", feature, coefficient);
  }
  return text;
}

// What was placed in a device.
struct Designs {
  std::vector<DatapathConfiguration> configurations;
  std::vector<MeasuredDesign> measured;
  std::vector<MeasuredUnit> units;
};

std::string design_text(const MeasuredDesign& d) {
  return fmt::format(
      "parameters = \"{}\"\nclock_ns = {:.2f}\nslowest_ns = {:.2f}\nlimited_by = \"{}\"\n"
      "luts = {}\nregisters = {}\ncarries = {}\nblock_rams = {}\n",
      d.parameters, d.clock_ns, d.slowest_ns, d.limited_by, d.luts, d.registers, d.carries,
      d.block_rams);
}

// `of_largest`: what was placed in the largest device, for all devices take as many LUTs and
// registers.
std::string card_text(const Device& device, const Designs& designs, const Designs& of_largest,
                      const std::string& tools) {
  std::string text = fmt::format(
      "# {}. Written by scripts/synthesize.sh: datapaths between registers, {} seeds. "
      "clock_ns is\n"
      "# the median of the seeds, slowest_ns the worst; limited_by is the block at the end of the\n"
      "# longest path. Other configurations are fitted: relative_error is the largest of a design\n"
      "# whose own figures were left out.\n"
      "name = \"{}\"\nsource = \"this RTL, placed and routed by {}\"\n"
      "device = \"{}\"\npackage = \"{}\"\nlogic_cells = {}\n",
      device.title, kPlacementSeeds, device.card, tools, device.device, device.package,
      device.logic_cells);
  std::set<std::string_view> modules;
  for (const DatapathKindTraits& kind : kDatapathKinds) modules.insert(kind.rtl_module);
  for (const std::string_view module : modules) {
    // Fits one figure; too few designs cannot be left out one after the other.
    const auto add = [&](const char* name, const Designs& known, auto member,
                         const std::vector<std::string_view>& features) {
      std::vector<DatapathConfiguration> configurations;
      std::vector<double> values;
      for (std::size_t i = 0; i < known.measured.size(); ++i) {
        if (traits(known.configurations[i].kind).rtl_module != module) continue;
        configurations.push_back(known.configurations[i]);
        values.push_back(static_cast<double>(known.measured[i].*member));
      }
      if (values.size() <= features.size() + 1) {
        throw std::runtime_error(fmt::format("{}: too few designs of {}", device.card, module));
      }
      text += model_text(module, name, fit_model(configurations, values, features));
    };
    add("clock_ns", designs, &MeasuredDesign::clock_ns, clock_features(module));
    add("luts", of_largest, &MeasuredDesign::luts, area_features(module));
    add("registers", of_largest, &MeasuredDesign::registers, area_features(module));
  }
  for (const MeasuredDesign& d : designs.measured) {
    text += "\n[[measured]]\n" + design_text(d);
  }
  for (const MeasuredUnit& unit : designs.units) {
    text += fmt::format("\n[[unit]]\noperation = \"{}\"\nmodule = \"{}\"\nlatency_cycles = {}\n{}",
                        unit.operation, unit.module, unit.latency_cycles, design_text(unit.design));
  }
  return text;
}

void print_design(const MeasuredDesign& design) {
  fmt::print("{:.2f} ns by {}, {} LUTs, {} registers, {} block RAMs\n", design.clock_ns,
             design.limited_by, design.luts, design.registers, design.block_rams);
  std::fflush(stdout);
}

// Measures the units of hw/units/ for all cards.
void measure_units(std::map<std::string, Designs>& designs) {
  for (const UnitTarget& unit : unit_targets()) {
    const Netlist netlist(unit.target, installation().hardware / unit.folder);
    for (const Device& device : kDevices) {
      fmt::print("{} {}: ", device.card, unit.target.module);
      MeasuredDesign design = netlist.place(device.device, device.package);
      design.limited_by = unit.target.module;
      print_design(design);
      designs[device.card].units.push_back(
          {unit.operation, unit.target.module, unit.latency_cycles, design});
    }
  }
}

void write_cards(const std::filesystem::path& folder) {
  const std::vector<DatapathConfiguration> all = configurations();
  std::map<std::string, Designs> designs;  // by card
  measure_units(designs);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Netlist netlist(datapath_target(all[i]), installation().hardware);
    for (const Device& device : kDevices) {
      if (all[i].lanes() > device.most_lanes) continue;
      fmt::print("{}/{} {} {}: ", i + 1, all.size(), device.card, rtl_parameters_text(all[i]));
      try {
        const MeasuredDesign design = netlist.place(device.device, device.package);
        print_design(design);
        designs[device.card].configurations.push_back(all[i]);
        designs[device.card].measured.push_back(design);
      } catch (const InputError&) {
        fmt::print("too large\n");
      }
    }
  }
  for (const Device& device : kDevices) {
    write_text(
        folder / fmt::format("{}.toml", device.card),
        card_text(device, designs[device.card], designs[kDevices[0].card], synthesis_tools()));
  }
}

// With the designs of the cards that there are; with their units, too, or with units measured anew.
void write_cards_again(const std::filesystem::path& folder, bool with_new_units) {
  std::map<std::string, Designs> all;  // by card
  if (with_new_units) measure_units(all);
  for (const Device& device : kDevices) {
    const Technology card = load_technology(device.card);
    Designs& designs = all[device.card];
    if (!with_new_units) designs.units = card.units;
    for (const DatapathConfiguration& configuration : configurations()) {
      const MeasuredDesign* const design = card.find(configuration);
      if (design == nullptr) continue;  // too large for the device
      designs.configurations.push_back(configuration);
      designs.measured.push_back(*design);
    }
    constexpr std::string_view kBy = "routed by ";
    const std::string tools = card.source.substr(card.source.find(kBy) + kBy.size());
    write_text(folder / fmt::format("{}.toml", device.card),
               card_text(device, designs, all[kDevices[0].card], tools));
  }
}

// Whether the presets are as fast and as small as their cards say, but for what seeds do.
bool check_cards() {
  bool good = true;
  for (const char* preset : {"default", "paper-8k"}) {
    const DatapathConfiguration datapath = of_preset(preset, 1);
    const Netlist netlist(datapath_target(datapath), installation().hardware);
    for (const Device& device : kDevices) {
      const MeasuredDesign* const known = load_technology(device.card).find(datapath);
      if (known == nullptr) throw std::runtime_error("the card has no figures of the preset");
      const MeasuredDesign now = netlist.place(device.device, device.package);
      const bool slower = now.clock_ns > known->slowest_ns;
      const bool larger = now.luts > known->luts || now.registers > known->registers ||
                          now.block_rams > known->block_rams;
      fmt::print(
          "{} {}: {:.2f} ns (card {:.2f}, slowest seed {:.2f}), {} LUTs ({}), {} registers "
          "({}){}\n",
          preset, device.card, now.clock_ns, known->clock_ns, known->slowest_ns, now.luts,
          known->luts, now.registers, known->registers,
          slower   ? ": SLOWER than the card says"
          : larger ? ": LARGER than the card says"
                   : "");
      good = good && !slower && !larger;
    }
  }
  return good;
}

}  // namespace
}  // namespace phongpipe

int main(int argc, char** argv) {
  try {
    if (argc == 2 && std::string(argv[1]) == "--check") return phongpipe::check_cards() ? 0 : 1;
    if (argc == 3 && (std::string(argv[1]) == "--fit" || std::string(argv[1]) == "--units")) {
      phongpipe::write_cards_again(argv[2], std::string(argv[1]) == "--units");
      return 0;
    }
    if (argc != 2) {
      fmt::print(stderr, "synthesize_cards [--fit | --units] FOLDER, or --check\n");
      return 2;
    }
    phongpipe::write_cards(argv[1]);
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "synthesize_cards: {}\n", error.what());
    return 3;
  }
}
