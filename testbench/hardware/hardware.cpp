#include "testbench/hardware/hardware.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>

#include "model/files/spelling.h"
#include "model/files/text_file.h"
#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/system/fnv_hash.h"
#include "testbench/system/installation.h"

namespace phongpipe {
namespace {

template <typename Enum>
Setting choice(std::string_view section, std::string_view key,
               std::vector<std::string_view> choices, Enum& value) {
  return {section, key, std::move(choices), [&value] { return static_cast<int>(value); },
          [&value](int index) { value = static_cast<Enum>(index); }};
}

Setting number(std::string_view section, std::string_view key, int& value) {
  return {section, key, {}, [&value] { return value; }, [&value](int set) { value = set; }};
}

void check(const Hardware& hardware) {
  hardware.datapath.check();
  hardware.pipeline.check();
}

void read_file(Hardware& hardware, const std::filesystem::path& file, std::string& technology) {
  const TomlTable table = TomlTable::read_file(file);
  technology = table.text("technology", technology);
  std::vector<Setting> all = settings(hardware);
  while (!all.empty()) {
    const std::string section(all.front().section);
    const auto in_section = [&section](const Setting& s) { return s.section == section; };
    if (const auto part = table.optional_table(section)) {
      for (const Setting& setting : all) {
        if (!in_section(setting) || !part->has(setting.key)) continue;
        if (setting.choices.empty()) {
          setting.put(part->integer(setting.key, std::numeric_limits<int>::min(),
                                    std::numeric_limits<int>::max()));
        } else {
          const std::string text = part->text(setting.key);
          const auto found = std::find(setting.choices.begin(), setting.choices.end(), text);
          if (found == setting.choices.end()) {
            part->fail(setting.key, fmt::format("{} = \"{}\" is none of {}", setting.key, text,
                                                fmt::join(setting.choices, ", ")));
          }
          setting.put(static_cast<int>(found - setting.choices.begin()));
        }
        try {
          check(hardware);
        } catch (const InputError& error) {
          part->fail(setting.key, error.what());
        }
      }
      part->finish();
    }
    all.erase(std::remove_if(all.begin(), all.end(), in_section), all.end());
  }
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
  std::vector<std::string> known = {"technology"};
  for (const Setting& setting : settings(hardware)) {
    known.emplace_back(setting.name());
    known.emplace_back(setting.key);
    if (key != setting.key && key != setting.name()) continue;
    const auto found = std::find(setting.choices.begin(), setting.choices.end(), value);
    if (!setting.choices.empty() && found == setting.choices.end()) {
      throw InputError(fmt::format("--set {}: {} is one of {}", text, setting.key,
                                   fmt::join(setting.choices, ", ")));
    }
    const auto integer = parse_integer(value);
    if (setting.choices.empty() && (!integer || *integer != static_cast<int>(*integer))) {
      throw InputError(fmt::format("--set {}: {} takes a whole number", text, setting.key));
    }
    setting.put(setting.choices.empty() ? static_cast<int>(*integer)
                                        : static_cast<int>(found - setting.choices.begin()));
    try {
      check(hardware);
    } catch (const InputError& error) {
      throw InputError(fmt::format("--set {}: {}", text, error.what()));
    }
    return;
  }
  const std::string close = closest_word(key, known);
  throw InputError(fmt::format("--set {}: unknown key; {}", text,
                               close.empty() ? "`phongpipe verify --help` lists them"
                                             : fmt::format("did you mean {}?", close)));
}

}  // namespace

std::string Setting::name() const {
  return fmt::format("{}.{}", section, key);
}

std::string Setting::value() const {
  return choices.empty() ? fmt::format("{}", get())
                         : std::string(choices[static_cast<std::size_t>(get())]);
}

std::vector<Setting> settings(Hardware& hardware) {
  DatapathConfiguration& d = hardware.datapath;
  PipelineConfiguration& p = hardware.pipeline;
  Setting channels = {"datapath", "channels", {"auto", "1", "3"}, nullptr, nullptr};
  channels.get = [&hardware] {
    return hardware.choose_channels ? 0 : (hardware.datapath.channels + 1) / 2;
  };
  channels.put = [&hardware](int index) {
    hardware.choose_channels = index == 0;
    if (index > 0) hardware.datapath.channels = 2 * index - 1;
  };
  return {
      channels,
      number("datapath", "diffuse_fraction_bits", d.diffuse_fraction_bits),
      number("datapath", "specular_fraction_bits", d.specular_fraction_bits),
      number("datapath", "rom_address_bits", d.rom_address_bits),
      number("datapath", "rom_data_bits", d.rom_data_bits),
      choice("datapath", "index_rounding", {"nearest", "truncate"}, d.index_rounding),
      choice("datapath", "specular_gate", {"off", "diffuse", "series"}, d.gate),
      choice("datapath", "anchor", {"triangle", "span"}, d.anchor),
      choice("setup_engine", "series", series_fit_names(), d.series_fit),
      number("setup_engine", "subdivide_degrees", d.subdivide_degrees),
      number("setup_engine", "adders", p.adders.count),
      number("setup_engine", "adders_latency", p.adders.latency),
      number("setup_engine", "adders_interval", p.adders.interval),
      number("setup_engine", "multipliers", p.multipliers.count),
      number("setup_engine", "multipliers_latency", p.multipliers.latency),
      number("setup_engine", "multipliers_interval", p.multipliers.interval),
      number("setup_engine", "rsqrt", p.rsqrt.count),
      number("setup_engine", "rsqrt_latency", p.rsqrt.latency),
      number("setup_engine", "rsqrt_interval", p.rsqrt.interval),
      number("setup_engine", "power_units", p.power.count),
      number("setup_engine", "power_units_latency", p.power.latency),
      number("setup_engine", "power_units_interval", p.power.interval),
      number("span_walker", "triangle_cycles", p.walker_triangle_cycles),
      number("span_walker", "row_cycles", p.walker_row_cycles),
      number("framebuffer", "write_cycles", p.framebuffer_write_cycles),
      number("framebuffer", "test_cycles", p.framebuffer_test_cycles),
      number("framebuffer", "add_cycles", p.framebuffer_add_cycles),
      number("framebuffer", "depth_bits", p.depth_bits),
      number("queues", "triangles", p.triangle_fifo),
      number("queues", "spans", p.span_fifo),
      number("queues", "pixels", p.pixel_fifo),
  };
}

Hardware load_hardware(const std::string& name, const std::vector<std::string>& overrides) {
  Hardware hardware;
  std::string technology = "ice40-hx8k";
  const auto file = find_named(name, installation().hardware / "presets", "preset");
  hardware.name = file.stem().string();
  read_file(hardware, file, technology);
  for (const std::string& text : overrides) apply_override(hardware, text, technology);
  hardware.technology = load_technology(technology);
  return hardware;
}

void suit_scene(Hardware& hardware, const Scene& scene, const Geometry& geometry, Effects effects) {
  if (hardware.choose_channels) {
    const bool grey = effects == Effects::derived && is_grey(scene, geometry);
    hardware.datapath.channels = grey ? 1 : 3;
  }
  hardware.datapath = suit_scene(hardware.datapath, scene, geometry, effects);
}

std::string method_of(const Hardware& hardware, const Scene& scene) {
  std::string name(series_fit_names()[static_cast<std::size_t>(hardware.datapath.series_fit)]);
  if (scene.shading.viewer == Viewer::local) name += kLocalSuffix;
  return name;
}

std::string configuration_hash(const Hardware& hardware) {
  Hardware copy = hardware;
  copy.choose_channels = false;
  FnvHash hash;
  const auto add = [&hash](const std::string& text) {
    for (const char c : text + "\n") {
      hash.add(static_cast<unsigned char>(c));
    }
  };
  for (const Setting& setting : settings(copy)) add(setting.name() + "=" + setting.value());
  add("technology=" + hardware.technology.name);
  return fmt::format("{:016x}", hash.value());
}

}  // namespace phongpipe
