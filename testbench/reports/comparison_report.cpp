#include "testbench/reports/comparison_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "testbench/campaign/pareto.h"
#include "testbench/drawing/pictures.h"
#include "testbench/methods/curves.h"
#include "testbench/methods/operation_time.h"
#include "testbench/methods/unit_hardware.h"
#include "testbench/reports/result_page.h"
#include "testbench/system/output_file.h"

namespace phongpipe {
namespace {

// Without folders and extension, as files and titles have it.
std::string name_of(const Comparison& comparison) {
  return std::filesystem::path(comparison.scene).stem().string();
}

std::string operations_text(const OperationCounts& c) {
  return fmt::format("{}/{}/{}/{}/{}", c.add, c.multiply, c.divide, c.sqrt + c.rsqrt, c.read);
}

std::string break_even_text(std::optional<int> pixels) {
  return pixels ? fmt::format("{}", *pixels) : "never";
}

double wall_clock_of_phong(const Comparison& comparison) {
  for (const MethodResult& result : comparison.methods) {
    if (result.name == "phong") return result.wall_clock_ns_per_pixel;
  }
  return 0;
}

std::string subdivision_text(const Comparison& c) {
  if (c.split == 0) return "";
  return fmt::format(
      "split for the fitted quadratics: {} over which normals turn by more than {}°, or highlight "
      "or light too far, into {}\n",
      count_text(c.split, "triangle"), c.hardware.setup.subdivide_degrees,
      count_text(c.pieces, "piece"));
}

nlohmann::ordered_json operations_json(const OperationCounts& c) {
  return {{"add", c.add},   {"multiply", c.multiply}, {"divide", c.divide},
          {"sqrt", c.sqrt}, {"rsqrt", c.rsqrt},       {"read", c.read}};
}

// The paper's own series, for the eye where the scene has it.
double largest_error_of_taylor(const Comparison& comparison) {
  for (const MethodResult& result : comparison.methods) {
    const bool taylor = result.name == "taylor" || result.name == "taylor-local";
    if (taylor && result.refused.empty()) return result.error.largest_lsb;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

nlohmann::ordered_json finite_or_null(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

Picture error_picture(const MethodResult& result, const Comparison& comparison) {
  Picture picture = error_map(comparison.width, comparison.height);
  for (std::size_t i = 0; i < result.errors_lsb.size(); ++i) {
    const auto error_lsb = static_cast<double>(result.errors_lsb[i]);
    if (!std::isnan(error_lsb)) *picture.pixel(i) = error_level(error_lsb);
  }
  return picture;
}

using Better = Metric::Better;

// To a millionth: less is the rounding of doubles, by which no method is better than another.
double meaningful(double lsb) {
  constexpr double kSteps = 1e6;
  return std::round(kSteps * lsb) / kSteps;
}

// A measure of a method. Those of cost are not filled in for the limit.
struct MethodColumn {
  std::string_view name, unit, meaning;
  Better better;
  bool of_cost;
  MetricValue (*value)(const MethodResult&, const Comparison&);
};

OperationCounts of_a_pixel(const MethodResult& r) {
  return r.costs.pixel + r.costs.combine;
}

std::optional<UnitHardware> hardware_of(const MethodResult& r, const Comparison& comparison) {
  return unit_hardware(of_a_pixel(r), comparison.hardware.technology);
}

nlohmann::ordered_json hardware_json(const MethodResult& r, const Comparison& comparison) {
  const auto hardware = hardware_of(r, comparison);
  if (!hardware) return nullptr;
  return {{"luts", hardware->luts},
          {"registers", hardware->registers},
          {"block_rams", hardware->block_rams},
          {"clock_ns", hardware->clock_ns}};
}

MetricValue count(std::size_t value) {
  return static_cast<std::int64_t>(value);
}

// A figure of the hardware that shades a pixel a clock, if the card has units.
template <auto figure>
MetricValue of_hardware(const MethodResult& r, const Comparison& comparison) {
  const auto hardware = hardware_of(r, comparison);
  if (!hardware) return {};
  const auto value = std::invoke(figure, *hardware);
  if constexpr (std::is_integral_v<decltype(value)>) {
    return count(static_cast<std::size_t>(value));
  } else {
    return value;
  }
}

constexpr MethodColumn kMethodColumns[] = {
    {"add", "", "additions for a pixel", Better::less, true,
     [](const MethodResult& r, const Comparison&) { return count(of_a_pixel(r).add); }},
    {"multiply", "", "multiplications for a pixel", Better::less, true,
     [](const MethodResult& r, const Comparison&) { return count(of_a_pixel(r).multiply); }},
    {"divide", "", "divisions for a pixel", Better::less, true,
     [](const MethodResult& r, const Comparison&) { return count(of_a_pixel(r).divide); }},
    {"sqrt", "", "√ and 1/√ for a pixel", Better::less, true,
     [](const MethodResult& r, const Comparison&) {
       return count(of_a_pixel(r).sqrt + of_a_pixel(r).rsqrt);
     }},
    {"read", "", "table reads for a pixel", Better::less, true,
     [](const MethodResult& r, const Comparison&) { return count(of_a_pixel(r).read); }},
    {"clocks_per_pixel", "cycles", "on the setup engine's units, setup shared out over the pixels",
     Better::less, true,
     [](const MethodResult& r, const Comparison&) -> MetricValue { return r.clocks_per_pixel; }},
    {"ns_per_pixel", "ns", "the same as time", Better::less, true,
     [](const MethodResult& r, const Comparison&) -> MetricValue { return r.ns_per_pixel; }},
    {"luts", "", "of hardware that shades a pixel a clock: a unit for each operation", Better::less,
     true, of_hardware<&UnitHardware::luts>},
    {"registers", "", "of the same, in bits", Better::less, true,
     of_hardware<&UnitHardware::registers>},
    {"block_rams", "", "of the same", Better::less, true, of_hardware<&UnitHardware::block_rams>},
    {"unit_clock_ns", "ns", "clock of its slowest unit, and time of a pixel", Better::less, true,
     of_hardware<&UnitHardware::clock_ns>},
    {"lut_ns", "ns", "area × time: LUTs of that hardware times its clock", Better::less, true,
     of_hardware<&UnitHardware::lut_ns>},
    {"speed_over_phong", "", "as software on this machine, exact Phong's being 1", Better::more,
     true,
     [](const MethodResult& r, const Comparison& c) -> MetricValue {
       return wall_clock_of_phong(c) / r.wall_clock_ns_per_pixel;
     }},
    {"max_lsb", "LSB", "largest error against exact Phong", Better::less, false,
     [](const MethodResult& r, const Comparison&) -> MetricValue {
       return meaningful(r.error.largest_lsb);
     }},
    {"rms_lsb", "LSB", "root of its mean square", Better::less, false,
     [](const MethodResult& r, const Comparison&) -> MetricValue {
       return meaningful(r.error.rms_lsb());
     }},
    {"seam_lsb", "LSB", "largest jump of the error across an edge that two triangles share",
     Better::less, false,
     [](const MethodResult& r, const Comparison&) -> MetricValue {
       return meaningful(r.largest_seam_lsb);
     }},
};

Cell cell(const MethodColumn& column, const MethodResult& r, const Comparison& comparison) {
  if (!r.refused.empty() || (column.of_cost && r.is_limit)) return MetricValue();
  return column.value(r, comparison);
}

// A cost of a method, if it has one.
using CostOf = std::function<std::optional<double>(const MethodResult&)>;

// The methods with the least error for their cost, the cheapest first; of those whose errors are as
// good as the same, the cheapest alone.
std::vector<std::size_t> best_methods(const Comparison& comparison, const CostOf& cost) {
  std::vector<std::optional<ParetoPoint>> points;
  for (const MethodResult& r : comparison.methods) {
    std::optional<double> value;
    if (r.refused.empty() && !r.is_limit) value = cost(r);
    points.push_back(value
                         ? std::make_optional(ParetoPoint{*value, meaningful(r.error.largest_lsb)})
                         : std::nullopt);
  }
  return pareto_front(points);
}

CostOf time_of_units() {
  return [](const MethodResult& r) { return std::make_optional(r.ns_per_pixel); };
}
CostOf area_times_time(const Comparison& comparison) {
  return [&comparison](const MethodResult& r) -> std::optional<double> {
    const auto hardware = hardware_of(r, comparison);
    if (!hardware || hardware->luts == 0) return {};  // nothing to compute for a pixel
    return hardware->lut_ns();
  };
}

// All methods, and the front of those with the least error for their cost.
Chart accuracy_against(const Comparison& comparison, const CostOf& cost, std::string title,
                       std::string x_label) {
  Chart chart;
  chart.title = name_of(comparison) + std::move(title);
  chart.x_label = std::move(x_label);
  chart.y_label = "largest error, LSB";
  chart.log_x = chart.log_y = true;
  const auto point = [&cost](const MethodResult& r, std::string label) {
    // Methods that equal Phong but for the last bits stand on the floor of the plot.
    constexpr double kFloor = 0.01;
    return PlotPoint{*cost(r), std::max(kFloor, r.error.largest_lsb), std::move(label)};
  };
  PlotSeries methods = {"methods", {}, false}, front = {"least error for its cost", {}};
  for (const MethodResult& r : comparison.methods) {
    if (!r.refused.empty() || r.is_limit || !cost(r)) continue;
    methods.points.push_back(point(r, std::string(r.name)));
  }
  for (const std::size_t i : best_methods(comparison, cost)) {
    front.points.push_back(point(comparison.methods[i], ""));
  }
  chart.series = {std::move(methods), std::move(front)};
  return chart;
}

}  // namespace

std::vector<std::string> comparison_answer(const Comparison& comparison) {
  const auto best = [&](const CostOf& cost, const char* format) {
    std::vector<std::string> texts;
    for (const std::size_t i : best_methods(comparison, cost)) {
      const MethodResult& r = comparison.methods[i];
      texts.push_back(fmt::format(fmt::runtime(format), r.name, *cost(r), r.error.largest_lsb));
    }
    return fmt::format("{}", fmt::join(texts, "; "));
  };
  const auto& methods = comparison.methods;
  const auto drawn = std::count_if(methods.begin(), methods.end(),
                                   [](const MethodResult& r) { return r.refused.empty(); });
  std::vector<std::string> lines = {
      fmt::format("{}: {} of {} methods render it.", comparison.scene, drawn, methods.size()),
      fmt::format("Least error for their time: {}.",
                  best(time_of_units(), "{} {:.2f} ns a pixel and {:.2f} LSB"))};
  if (!comparison.hardware.technology.units.empty()) {
    lines.push_back(
        fmt::format("Least error for the area × time of hardware that shades a pixel a clock: {}.",
                    best(area_times_time(comparison), "{} {:.0f} LUT·ns and {:.2f} LSB")));
  }
  for (const MethodResult& r : methods) {
    if (!r.of_hardware) continue;
    lines.push_back(fmt::format("Hardware {} has {}: {:.2f} ns a pixel and {:.2f} LSB.",
                                comparison.hardware.name, r.name, r.ns_per_pixel,
                                r.error.largest_lsb));
  }
  return lines;
}

std::string comparison_text(const Comparison& comparison) {
  std::string text = fmt::format(
      "{}: {}, {}, {} shaded; clock {:.2f} ns ({}, {})\n{}"
      "{:<20} {:>12} {:>14} {:>8} {:>8} {:>7} {:>10} {:>8} {:>8} {:>8} {:>7}\n"
      "{:<20} {:>12} {:>14} {:>8} {:>8} {:>7} {:>10} {:>8} {:>8} {:>8} {:>7}\n",
      comparison.scene, count_text(comparison.triangles, "triangle"),
      count_text(comparison.spans, "span"), count_text(comparison.pixels, "pixel"),
      comparison.clock.ns, kind_text(comparison.clock), comparison.hardware.technology.name,
      subdivision_text(comparison), "method", "a pixel", "a triangle", "clocks", "ns", "speed",
      "pays from", "largest", "largest", "RMS", "seam", "", "+/×/÷/√/read", "+/×/÷/√/read",
      "a pixel", "a pixel", "×Phong", "pixels", "LSB", "×Taylor", "LSB", "LSB");
  const double phong = wall_clock_of_phong(comparison);
  const double taylor = largest_error_of_taylor(comparison);
  for (const MethodResult& r : comparison.methods) {
    if (!r.refused.empty()) {
      text += fmt::format("{:<20} refused: {}\n", r.name, r.refused);
      continue;
    }
    const std::string cost =
        r.is_limit
            ? fmt::format("{:>12} {:>14} {:>8} {:>8} {:>7} {:>10}", "–", "–", "–", "–", "–", "–")
            : fmt::format("{:>12} {:>14} {:>8.2f} {:>8.2f} {:>7.2f} {:>10}",
                          operations_text(r.costs.pixel + r.costs.combine),
                          operations_text(r.costs.triangle), r.clocks_per_pixel, r.ns_per_pixel,
                          phong / r.wall_clock_ns_per_pixel, break_even_text(r.break_even_pixels));
    const double ratio = r.error.largest_lsb / taylor;
    text +=
        fmt::format("{:<20} {} {:>8.2f} {:>8} {:>8.3f} {:>7.2f}{}\n", r.name, cost,
                    r.error.largest_lsb, std::isfinite(ratio) ? fmt::format("{:.2f}", ratio) : "–",
                    r.error.rms_lsb(), r.largest_seam_lsb, r.note.empty() ? "" : "  " + r.note);
  }
  return text +
         "a pixel, a triangle: operations counted, one channel, power by table; clocks: on the "
         "setup "
         "engine's units, setup shared out;\nspeed: as software on this machine, setup included; "
         "pays from: triangles of so many pixels cost less than exact Phong's, 1/√ = 10\n";
}

nlohmann::ordered_json comparison_json(const Comparison& comparison) {
  nlohmann::ordered_json methods = nlohmann::ordered_json::array();
  const double phong = wall_clock_of_phong(comparison);
  const double taylor = largest_error_of_taylor(comparison);
  for (const MethodResult& r : comparison.methods) {
    nlohmann::ordered_json j = {{"method", r.name}, {"source", r.source}};
    if (!r.refused.empty()) {
      j["refused"] = r.refused;
      methods.push_back(std::move(j));
      continue;
    }
    j["note"] = r.note;
    if (!r.is_limit) {
      nlohmann::ordered_json pays = nlohmann::ordered_json::object();
      for (const MethodResult& other : comparison.methods) {
        if (!other.refused.empty() || other.is_limit || &other == &r) continue;
        const auto pixels = break_even_pixels(r.costs, other.costs, sequential_operations);
        pays[std::string(other.name)] =
            pixels ? nlohmann::ordered_json(*pixels) : nlohmann::ordered_json(nullptr);
      }
      j.update({{"operations",
                 {{"pixel", operations_json(r.costs.pixel + r.costs.combine)},
                  {"span", operations_json(r.costs.span)},
                  {"triangle", operations_json(r.costs.triangle)}}},
                {"clocks_per_pixel", r.clocks_per_pixel},
                {"ns_per_pixel", r.ns_per_pixel},
                {"sequential_operations_per_pixel", r.operations_per_pixel},
                {"one_pixel_a_clock", hardware_json(r, comparison)},
                {"cycles_per_triangle", clocks(r.costs.triangle, comparison.hardware.pipeline)},
                {"speed_over_phong", phong / r.wall_clock_ns_per_pixel},
                {"break_even_pixels", pays}});
    }
    j.update({{"max_lsb", meaningful(r.error.largest_lsb)},
              {"max_over_taylor", finite_or_null(r.error.largest_lsb / taylor)},
              {"rms_lsb", meaningful(r.error.rms_lsb())},
              {"psnr_db", finite_or_null(r.error.psnr_db())},
              {"seam_lsb", meaningful(r.largest_seam_lsb)}});
    methods.push_back(std::move(j));
  }
  return {{"scene", comparison.scene},
          {"triangles", comparison.triangles},
          {"spans", comparison.spans},
          {"pixels", comparison.pixels},
          {"subdivision", {{"triangles", comparison.split}, {"pieces", comparison.pieces}}},
          {"clock_ns", comparison.clock.ns},
          {"clock_kind", name(comparison.clock.kind)},
          {"clock_limited_by", comparison.clock.limited_by},
          {"methods", methods}};
}

std::string comparison_csv(const Comparison& comparison) {
  std::string text = "scene,method,refused";
  for (const MethodColumn& column : kMethodColumns) text += fmt::format(",{}", column.name);
  text += '\n';
  for (const MethodResult& r : comparison.methods) {
    text += fmt::format("{},{},{}", comparison.scene, r.name,
                        r.refused.empty() ? "" : fmt::format("\"{}\"", r.refused));
    for (const MethodColumn& column : kMethodColumns) {
      text += "," + exact_text(cell(column, r, comparison));
    }
    text += '\n';
  }
  return text;
}

Chart accuracy_against_time(const Comparison& comparison) {
  return accuracy_against(comparison, time_of_units(), ": accuracy against time",
                          "ns a pixel on the setup engine's units");
}

std::vector<std::filesystem::path> write_comparison_page(const Comparison& comparison,
                                                         const std::string& render,
                                                         const std::filesystem::path& folder) {
  const std::string scene = name_of(comparison);
  make_folder(folder);
  PageContent page;
  page.title = scene + ": every shading method, its accuracy and its time";
  page.row = "method";
  page.summary = comparison_answer(comparison);
  const bool units = !comparison.hardware.technology.units.empty();
  page.x = units ? "lut_ns" : "ns_per_pixel";
  page.y = "max_lsb";
  page.logarithmic = true;
  page.details = comparison_text(comparison);
  const auto add_column = [&page](std::string_view name, std::string_view meaning,
                                  PageColumn::Kind kind) {
    page.columns.push_back({std::string(name), "", std::string(meaning), kind, Better::neither});
  };
  add_column("method", "", PageColumn::Kind::input);
  add_column("source", "where it is described", PageColumn::Kind::text);
  add_column("outcome", "whether it can render the scene", PageColumn::Kind::text);
  add_column("message", "why it is refused, or what else there is to it", PageColumn::Kind::text);
  for (const MethodColumn& column : kMethodColumns) {
    page.columns.push_back({std::string(column.name), std::string(column.unit),
                            std::string(column.meaning), PageColumn::Kind::metric, column.better});
  }
  for (const MethodResult& r : comparison.methods) {
    const bool refused = !r.refused.empty();
    std::vector<Cell>& row = page.rows.emplace_back();
    row = {std::string(r.name), std::string(r.source), std::string(refused ? "refused" : "passed"),
           refused ? r.refused : r.note};
    for (const MethodColumn& column : kMethodColumns) row.push_back(cell(column, r, comparison));
    const bool renders = !refused && !r.is_limit;
    page.commands.push_back(renders
                                ? fmt::format("{} --method {} -o {}", render, r.name,
                                              shell_word(fmt::format("{}-{}.png", scene, r.name)))
                                : "");
    if (refused) continue;
    const std::string picture =
        png(picture_of(r.colors, comparison.width, comparison.height, comparison.channels));
    const std::string error = png(error_picture(r, comparison));
    write_text(folder / fmt::format("{}-{}.png", scene, r.name), picture);
    write_text(folder / fmt::format("{}-{}-error.png", scene, r.name), error);
    page.pictures[page.rows.size() - 1] = {{"result", picture}, {"error map", error}};
  }
  std::vector<std::filesystem::path> files;
  const auto write = [&](const char* what, const std::string& text) {
    files.push_back(folder / (scene + what));
    write_text(files.back(), text);
  };
  write("-methods.html", result_page(page));
  write("-methods.svg", svg(accuracy_against_time(comparison)));
  if (units) {
    write("-area.svg", svg(accuracy_against(comparison, area_times_time(comparison),
                                            ": accuracy against area × time, a pixel a clock",
                                            "LUTs × clock in ns")));
  }
  return files;
}

std::string microvax_text() {
  // Bishop & Weimer 1986, summary: their figure 4, CPU seconds.
  struct Row {
    const char* printed_as;
    const char* method;
    double seconds, setup_seconds;
  };
  constexpr std::array<Row, 5> kRows = {Row{"Gouraud", "gouraud", 406, 0},
                                        {"Taylor (infinite)", "taylor", 767, 119},
                                        {"Taylor (finite)", "taylor-local", 850, 202},
                                        {"Duff", "duff", 2597, 0},
                                        {"Phong", "phong", 3900, 0}};
  constexpr double kTriangles = 14620, kPixels = 2048.0 * 2048.0;
  const auto costs = [](const Row& row) {
    return find_shading_method(row.method)->costs(Parts::full, PowerKind::table);
  };
  const auto setup = [&](const Row& row) {
    return kTriangles * sequential_operations(costs(row).triangle);
  };
  const auto pixels = [&](const Row& row) {
    return kPixels * sequential_operations(costs(row).pixel + costs(row).combine);
  };
  const double second = kRows[1].setup_seconds / setup(kRows[1]);
  const double gouraud = pixels(kRows[0]) + setup(kRows[0]);
  std::string text = fmt::format(
      "MicroVAX-II, 14,620 triangles at 2048×2048: printed seconds, and operations counted (add = "
      "multiply = memory = 1, 1/√ = 10)\nat {:.2f} µs each, which makes the Taylor setup take its "
      "119 s. Shading only: no transformation, scan conversion or display.\n"
      "{:<18} {:>8} {:>8} {:>10} {:>10} {:>10} {:>14} {:>14}\n",
      1e6 * second, "", "printed", "setup", "counted", "setup", "ops/pixel", "÷Gouraud",
      "printed ÷");
  for (const Row& row : kRows) {
    text += fmt::format(
        "{:<18} {:>8.0f} {:>8} {:>10.0f} {:>10.0f} {:>10.0f} {:>14.2f} {:>14.2f}\n", row.printed_as,
        row.seconds, row.setup_seconds > 0 ? fmt::format("{:.0f}", row.setup_seconds) : "",
        second * (setup(row) + pixels(row)), second * setup(row), pixels(row) / kPixels,
        (setup(row) + pixels(row)) / gouraud, row.seconds / kRows[0].seconds);
  }
  return text;
}

}  // namespace phongpipe
