#include "testbench/methods/curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/fixed/coverage.h"
#include "model/shading/methods/lookup.h"
#include "sim/schedule.h"
#include "testbench/methods/operation_time.h"
#include "testbench/methods/specimens.h"

namespace phongpipe {
namespace {

constexpr double kFullScale = 255;

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<const ShadingMethod*> accepting(const Scene& scene, const Material& material) {
  std::vector<const ShadingMethod*> methods;
  for (const ShadingMethod& method : shading_methods()) {
    if (!refusal(method, scene, {material})) methods.push_back(&method);
  }
  return methods;
}

Material grey(double diffuse, double specular, double shininess) {
  Material material;
  material.ambient = Color::Zero();
  material.diffuse = Color::Constant(diffuse);
  material.specular = Color::Constant(specular);
  material.shininess = shininess;
  return material;
}

// Full shading never exceeds full scale, where the clamp would hide errors.
Material material_of(Parts parts, double shininess) {
  return parts == Parts::full ? grey(0.5, 0.5, shininess) : grey(1, 0, shininess);
}

void report(const CurveOptions& options, const std::string& text) {
  if (options.progress) options.progress(text);
}

std::vector<int> decade_steps(const std::vector<int>& factors, int last) {
  std::vector<int> values;
  for (int decade = 1; decade < last; decade *= 10) {
    for (const int factor : factors) values.push_back(factor * decade);
  }
  values.push_back(last);
  return values;
}

constexpr int kLargestTriangle = 10000, kLargestExponent = 10000;

// A way to the power beside those of Power: the paper's larger table.
struct NamedPower {
  std::string name;
  std::function<double(double)> power;
};

std::vector<NamedPower> powers(double n) {
  std::vector<NamedPower> result;
  for (const PowerKind kind : power_kinds()) {
    if (kind == PowerKind::exact) continue;
    result.push_back({std::string(name(kind)), Power(kind, n)});
    if (kind != PowerKind::table) continue;
    result.back().name = "table of 2^10";
    constexpr int kWords = 1 << 13;
    const auto power = [n](double x) { return std::pow(x, n); };
    result.push_back({"table of 2^13",
                      [table = LookupTable(kWords, 1, power)](double x) { return table.at(x); }});
  }
  return result;
}

// As shaders put a highlight together.
std::vector<double> highlights(const std::vector<Reflection<double>>& reflections,
                               const NamedPower& power) {
  std::vector<double> levels;
  for (const Reflection<double>& r : reflections) {
    const double level = r.diffuse > 0 ? power.power(std::min(r.highlight, 1.0)) : 0;
    levels.push_back(kFullScale * std::clamp(level, 0.0, 1.0));
  }
  return levels;
}

// Errors of each series at one x, in the order in which series first appear.
class Errors {
 public:
  void add(const std::string& series, double error) {
    const auto same = [&](const auto& entry) { return entry.first == series; };
    auto found = std::find_if(errors_.begin(), errors_.end(), same);
    if (found == errors_.end()) found = errors_.insert(errors_.end(), {series, {}});
    found->second.push_back(error);
  }
  void append_medians(double x, Curve& curve) const {
    curve.series.resize(errors_.size());
    for (std::size_t i = 0; i < errors_.size(); ++i) {
      curve.series[i].name = errors_[i].first;
      curve.series[i].points.push_back({x, median(errors_[i].second), ""});
    }
  }

