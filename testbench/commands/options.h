// The commands of the program, one file each. Each adds its options to the application, and sets
// `run` when it is the one that was called.
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

#include "model/scene/scene.h"
#include "model/shading/methods/power.h"
#include "testbench/system/terminal.h"

namespace phongpipe {

// The exit status of the program, besides 0 where all holds.
constexpr int kCheckFailed = 1, kBadInput = 2, kToolFailed = 3;

using Run = std::function<int()>;  // returns the exit status

void add_compare(CLI::App& application, Run& run);
void add_render(CLI::App& application, Run& run);
void add_verify(CLI::App& application, Run& run);

// A scene by its file, or by the name of a shipped one; messages call it by `name`. Throws
// InputError.
Scene load_named_scene(const std::string& name);

// What --help-settings prints.
std::string settings_help();

// What several commands take.
struct HardwareOptions {
  std::string hardware = "default";
  std::vector<std::string> overrides;

  void add_to(CLI::App& command);
};

// An option whose value is one of some words. `Value`: the enumeration, or an optional of it.
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

// Where a result goes: a file, standard output for "-", nowhere for an empty name.
void write_output(const std::string& file, const std::string& text);
// Throws InputError where write_output() could not, before the work.
void check_output(const std::string& file);
// Throws InputError where `files`, all of one folder that need not be there yet, cannot be written;
// changes nothing.
void check_outputs(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& files);

// --power: how the power of highlights is computed by the methods in real arithmetic.
void add_power_option(CLI::App& command, std::optional<PowerKind>& power);

}  // namespace phongpipe
