// phongpipe sweep: accuracy against time over widths, tables, series, or anything else that a run
// depends on.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/campaign/plan.h"
#include "testbench/commands/campaign_options.h"
#include "testbench/commands/options.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

struct Options {
  std::vector<std::string> inputs;  // scenes, and at most one sweep file
  HardwareOptions hardware;
  std::vector<std::string> vary, ties, conditions;
  std::uint64_t sample = 0, seed = 1;
  CampaignCommand campaign;
};

// The file, if `name` is a sweep file or a shipped sweep.
std::optional<std::filesystem::path> sweep_file(const std::string& name) {
  std::error_code none;
  if (std::filesystem::is_regular_file(name, none)) {
    const bool sweep = TomlTable::read_file(name).has("vary");
    return sweep ? std::make_optional<std::filesystem::path>(name) : std::nullopt;
  }
  const std::filesystem::path shipped = installation().sweeps / (name + ".toml");
  return std::filesystem::is_regular_file(shipped, none) ? std::make_optional(shipped)
                                                         : std::nullopt;
}

Plan plan_of(const Options& options) {
  Plan plan;
  std::vector<std::string> scenes;
  std::string file_name;
  for (const std::string& input : options.inputs) {
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
  if (options.hardware.hardware != "default") plan.base.hardware = options.hardware.hardware;
  for (const std::string& setting : options.hardware.overrides) {
    plan.base.settings.push_back(setting);
  }
  for (const std::string& text : options.vary) plan.axes.push_back(parse_axis(text));
  for (const std::string& text : options.ties) plan.ties.push_back(parse_tie(text));
  plan.conditions.insert(plan.conditions.end(), options.conditions.begin(),
                         options.conditions.end());
  if (options.sample > 0) {
    plan.sample = options.sample;
    plan.seed = options.seed;
  }
  bool has_scene = false;
  for (const Axis& axis : plan.axes) has_scene = has_scene || axis.key == "scene";
  if (!has_scene) throw InputError("no scene: give one, as in phongpipe sweep teapot --vary …");
  if (plan.axes.size() < 2 && plan.axes.front().values.size() < 2) {
    throw InputError("nothing varies: give --vary KEY=LIST or a sweep file");
  }
  return plan;
}

int sweep(Options& options) {
  const Plan plan = plan_of(options);
  std::vector<CampaignRun> runs;
  for (PlanPoint& point : points_of(plan)) {
    runs.push_back({std::move(point.request), std::move(point.values)});
  }
  std::vector<std::string> keys;
  for (const Axis& axis : plan.axes) keys.push_back(axis.key);
  for (const Tie& tie : plan.ties) keys.push_back(tie.key);
  if (options.campaign.database.empty()) {
    options.campaign.database =
        std::filesystem::path(options.inputs.front()).stem().string() + "-sweep.db";
  }
  return options.campaign.run(std::move(runs), keys);
}

}  // namespace

void add_sweep(CLI::App& application, Run& run) {
  auto options = std::make_shared<Options>();
  options->campaign.kind = "sweep";
  CLI::App* command = application.add_subcommand(
      "sweep", "Vary settings; record accuracy against time, verified in RTL");
  command
      ->add_option("inputs", options->inputs,
                   "Scenes, or a sweep file (TOML), or the name of a shipped one")
      ->required()
      ->type_name("SCENE|SWEEP");
  command
      ->add_option("--vary", options->vary,
                   "Values of one key: a setting (see --help-settings), technology, scene.PATH, "
                   "hardware, detail, stall, seed, effects or budget; may be given again")
      ->type_name("KEY=LIST|FROM:TO[:STEP]")
      ->allow_extra_args(false);
  command
      ->add_option("--tie", options->ties,
                   "A key whose value follows from those that vary, as in "
                   "'specular_fraction_bits=22-rom_address_bits'")
      ->type_name("KEY=EXPRESSION")
      ->allow_extra_args(false);
  command
      ->add_option("--where", options->conditions,
                   "Leave out points at which this does not hold, as in 'rom_address_bits>8'")
      ->type_name("EXPRESSION")
      ->allow_extra_args(false);
  command->add_option("--sample", options->sample, "Draw N points at random instead of all")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, kMostPoints).description(""));
  command->add_option("--seed", options->seed, "Of the sample")
      ->capture_default_str()
      ->type_name("S");
  options->campaign.add_to(*command);
  options->hardware.add_to(*command);
  command->footer(
      "Exit status: 0 all runs passed or were refused, 1 a run failed or timed out, 2 bad usage or "
      "input, 3 a run crashed, 130 interrupted.\n"
      "Example: phongpipe sweep teapot --vary rom_address_bits=6:13 --vary "
      "diffuse_fraction_bits=4:24:2 --db teapot.db\n");
  command->callback([options, &run] { run = [options] { return sweep(*options); }; });
}

}  // namespace phongpipe