 private:
  std::vector<std::pair<std::string, std::vector<double>>> errors_;
};

std::string y_label(const CurveOptions& options) {
  return fmt::format("largest error, LSB (median of {} triangles)", options.triangles);
}

// Rows of a triangle, which is half of a square.
double rows_of(int pixels) {
  return std::round(std::sqrt(2.0 * pixels));
}

}  // namespace

Curve curvature_curve(Parts parts, double shininess, const CurveOptions& options) {
  // With a highlight, the light is nowhere far beyond the horizon; without, any light is as good.
  const double eye_from_peak = parts == Parts::full ? 30 : 60;
  Curve curve;
  curve.title = parts == Parts::full
                    ? fmt::format("Error of full Phong shading, exponent {}", shininess)
                    : "Error of diffuse light";
  curve.x_label = "largest angle between the normals of a triangle, degrees";
  curve.y_label = y_label(options);
  curve.log_y = true;
  for (int spread = 5; spread <= 90; spread += 5) {
    report(options, fmt::format("curvature {} degrees", spread));
    Errors errors;
    for (Specimen& specimen :
         random_specimens({static_cast<double>(spread), eye_from_peak, options.highlight},
                          options.triangles, options.seed)) {
      specimen.material = material_of(parts, shininess);
      const auto exact = specimen.shade(*find_shading_method("phong"));
      for (const ShadingMethod* method : accepting(specimen.scene, specimen.material)) {
        errors.add(std::string(method->name), largest_difference(specimen.shade(*method), exact));
      }
    }
    errors.append_medians(spread, curve);
  }
  return curve;
}

double amortised_clocks(const MethodCosts& costs, int pixels, const ClockFunction& clocks) {
  return (clocks(costs.triangle) + rows_of(pixels) * clocks(costs.span)) / pixels +
         clocks(costs.pixel + costs.combine);
}

Curve size_curve(Parts parts, PowerKind power, const ClockFunction& clocks,
                 const CurveOptions& options) {
  Curve curve;
  curve.title = parts == Parts::full ? "Time of full Phong shading" : "Time of diffuse light";
  curve.x_label = "size of a triangle, pixels";
  curve.y_label = "clocks a pixel, set-up included";
  curve.log_x = curve.log_y = true;
  const Scene scene = random_specimens({5, 0, options.highlight}, 1, options.seed).front().scene;
  for (const ShadingMethod* method : accepting(scene, material_of(parts, 1))) {
    const MethodCosts costs = method->costs(parts, power);
    PlotSeries series = {std::string(method->name), {}};
    for (const int pixels : decade_steps({1, 2, 3, 5, 7}, kLargestTriangle)) {
      series.points.push_back(
          {static_cast<double>(pixels), amortised_clocks(costs, pixels, clocks), ""});
    }
    curve.series.push_back(std::move(series));
  }
  return curve;
}

Curve block_curve(const std::shared_ptr<const PreparedScene>& scene, const Hardware& hardware,
                  double budget_ns) {
  if (!covers_a_pixel(scene->scene, scene->geometry)) throw nothing_covered(scene->scene);
  Curve curve;
  curve.title = "Time of each block of the pipeline, " + scene->scene.source;
  curve.x_label = "size of a triangle, pixels";
  curve.y_label = "ns a pixel";
  curve.log_x = curve.log_y = true;
  const PipelineConfiguration& pipeline = hardware.pipeline;
  const auto add = [&curve](std::string name, const std::function<double(int)>& ns) {
    PlotSeries series = {std::move(name), {}};
    for (const int pixels : decade_steps({1, 2, 3, 5, 7}, kLargestTriangle)) {
      series.points.push_back({static_cast<double>(pixels), ns(pixels), ""});
    }
    curve.series.push_back(std::move(series));
  };
  SetupTimes times(pipeline);
  double clock_ns = 0;
  DatapathConfiguration datapath;
  for (std::size_t i = 0; i < series_fit_names().size(); ++i) {
    SetupPolicy policy = hardware.setup;
    policy.series_fit = static_cast<SeriesFit>(i);
    const PreparedFrame frame(scene, hardware.formats, policy);
    datapath = frame.setup.configuration;
    clock_ns = hardware.technology.clock(datapath).ns;
    const std::uint32_t material = frame.geometry().triangles.front().material;
    const double cycles = times.of(frame.setup.material(0, material).plan).cycles;
    add(fmt::format("setup_engine, {}", series_fit_names()[i]),
        [=](int pixels) { return clock_ns * cycles / pixels; });
  }
  add("span_walker", [&](int pixels) {
    const double rows = rows_of(pixels);
    return clock_ns *
           (pipeline.walker_triangle_cycles + (rows - 1) * pipeline.walker_row_cycles + 1) / pixels;
  });
  // Groups of pixels that leave together, in rows of equal length.
  const auto groups = [&](int pixels) -> double {
    if (datapath.lanes() == 1) return pixels;
    return rows_of(pixels) * std::ceil(pixels / rows_of(pixels) / datapath.lanes());
  };
  add("pixel_datapath",
      [&](int pixels) { return clock_ns * datapath.interval_cycles() * groups(pixels) / pixels; });
  add("framebuffer", [&](int pixels) {
    return clock_ns * pipeline.framebuffer_write_cycles * groups(pixels) / pixels;
  });
  add("budget", [&](int) { return budget_ns; });
  return curve;
}

Curve break_even_curve(const PipelineConfiguration& units) {
  Curve curve;
  curve.title = "Time of a series over that of shading each pixel anew; it pays below 1";
  curve.x_label = "size of a triangle, pixels";
  curve.y_label = "ratio of times, set-up included";
  curve.log_x = curve.log_y = true;
  const auto costs = [](const char* name) {
    return find_shading_method(name)->costs(Parts::full, PowerKind::table);
  };
  const std::pair<const char*, ClockFunction> machines[] = {
      {"sequential", sequential_operations},
      {"shared units", [&units](const OperationCounts& counts) { return clocks(counts, units); }}};
  for (const auto& [machine, clocks] : machines) {
    for (const char* series : {"taylor", "weighted"}) {
      for (const char* rival : {"phong", "duff"}) {
        const auto size = break_even_pixels(costs(series), costs(rival), clocks);
        PlotSeries line = {fmt::format("{} over {}, {}: pays {}", series, rival, machine,
                                       size ? fmt::format("from {} pixels", *size) : "nowhere"),
                           {}};
        for (const int pixels : decade_steps({1, 2, 3, 5, 7}, kLargestTriangle)) {
          const double ratio = amortised_clocks(costs(series), pixels, clocks) /
                               amortised_clocks(costs(rival), pixels, clocks);
          line.points.push_back({static_cast<double>(pixels), ratio, ""});
        }
        curve.series.push_back(std::move(line));
      }
    }
  }
  return curve;
}

std::optional<int> break_even_pixels(const MethodCosts& method, const MethodCosts& other,
                                     const ClockFunction& clocks) {
  int pixels = kLargestTriangle;
  while (pixels > 0 &&
         amortised_clocks(method, pixels, clocks) < amortised_clocks(other, pixels, clocks)) {
    --pixels;
  }
  if (pixels == kLargestTriangle) return std::nullopt;
  return pixels + 1;
}

Curve exponent_curve(double spread_degrees, const CurveOptions& options) {
  Curve curve;
  curve.title =
      fmt::format("Error of the highlight alone, normals spanning {} degrees", spread_degrees);
  curve.x_label = "exponent";
  curve.y_label = y_label(options);
  curve.log_x = curve.log_y = true;
  const ShadingMethod& phong = *find_shading_method("phong");
  std::vector<Specimen> triangles =
      random_specimens({spread_degrees, 0, options.highlight}, options.triangles, options.seed);
  const std::vector<const ShadingMethod*> stepped = {&phong, find_shading_method("taylor")};
  for (const int exponent : decade_steps({1, 2, 3, 5, 7}, kLargestExponent)) {
    report(options, fmt::format("exponent {}", exponent));
    const std::vector<NamedPower> ways = powers(exponent);
    Errors errors;
    for (Specimen& specimen : triangles) {
      specimen.material = grey(0, 1, exponent);
      const auto exact = specimen.shade(phong);
      for (const ShadingMethod* method : accepting(specimen.scene, specimen.material)) {
        errors.add(std::string(method->name), largest_difference(specimen.shade(*method), exact));
      }
      for (const ShadingMethod* method : stepped) {
        if (refusal(*method, specimen.scene, {specimen.material})) continue;
        const auto reflections = specimen.reflect(*method);
        for (const NamedPower& way : ways) {
          errors.add(fmt::format("{}, {}", method->name, way.name),
                     largest_difference(highlights(reflections, way), exact));
        }
      }
    }
    errors.append_medians(exponent, curve);
  }
  return curve;
}

Chart chart_of(const Curve& curve) {
  return {curve.title, curve.x_label, curve.y_label, curve.log_x, curve.log_y, true, curve.series};
}

}  // namespace phongpipe
