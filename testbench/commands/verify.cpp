// phongpipe verify: every pixel three ways, accuracy, and the time budget.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/commands/hard_cases.h"
#include "testbench/commands/options.h"
#include "testbench/reports/timeline_report.h"
#include "testbench/reports/verification_json.h"
#include "testbench/reports/verification_page.h"
#include "testbench/reports/verification_report.h"
#include "testbench/system/output_file.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/failure.h"

namespace phongpipe {
namespace {

struct VerifyCommandOptions {
  std::vector<std::string> scenes;
  HardwareOptions hardware;
  VerificationOptions verification;
  std::filesystem::path pictures;
  std::string json;
  std::filesystem::path timeline;
  bool verbose = false;
  bool hard_cases = false;  // in place of scenes
};

// Names for the scenes' pictures: the file's without folder and extension, numbered where two are
// the same.
std::vector<std::string> picture_names(const std::vector<std::string>& scenes) {
  std::map<std::string, int> uses;
  std::vector<std::string> names;
  for (const std::string& scene : scenes) {
    std::string name = std::filesystem::path(scene).stem().string();
    const int use = ++uses[name];
    if (use > 1) name += fmt::format("-{}", use);
    names.push_back(name);
  }
  return names;
}

class Verifier {
 public:
  explicit Verifier(const VerifyCommandOptions& options)
      : options_(options),
        hardware_(load_hardware(options.hardware.hardware, options.hardware.overrides)),
        names_(picture_names(options.scenes)) {}

  // The exit status.
  int run() {
    // A mistake in the last scene must not cost the work on those before.
    std::vector<Scene> scenes;
    for (const std::string& name : options_.scenes)
      scenes.push_back(load_named_scene(name, options_.hardware.overrides));
    check_outputs();
    for (std::size_t i = 0; i < scenes.size(); ++i) verify_scene(scenes[i], names_[i]);
    if (scenes.size() > 1 && options_.json != "-") {
      print_or_throw(fmt::format("{} of {} passed\n", passed_, scenes.size()));
    }
    write_output(options_.json, json_text());
    if (!options_.pictures.empty()) write_text(page_file(), page_.text());
    if (status_ == 0 && passed_ < scenes.size()) status_ = kCheckFailed;
    return status_;
  }

 private:
  // A scene that cannot be verified does not keep the others from it.
  void verify_scene(const Scene& scene, const std::string& name) {
    const auto show_step = [&](const std::string& what) {
      progress_(fmt::format("{}: {}", scene.source, what));
    };
    try {
      const auto prepared = std::make_shared<const PreparedScene>(scene);
      std::optional<WrittenPictures> pictures;
      const auto write_pictures = [&](const VerificationResult& result) {
        make_folder(options_.pictures);
        pictures.emplace(result, picture_files(options_.pictures, name));
      };
      const VerificationResult result =
          verify(prepared, hardware_, options_.verification, show_step, write_pictures);
      if (pictures) pictures->wait();
      if (!options_.timeline.empty()) {
        show_step("recording the timeline");
        write_timeline(record_timeline(prepared, hardware_, options_.verification), scene.source);
      }
      if (!result.agrees()) show_step("tracing what differs");
      const FailureFiles failure = keep_failure(prepared, result, name);
      progress_.clear();
      show(scene, result, name, failure);
      if (!options_.pictures.empty()) {
        add_to_page(scene, summary_of(result));
        page_.add_pictures(picture_files(options_.pictures, name));
        if (timeline_is_beside_page()) {
          page_.add_picture("timeline", timeline_picture_file());
        }
      }
      results_.push_back(report_json(result, failure.capsule.string()));
      passed_ += result.passed() ? 1 : 0;
    } catch (const std::exception& error) {
      progress_.clear();
      if (options_.scenes.size() == 1) throw;
      const bool input = dynamic_cast<const InputError*>(&error) != nullptr;
      status_ = std::max(status_, input ? kBadInput : kToolFailed);
      tell("phongpipe: " + printable(error.what()));
      if (input) add_to_page(scene, refused(error.what()));
      results_.push_back(
          {{"scene", scene.source}, {"passed", false}, {"error", printable(error.what())}});
    }
  }

