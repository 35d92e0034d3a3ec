// phongpipe regress: many verifications, of a list or at random, with the failures sorted.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>

#include "model/scene/input_error.h"
#include "testbench/commands/campaign_options.h"
#include "testbench/commands/options.h"
#include "testbench/commands/plan_options.h"
#include "testbench/reports/junit_report.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

struct RegressCommandOptions {
  std::vector<std::string> inputs;  // see PlanOptions
  bool random = false;
  std::uint64_t count = 0;
  double minutes = 0;
  std::optional<std::uint64_t> seed;
  std::string junit;
  CampaignCommand campaign;
};

// Every shipped scene × presets × details × back-pressure.
Plan smoke_plan() {
  Plan plan;
  plan.axes = {{"scene", names_in(installation().scenes)},
               {"hardware", names_in(installation().hardware / "presets")},
               {"detail", {"span", "cycle"}},
               {"stall", {"0", "25"}}};
  return plan;
}

int random_regression(RegressCommandOptions& options) {
  if (options.count == 0 && options.minutes == 0) options.count = 100;
  const auto now = std::chrono::system_clock::now().time_since_epoch().count();
  const std::uint64_t seed =
      options.seed ? *options.seed : static_cast<std::uint64_t>(now) % 1'000'000;
  tell(fmt::format("random runs; --seed {} does the same again", seed));
  return options.campaign.run_random(seed, options.count, 60 * options.minutes);
}

int listed_regression(RegressCommandOptions& options) {
  if (options.inputs.empty()) return options.campaign.run(smoke_plan());
  PlanOptions plan;
  plan.inputs = options.inputs;
  return options.campaign.run(plan.plan());
}

int regress(RegressCommandOptions& options) {
  if (options.random && !options.inputs.empty()) {
    throw InputError("--random draws its scenes itself: give no scenes");
  }
  if (!options.random && (options.count > 0 || options.minutes > 0)) {
    throw InputError("--count and --minutes go with --random");
  }
  check_output(options.junit);
  if (options.campaign.database.empty()) options.campaign.database = ":memory:";
  options.campaign.finish = [&](const Store& store) {
    write_output(options.junit, junit_xml(store, "phongpipe regress"));
  };
  return options.random ? random_regression(options) : listed_regression(options);
}

}  // namespace

void add_regress(CLI::App& application, Run& run) {
  auto options = std::make_shared<RegressCommandOptions>();
  options->campaign.kind = "regress";
  CLI::App* command = application.add_subcommand(
      "regress", "Verify many scenes and settings, from a list or at random");
  command
      ->add_option("inputs", options->inputs,
                   "Scenes, or a sweep file; none: every shipped scene × presets × details × "
                   "back-pressure")
      ->type_name("SCENE|SWEEP");
  command->add_flag("--random", options->random,
                    "Draw scenes, hardware and back-pressure at random, from one seed");
  command->add_option("--count", options->count, "Number of random runs (100 without --minutes)")
      ->type_name("N")
      ->check(CLI::Range(std::uint64_t{1}, kMostPoints).description(""));
  command->add_option("--minutes", options->minutes, "Time in which to begin random runs")
      ->type_name("M")
      ->check(positive_number());
  command->add_option("--seed", options->seed, "Of random runs; the same seed gives the same runs")
      ->type_name("S");
  command->add_option("--junit", options->junit, "Write the results as JUnit XML")
      ->type_name("FILE");
  options->campaign.add_to(*command);
  command->footer(
      "Without --db nothing is kept, and everything is done anew.\n"
      "Exit status: 0 all runs passed or were refused, 1 a run failed or timed out, 2 bad usage or "
      "input, 3 a run crashed, 130 interrupted.\n"
      "Example: phongpipe regress --random --minutes 30 --jobs 2 --seed 7 --junit regress.xml\n");
  command->callback([options, &run] { run = [options] { return regress(*options); }; });
}

}  // namespace phongpipe
