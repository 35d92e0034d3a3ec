// phongpipe compare: all shading methods, accuracy against time.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/options.h"
#include "testbench/cosim/run.h"
#include "testbench/methods/certified_curve.h"
#include "testbench/methods/curves.h"
#include "testbench/methods/operation_time.h"
#include "testbench/reports/comparison_report.h"
#include "testbench/reports/curve_report.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

struct CompareCommandOptions {
  std::vector<std::string> scenes;
  HardwareOptions hardware;
  std::string curve;
  std::optional<PowerKind> power;
  bool microvax = false;
  std::filesystem::path out;
  std::string json, csv;
};

struct NamedCurve {
  std::string name;  // of its files
  Curve curve;
};

constexpr const char *kMaxError = "max-error", *kSize = "size";  // the curves that are of scenes

std::vector<NamedCurve> curves_of_scenes(const CompareCommandOptions& options,
                                         const CurveOptions& how) {
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  std::vector<NamedCurve> curves;
  for (const std::string& name : options.scenes) {
    const auto scene =
        std::make_shared<const PreparedScene>(load_named_scene(name, options.hardware.overrides));
    curves.push_back({fmt::format("max-error-{}", std::filesystem::path(name).stem().string()),
                      certified_curve(scene, hardware, how.progress)});
  }
  return curves;
}

std::vector<NamedCurve> draw_curves(const CompareCommandOptions& options, const CurveOptions& how) {
  if (options.curve == kMaxError) return curves_of_scenes(options, how);
  constexpr double kShininess = 20;
  if (options.curve == "curvature") {
    return {{"curvature-diffuse", curvature_curve(Parts::diffuse, kShininess, how)},
            {"curvature", curvature_curve(Parts::full, kShininess, how)}};
  }
  if (options.curve == "exponent") return {{"exponent", exponent_curve(10, how)}};
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  const PipelineConfiguration& units = hardware.pipeline;
  const auto on_units = [&units](const OperationCounts& counts) { return clocks(counts, units); };
  // Of one light and the default's channels, if no scene is given.
  const std::string scene = options.scenes.empty() ? "sphere" : options.scenes.front();
  const auto prepared =
      std::make_shared<const PreparedScene>(load_named_scene(scene, options.hardware.overrides));
  return {{"size-diffuse", size_curve(Parts::diffuse, PowerKind::table, on_units, how)},
          {"size", size_curve(Parts::full, PowerKind::table, on_units, how)},
          {"size-blocks", block_curve(prepared, hardware, VerificationOptions().budget_ns)},
          {"size-break-even", break_even_curve(units)}};
}

// Standard output is for people, unless a file takes it.
bool is_told(const CompareCommandOptions& options) {
  return options.json != "-" && options.csv != "-";
}

// What there is besides what is told.
void tell_more(const std::vector<std::filesystem::path>& files) {
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const std::filesystem::path& file : files) names.push_back(printable(file.string()));
  if (!names.empty()) print_or_throw(fmt::format("  more     {}\n", fmt::join(names, ", ")));
}

// The results as JSON and CSV, to where they are wanted.
void write_results(const CompareCommandOptions& options, const nlohmann::ordered_json& json,
                   const std::string& csv) {
  write_output(options.json, json.dump(2) + "\n");
  write_output(options.csv, csv);
}

void compare_by_curves(const CompareCommandOptions& options) {
  Progress progress;
  CurveOptions how;
  how.progress = [&progress](const std::string& what) { progress(what); };
  const std::vector<NamedCurve> curves = draw_curves(options, how);
  progress.clear();
  std::vector<std::filesystem::path> files;
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  std::string csv;
  for (const auto& [name, curve] : curves) {
    if (is_told(options)) print_or_throw(curve_text(curve));
    json.push_back(curve_json(curve));
    csv += fmt::format("# {}\n{}", curve.title, curve_csv(curve));
    if (options.out.empty()) continue;
    make_folder(options.out);
    files.insert(files.end(), {options.out / (name + ".csv"), options.out / (name + ".svg")});
    write_text(files[files.size() - 2], curve_csv(curve));
    write_text(files.back(), svg(chart_of(curve)));
  }
  write_results(options, json, csv);
  if (files.empty()) files = {"--out DIR", "--csv FILE"};
  if (is_told(options)) tell_more(files);
}

// The command that renders a scene with the same hardware.
std::string render_command(const CompareCommandOptions& options, const std::string& scene) {
  std::string text = "phongpipe render " + shell_word(scene);
  const HardwareOptions& hardware = options.hardware;
  if (hardware.hardware != HardwareOptions().hardware) {
    text += " --hardware " + shell_word(hardware.hardware);
  }
  for (const std::string& setting : hardware.overrides) text += " --set " + shell_word(setting);
  if (options.power) text += fmt::format(" --power {}", name(*options.power));
  return text;
}

