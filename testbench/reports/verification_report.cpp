#include "testbench/reports/verification_report.h"

#include <fmt/color.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "testbench/cosim/metrics.h"
#include "testbench/system/process.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace {

using nlohmann::ordered_json;

enum class Tone { good, bad, warning };

class Page {
 public:
  explicit Page(bool color) : color_(color) {}

  void line(std::string_view label, const std::string& text) {
    text_ += fmt::format("  {:<8} {}\n", label, text);
  }
  void plain(const std::string& text) { text_ += text + "\n"; }
  std::string toned(Tone tone, const std::string& text) const {
    if (!color_) return text;
    const auto color = tone == Tone::good  ? fmt::terminal_color::green
                       : tone == Tone::bad ? fmt::terminal_color::red
                                           : fmt::terminal_color::yellow;
    return fmt::format(fmt::emphasis::bold | fmt::fg(color), "{}", text);
  }
  std::string verdict(bool passed) const {
    return toned(passed ? Tone::good : Tone::bad, passed ? "PASSED" : "FAILED");
  }
  const std::string& text() const { return text_; }

 private:
  bool color_;
  std::string text_;
};

std::string color_text(std::uint32_t color, int channels) {
  std::string hex, lsb;
  for (int c = 0; c < channels; ++c) {
    const std::uint32_t value = (color >> (8 * c)) & 0xff;
    hex += fmt::format("{:02x}", value);
    lsb += fmt::format("{}{}", c > 0 ? "," : "", value);
  }
  return fmt::format("0x{} ({} LSB)", hex, lsb);
}

std::string heading(const Page& page, const VerificationResult& r) {
  const std::string errors = r.within_error() ? r.over_limit_text() : "";  // else told as a failure
  return fmt::format("{} {}  {}×{}, {} pixels, hardware {} {}{}", page.verdict(r.passed()), r.scene,
                     r.width, r.height, count_text(r.pixels), r.hardware.name,
                     configuration_hash(r.hardware).substr(0, 8),
                     errors.empty() ? "" : "; " + page.toned(Tone::warning, errors));
}

std::pair<std::string_view, double> largest_link(const Accuracy& a) {
  const std::pair<std::string_view, double> links[] = {{"visibility", a.visibility.largest_lsb},
                                                       {"series", a.series.largest_lsb},
                                                       {"rounding", a.rounding.largest_lsb},
                                                       {"table", a.rom.largest_lsb},
                                                       {"output", a.output.largest_lsb}};
  return *std::max_element(std::begin(links), std::end(links),
                           [](const auto& x, const auto& y) { return x.second < y.second; });
}

void report_implementation(Page& page, const char* name, const ImplementationResult& found,
                           const VerificationResult& r) {
  if (found.agrees()) return;
  page.line("differs", page.toned(Tone::bad, fmt::format("{} ≠ model: {}", name,
                                                         mismatches_text(found, r.pixels))));
  if (!found.counts.failure.empty()) page.line("", page.toned(Tone::bad, found.counts.failure));
  if (!found.first_divergence) return;
  const Divergence& d = *found.first_divergence;
  const int channels = r.configuration.channels;
  page.line("first",
            fmt::format(
                "triangle {}, x {}, y {}, cycle {}, span {}, pixel {} of the stream, seed {}",
                d.triangle, d.model.x, d.model.y, d.cycle, d.span, d.stream_index, r.options.seed));
  page.line("", fmt::format("model    {}", d.extra ? std::string("ended before this pixel")
                                                   : color_text(d.model.color, channels)));
  page.line("", fmt::format(
                    "{:<8} {}", name,
                    d.missing ? std::string("ended before this pixel")
                              : fmt::format("{} at x {}, y {}", color_text(d.found.color, channels),
                                            d.found.x, d.found.y)));
}

// The register that differs first.
void report_signal(Page& page, const VerificationResult& r) {
  if (!r.rtl || !r.rtl->signal_divergence) return;
  const SignalDivergence& s = *r.rtl->signal_divergence;
  page.line("cause", page.toned(Tone::bad,
                                fmt::format("{}: model {}, rtl {} in cycle {}", s.name(),
                                            hex_text(s.model, s.width), hex_text(s.other, s.width),
                                            count_text(static_cast<std::uint64_t>(s.cycle)))));
}

