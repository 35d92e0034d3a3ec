// The commands of the program, one file each. Each adds its options to the application, and sets
// `run` if it was called.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/fixed/coverage.h"
#include "model/shading/methods/power.h"
#include "sim/pipeline.h"
#include "testbench/system/terminal.h"

namespace phongpipe {

// Exit statuses of the program besides 0, which means success.
constexpr int kCheckFailed = 1, kBadInput = 2, kToolFailed = 3;

using Run = std::function<int()>;  // returns the exit status

void add_compare(CLI::App& application, Run& run);
void add_diff_traces(CLI::App& application, Run& run);
void add_explain(CLI::App& application, Run& run);
void add_export(CLI::App& application, Run& run);
void add_merge(CLI::App& application, Run& run);
void add_regress(CLI::App& application, Run& run);
void add_render(CLI::App& application, Run& run);
void add_replay(CLI::App& application, Run& run);
void add_report(CLI::App& application, Run& run);
void add_sweep(CLI::App& application, Run& run);
void add_trace(CLI::App& application, Run& run);
void add_verify(CLI::App& application, Run& run);

// The texts of --help-settings and --help-metrics.
std::string settings_help();
std::string metrics_help();

// Options for the hardware, common to several commands.
struct HardwareOptions {
  std::string hardware = "default";
  std::vector<std::string> overrides;

  void add_to(CLI::App& command);
};

// Adds an option whose value is one of the given words. `Value`: the enumeration, or an optional of
// it.
template <typename Enum, typename Value>
void add_choice(CLI::App& command, const std::string& flag, Value& value,
                const std::vector<std::pair<std::string_view, Enum>>& choices,
                const std::string& fallback, const std::string& help) {
  std::string words;
  for (const auto& [word, choice] : choices) {
    words += fmt::format("{}{}", words.empty() ? "" : "|", word);
  }
  const auto set = [&value, choices, flag, words](const std::string& text) {
    for (const auto& [word, choice] : choices) {
      if (text != word) continue;
      value = choice;
      return;
    }
    throw CLI::ValidationError(flag, fmt::format("{} is none of {}", text, words));
  };
  command.add_option_function<std::string>(flag, set, help)
      ->type_name(words)
      ->default_str(fallback);
}

// A finite number above 0.
CLI::Validator positive_number();

// --rtl: other RTL than the installed.
void add_rtl_option(CLI::App& command, std::filesystem::path& rtl_sources);
// --stall and --seed: random back-pressure, as `verify` has it.
void add_stall_options(CLI::App& command, SimulationOptions& simulation);

// X,Y of --pixel. Throws InputError for anything else.
Pixel parse_pixel(const std::string& text);

// Writes a result to a file, to standard output for "-", or nowhere for an empty name.
void write_output(const std::string& file, const std::string& text);
// Throws InputError if write_output() could not write to `file`. Call it before long work.
void check_output(const std::string& file);
// Throws InputError if `files`, all in `folder`, cannot be written; changes nothing. The folder
// need not exist yet.
void check_outputs(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& files);

// --power: how methods in real arithmetic compute the power of highlights.
void add_power_option(CLI::App& command, std::optional<PowerKind>& power);

}  // namespace phongpipe