  // That it cannot be written does not keep the report from its reader.
  FailureFiles keep_failure(const std::shared_ptr<const PreparedScene>& scene,
                            const VerificationResult& result, const std::string& name) const {
    try {
      return write_failure(scene, result, failure_folder(), name);
    } catch (const std::exception& error) {
      tell(fmt::format("phongpipe: the failure is not kept: {}; --out names another folder",
                       printable(error.what())));
      return {};
    }
  }

  void write_timeline(const Timeline& timeline, const std::string& scene) const {
    if (timeline_is_beside_page()) make_folder(options_.pictures);
    write_text(options_.timeline, timeline_json(timeline, scene));
    write_text(timeline_picture_file(), timeline_picture(timeline, scene));
  }

  void show(const Scene& scene, const VerificationResult& result, const std::string& name,
            const FailureFiles& failure) const {
    ReportStyle style;
    style.color = color_wanted();
    style.verbose = options_.verbose;
    style.command = command_of(request_of(scene));
    if (!options_.json.empty() && options_.json != "-") {
      style.more.push_back(printable(options_.json));
    }
    if (!options_.pictures.empty()) {
      const auto files = picture_files(options_.pictures, name);
      style.more.push_back(printable(files.back().string()));
      if (options_.scenes.size() == 1) style.more.push_back(printable(page_file().string()));
    }
    if (!options_.timeline.empty()) {
      style.more.push_back(printable(options_.timeline.string()));
      style.more.push_back(printable(timeline_picture_file().string()));
    }
    for (const std::filesystem::path& file : {failure.trace, failure.capsule}) {
      if (!file.empty()) style.more.push_back(printable(file.string()));
    }
    if (options_.json == "-") return;
    print_or_throw(options_.scenes.size() == 1 ? report_text(result, style)
                                               : report_line(result, style));
  }

  // What cannot be written is said before the work.
  void check_outputs() const {
    check_output(options_.json);
    const bool beside = timeline_is_beside_page();  // in a folder that need not exist yet
    if (!options_.timeline.empty() && !beside) {
      check_writable(options_.timeline);
      check_writable(timeline_picture_file());
    }
    if (options_.pictures.empty()) return;
    std::vector<std::filesystem::path> files = {page_file()};
    if (beside) files.insert(files.end(), {options_.timeline, timeline_picture_file()});
    for (const std::string& name : names_) {
      for (const auto& file : picture_files(options_.pictures, name)) files.push_back(file);
    }
    phongpipe::check_outputs(options_.pictures, files);
  }

  bool timeline_is_beside_page() const {
    const auto plain = [](const std::filesystem::path& path) {
      return std::filesystem::absolute(path).lexically_normal();
    };
    return !options_.timeline.empty() && !options_.pictures.empty() &&
           plain(options_.timeline).parent_path() / "" == plain(options_.pictures / "");
  }
  std::filesystem::path failure_folder() const {
    return options_.pictures.empty() ? std::filesystem::path(kFailureFolder) : options_.pictures;
  }
  std::filesystem::path page_file() const { return options_.pictures / "verify.html"; }
  std::filesystem::path timeline_picture_file() const {
    return std::filesystem::path(options_.timeline).replace_extension(".svg");
  }
  void add_to_page(const Scene& scene, RunResult result) {
    const RunRequest request = request_of(scene);
    page_.add(scene.source, request.hardware, command_of(request), std::move(result));
  }
  RunRequest request_of(const Scene& scene) const {
    return {scene.source, options_.hardware.hardware, options_.hardware.overrides,
            options_.verification};
  }

