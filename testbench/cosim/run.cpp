#include "testbench/cosim/run.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "testbench/system/fnv_hash.h"

namespace phongpipe {
namespace {

using Options = VerificationOptions;

constexpr std::array<std::string_view, 2> kDetails = {"span", "cycle"};
constexpr std::array<std::string_view, 3> kEffects = {"scene", "all", "both"};

template <typename Enum, std::size_t kSize>
Enum choice(std::string_view option, const std::string& text,
            const std::array<std::string_view, kSize>& words) {
  const auto found = std::find(words.begin(), words.end(), text);
  if (found == words.end()) {
    throw InputError(fmt::format("{} = {}: one of {}", option, text, fmt::join(words, ", ")));
  }
  return static_cast<Enum>(found - words.begin());
}

template <std::size_t kSize, typename Enum>
std::string word(const std::array<std::string_view, kSize>& words, Enum value) {
  return std::string(words[static_cast<std::size_t>(value)]);
}

long whole_number(std::string_view option, const std::string& text, long low, long high) {
  const auto number = parse_integer(text);
  if (!number || *number < low || *number > high) {
    throw InputError(fmt::format("{} = {}: a whole number from {} to {}", option, text, low, high));
  }
  return *number;
}

bool is_plain(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 ||
         std::string_view("_-+=.,:/@%").find(c) != std::string_view::npos;
}

// The words that a shell makes of a line in which words are as shell_word() gives them.
std::vector<std::string> shell_words(const std::string& line) {
  std::vector<std::string> words;
  bool inside = false, in_quotes = false;  // of a word, of its quotes
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == ' ' && !in_quotes) {
      inside = false;
      continue;
    }
    if (!inside) words.emplace_back();
    inside = true;
    if (c == '\'') {
      in_quotes = !in_quotes;
    } else if (c == '\\' && !in_quotes && i + 1 < line.size()) {
      words.back() += line[++i];
    } else {
      words.back() += c;
    }
  }
  if (in_quotes) throw InputError(fmt::format("{}: a quote is not closed", line));
  return words;
}

constexpr std::string_view kNoLimit = "none";

// What of a failed verification is told first.
struct Failure {
  std::string bucket, message;
};

// "channel[].summation.sum" of "channel[0].summation.sum".
std::string without_indices(const std::string& name) {
  std::string result;
  bool inside = false;
  for (const char c : name) {
    inside = c == '[' || (inside && c != ']');
    if (!inside || c == '[') result += c;
  }
  return result;
}

Failure failure_of(const char* name, const ImplementationResult& found, std::uint64_t pixels) {
  std::string message =
      fmt::format("{} differs from the model in {}", name, mismatches_text(found, pixels));
  if (!found.counts.failure.empty()) message += "; " + found.counts.failure;
  if (found.first_divergence) {
    const Divergence& d = *found.first_divergence;
    message += fmt::format("; first at triangle {}, x {}, y {}, cycle {}", d.triangle, d.model.x,
                           d.model.y, d.cycle);
  }
  const char* what = "frame";
  if (found.first_divergence) {
    const Divergence& d = *found.first_divergence;
    const bool same_place = d.model.x == d.found.x && d.model.y == d.found.y;
    what = d.missing    ? "pixel missing"
           : d.extra    ? "pixel too many"
           : same_place ? "color"
                        : "position";
  } else if (!found.counts.failure.empty()) {
    what = "stuck";
  }
  if (found.signal_divergence) {
    const SignalDivergence& s = *found.signal_divergence;
    const std::string signal = without_indices(s.name());
    message += fmt::format("; {} differs first, in cycle {}", s.name(), s.cycle);
    return {fmt::format("{}: {}: {}", name, what, signal), message};
  }
  return {fmt::format("{}: {}", name, what), message};
}

