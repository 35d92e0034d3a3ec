// phongpipe verify: every pixel three ways, accuracy, and the time budget.
#include <fmt/format.h>

#include <memory>

#include "model/scene/input_error.h"
#include "testbench/commands/options.h"
#include "testbench/reports/verification_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct Options {
  std::vector<std::string> scenes;
  HardwareOptions hardware;
  VerificationOptions verification;
  std::string json;
};

int verify_scenes(Options options) {
  Progress progress;
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  bool passed = true;
  for (const std::string& scene : options.scenes) {
    options.verification.progress = [&](const std::string& what) {
      progress(fmt::format("{}: {}", scene, what));
    };
    const Verification verification = verify(find_scene(scene), hardware, options.verification);
    progress.clear();
    if (options.json != "-") fmt::print("{}", report_text(verification, color_wanted()));
    std::fflush(stdout);
    results.push_back(report_json(verification));
    passed = passed && verification.passed();
  }
  if (!options.json.empty()) {
    const auto& whole = results.size() == 1 ? results.front() : results;
    if (options.json == "-") {
      fmt::print("{}\n", whole.dump(2));
    } else {
      write_text(options.json, whole.dump(2) + "\n");
    }
  }
  return passed ? 0 : 1;
}

}  // namespace

void add_verify(CLI::App& application, Run& run) {
  auto options = std::make_shared<Options>();
  CLI::App* command = application.add_subcommand(
      "verify", "Compute every pixel three ways, compare them, and check the time budget");
  command->add_option("scenes", options->scenes, "Scene files, or names of shipped scenes")
      ->required()
      ->type_name("SCENE");
  VerificationOptions& v = options->verification;
  command->add_option("--budget", v.budget_ns, "Nanoseconds a pixel of the whole frame may take")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  command->add_option("--out", v.pictures, "Folder for result, exact Phong and error map (PNG)")
      ->type_name("DIR");
  command
      ->add_option("--json", options->json,
                   "Write the results as JSON; - is standard output, in place of the report")
      ->type_name("FILE");
  add_choice<Detail>(*command, "--detail", v.detail,
                     {{"span", Detail::span}, {"cycle", Detail::cycle}}, "span",
                     "SystemC by the span, or by every clock (slower)");
  command
      ->add_option("--stall", v.stall_percent,
                   "Random back-pressure: per cent of pixels the framebuffer stalls at")
      ->check(CLI::Range(0, 100));
  command->add_option("--seed", v.seed, "Of the random back-pressure")->capture_default_str();
  add_choice<Effects>(*command, "--effects", v.effects,
                      {{"scene", Effects::derived}, {"all", Effects::all}}, "scene",
                      "Build and simulate what the scene's effects need, or everything there is");
  command->add_option("--rtl", v.rtl_sources, "Folder of the RTL to verify, if not the installed")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  command->footer(
      "Exit status: 0 all holds, 1 a check failed, 2 bad usage or input.\n"
      "Example: phongpipe verify scene.toml --budget 80 --set rom_address_bits=12 --out "
      "pictures\n");
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return verify_scenes(*options); }; });
}

}  // namespace phongpipe
