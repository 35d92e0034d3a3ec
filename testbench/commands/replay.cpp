// phongpipe replay: shows the divergence of a capsule again.
#include <fmt/format.h>

#include <memory>

#include "model/scene/input_error.h"
#include "testbench/commands/options.h"
#include "testbench/reports/verification_json.h"
#include "testbench/reports/verification_report.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/system/output_file.h"
#include "testbench/system/terminal.h"
#include "testbench/trace/capsule.h"

namespace phongpipe {
namespace {

struct ReplayCommandOptions {
  std::filesystem::path capsule, rtl_sources;
  std::string json;
  bool anyway = false;
};

int replay(const ReplayCommandOptions& options) {
  Capsule capsule = read_capsule(options.capsule, options.anyway);
  capsule.options.rtl_sources = options.rtl_sources;
  if (rtl_hash(options.rtl_sources) != capsule.rtl_hash && !options.anyway) {
    throw InputError(fmt::format(
        "{}: found in other RTL; give its folder with --rtl, or replay it with this RTL "
        "by --anyway",
        printable(options.capsule.string())));
  }
  check_output(options.json);
  Progress progress;
  const VerificationResult result = verify(capsule.scene, capsule.hardware, capsule.options,
                                           [&](const std::string& what) { progress(what); });
  progress.clear();
  const std::string found = divergence_text(result);
  const bool same = found == capsule.found;
  write_output(options.json, report_json(result).dump(2) + "\n");
  if (options.json != "-") {
    ReportStyle style;
    style.color = color_wanted();
    print_or_throw(report_text(result, style));
    print_or_throw(same ? "  replay   the same divergence as recorded\n"
                        : fmt::format("  replay   recorded was {}{}\n", printable(capsule.found),
                                      capsule.same_program ? "" : ", by another program file"));
  }
  return result.passed() ? 0 : kCheckFailed;
}

}  // namespace

void add_replay(CLI::App& application, Run& run) {
  auto options = std::make_shared<ReplayCommandOptions>();
  CLI::App* command =
      application.add_subcommand("replay", "Show the divergence of a capsule again");
  command->add_option("capsule", options->capsule, "File that verify or regress has written")
      ->required()
      ->type_name("CAPSULE");
  add_rtl_option(*command, options->rtl_sources);
  command->add_flag("--anyway", options->anyway,
                    "Also with other RTL, another version, or a capsule changed by hand");
  command->add_option("--json", options->json, "Write the result as JSON; - is standard output")
      ->type_name("FILE");
  command->footer(
      "Exit status: 0 it does not fail any more, 1 it fails, 2 refused.\n"
      "Example: phongpipe replay phongpipe-failures/pawn.toml --rtl my-rtl\n");
  command->callback([options, &run] { run = [options] { return replay(*options); }; });
}

}  // namespace phongpipe