Failure failure_of(const VerificationResult& r) {
  if (const ImplementationResult* const found = r.diverging()) {
    return failure_of(found == &r.systemc ? "SystemC" : "RTL", *found, r.pixels);
  }
  if (!r.systemc.agrees()) return failure_of("SystemC", r.systemc, r.pixels);
  if (r.rtl && !r.rtl->agrees()) return failure_of("RTL", *r.rtl, r.pixels);
  if (!r.same_cycles()) {
    return {"cycles", fmt::format("the frame takes {} cycles more with the RTL than in SystemC",
                                  r.cycle_difference())};
  }
  if (r.full_hardware && !r.full_hardware->systemc.agrees()) {
    return {"effects", fmt::format("{} pixels differ with hardware that has every effect",
                                   r.full_hardware->systemc.frame_mismatches)};
  }
  if (r.set_up.overflows > 0) {
    return {std::string(kOverflow), overflow_text(r.set_up.overflows)};
  }
  if (!r.within_error()) {
    return {fmt::format("error: {}", r.worst_pixels.front().largest_part), r.over_limit_text()};
  }
  if (!r.certificate_holds()) {
    return {"certificate", fmt::format("a pixel is off by {:.3f} LSB where {:.3f} was proved",
                                       r.accuracy.total.largest_lsb, *r.certified_error_lsb)};
  }
  return {"budget", fmt::format("{:.2f} ns a pixel, over the budget of {:.10g}",
                                r.frame_ns_per_pixel(), r.options.budget_ns)};
}

}  // namespace

const std::vector<RunOption>& run_options() {
  static const std::vector<RunOption> all = {
      {"detail", "span|cycle", "SystemC by the span, or by every clock (slower)",
       [](const Options& o) { return word(kDetails, o.detail); },
       [](Options& o, const std::string& text) {
         o.detail = choice<Detail>("detail", text, kDetails);
       }},
      {"stall", "0-100",
       "Random back-pressure: per cent of pixels, or groups side by side, the framebuffer stalls "
       "at",
       [](const Options& o) { return std::to_string(o.stall_percent); },
       [](Options& o, const std::string& text) {
         o.stall_percent = static_cast<int>(whole_number("stall", text, 0, 100));
       }},
      {"seed", "N", "Of the random back-pressure",
       [](const Options& o) { return std::to_string(o.seed); },
       [](Options& o, const std::string& text) {
         o.seed = static_cast<std::uint32_t>(whole_number("seed", text, 0, 0xffffffff));
       }},
      {"effects", "scene|all|both",
       "Build and simulate what the scene's effects need, everything there is, or both and compare "
       "them",
       [](const Options& o) { return word(kEffects, o.effects); },
       [](Options& o, const std::string& text) {
         o.effects = choice<EffectsToVerify>("effects", text, kEffects);
       }},
      {"budget", "NS", "Nanoseconds that a pixel of the whole frame may take",
       [](const Options& o) { return fmt::format("{}", o.budget_ns); },
       [](Options& o, const std::string& text) {
         const auto number = parse_number(text);
         if (!number || *number <= 0) {
           throw InputError(fmt::format("budget = {}: a number of ns above 0", text));
         }
         o.budget_ns = *number;
       }},
      {"max-error", "LSB", "Largest error against exact Phong shading that a pixel may have",
       [](const Options& o) {
         return o.max_error_lsb ? fmt::format("{}", *o.max_error_lsb) : std::string(kNoLimit);
       },
       [](Options& o, const std::string& text) {
         const auto number = parse_number(text);
         if (text != kNoLimit && (!number || *number < 0)) {
           throw InputError(fmt::format("max-error = {}: a number of LSB, 0 or more", text));
         }
         o.max_error_lsb = number;
       }},
  };
  return all;
}

void set_key(RunRequest& request, const std::string& key, const std::string& value) {
  if (key == "scene") {
    request.scene = value;
  } else if (key == "hardware") {
    request.hardware = value;
  } else {
    for (const RunOption& option : run_options()) {
      if (key == option.name) return option.put(request.options, value);
    }
    request.settings.push_back(key + "=" + value);
  }
}