// The pixels with the largest errors, if some error is more than --max-error allows.
void report_worst_pixels(Page& page, const VerificationResult& r) {
  if (r.within_error()) return;
  page.line("limit", page.toned(Tone::bad, r.over_limit_text() + "; the worst:"));
  for (const WorstPixel& worst : r.worst_pixels) {
    if (worst.error_lsb <= *r.options.max_error_lsb) break;
    const auto text = [&](const Color& color) {
      const int channels = r.configuration.channels;
      return fmt::format("{:.2f}", fmt::join(color.data(), color.data() + channels, " "));
    };
    page.line("", fmt::format("{:6.2f} LSB  triangle {}, x {}, y {}: {}, exact {}; mostly {}",
                              worst.error_lsb, worst.triangle, worst.x, worst.y, text(worst.output),
                              text(worst.exact), worst.largest_part));
  }
}

// The lines that tell what does not hold.
void report_failures(Page& page, const VerificationResult& r, const ReportStyle& style) {
  report_implementation(page, "SystemC", r.systemc, r);
  if (r.rtl) report_implementation(page, "RTL", *r.rtl, r);
  if (r.systemc.agrees() && r.rtl && r.rtl->agrees() && !r.same_cycles()) {
    page.line(
        "differs",
        page.toned(
            Tone::bad,
            r.cycle_difference() != 0
                ? fmt::format("the frame takes {} cycles in SystemC, {} with the RTL",
                              count_text(static_cast<std::uint64_t>(r.systemc.counts.frame_cycles)),
                              count_text(static_cast<std::uint64_t>(r.rtl->counts.frame_cycles)))
                : std::string("pixels leave SystemC and RTL in other cycles")));
  }
  report_signal(page, r);
  if (r.full_hardware && !r.full_hardware->systemc.agrees()) {
    page.line("differs",
              page.toned(Tone::bad, fmt::format("{} pixels of hardware with every effect",
                                                r.full_hardware->systemc.frame_mismatches)));
  }
  if (r.set_up.overflows > 0) {
    const bool in_setup = r.overflowing.empty();
    page.line(
        "overflow",
        page.toned(Tone::bad,
                   fmt::format("{}, so that their pixels may be wrong: {}",
                               overflow_text(r.set_up.overflows),
                               in_setup ? "with so many fraction bits 64 bits are too few in the "
                                          "setup engine"
                                        : "is a light too close or bright, or [depth_cue] "
                                          "narrow?")));
    for (const SeriesRanges& ranges : r.overflowing) {
      page.line("", fmt::format("the {} series needs registers of {} bits and has {}", ranges.name,
                                ranges.needed_width(), ranges.width));
    }
  }
  report_worst_pixels(page, r);
  if (!r.certificate_holds()) {
    page.line("error", page.toned(Tone::bad, fmt::format("at most {:.3f} LSB was proved: a bound "
                                                         "is wrong",
                                                         *r.certified_error_lsb)));
  }
  if (!r.passed() && !style.command.empty()) {
    page.line("again", printable(style.command) + (r.agrees() || r.options.detail == Detail::cycle
                                                       ? " --verbose"
                                                       : " --detail cycle --verbose"));
  }
}

std::string budget_text(const Page& page, const VerificationResult& r) {
  const std::string frame =
      fmt::format("{:.2f} of {:.10g} ns a pixel", r.frame_ns_per_pixel(), r.options.budget_ns);
  return r.within_budget() ? frame : page.toned(Tone::bad, frame + ", OVER BUDGET");
}

std::string time_text(const Page& page, const VerificationResult& r) {
  return fmt::format("{}, clock {:.2f} ns {}; {}limited by {}", budget_text(page, r), r.clock.ns,
                     kind_text(r.clock),
                     r.rtl ? fmt::format("datapath {:.2f}; ", r.datapath_ns_per_pixel()) : "",
                     r.limiting_block().block);
}

std::string error_text(const VerificationResult& r) {
  const auto [link, largest] = largest_link(r.accuracy);
  return fmt::format("at most {:.2f} LSB, RMS {:.2f}; largest part: {} {:.2f}",
                     r.accuracy.total.largest_lsb, r.accuracy.total.rms_lsb(), link, largest);
}

