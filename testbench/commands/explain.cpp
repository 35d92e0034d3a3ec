// phongpipe explain: the life of one pixel, and where its error comes from.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/options.h"
#include "testbench/reports/pixel_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct Options {
  std::string scene, pixel, json;
  bool worst = false;
  HardwareOptions hardware;
};

Pixel parse_pixel(const std::string& text) {
  const std::vector<std::string_view> parts = split(text, ',');
  std::vector<int> numbers;
  for (const std::string_view part : parts) {
    const std::optional<long> number = parse_integer(part);
    // Numbers beyond any image are told as such later.
    constexpr long kFar = 1'000'000;
    if (number) numbers.push_back(static_cast<int>(std::clamp(*number, -kFar, kFar)));
  }
  if (parts.size() != 2 || numbers.size() != 2) {
    throw InputError(fmt::format(
        "--pixel {}: give X,Y, two whole numbers counted from the top left pixel 0,0", text));
  }
  return {numbers[0], numbers[1]};
}

Pixel worst_pixel(const FrameSetup& frame, const ModelFrame& model) {
  const Accuracy accuracy = measure_accuracy(frame, model, false);
  if (accuracy.worst_pixels.empty()) return {};  // told as not covered
  const std::size_t index = accuracy.worst_pixels.front().index;
  const auto width = static_cast<std::size_t>(frame.width);
  return {static_cast<int>(index % width), static_cast<int>(index / width)};
}

int explain(const Options& options) {
  if (options.pixel.empty() != options.worst) {
    throw InputError("which pixel? Give --pixel X,Y or --worst");
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
  build.progress = [&](const std::string& what) { progress("building the RTL for " + what); };
  const RtlLibrary library(frame.setup.configuration, build);
  progress("simulating SystemC and RTL");
  add_cycles(frame, library, story);
  progress.clear();
  write_output(options.json, pixel_json(story).dump(2) + "\n");
  if (options.json != "-") print_or_throw(pixel_text(story));
  return 0;
}

}  // namespace

void add_explain(CLI::App& application, Run& run) {
  auto options = std::make_shared<Options>();
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
  command->footer("Example: phongpipe explain teapot --pixel 185,245\n");
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return explain(*options); }; });
}

}  // namespace phongpipe
