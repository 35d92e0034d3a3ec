#include "testbench/commands/options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/cosim/metrics.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/installation.h"
#include "testbench/system/output_file.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
std::string settings_help() {
  const Hardware preset = load_hardware("default", {});
  std::string text =
      "Settings of the hardware, for --set key=value and for hardware files, with the values of "
      "the "
      "preset `default`.\n";
  std::string_view section;
  for (const Setting<Hardware>& setting : hardware_settings()) {
    if (setting.section != section) text += fmt::format("\n[{}]\n", setting.section);
    section = setting.section;
    const std::string range =
        setting.choices.empty()
            ? fmt::format("{} to {}", setting.text(setting.low), setting.text(setting.high))
            : fmt::format("{}", fmt::join(setting.choices, ", "));
    text += fmt::format("  {:<42} {}{}{}; {}\n",
                        fmt::format("{} = {}", setting.key, setting.value(preset)), range,
                        setting.unit.empty() ? "" : " ", setting.unit, setting.meaning);
  }
  return text + fmt::format("\n  {:<42} a card in hw/technology, or a file: the clock\n",
                            fmt::format("technology = {}", preset.technology.name));
}

std::string metrics_help() {
  std::string text = "Metrics of a verification, in reports, JSON, CSV and databases.\n\n";
  for (const Metric& metric : metrics()) {
    const std::string_view better = metric.better == Metric::Better::less   ? "; less is better"
                                    : metric.better == Metric::Better::more ? "; more is better"
                                                                            : "";
    text += fmt::format("  {:<27} {:<6} {}{}\n", metric.name, metric.unit, metric.meaning, better);
  }
  return text;
}

void add_rtl_option(CLI::App& command, std::filesystem::path& rtl_sources) {
  command
      .add_option(
          "--rtl", rtl_sources,
          "Folder of the RTL, if not the installed. It is compiled and run: code with your rights")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory.description(""));
}

void add_stall_options(CLI::App& command, SimulationOptions& simulation) {
  command.add_option("--stall", simulation.stall_percent, "Back-pressure, as in verify")
      ->type_name("0-100")
      ->check(CLI::Range(0, 100).description(""));
  command.add_option("--seed", simulation.stall_seed, "Of the back-pressure")
      ->capture_default_str()
      ->type_name("N");
}

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

void write_output(const std::string& file, const std::string& text) {
  if (file == "-") {
    print_or_throw(text);
  } else if (!file.empty()) {
    write_text(file, text);
  }
}

void check_output(const std::string& file) {
  if (!file.empty() && file != "-") check_writable(file);
}

void check_outputs(const std::filesystem::path& folder,
                   const std::vector<std::filesystem::path>& files) {
  std::error_code none;
  if (std::filesystem::exists(folder, none)) {
    for (const std::filesystem::path& file : files) check_writable(file);
    return;
  }
  // It will be made: the nearest folder that is there must take a new name.
  std::filesystem::path made = std::filesystem::absolute(folder);
  while (!std::filesystem::exists(made.parent_path(), none)) made = made.parent_path();
  check_writable(made);
}

CLI::Validator positive_number() {
  return CLI::Validator(
      [](const std::string& text) {
        const auto number = parse_number(text);
        return number && *number > 0 ? std::string()
                                     : fmt::format("{} is not a number above 0", text);
      },
      "");
}

void add_power_option(CLI::App& command, std::optional<PowerKind>& power) {
  std::vector<std::pair<std::string_view, PowerKind>> kinds;
  for (const PowerKind kind : power_kinds()) kinds.emplace_back(name(kind), kind);
  add_choice(command, "--power", power, kinds, "exact",
             "Power of highlights in real arithmetic: exact, the paper's table, or by Schlick or "
             "Lyon without one; flat, gouraud and phong stay exact");
}

void HardwareOptions::add_to(CLI::App& command) {
  command
      .add_option("--hardware", hardware,
                  "Preset (default, paper-1k, paper-8k) or hardware TOML file")
      ->type_name("PRESET|FILE")
      ->capture_default_str();
  command
      .add_option("--set", overrides,
                  "key=value: change one setting of the hardware, or scene.… of the scene; may be "
                  "given again")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command
      .add_option_function<std::string>(
          "--technology",
          [this](const std::string& card) { overrides.push_back("technology=" + card); },
          "Card that gives the clock: ice40-hx8k, ice40-up5k, ttl-1986, generic, or a TOML file")
      ->type_name("CARD|FILE");
  command.add_flag("--help-settings",
                   "Explain all settings of the hardware, with units and ranges, and exit");
}

}  // namespace phongpipe