// Nothing that is asked for is left out without a word.
void check(const CompareCommandOptions& options) {
  const std::size_t scenes = options.scenes.size();
  if (scenes == 0 && options.curve.empty() && !options.microvax) {
    throw InputError("nothing to compare: give scenes, --curve NAME or --microvax");
  }
  const bool files = !options.json.empty() || !options.csv.empty() || !options.out.empty();
  if (options.microvax && (scenes > 0 || !options.curve.empty() || files)) {
    throw InputError(
        "--microvax is a table by itself: leave out scenes, --curve, --out, --json and --csv");
  }
  if (options.json == "-" && options.csv == "-") {
    throw InputError("--json - and --csv - both go to standard output: give one of them a file");
  }
  if (options.curve == kMaxError && scenes == 0) {
    throw InputError("--curve max-error is of scenes: compare SCENE --curve max-error");
  }
  if (options.curve == kSize && scenes > 1) {
    throw InputError("--curve size is of one scene: give one, or none for the sphere");
  }
  const bool of_scenes = options.curve == kMaxError || options.curve == kSize;
  if (!options.curve.empty() && !of_scenes && scenes > 0) {
    throw InputError(fmt::format("--curve {} is of random triangles: leave out {}", options.curve,
                                 printable(fmt::format("{}", fmt::join(options.scenes, " ")))));
  }
  check_output(options.json);
  check_output(options.csv);
  if (!options.out.empty()) check_outputs(options.out, {options.out / "a-page"});
}

void compare_methods(const CompareCommandOptions& options) {
  Progress progress;
  const Hardware hardware = load_hardware(options.hardware.hardware, options.hardware.overrides);
  nlohmann::ordered_json results = nlohmann::ordered_json::array();
  std::string csv;
  std::vector<Scene> scenes;
  for (const std::string& name : options.scenes)
    scenes.push_back(load_named_scene(name, options.hardware.overrides));
  for (const Scene& scene : scenes) {
    const Comparison comparison = compare(
        scene, hardware, [&](const std::string& what) { progress(what); },
        options.power.value_or(PowerKind::exact));
    progress.clear();
    std::vector<std::filesystem::path> files;
    if (!options.out.empty()) {
      files =
          write_comparison_page(comparison, render_command(options, comparison.scene), options.out);
    }
    if (is_told(options)) {
      if (results.size() > 0) print_or_throw("\n");
      print_or_throw(fmt::format("{}\n", fmt::join(comparison_answer(comparison), "\n")));
      tell_more(files);
      print_or_throw("\n" + comparison_text(comparison));
    }
    results.push_back(comparison_json(comparison));
    const std::string rows = comparison_csv(comparison);
    csv += csv.empty() ? rows : rows.substr(rows.find('\n') + 1);
  }
  write_results(options, results, csv);
}

int compare(const CompareCommandOptions& options) {
  check(options);
  if (options.microvax) {
    print_or_throw(microvax_text());
  } else if (!options.curve.empty()) {
    compare_by_curves(options);
  } else {
    compare_methods(options);
  }
  return 0;
}

}  // namespace

void add_compare(CLI::App& application, Run& run) {
  auto options = std::make_shared<CompareCommandOptions>();
  CLI::App* command = application.add_subcommand(
      "compare", "Compare all shading methods: operations, time and accuracy");
  command->add_option("scenes", options->scenes, "Scene files, or names of shipped scenes")
      ->type_name("SCENE");
  command
      ->add_option("--out", options->out,
                   "Folder for a page with plot, pictures and error maps, or for the curves")
      ->type_name("DIR");
  command
      ->add_option("--json", options->json,
                   "Write the results as JSON; - is standard output, in place of the table")
      ->type_name("FILE");
  command
      ->add_option("--csv", options->csv,
                   "Write the table, or the curves, as CSV; - as with --json")
      ->type_name("FILE");
  command
      ->add_option(
          "--curve", options->curve,
          "In place of the methods' table, a curve over all of them: error over curvature, "
          "clocks over triangle size, or error over the exponent; or, of scenes, time over "
          "the error that is proved")
      ->check(CLI::IsMember({"curvature", kSize, "exponent", kMaxError}));
  command->add_flag("--microvax", options->microvax,
                    "The paper's timings beside the operations counted");
  command->footer(
      "Example: phongpipe compare teapot --out out\n"
      "         phongpipe compare --curve curvature --out out\n"
      "         phongpipe compare teapot --curve max-error --out out\n");
  add_power_option(*command, options->power);
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return compare(*options); }; });
}

}  // namespace phongpipe
