#include "testbench/comparison.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "model/scene/input_error.h"
#include "testbench/curves.h"
#include "testbench/operation_time.h"
#include "testbench/real_frame.h"

namespace phongpipe {
namespace {

// Two triangles that have two corners in common.
bool share_edge(const ScreenTriangle& a, const ScreenTriangle& b) {
  int common = 0;
  for (const ScreenVertex& v : a.vertices) {
    for (const ScreenVertex& w : b.vertices) common += v.x == w.x && v.y == w.y && v.z == w.z;
  }
  return common >= 2;
}

double largest_seam(const Geometry& geometry, const Visibility& visibility,
                    const std::vector<Color>& error, int channels) {
  double largest = 0;
  const auto look = [&](std::size_t here, std::size_t there) {
    const std::uint32_t a = visibility.seen[here], b = visibility.seen[there];
    if (a == b || a == Visibility::kNothing || b == Visibility::kNothing) return;
    const double jump = (error[here] - error[there]).abs().head(channels).maxCoeff();
    if (jump > largest && share_edge(geometry.triangles[a], geometry.triangles[b])) largest = jump;
  };
  for (int y = 0; y < visibility.height; ++y) {
    for (int x = 0; x < visibility.width; ++x) {
      if (x + 1 < visibility.width) look(visibility.index(x, y), visibility.index(x + 1, y));
      if (y + 1 < visibility.height) look(visibility.index(x, y), visibility.index(x, y + 1));
    }
  }
  return largest;
}

// Costs of the whole frame over its pixels.
template <typename Measure>
double amortised(const MethodCosts& costs, const Comparison& frame, Measure measure) {
  const double shared = measure(costs.triangle) * static_cast<double>(frame.triangles) +
                        measure(costs.span) * static_cast<double>(frame.spans);
  return measure(costs.pixel + costs.combine) +
         (frame.pixels == 0 ? 0 : shared / static_cast<double>(frame.pixels));
}

bool has_highlight(const Geometry& geometry) {
  return std::any_of(geometry.materials.begin(), geometry.materials.end(),
                     [](const Material& material) { return (material.specular > 0).any(); });
}

// The scene as a method that knows one form of the highlight wants it.
Scene with_highlight_of(const Scene& scene, const ShadingMethod& method) {
  Scene own = scene;
  own.shading.highlight = method.abilities.highlight.value_or(scene.shading.highlight);
  return own;
}

class SceneComparison {
 public:
  SceneComparison(const Scene& scene, const Geometry& geometry, Comparison& comparison)
      : scene_(scene),
        geometry_(geometry),
        comparison_(comparison),
        visibility_(find_visible(scene, geometry)),
        parts_(has_highlight(geometry) ? Parts::full : Parts::diffuse) {
    comparison.triangles = visibility_.triangles;
    comparison.spans = visibility_.spans;
    comparison.pixels = visibility_.shaded;
  }

  MethodResult measure(const ShadingMethod& method) {
    MethodResult result;
    result.method = &method;
    const Scene scene = with_highlight_of(scene_, method);
    if (const auto reason = refusal(method, scene, geometry_.materials)) {
      result.refused = *reason;
      return result;
    }
    if (scene.shading.highlight != scene_.shading.highlight) {
      result.note = "R·V, against Phong with R·V";
    }
    cost(method, scene, result);
    MethodFrame frame = timed_frame(method, scene, result);
    if (frame.exact_spans > 0) {
      result.note += fmt::format("{}{} spans by exact Phong", result.note.empty() ? "" : "; ",
                                 frame.exact_spans);
    }
    judge(scene, std::move(frame.colors), result);
    return result;
  }

 private:
  // The least of a few passes is the one least disturbed.
  MethodFrame timed_frame(const ShadingMethod& method, const Scene& scene,
                          MethodResult& result) const {
    constexpr int kPasses = 3;
    MethodFrame frame;
    double least = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < kPasses; ++pass) {
      const auto start = std::chrono::steady_clock::now();
      frame = render_method(scene, geometry_, visibility_, method, PowerKind::exact);
      const std::chrono::duration<double, std::nano> taken =
          std::chrono::steady_clock::now() - start;
      least = std::min(least, taken.count());
    }
    result.wall_clock_ns =
        least / static_cast<double>(std::max<std::size_t>(1, comparison_.pixels));
    return frame;
  }

  void cost(const ShadingMethod& method, const Scene& scene, MethodResult& result) const {
    const bool exact = method.name == "phong";
    const MethodCosts phong = phong_costs(scene, parts_, PowerKind::table);
    result.costs = exact ? phong : method.costs(parts_, PowerKind::table);
    const PipelineConfiguration& units = comparison_.hardware.pipeline;
    result.clocks_per_pixel =
        amortised(result.costs, comparison_,
                  [&units](const OperationCounts& counts) { return clocks(counts, units); });
    result.ns_per_pixel = result.clocks_per_pixel * comparison_.hardware.clock_ns();
    result.operations_per_pixel = amortised(result.costs, comparison_, sequential_operations);
    result.break_even_pixels = break_even_pixels(result.costs, phong, sequential_operations);
  }

  void judge(const Scene& scene, std::vector<Color> colors, MethodResult& result) {
    const std::vector<Color>& exact = exact_of(scene);
    result.errors.assign(colors.size(), std::numeric_limits<float>::quiet_NaN());
    std::vector<Color> error(colors.size(), Color::Zero());
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (visibility_.seen[i] == Visibility::kNothing) continue;
      error[i] = colors[i] - exact[i];
      for (int c = 0; c < comparison_.channels; ++c) result.error.add(error[i][c]);
      result.errors[i] = static_cast<float>(error[i].abs().head(comparison_.channels).maxCoeff());
    }
    result.seam = largest_seam(geometry_, visibility_, error, comparison_.channels);
    result.colors = std::move(colors);
  }

  // Each form of the highlight is measured against Phong shading with that form.
  const std::vector<Color>& exact_of(const Scene& scene) {
    std::vector<Color>& exact = exact_[scene.shading.highlight == Highlight::halfway ? 0 : 1];
    if (exact.empty()) exact = render_phong(scene, geometry_, visibility_);
    return exact;
  }

  const Scene& scene_;
  const Geometry& geometry_;
  Comparison& comparison_;
  Visibility visibility_;
  Parts parts_;
  std::array<std::vector<Color>, 2> exact_;
};

}  // namespace

Comparison compare(const std::filesystem::path& file, const Hardware& hardware,
                   const std::function<void(const std::string&)>& progress) {
  Comparison comparison;
  comparison.scene = file;
  comparison.hardware = hardware;
  const Scene scene = load_scene(file);
  if (scene.depth_cue) {
    throw InputError(scene.file, 0, "depth cueing is not compared yet; leave [depth_cue] out");
  }
  const Geometry geometry = make_geometry(scene);
  suit_scene(comparison.hardware, scene, geometry);
  comparison.width = scene.image.width;
  comparison.height = scene.image.height;
  comparison.channels = is_grey(scene, geometry) ? 1 : 3;
  SceneComparison measured(scene, geometry, comparison);
  for (const ShadingMethod& method : shading_methods()) {
    progress(fmt::format("{}: {}", file.string(), method.name));
    comparison.methods.push_back(measured.measure(method));
  }
  return comparison;
}

}  // namespace phongpipe
