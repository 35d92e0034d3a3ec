// The program: parses the command line and runs one command.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <new>

#include "model/files/spelling.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/commands/options.h"
#include "testbench/system/output_file.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

int fail(int status, const std::string& message) {
  // A line that quotes a file may be long; its reason stands at its end.
  constexpr std::size_t kMaxBytes = 1000, kEndBytes = 300;
  std::string shown = message;
  if (shown.size() > kMaxBytes) {
    shown = excerpt(shown, kMaxBytes - kEndBytes) + shown.substr(shown.size() - kEndBytes);
  }
  tell("phongpipe: " + printable(shown));
  return status;
}

// CLI11 would say that a subcommand is required where there is one that it does not know.
void check_command(const CLI::App& application, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::App* command : application.get_subcommands({})) {
    known.push_back(command->get_name());
  }
  if (argc < 2) {
    throw InputError(
        fmt::format("which command? There are {}; see phongpipe --help", fmt::join(known, ", ")));
  }
  const std::string word = argv[1];
  if (word.empty() || word.front() == '-') return;
  if (std::find(known.begin(), known.end(), word) != known.end()) return;
  const std::string close = closest_word(word, known);
  throw InputError(fmt::format(
      "{}: no such command; {}", word,
      close.empty() ? fmt::format("there are {}; see phongpipe --help", fmt::join(known, ", "))
                    : fmt::format("did you mean {}?", close)));
}

// What CLI11 found wrong, the option that a misspelt one is likely to be, and where to read on.
std::string usage_mistake(const CLI::App& application, const CLI::ParseError& error, int argc,
                          char** argv) {
  const std::vector<CLI::App*> called = application.get_subcommands();
  if (called.empty()) return fmt::format("{}; see phongpipe --help", error.what());
  const CLI::App& command = *called.front();
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  }
  const bool is_unknown = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr;
  for (int i = 2; i < argc && is_unknown; ++i) {
    std::string word = argv[i];
    word.resize(std::min(word.size(), word.find('=')));
    const bool is_known = std::find(known.begin(), known.end(), word) != known.end();
    if (word.rfind("--", 0) != 0 || is_known) continue;
    const std::string close = closest_word(word, known);
    if (close.empty()) break;
    return fmt::format("{}: no such option of {}; did you mean {}?", word, command.get_name(),
                       close);
  }
  return fmt::format("{}; see phongpipe {} --help", error.what(), command.get_name());
}

int run_program(int argc, char** argv) {
  CLI::App application(
      "phongpipe simulates the fixed-point pipeline of Bishop & Weimer's Fast Phong Shading "
      "(1986),\n"
      "pixel by pixel in a C++ model, in SystemC and in Verilated RTL.");
  application.name("phongpipe");
  application.require_subcommand(1);
  application.set_version_flag("--version", "phongpipe " PHONGPIPE_VERSION);
  application.footer(
      "`phongpipe COMMAND --help` tells more; --help-settings explains the hardware's settings,\n"
      "--help-metrics what is measured.\n"
      "Exit status: 0 all holds, 1 a check failed, 2 bad usage or input, 3 a tool or the machine "
      "failed.\n"
      "Example: phongpipe verify teapot --out out\n");
  Run run;
  add_verify(application, run);
  add_render(application, run);
  add_compare(application, run);
  add_sweep(application, run);
  add_regress(application, run);
  add_explain(application, run);
  add_trace(application, run);
  add_replay(application, run);
  add_diff_traces(application, run);
  add_report(application, run);
  add_export(application, run);
  add_merge(application, run);
  const auto asked_for = [&](const char* flag) {
    return std::any_of(argv + 1, argv + argc,
                       [flag](const char* word) { return word == std::string_view(flag); });
  };
  const std::pair<const char*, std::string (*)()> texts[] = {{"--help-settings", settings_help},
                                                             {"--help-metrics", metrics_help}};
  for (const auto& [flag, help] : texts) {
    if (!asked_for(flag)) continue;
    print_or_throw(help());
    return 0;
  }
  check_command(application, argc, argv);
  try {
    application.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return application.exit(help);
  } catch (const CLI::ParseError& error) {
    return fail(kBadInput, usage_mistake(application, error, argc, argv));
  }
  return run();
}

}  // namespace
}  // namespace phongpipe

int main(int argc, char** argv) {
  using namespace phongpipe;
  try {
    return run_program(argc, argv);
  } catch (const InputError& error) {
    return fail(kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(kToolFailed, "out of memory");
  } catch (const std::exception& error) {
    return fail(kToolFailed, error.what());
  }
}
