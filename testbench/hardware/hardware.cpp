#include "testbench/hardware/hardware.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/files/spelling.h"
#include "model/files/text_file.h"
#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/system/fnv_hash.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

using HardwareSetting = Setting<Hardware>;

// The value that `text` names, or an explanation of what would be right.
struct ParsedValue {
  std::optional<int> value;
  std::string complaint;
};

// So many fit an int in parts of any setting's unit.
constexpr double kMostUnits = 1e5;

ParsedValue parse_value(const HardwareSetting& setting, std::string_view text) {
  if (setting.per_unit > 1) {
    const auto number = parse_number(text);
    if (number && std::fabs(*number) < kMostUnits) return {setting.parts(*number), {}};
    return {{}, fmt::format("{} takes a number", setting.key)};
  }
  if (setting.choices.empty()) {
    const auto integer = parse_integer(text);
    if (integer && *integer == static_cast<int>(*integer)) return {static_cast<int>(*integer), {}};
    return {{}, fmt::format("{} takes a whole number", setting.key)};
  }
  const auto found = std::find(setting.choices.begin(), setting.choices.end(), text);
  if (found != setting.choices.end()) {
    return {static_cast<int>(found - setting.choices.begin()), {}};
  }
  return {{}, fmt::format("{} is one of {}", setting.key, fmt::join(setting.choices, ", "))};
}

void read_settings(Hardware& hardware, const TomlTable& table, std::string& technology) {
  technology = table.text("technology", technology);
  std::string_view section;
  std::optional<TomlTable> part;
  for (const HardwareSetting& setting : hardware_settings()) {
    if (setting.section != section) {
      if (part) part->finish();
      section = setting.section;
      part = table.optional_table(section);
    }
    if (!part || !part->has(setting.key)) continue;
    if (setting.per_unit > 1) {
      setting.put(hardware, setting.parts(part->number(setting.key, {-kMostUnits, kMostUnits})));
    } else if (setting.choices.empty()) {
      setting.put(hardware, part->integer(setting.key, std::numeric_limits<int>::min(),
                                          std::numeric_limits<int>::max()));
    } else {
      const auto [value, complaint] = parse_value(setting, part->text(setting.key));
      if (!value) part->fail(setting.key, complaint);
      setting.put(hardware, *value);
    }
    try {
      setting.check(hardware);
    } catch (const InputError& error) {
      part->fail(setting.key, error.what());
    }
  }
  if (part) part->finish();
  table.finish();
}

void apply_override(Hardware& hardware, const std::string& text, std::string& technology) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    throw InputError(fmt::format("--set {}: write key=value, as in rom_address_bits=12", text));
  }
  const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
  if (key == "technology") {
    technology = value;
    return;
  }
  for (const HardwareSetting& setting : hardware_settings()) {
    if (!setting.is_called(key)) continue;
    const ParsedValue parsed = parse_value(setting, value);
    if (!parsed.value) throw InputError(fmt::format("--set {}: {}", text, parsed.complaint));
    setting.put(hardware, *parsed.value);
    try {
      setting.check(hardware);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--set {}: {}", text, error.what()));
    }
    return;
  }
  std::vector<std::string> known = {"technology"};
  for (const HardwareSetting& setting : hardware_settings()) {
    known.emplace_back(setting.name());
    known.emplace_back(setting.key);
  }
  const std::string close = closest_word(key, known);
  throw InputError(fmt::format("--set {}: unknown key; {}", text,
                               close.empty() ? "`phongpipe verify --help-settings` lists them"
                                             : fmt::format("did you mean {}?", close)));
}

Settings<Hardware> all_settings() {
  Settings<Hardware> all;
  const auto add = [&all](const auto& settings, auto part) {
    for (const auto& setting : settings) all.push_back(setting.of(part));
  };
  add(SetupPolicy::settings(), &Hardware::setup);
  add(PipelineConfiguration::settings(), &Hardware::pipeline);
  add(FixedPointFormats::settings(), &Hardware::formats);
  const auto place = [](const HardwareSetting& setting) {
    static constexpr std::string_view kSections[] = {"datapath",    "setup_engine", "exact_path",
                                                     "span_walker", "framebuffer",  "queues"};
    return std::find(std::begin(kSections), std::end(kSections), setting.section);
  };
  std::stable_sort(all.begin(), all.end(), [&](const HardwareSetting& a, const HardwareSetting& b) {
    return place(a) < place(b);
  });
  return all;
}

void apply_overrides(Hardware& hardware, const std::vector<std::string>& overrides,
                     std::string& technology) {
  for (const std::string& text : overrides) {
    if (!is_scene_key(text)) apply_override(hardware, text, technology);
  }
}

}  // namespace

const Settings<Hardware>& hardware_settings() {
  static const Settings<Hardware> all = all_settings();
  return all;
}

Hardware load_hardware(const std::string& name, const std::vector<std::string>& overrides) {
  Hardware hardware;
  std::string technology = "ice40-hx8k";
  const auto file = find_named(name, installation().hardware / "presets", "preset");
  hardware.name = file.stem().string();
  read_settings(hardware, TomlTable::read_file(file), technology);
  apply_overrides(hardware, overrides, technology);
  hardware.technology = load_technology(technology);
  return hardware;
}

Hardware parse_hardware(const std::string& text, const std::filesystem::path& file) {
  Hardware hardware;
  std::string technology;
  hardware.name = file.stem().string();
  read_settings(hardware, TomlTable::read_text(text, file), technology);
  hardware.technology = load_technology(technology);
  return hardware;
}

Hardware override_hardware(Hardware hardware, const std::vector<std::string>& overrides) {
  std::string technology;
  apply_overrides(hardware, overrides, technology);
  if (!technology.empty()) hardware.technology = load_technology(technology);
  return hardware;
}

Hardware resolved(const Hardware& hardware, const EffectBlocks& blocks) {
  Hardware result = hardware;
  result.formats.channel_choice = blocks.channels == 1 ? ChannelChoice::one : ChannelChoice::three;
  result.formats.gate_choice = blocks.gate;
  return result;
}

std::string method_of(const Hardware& hardware, const Scene& scene) {
  std::string name(series_fit_names()[static_cast<std::size_t>(hardware.setup.series_fit)]);
  if (scene.shading.viewer == Viewer::local) name += kLocalSuffix;
  return name;
}

std::string configuration_hash(const Hardware& resolved_hardware) {
  FnvHash hash;
  const auto add = [&hash](const std::string& text) {
    for (const char c : text + "\n") {
      hash.add(static_cast<unsigned char>(c));
    }
  };
  for (const HardwareSetting& setting : hardware_settings()) {
    add(setting.name() + "=" + setting.value(resolved_hardware));
  }
  add("technology=" + resolved_hardware.technology.name);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace phongpipe
