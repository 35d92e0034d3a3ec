// phongpipe explain: the life of one pixel, and where its error comes from.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/options.h"
#include "testbench/reports/pixel_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct ExplainCommandOptions {
  std::string scene, pixel, json;
  bool worst = false;
  HardwareOptions hardware;
  std::filesystem::path rtl_sources;
  SimulationOptions simulation;
};

int explain(const ExplainCommandOptions& options) {
  if (options.pixel.empty() != options.worst) {
    throw InputError("which pixel? Give one of --pixel X,Y and --worst");
  }
  std::optional<Pixel> pixel;
  if (!options.worst) pixel = parse_pixel(options.pixel);
  check_output(options.json);
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  Progress progress;
  progress("shading");
  const PreparedFrame frame(load_named_scene(options.scene, options.hardware.overrides),
                            hardware.formats, hardware.setup);
  const ModelFrame model = run_model(frame.setup);
  if (!pixel) pixel = worst_pixel(frame.setup, model);
  PixelStory story = tell_story(frame, hardware, model, pixel->x, pixel->y);
  RtlBuildOptions build;
  build.sources = options.rtl_sources;
  build.progress = [&](const std::string& what) { progress("building the RTL for " + what); };
  const RtlLibrary library(frame.setup.configuration, build);
  progress("simulating SystemC and RTL");
  add_cycles(frame, library, options.simulation, story);
  progress.clear();
  write_output(options.json, pixel_json(story).dump(2) + "\n");
  if (options.json != "-") print_or_throw(pixel_text(story));
  return story.rtl_agrees() ? 0 : kCheckFailed;
}

}  // namespace

void add_explain(CLI::App& application, Run& run) {
  auto options = std::make_shared<ExplainCommandOptions>();
  CLI::App* command = application.add_subcommand(
      "explain", "The life of one pixel, and where its error comes from");
  command->add_option("scene", options->scene, "Scene file, or name of a shipped scene")
      ->required()
      ->type_name("SCENE");
  command->add_option("--pixel", options->pixel, "The pixel, counted from the top left one, 0,0")
      ->type_name("X,Y");
  command->add_flag("--worst", options->worst, "The pixel with the largest error");
  command
      ->add_option("--json", options->json,
                   "Write the same as JSON; - is standard output, in place of the report")
      ->type_name("FILE");
  add_stall_options(*command, options->simulation);
  add_rtl_option(*command, options->rtl_sources);
  command->footer(
      "Exit status: 0 explained, 1 the RTL shades the pixel in another colour, 2 bad usage or "
      "input, "
      "3 a tool failed.\n"
      "Example: phongpipe explain teapot --pixel 185,245\n");
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return explain(*options); }; });
}

}  // namespace phongpipe