// How the pixels were shaded, and what that took.
void report_ledger(Page& page, const VerificationResult& r) {
  if (r.certified_error_lsb) {
    const std::uint64_t refused = r.ledger[ShadingPath::refused];
    const std::size_t misplaced = r.accuracy.misplaced.size();
    std::string proved =
        fmt::format("at most {:.3f} LSB proved for every pixel", *r.certified_error_lsb);
    if (refused > 0) {
      proved = page.toned(Tone::warning,
                          fmt::format("nothing is proved for {} pixels", count_text(refused)));
    }
    if (misplaced > 0) {
      proved = page.toned(Tone::warning,
                          fmt::format("nothing is proved where {} pixels show another triangle "
                                      "than the nearest: raise framebuffer.depth_bits",
                                      count_text(misplaced)));
    }
    page.line("ledger", proved);
  } else {
    page.plain("ledger");
  }
  for (std::size_t i = 0; i < kShadingPaths; ++i) {
    const auto path = static_cast<ShadingPath>(i);
    const std::uint64_t pixels = r.ledger[path], cycles = r.unit_cycles(path);
    if (pixels == 0 && cycles == 0) continue;
    std::string line = fmt::format(
        "{:<11} {:>11} pixels {:5.1f} %, {:>11} cycles of units", kShadingPathNames[i],
        count_text(pixels), 100 * static_cast<double>(pixels) / static_cast<double>(r.pixels),
        count_text(cycles));
    if (pixels > 0 && cycles > 0) {
      line += fmt::format(", {:.2f} ns a pixel",
                          r.clock.ns * static_cast<double>(cycles) / static_cast<double>(pixels));
    }
    page.line("", line);
  }
}

void report_warnings(Page& page, const VerificationResult& r) {
  for (const std::string& note : r.notes) page.line("note", note);
  if (r.rom_error > 0.01) {
    page.line("warning",
              page.toned(Tone::warning,
                         fmt::format("the ROM errs by up to {:.2f} % of a full highlight; {}",
                                     100 * r.rom_error,
                                     r.configuration.rom_layout == RomLayout::plain
                                         ? "raise rom_address_bits, or set rom_layout = bipartite"
                                         : "raise rom_address_bits, or lower rom_octaves")));
  }
}

void report_effects(Page& page, const VerificationResult& r) {
  page.plain("effects");
  page.line("used", fmt::format("{}", fmt::join(r.effects.used, ", ")));
  if (r.options.effects == EffectsToVerify::all) {
    page.line("", "everything is built and simulated, whether the scene has it or not");
    return;
  }
  page.line("left out", fmt::format("{}", fmt::join(r.effects.left_out, ", ")));
  if (!r.full_hardware) {
    page.line("", "--effects both tells what that saves");
    return;
  }
  page.plain("hardware for the scene, with every effect, and the difference");
  for_each_block_metric(
      r, [&](const Metric& metric, const MetricValue& own, const MetricValue& full) {
        const double all = number_of(full).value_or(0);
        const double percent = all > 0 ? std::round(100 * (*number_of(own) / all - 1)) : 0;
        page.plain(fmt::format("  {:<27} {:>14} {:>14} {:+5.0f} %", metric.name, metric_text(own),
                               metric_text(full), percent == 0 ? 0.0 : percent));
      });
}

// How far each block is from the budget, and what would balance them.
void report_blocks(Page& page, const VerificationResult& r) {
  page.plain("blocks");
  const std::string_view limiting = r.limiting_block().block;
  for (const BlockLoad& load : r.block_loads()) {
    const double ns = r.ns_per_pixel(load), slack_ns = r.options.budget_ns - ns;
    const std::string slack = fmt::format("slack {:8.2f} ns", slack_ns);
    page.plain(fmt::format("  {:<14} {:>13} cycles {:8.2f} ns a pixel, {}{}", load.block,
                           count_text(static_cast<std::uint64_t>(load.cycles)), ns,
                           slack_ns < 0 ? page.toned(Tone::bad, slack) : slack,
                           load.block == limiting ? ", limits the frame" : ""));
  }
  page.plain(fmt::format("  {:<14} {}", "clock",
                         r.clock.limited_by.empty() ? "what limits it is not known"
                                                    : "limited by " + r.clock.limited_by));
  const auto units_text = [](const PipelineConfiguration& p) {
    return fmt::format("{} adders, {} multipliers, {} 1/√, {} power", p.adders.count,
                       p.multipliers.count, p.rsqrt.count, p.power.count);
  };
  const auto balanced = r.balanced_units();
  page.plain(fmt::format(
      "  {:<14} {}", "balance",
      balanced ? fmt::format("the setup engine keeps up from {} on; it has {}",
                             units_text(*balanced), units_text(r.hardware.pipeline))
               : fmt::format("no number of units lets the setup engine keep up: triangles are set "
                             "up one after the other, at best in {} cycles",
                             count_text(static_cast<std::uint64_t>(r.least_setup_cycles())))));
}

