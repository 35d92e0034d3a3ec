#include "testbench/trace/capsule.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

#include "model/files/scene_file.h"
#include "model/files/scene_writer.h"
#include "model/files/text_file.h"
#include "model/files/toml_reader.h"
#include "model/scene/input_error.h"
#include "testbench/cosim/run.h"
#include "testbench/rtl/rtl_library.h"
#include "testbench/system/fnv_hash.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

constexpr std::string_view kDigest = "digest = ";

std::string hash_text(std::uint64_t hash) {
  return fmt::format("{:016x}", hash);
}
std::uint64_t parse_hash(const std::string& text) {
  std::uint64_t hash = 0;
  std::istringstream(text) >> std::hex >> hash;
  return hash;
}

std::string digest_of(std::string_view text) {
  FnvHash hash;
  hash.add(text);
  return hash_text(hash.value());
}

// Hash of the file of this program.
std::uint64_t program_hash() {
  static const std::uint64_t value = [] {
    FnvHash hash;
    hash.add(read_whole_file("/proc/self/exe"));
    return hash.value();
  }();
  return value;
}

// Settings of the hardware as a hardware file has them.
std::string hardware_toml(const Hardware& hardware) {
  toml::table root;
  for (const Setting<Hardware>& setting : hardware_settings()) {
    const auto [place, added] = root.insert(setting.section, toml::table{});
    toml::table& section = *place->second.as_table();
    const std::string value = setting.value(hardware);
    if (setting.per_unit > 1) {
      section.insert(setting.key, setting.in_units(setting.get(hardware)));
    } else if (setting.choices.empty()) {
      section.insert(setting.key, setting.get(hardware));
    } else {
      section.insert(setting.key, value);
    }
  }
  std::ostringstream text;
  text << root;
  return fmt::format("technology = \"{}\"\n{}\n", hardware.technology.name, text.str());
}

// What was expected and found, for readers: replay finds it anew.
toml::table divergence_table(const ImplementationResult& found) {
  toml::table table;
  if (found.first_divergence) {
    const Divergence& d = *found.first_divergence;
    table = toml::table{{"triangle", d.triangle},
                        {"x", d.model.x},
                        {"y", d.model.y},
                        {"cycle", d.cycle},
                        {"span", static_cast<std::int64_t>(d.span)},
                        {"pixel_of_the_stream", static_cast<std::int64_t>(d.stream_index)},
                        {"expected_color", d.model.color},
                        {"found_color", d.found.color}};
  }
  if (found.signal_divergence) {
    const SignalDivergence& s = *found.signal_divergence;
    table.insert("signal", s.name());
    table.insert("signal_cycle", s.cycle);
    table.insert("expected", s.model);
    table.insert("found", s.other);
  }
  return table;
}

}  // namespace

std::string divergence_text(const VerificationResult& r) {
  const ImplementationResult* const found = r.diverging();
  if (found == nullptr) return {};
  if (found->signal_divergence) {
    const SignalDivergence& s = *found->signal_divergence;
    return fmt::format("{}: model {}, rtl {} in cycle {}", s.name(), hex_text(s.model, s.width),
                       hex_text(s.other, s.width), s.cycle);
  }
  const Divergence& d = *found->first_divergence;
  return fmt::format("{}: x {}, y {}: model {:#x}, found {:#x} in cycle {}",
                     found == &r.systemc ? "SystemC" : "RTL", d.model.x, d.model.y, d.model.color,
                     d.found.color, d.cycle);
}

std::string capsule_text(const Scene& scene, const VerificationResult& result) {
  const VerificationOptions& options = result.options;
  toml::table chosen;
  for (const RunOption& option : run_options()) chosen.insert(option.name, option.get(options));
  const toml::table root{{"version", PHONGPIPE_VERSION},
                         {"arithmetic", kArithmeticVersion},
                         {"name", scene.source},
                         {"program_hash", hash_text(program_hash())},
                         {"rtl_hash", hash_text(rtl_hash(options.rtl_sources))},
                         {"found", divergence_text(result)},
                         {"divergence", divergence_table(*result.diverging())},
                         {"options", chosen},
                         {"hardware_name", result.hardware.name},
                         {"hardware", hardware_toml(result.hardware)},
                         {"scene", scene_toml(scene)}};
  std::ostringstream text;
  // A literal string of several lines could not hold another, such as the rows of triangles.
  constexpr toml::format_flags kFlags =
      toml::toml_formatter::default_flags & ~toml::format_flags::allow_literal_strings;
  text << toml::toml_formatter(root, kFlags) << "\n";
  return fmt::format(
      "# A divergence found by phongpipe; `phongpipe replay` shows it again.\n{}\"{}\"\n{}",
      kDigest, digest_of(text.str()), text.str());
}

Capsule read_capsule(const std::filesystem::path& file, bool anyway) {
  const std::string text = read_whole_file(file, kMaxTomlBytes);
  const std::size_t at = text.find(kDigest);
  const std::size_t begin = text.find('\n', at);
  if (at == std::string::npos || begin == std::string::npos) {
    throw InputError(
        fmt::format("{}: no capsule, which `phongpipe verify` writes where RTL or "
                    "SystemC differs from the model",
                    printable(file.string())));
  }
  const bool whole = text.find(digest_of(std::string_view(text).substr(begin + 1)), at) < begin;
  if (!whole && !anyway) {
    throw InputError(
        fmt::format("{}: changed after it was written; --anyway replays what it says now",
                    printable(file.string())));
  }
  const TomlTable root = TomlTable::read_text(text, file);
  Capsule capsule;
  root.text("digest");
  capsule.version = root.text("version");
  const int arithmetic = root.integer("arithmetic", 0, 1'000'000);
  capsule.name = printable(root.text("name"));
  capsule.found = root.text("found");
  capsule.same_program = parse_hash(root.text("program_hash", "")) == program_hash();
  capsule.rtl_hash = parse_hash(root.text("rtl_hash"));
  root.table("divergence");
  const TomlTable options = root.table("options");
  for (const RunOption& option : run_options()) {
    option.put(capsule.options, options.text(option.name, option.get(capsule.options)));
  }
  options.finish();
  capsule.hardware = parse_hardware(root.text("hardware"), file.string() + " (its hardware)");
  capsule.hardware.name = root.text("hardware_name");
  capsule.scene = parse_scene(root.text("scene"), file.string() + " (its scene)");
  root.finish();
  capsule.scene.source = capsule.name;
  const bool same_version =
      capsule.version == PHONGPIPE_VERSION && arithmetic == kArithmeticVersion;
  if (!same_version && !anyway) {
    throw InputError(fmt::format(
        "{}: written by another version of phongpipe ({}, arithmetic {}); --anyway replays it with "
        "this one ({}, arithmetic {})",
        printable(file.string()), printable(capsule.version), arithmetic, PHONGPIPE_VERSION,
        kArithmeticVersion));
  }
  return capsule;
}

}  // namespace phongpipe
