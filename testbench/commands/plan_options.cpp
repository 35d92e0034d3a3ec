#include "testbench/commands/plan_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "model/files/spelling.h"
#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/system/installation.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

// The file, if `name` is a sweep file or a shipped sweep.
std::optional<std::filesystem::path> sweep_file(const std::string& name) {
  std::error_code none;
  if (std::filesystem::is_regular_file(name, none)) {
    const bool sweep = TomlTable::read_file(name).has("vary");
    return sweep ? std::make_optional<std::filesystem::path>(name) : std::nullopt;
  }
  const std::filesystem::path shipped = installation().sweeps / (name + ".toml");
  if (std::filesystem::is_regular_file(shipped, none)) return shipped;
  const std::vector<std::string> scenes = names_in(installation().scenes);
  const std::string close = closest_word(name, names_in(installation().sweeps));
  if (!close.empty() && std::find(scenes.begin(), scenes.end(), name) == scenes.end()) {
    throw InputError(
        fmt::format("{}: no such file, scene or sweep; did you mean {}?", printable(name), close));
  }
  return std::nullopt;
}

}  // namespace

void PlanOptions::add_to(CLI::App& command) {
  command
      .add_option("inputs", inputs, "Scenes, or a sweep file (TOML), or the name of a shipped one")
      ->required()
      ->type_name("SCENE|SWEEP");
  command
      .add_option("--vary", vary,
                  "Values of one key: a setting (see --help-settings), technology, scene.PATH, "
                  "hardware, detail, stall, seed, effects or budget; may be given again")
      ->type_name("KEY=LIST|FROM:TO[:STEP]")
      ->allow_extra_args(false);
  command
      .add_option("--tie", ties,
                  "A key whose value follows from those that vary, as in "
                  "'specular_fraction_bits=22-rom_address_bits'")
      ->type_name("KEY=EXPRESSION")
      ->allow_extra_args(false);
  command
      .add_option("--where", conditions,
                  "Leave out points at which this does not hold, as in 'rom_address_bits>8'")
      ->type_name("EXPRESSION")
      ->allow_extra_args(false);
  command.add_option("--sample", sample, "Draw N points at random instead of all")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, kMostPoints).description(""));
  command.add_option("--seed", seed, "Of the sample (1)")->type_name("S");
  hardware.add_to(command);
}

Plan PlanOptions::plan() const {
  Plan plan;
  std::vector<std::string> scenes;
  std::string file_name;
  for (const std::string& input : inputs) {
    const auto file = sweep_file(input);
    if (!file) {
      scenes.push_back(input);
    } else if (!file_name.empty()) {
      throw InputError(fmt::format("{} and {}: one sweep file at a time", file_name, input));
    } else {
      file_name = input;
      read_sweep_file(*file, plan);
    }
  }
  if (!scenes.empty()) {
    // Scenes of the command line replace those of the file.
    if (!plan.axes.empty() && plan.axes.front().key == "scene") plan.axes.erase(plan.axes.begin());
    plan.axes.insert(plan.axes.begin(), {"scene", scenes});
  }
  if (hardware.hardware != "default") plan.base.hardware = hardware.hardware;
  plan.base.settings.insert(plan.base.settings.end(), hardware.overrides.begin(),
                            hardware.overrides.end());
  for (const std::string& text : vary) plan.axes.push_back(parse_axis(text));
  for (const std::string& text : ties) plan.ties.push_back(parse_tie(text));
  plan.conditions.insert(plan.conditions.end(), conditions.begin(), conditions.end());
  if (sample) plan.sample = *sample;
  if (seed && plan.sample == 0) throw InputError("--seed is of a sample: give --sample N, too");
  if (seed) plan.seed = *seed;
  if (std::none_of(plan.axes.begin(), plan.axes.end(),
                   [](const Axis& axis) { return axis.key == "scene"; })) {
    throw InputError(
        "no scene: give one, as in phongpipe sweep teapot --vary rom_address_bits=6:13");
  }
  return plan;
}

}  // namespace phongpipe
