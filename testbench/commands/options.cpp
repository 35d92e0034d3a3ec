#include "testbench/commands/options.h"

#include <fmt/format.h>

#include "testbench/hardware/hardware.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

std::string list_settings() {
  Hardware hardware;
  std::string text;
  for (const Setting& setting : settings(hardware)) {
    text += fmt::format("  {} = {}", setting.name(), setting.value());
    if (!setting.choices.empty()) {
      text += " of";
      for (const auto choice : setting.choices) text += fmt::format(" {}", choice);
    }
    text += "\n";
  }
  return text + "  technology = ice40-hx8k\n";
}

}  // namespace

std::filesystem::path find_scene(const std::string& name) {
  return find_named(name, installation().scenes, "scene");
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
      ->capture_default_str();
  command
      .add_option("--set", overrides,
                  "key=value: change one setting of the hardware; may be given again")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.footer(command.get_footer() +
                 "\nSettings for --set and hardware files, with defaults:\n" + list_settings());
}

}  // namespace phongpipe
