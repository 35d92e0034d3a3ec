// phongpipe sweep: accuracy against time over widths, tables, series, or anything else that a run
// depends on.
#include <filesystem>
#include <memory>

#include "model/scene/input_error.h"
#include "testbench/campaign/loader.h"
#include "testbench/commands/campaign_options.h"
#include "testbench/commands/plan_options.h"

namespace phongpipe {
namespace {

struct SweepCommandOptions {
  PlanOptions plan;
  CampaignCommand campaign;
};

int sweep(SweepCommandOptions& options) {
  const Plan plan = options.plan.plan();
  if (grid_size(plan) == 1) {
    // A mistake in the only point is more of a reason.
    const RunRequest only = points_of(plan).front().request;
    Loader loader;
    loader.scene(only);
    loader.hardware(only);
    throw InputError(
        "nothing varies, each key has one value: give --vary KEY=LIST or KEY=FROM:TO, several "
        "scenes, or a sweep file");
  }
  if (options.campaign.database.empty()) {
    options.campaign.database =
        std::filesystem::path(options.plan.inputs.front()).stem().string() + "-sweep.db";
  }
  return options.campaign.run(plan);
}

}  // namespace

void add_sweep(CLI::App& application, Run& run) {
  auto options = std::make_shared<SweepCommandOptions>();
  options->campaign.kind = "sweep";
  CLI::App* command = application.add_subcommand(
      "sweep", "Vary settings; record accuracy against time, verified in RTL");
  options->plan.add_to(*command);
  options->campaign.add_to(*command);
  command->footer(
      "Without --db the results are kept in SCENE-sweep.db.\n"
      "Exit status: 0 all runs passed or were refused, 1 a run failed or timed out, 2 bad usage or "
      "input, 3 a run crashed, 130 interrupted.\n"
      "Example: phongpipe sweep teapot --vary rom_address_bits=6:13 --vary "
      "diffuse_fraction_bits=4:24:2 --db teapot.db\n");
  command->callback([options, &run] { run = [options] { return sweep(*options); }; });
}

}  // namespace phongpipe