std::string shell_word(const std::string& text) {
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string command_of(const RunRequest& request) {
  const RunRequest none;
  std::string text = "phongpipe verify " + shell_word(request.scene);
  if (request.hardware != none.hardware) text += " --hardware " + shell_word(request.hardware);
  for (const std::string& setting : request.settings) text += " --set " + shell_word(setting);
  for (const RunOption& option : run_options()) {
    const std::string value = option.get(request.options);
    if (value != option.get(none.options)) text += fmt::format(" --{} {}", option.name, value);
  }
  if (!request.options.rtl_sources.empty()) {
    text += " --rtl " + shell_word(request.options.rtl_sources.string());
  }
  return text;
}

RunRequest parse_command(const std::string& command) {
  const std::vector<std::string> words = shell_words(command);
  if (words.size() < 3 || words[0] != "phongpipe" || words[1] != "verify") {
    throw InputError(fmt::format("{}: not a command that verifies a scene", command));
  }
  RunRequest request;
  request.scene = words[2];
  for (std::size_t i = 3; i < words.size(); i += 2) {
    if (i + 1 == words.size()) throw InputError(fmt::format("{}: no value", words[i]));
    const std::string& value = words[i + 1];
    const auto is_option = [&](const RunOption& option) {
      return words[i] == fmt::format("--{}", option.name);
    };
    const auto option = std::find_if(run_options().begin(), run_options().end(), is_option);
    if (option != run_options().end()) {
      option->put(request.options, value);
    } else if (words[i] == "--hardware") {
      request.hardware = value;
    } else if (words[i] == "--set") {
      request.settings.push_back(value);
    } else if (words[i] == "--rtl") {
      request.options.rtl_sources = value;
    } else {
      throw InputError(fmt::format("{}: not an option of a run", words[i]));
    }
  }
  return request;
}

std::string canonical_text(std::uint64_t scene_hash, const Hardware& hardware,
                           const VerificationOptions& options, const RunLimits& limits,
                           std::uint64_t rtl_hash) {
  std::string text = fmt::format("arithmetic={}\nscene={:016x}\n", kArithmeticVersion, scene_hash);
  for (const Setting<Hardware>& setting : hardware_settings()) {
    text += fmt::format("{}={}\n", setting.name(), setting.value(hardware));
  }
  const Technology& technology = hardware.technology;
  text += fmt::format("technology={} {}", technology.name, technology.fixed.ns);
  for (const MeasuredDesign& design : technology.measured) {
    text += fmt::format(" {}:{},{},{},{}", design.parameters, design.clock_ns, design.luts,
                        design.registers, design.block_rams);
  }
  for (const auto& [module, models] : technology.fitted) {
    text += " " + module;
    for (const FittedModel* const model : {&models.clock_ns, &models.luts, &models.registers}) {
      text += fmt::format(" {}", fmt::join(model->coefficients, ","));
    }
  }
  text += "\n";
  for (const RunOption& option : run_options()) {
    text += fmt::format("{}={}\n", option.name, option.get(options));
  }
  text += fmt::format("rtl={:016x}\n", rtl_hash);
  return text + fmt::format("seconds={}\nmemory_mib={}\n", limits.seconds, limits.memory_mib);
}

std::string identity_of(const std::string& canonical_text) {
  FnvHash hash;
  hash.add(std::string_view(canonical_text));
  return fmt::format("{:016x}", hash.value());
}

std::string_view name(Outcome outcome) {
  static constexpr std::string_view kNames[] = {"passed", "failed", "refused", "crashed",
                                                "timed_out"};
  return kNames[static_cast<std::size_t>(outcome)];
}

std::string_view words_of(Outcome outcome) {
  return outcome == Outcome::timed_out ? "timed out" : name(outcome);
}

std::string_view name(VerifiedBy verified_by) {
  static constexpr std::string_view kNames[] = {"nothing", "model", "superset", "native"};
  return kNames[static_cast<std::size_t>(verified_by)];
}

VerifiedBy verified_by(RtlToVerify rtl) {
  switch (rtl) {
    case RtlToVerify::native:
      return VerifiedBy::native;
    case RtlToVerify::superset:
      return VerifiedBy::superset;
    default:
      return VerifiedBy::model;
  }
}

RunResult summary_of(const VerificationResult& result) {
  RunResult summary;
  if (result.passed()) {
    summary.outcome = Outcome::passed;
  } else {
    summary.outcome = Outcome::failed;
    Failure failure = failure_of(result);
    summary.message = std::move(failure.message);
    summary.bucket = std::move(failure.bucket);
  }
  summary.verified_by = verified_by(result.options.rtl);
  summary.configuration_hash = configuration_hash(result.hardware);
  for (const Metric& metric : metrics()) summary.metrics.push_back(metric.value(result));
  return summary;
}

RunResult refused(const std::string& reason) {
  RunResult result;
  result.outcome = Outcome::refused;
  result.message = reason;
  result.bucket = "refused";
  return result;
}

}  // namespace phongpipe