  std::string json_text() const {
    return (results_.size() == 1 ? results_.front() : results_).dump(2) + "\n";
  }

  const VerifyCommandOptions& options_;
  Hardware hardware_;
  std::vector<std::string> names_;
  Progress progress_;
  VerificationPage page_;  // filled in if pictures are wanted
  nlohmann::ordered_json results_ = nlohmann::ordered_json::array();
  std::size_t passed_ = 0;
  int status_ = 0;
};

void add_run_option(CLI::App& command, const RunOption& option, VerificationOptions& options) {
  const auto put = [&option, &options](const std::string& text) { option.put(options, text); };
  command
      .add_option_function<std::string>("--" + std::string(option.name), put,
                                        std::string(option.meaning))
      ->type_name(std::string(option.type))
      ->default_str(option.get(options));
}

int verify_scenes(VerifyCommandOptions options) {
  if (options.hard_cases) {
    if (!options.timeline.empty() || !options.hardware.overrides.empty()) {
      throw InputError(
          "--hard-cases: each case brings its scene and settings; only --out, --json, --verbose "
          "and --rtl go with it, and names of cases");
    }
    return verify_hard_cases({options.scenes, options.pictures, options.json,
                              options.verification.rtl_sources, options.verbose});
  }
  if (options.scenes.empty()) {
    throw InputError(
        "nothing to verify: give scenes, or --hard-cases; see phongpipe verify --help");
  }
  options.verification.pictures = !options.pictures.empty();
  if (!options.timeline.empty()) {
    if (options.timeline.extension() != ".json") {
      throw InputError(fmt::format("--timeline {}: a file .json, beside which a picture .svg goes",
                                   printable(options.timeline.string())));
    }
    if (options.scenes.size() > 1) throw InputError("--timeline is of one scene; give one");
  }
  return Verifier(options).run();
}

}  // namespace

void add_verify(CLI::App& application, Run& run) {
  auto options = std::make_shared<VerifyCommandOptions>();
  CLI::App* command = application.add_subcommand(
      "verify", "Compute every pixel three ways, compare them, and check the time budget");
  command->add_option("scenes", options->scenes, "Scene files, or names of shipped scenes")
      ->type_name("SCENE");
  VerificationOptions& v = options->verification;
  for (const RunOption& option : run_options()) add_run_option(*command, option, v);
  command
      ->add_option("--out", options->pictures,
                   "Folder for result, exact Phong and error map (PNG), and for a page of them")
      ->type_name("DIR");
  command
      ->add_option("--json", options->json,
                   "Write the results as JSON; - is standard output, in place of the report")
      ->type_name("FILE");
  command
      ->add_option(
          "--timeline", options->timeline,
          "Write what each SystemC module does in each cycle, as trace events for Perfetto "
          "(ui.perfetto.dev), and beside them a picture (SVG) of what limits the frame")
      ->type_name("FILE.json");
  command->add_flag("--hard-cases", options->hard_cases,
                    "Verify the shipped hard cases, or those named, a line each; --out gets a "
                    "contact sheet");
  command->add_flag("--synthesize", v.synthesize,
                    "Place and route the RTL for clock and area in the technology's device (20 s; "
                    "needs yosys and nextpnr-ice40)");
  command->add_flag("-v,--verbose", options->verbose,
                    "Tell settings, effects and all metrics after the answer");
  add_rtl_option(*command, v.rtl_sources);
  command->footer(
      "Exit status: 0 all holds, 1 a check failed, 2 bad usage or input, 3 a tool or the machine "
      "failed.\n"
      "Example: phongpipe verify teapot --budget 80 --set rom_address_bits=12 --out pictures\n"
      "         phongpipe verify teapot --technology ice40-up5k --synthesize\n"
      "         phongpipe verify --hard-cases --out hard\n");
  options->hardware.add_to(*command);
  command->callback([options, &run] { run = [options] { return verify_scenes(*options); }; });
}

}  // namespace phongpipe
