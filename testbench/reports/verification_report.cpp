#include "testbench/reports/verification_report.h"

#include <fmt/color.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace phongpipe {
namespace {

class Page {
 public:
  explicit Page(bool color) : color_(color) {}

  template <typename... Args>
  void line(const char* label, fmt::format_string<Args...> format, Args&&... args) {
    text_ += fmt::format("  {:<14} {}\n", label, fmt::format(format, std::forward<Args>(args)...));
  }
  void plain(const std::string& text) { text_ += text + "\n"; }
  std::string verdict(bool good, const std::string& text) const {
    if (!color_) return text;
    const auto style =
        fmt::emphasis::bold | fmt::fg(good ? fmt::terminal_color::green : fmt::terminal_color::red);
    return fmt::format(style, "{}", text);
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

void report_account(Page& page, const char* name, const Account& account, const Verification& v) {
  const bool good =
      account.mismatches == 0 && account.frame_mismatches == 0 && account.failure.empty();
  page.line(
      name, "{}",
      page.verdict(good, fmt::format("{} mismatches in {} pixels, {} in the final frame",
                                     account.mismatches, v.pixels, account.frame_mismatches)));
  if (!account.failure.empty()) page.line("", "{}", page.verdict(false, account.failure));
  if (!account.first) return;
  const Divergence& d = *account.first;
  const int channels = v.hardware.datapath.channels;
  page.line("",
            "first divergence: pixel {} of the stream, triangle {}, x {}, y {}, cycle {}, seed {}",
            d.place, d.triangle, d.model.x, d.model.y, d.cycle, v.options.seed);
  page.line("", "model:   {}", color_text(d.model.color, channels));
  page.line("", "{:<8} {}", fmt::format("{}:", name),
            d.missing ? std::string("the stream ended before it")
                      : fmt::format("{} at x {}, y {}", color_text(d.other.color, channels),
                                    d.other.x, d.other.y));
}

void report_hardware(Page& page, const Verification& v) {
  Hardware hardware = v.hardware;
  hardware.choose_channels = false;
  const DatapathConfiguration& d = hardware.datapath;
  std::string_view section;
  std::string text;
  for (const Setting& setting : settings(hardware)) {
    if (setting.section != section && !text.empty()) {
      page.line(std::string(section).c_str(), "{}", text);
      text.clear();
    }
    section = setting.section;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", setting.key, setting.value());
  }
  page.line(std::string(section).c_str(), "{}", text);
  page.line("formats", "diffuse s{}.{}, specular s{}.{}; {} series, {} adders, ROM {} × {} bits{}",
            d.diffuse_width() - 1 - d.diffuse_fraction_bits, d.diffuse_fraction_bits,
            d.specular_width() - 1 - d.specular_fraction_bits, d.specular_fraction_bits, d.series(),
            d.adders(), d.rom_words(), d.channels * d.rom_data_bits,
            d.has_gate_series() ? "; 2 adders of them only for the sign of N·L" : "");
  const OperationCounts& counts = v.systemc.setup_operations;
  const auto each = [&v](auto count) {
    return static_cast<double>(count) / static_cast<double>(v.triangles_set_up);
  };
  page.line("setup",
            "{:.1f} cycles a triangle, on average, for {:.1f} additions, {:.1f} multiplications, "
            "{:.1f} 1/√, {:.1f} powers",
            each(v.systemc.setup_cycles), each(counts.add), each(counts.multiply),
            each(counts.rsqrt), each(counts.power));
  if (v.triangles_split > 0) {
    page.line(
        "subdivision",
        "{} triangles over which normals turn by more than {}°, or highlight or light too far, "
        "split into {}",
        v.triangles_split, d.subdivide_degrees, v.pieces);
  }
}

// What `own` needs of `all`, and the difference in per cent.
template <typename Count>
std::string of_all(Count own, Count all) {
  const double part = all > 0 ? static_cast<double>(own) / static_cast<double>(all) - 1 : 0;
  const double percent = std::round(100 * part);
  return fmt::format("{} of {} ({:+.0f} %)", own, all, percent == 0 ? 0.0 : percent);
}

std::size_t operations(const OperationCounts& counts) {
  return counts.add + counts.multiply + counts.rsqrt + counts.power;
}

std::uint64_t operations(const PixelOperations& counts) {
  return counts.additions + counts.multiplications + counts.reads;
}

void report_effects(Page& page, const Verification& v) {
  page.line("effects", "{}", fmt::join(v.effects.used, ", "));
  if (!v.everything) {
    page.line("", "everything is built and simulated, whether the scene has it or not");
    return;
  }
  page.line("left out", "{}", fmt::join(v.effects.left_out, ", "));
  const Account &own = v.systemc, &all = v.everything->systemc;
  const DatapathConfiguration &built = v.hardware.datapath, &full = v.everything->datapath;
  page.line("of everything", "cycles {}, setup operations {}, pixel operations {}",
            of_all(own.frame_cycles, all.frame_cycles),
            of_all(operations(own.setup_operations), operations(all.setup_operations)),
            of_all(operations(own.pixel_operations), operations(all.pixel_operations)));
  page.line("", "adders {}, multipliers {} of {}, ROM bits {}, clock {:.2f} of {:.2f} ns",
            of_all(built.adders(), full.adders()), built.multipliers(), full.multipliers(),
            of_all(built.rom_bits(), full.rom_bits()), v.hardware.clock_ns(),
            v.hardware.technology.clock_ns(full));
  page.line("", "SystemC modules {} of {}, simulation {:.0f} ms of {:.0f} ms; {}",
            own.modules.size(), all.modules.size(), 1e3 * own.seconds, 1e3 * all.seconds,
            page.verdict(all.frame_mismatches == 0,
                         fmt::format("{} pixels differ from everything's", all.frame_mismatches)));
}

nlohmann::ordered_json built_json(const Verification& v, const DatapathConfiguration& datapath,
                                  const Account& account) {
  return {{"clock_ns", v.hardware.technology.clock_ns(datapath)},
          {"frame_cycles", account.frame_cycles},
          {"setup_operations", operations(account.setup_operations)},
          {"pixel_operations", operations(account.pixel_operations)},
          {"adders", datapath.adders()},
          {"multipliers", datapath.multipliers()},
          {"rom_bits", datapath.rom_bits()},
          {"modules", account.modules},
          {"simulation_seconds", account.seconds}};
}

nlohmann::ordered_json effects_json(const Verification& v) {
  nlohmann::ordered_json json = {{"used", v.effects.used},
                                 {"left_out", v.effects.left_out},
                                 {"built", built_json(v, v.hardware.datapath, v.systemc)}};
  if (v.everything) {
    json["everything"] = built_json(v, v.everything->datapath, v.everything->systemc);
    json["everything"]["frame_mismatches"] = v.everything->systemc.frame_mismatches;
  }
  return json;
}

void report_accuracy(Page& page, const Accuracy& accuracy) {
  const ErrorStatistics& e = accuracy.total;
  page.line("accuracy", "largest error {:.2f} LSB, RMS {:.3f} LSB, PSNR {:.1f} dB", e.largest,
            e.rms(), e.psnr_db());
  page.line("", "off by more than ½ LSB {:.2f} %, 1 LSB {:.2f} %, 2 LSB {:.2f} %",
            100 * e.share(e.over_half), 100 * e.share(e.over_one), 100 * e.share(e.over_two));
  const auto part = [](const ErrorStatistics& s) {
    return fmt::format("{:.2f} ({:.3f})", s.largest, s.rms());
  };
  page.line("of which", "series {}, rounding {}, ROM {}, output {}: largest (RMS) LSB",
            part(accuracy.series), part(accuracy.rounding), part(accuracy.rom),
            part(accuracy.output));
}

nlohmann::ordered_json statistics_json(const ErrorStatistics& s) {
  return {{"max_lsb", s.largest}, {"rms_lsb", s.rms()}};
}

}  // namespace

std::string report_text(const Verification& v, bool color) {
  Page page(color);
  page.plain(
      fmt::format("{}: {} triangles, {} of them in view; {} set up; {} pixels shaded, {} visible",
                  v.scene.string(), v.triangles_read, v.triangles, v.triangles_set_up, v.pixels,
                  v.visible_pixels));
  for (const std::string& note : v.notes) page.line("note", "{}", note);
  page.line("hardware", "{}, configuration {}", v.hardware.name, configuration_hash(v.hardware));
  report_hardware(page, v);
  report_effects(page, v);
  report_account(page, "systemc", v.systemc, v);
  report_account(page, "rtl", v.rtl, v);
  const std::int64_t difference = v.cycle_difference();
  page.line("cycles", "{} for the frame; with the RTL in it {}, difference {}{}",
            v.systemc.frame_cycles, v.rtl.frame_cycles,
            page.verdict(v.same_cycles(), fmt::format("{}", difference)),
            v.same_cycles() || difference != 0 ? "" : ", but pixels leave at other cycles");
  page.line("clock", "{:.2f} ns ({}: {})", v.hardware.clock_ns(), v.hardware.technology.name,
            v.hardware.technology.source);
  page.line("time", "datapath {:.2f} ns a pixel, whole frame {:.2f} ns a pixel, {}",
            v.datapath_ns(), v.frame_ns(),
            page.verdict(v.within_budget(),
                         fmt::format("{:.2f} ns {} the budget of {:g} ns",
                                     std::fabs(v.options.budget_ns - v.frame_ns()),
                                     v.within_budget() ? "under" : "OVER", v.options.budget_ns)));
  report_accuracy(page, v.accuracy);
  if (v.rom_error > 0.01) {
    page.line("warning",
              "the ROM errs by up to {:.2f} % of a full highlight; raise "
              "rom_address_bits, or bring the shininess nearer to 1",
              100 * v.rom_error);
  }
  if (v.coefficient_overflows > 0) {
    page.line("overflow", "{}",
              page.verdict(false, fmt::format("{} triangles have values that do not fit their "
                                              "registers, so that their pixels may be wrong: is a "
                                              "light too close or bright, or [depth_cue] narrow?",
                                              v.coefficient_overflows)));
  }
  page.plain(page.verdict(v.passed(), v.passed() ? "PASSED" : "FAILED") + " " + v.scene.string());
  return page.text();
}

nlohmann::ordered_json report_json(const Verification& v) {
  Hardware hardware = v.hardware;
  hardware.choose_channels = false;
  nlohmann::ordered_json configuration = {{"hardware", hardware.name},
                                          {"technology", hardware.technology.name}};
  for (const Setting& setting : settings(hardware)) {
    auto& value = configuration[std::string(setting.section)][std::string(setting.key)];
    if (setting.choices.empty()) {
      value = setting.get();
    } else {
      value = setting.value();
    }
  }
  configuration["datapath"]["channels"] = hardware.datapath.channels;
  const Accuracy& a = v.accuracy;
  const double psnr = a.total.psnr_db();
  return {{"scene", v.scene.string()},
          {"configuration", configuration},
          {"configuration_hash", configuration_hash(v.hardware)},
          {"triangles", v.triangles},
          {"triangles_read", v.triangles_read},
          {"subdivision", {{"triangles", v.triangles_split}, {"pieces", v.pieces}}},
          {"pixels", v.pixels},
          {"effects", effects_json(v)},
          {"mismatches",
           {{"model_rtl", v.rtl.mismatches + v.rtl.frame_mismatches},
            {"model_systemc", v.systemc.mismatches + v.systemc.frame_mismatches}}},
          {"cycles",
           {{"frame", v.systemc.frame_cycles},
            {"datapath_rtl", v.rtl.datapath_cycles},
            {"datapath_systemc", v.systemc.datapath_cycles},
            {"difference", v.cycle_difference()},
            {"setup", v.systemc.setup_cycles},
            {"setup_per_triangle",
             static_cast<double>(v.systemc.setup_cycles) / static_cast<double>(v.triangles_set_up)},
            {"rom_load", v.systemc.rom_load_cycles}}},
          {"clock_ns", v.hardware.clock_ns()},
          {"clock_source", v.hardware.technology.source},
          {"ns_per_pixel", {{"datapath", v.datapath_ns()}, {"frame", v.frame_ns()}}},
          {"budget_ns", v.options.budget_ns},
          {"within_budget", v.within_budget()},
          {"accuracy",
           {{"max_lsb", a.total.largest},
            {"rms_lsb", a.total.rms()},
            {"psnr_db", std::isfinite(psnr) ? nlohmann::ordered_json(psnr) : nullptr},
            {"over_half", a.total.share(a.total.over_half)},
            {"over_one", a.total.share(a.total.over_one)},
            {"over_two", a.total.share(a.total.over_two)}}},
          {"accuracy_split",
           {{"series", statistics_json(a.series)},
            {"rounding", statistics_json(a.rounding)},
            {"rom", statistics_json(a.rom)},
            {"output", statistics_json(a.output)}}},
          {"coefficient_overflows", v.coefficient_overflows},
          {"seed", v.options.seed},
          {"passed", v.passed()}};
}

}  // namespace phongpipe