void report_details(Page& page, const VerificationResult& r) {
  page.plain("settings");
  std::string_view section;
  std::string text;
  const auto flush = [&] {
    if (!text.empty()) page.plain(fmt::format("  {:<13} {}", section, text));
    text.clear();
  };
  for (const Setting<Hardware>& setting : hardware_settings()) {
    if (setting.section != section) flush();
    section = setting.section;
    text +=
        fmt::format("{}{} {}", text.empty() ? "" : ", ", setting.key, setting.value(r.hardware));
  }
  flush();
  page.plain(fmt::format("  {:<13} {}: {}", "technology", r.hardware.technology.name,
                         r.hardware.technology.source));
  const FrameConfiguration& c = r.configuration;
  page.plain(fmt::format("  {:<13} diffuse s{}.{}, specular s{}.{}; {} series, ROM {} × {} bits",
                         "formats", c.diffuse_width() - 1 - c.diffuse_fraction_bits,
                         c.diffuse_fraction_bits, c.specular_width() - 1 - c.specular_fraction_bits,
                         c.specular_fraction_bits, c.series(), c.rom_words(),
                         c.channels * c.rom_data_bits));
  if (!r.certified_error_lsb) report_ledger(page, r);
  report_blocks(page, r);
  report_effects(page, r);
  page.plain("metrics");
  for (const Metric& metric : metrics()) {
    page.plain(fmt::format("  {:<27} {:>14} {:<6} {}", metric.name, metric_text(metric.value(r)),
                           metric.unit, metric.meaning));
  }
}

}  // namespace

std::string report_line(const VerificationResult& r, const ReportStyle& style) {
  Page page(style.color);
  const bool error_is_told = r.accuracy.pixels_over_limit > 0 && r.within_error();
  page.plain(fmt::format(
      "{}, {}{}", heading(page, r), budget_text(page, r),
      error_is_told ? "" : fmt::format(", at most {:.2f} LSB", r.accuracy.total.largest_lsb)));
  report_warnings(page, r);
  report_failures(page, r, style);
  if (style.verbose) report_details(page, r);
  return page.text();
}

std::string report_text(const VerificationResult& r, const ReportStyle& style) {
  Page page(style.color);
  page.plain(heading(page, r));
  if (r.agrees()) {
    page.line(
        "same",
        fmt::format("model = SystemC{}, every pixel and every cycle ({})", r.rtl ? " = RTL" : "",
                    count_text(static_cast<std::uint64_t>(r.systemc.counts.frame_cycles))));
  }
  page.line("time", time_text(page, r));
  page.line("error", error_text(r));
  if (r.certified_error_lsb) report_ledger(page, r);
  report_warnings(page, r);
  report_failures(page, r, style);
  std::string more = style.verbose ? "" : "--verbose";
  for (const std::string& file : style.more) more += (more.empty() ? "" : ", ") + file;
  if (!more.empty()) page.line("more", more);
  if (style.verbose) report_details(page, r);
  return page.text();
}

// Where implementations part: null if they do not.
std::array<std::filesystem::path, 3> picture_files(const std::filesystem::path& folder,
                                                   const std::string& name) {
  return {folder / (name + "-result.png"), folder / (name + "-exact.png"),
          folder / (name + "-error.png")};
}

WrittenPictures::WrittenPictures(const VerificationResult& r,
                                 const std::array<std::filesystem::path, 3>& files)
    : colors_([&] {
        write_png(files[0], r.result_picture);
        write_png(files[1], r.accuracy.exact_picture);
        return std::string("written");
      }),
      errors_([&] {
        write_png(files[2], r.accuracy.error_picture);
        return std::string("written");
      }) {}

void WrittenPictures::wait() {
  colors_.get();
  errors_.get();
}

}  // namespace phongpipe
