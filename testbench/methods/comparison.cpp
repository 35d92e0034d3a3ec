#include "testbench/methods/comparison.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>

#include "model/fixed/coverage.h"
#include "model/scene/subdivision.h"
#include "testbench/methods/curves.h"
#include "testbench/methods/operation_time.h"
#include "testbench/methods/real_frame.h"

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

// Triangles and what is seen of them. Whole, or split as the setup engine splits them.
struct Drawn {
  Subdivision triangles;
  Visibility visibility;

  Drawn(const Scene& scene, const Geometry& geometry, int largest_turn_degrees)
      : triangles(subdivide(scene, geometry, largest_turn_degrees)),
        visibility(find_visible(scene, triangles.geometry)) {}
};

double largest_seam(const Geometry& whole, const Drawn& drawn, const std::vector<Color>& error,
                    int channels) {
  const Visibility& visibility = drawn.visibility;
  double largest = 0;
  const auto look = [&](std::size_t here, std::size_t there) {
    const std::uint32_t a = visibility.seen[here], b = visibility.seen[there];
    if (a == b || a == Visibility::kNothing || b == Visibility::kNothing) return;
    const double jump = (error[here] - error[there]).abs().head(channels).maxCoeff();
    if (jump <= largest) return;
    // Pieces border on others of their own triangle, and where that borders on its neighbours.
    const std::uint32_t of_a = drawn.triangles.whole[a], of_b = drawn.triangles.whole[b];
    if (of_a == of_b || share_edge(whole.triangles[of_a], whole.triangles[of_b])) largest = jump;
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
double amortised(const MethodCosts& costs, const Visibility& frame, Measure measure) {
  const double shared = measure(costs.triangle) * static_cast<double>(frame.triangles) +
                        measure(costs.span) * static_cast<double>(frame.spans);
  return measure(costs.pixel + costs.combine) + shared / static_cast<double>(frame.shaded);
}

bool has_highlight(const Geometry& geometry) {
  return std::any_of(geometry.materials.begin(), geometry.materials.end(), is_shiny);
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
        whole_(scene, geometry, 0),
        pieces_(scene, geometry, comparison.hardware.setup.subdivide_degrees),
        parts_(has_highlight(geometry) ? Parts::full : Parts::diffuse) {
    comparison.triangles = whole_.visibility.triangles;
    comparison.spans = whole_.visibility.spans;
    comparison.pixels = whole_.visibility.shaded;
    comparison.split = pieces_.triangles.split;
    comparison.pieces = pieces_.triangles.pieces;
  }

  MethodResult measure(const ShadingMethod& method) {
    MethodResult result;
    result.name = method.name;
    result.source = method.source;
    const Scene scene = with_highlight_of(scene_, method);
    if (const auto reason = refusal(method, scene, geometry_.materials)) {
      result.refused = *reason;
      return result;
    }
    if (scene.shading.highlight != scene_.shading.highlight) {
      const char* const form = scene.shading.highlight == Highlight::halfway ? "N·H" : "R·V";
      add_note(result, fmt::format("{}, against Phong with {}", form, form));
    }
    const Drawn& drawn = method.takes_pieces ? pieces_ : whole_;
    cost(method, scene, drawn.visibility, result);
    const auto fades = [](const Light& light) {
      return is_attenuated(light) || has_spot_factor(light);
    };
    if (scene.lights.size() > 1 || scene.depth_cue || fades(scene.lights.front())) {
      add_note(result, "costs are those of one light that does not fade");
    }
    MethodFrame frame = timed_frame(method, scene, drawn, result);
    if (method.name == method_of(comparison_.hardware, scene_)) {
      result.of_hardware = true;
      add_note(result, fmt::format("the series of hardware {}", comparison_.hardware.name));
    }
    if (frame.exact_spans > 0) {
      add_note(result, fmt::format("{} spans by exact Phong", frame.exact_spans));
    }
    judge(scene, drawn, std::move(frame.colors), result);
    return result;
  }

  MethodResult measure_limit() {
    MethodResult result;
    result.name = "best";
    result.source = "weighted minimax, model/shading/quadratics";
    result.is_limit = true;
    if (scene_.depth_cue) {
      result.refused = "it has no depth cueing";
      return result;
    }
    add_note(result, "the limit of quadratics, offline");
    judge(scene_, pieces_, render_best(scene_, pieces_.triangles.geometry, pieces_.visibility),
          result);
    return result;
  }

 private:
  static void add_note(MethodResult& result, const std::string& note) {
    result.note += (result.note.empty() ? "" : "; ") + note;
  }

  // The least of a few passes is the one least disturbed.
  MethodFrame timed_frame(const ShadingMethod& method, const Scene& scene, const Drawn& drawn,
                          MethodResult& result) const {
    constexpr int kPasses = 3;
    MethodFrame frame;
    double least = std::numeric_limits<double>::infinity();
    for (int pass = 0; pass < kPasses; ++pass) {
      const auto start = std::chrono::steady_clock::now();
      frame = render_method(scene, drawn.triangles.geometry, drawn.visibility, method,
                            comparison_.power);
      const std::chrono::duration<double, std::nano> taken =
          std::chrono::steady_clock::now() - start;
      least = std::min(least, taken.count());
    }
    result.wall_clock_ns_per_pixel = least / static_cast<double>(comparison_.pixels);
    return frame;
  }

  void cost(const ShadingMethod& method, const Scene& scene, const Visibility& visibility,
            MethodResult& result) const {
    const bool exact = method.name == "phong";
    const MethodCosts phong = phong_costs(scene, parts_, comparison_.power);
    result.costs = exact ? phong : method.costs(parts_, comparison_.power);
    const PipelineConfiguration& units = comparison_.hardware.pipeline;
    result.clocks_per_pixel =
        amortised(result.costs, visibility,
                  [&units](const OperationCounts& counts) { return clocks(counts, units); });
    result.ns_per_pixel = result.clocks_per_pixel * comparison_.clock.ns;
    result.operations_per_pixel = amortised(result.costs, visibility, sequential_operations);
    result.break_even_pixels = break_even_pixels(result.costs, phong, sequential_operations);
  }

  void judge(const Scene& scene, const Drawn& drawn, std::vector<Color> colors,
             MethodResult& result) {
    const std::vector<Color>& exact = exact_of(scene);
    result.errors_lsb.assign(colors.size(), std::numeric_limits<float>::quiet_NaN());
    std::vector<Color> error(colors.size(), Color::Zero());
    for (std::size_t i = 0; i < colors.size(); ++i) {
      if (whole_.visibility.seen[i] == Visibility::kNothing) continue;
      error[i] = colors[i] - exact[i];
      for (int c = 0; c < comparison_.channels; ++c) result.error.add(error[i][c]);
      result.errors_lsb[i] =
          static_cast<float>(error[i].abs().head(comparison_.channels).maxCoeff());
    }
    result.largest_seam_lsb = largest_seam(geometry_, drawn, error, comparison_.channels);
    result.colors = std::move(colors);
  }

  // Each form of the highlight is measured against Phong shading with that form.
  const std::vector<Color>& exact_of(const Scene& scene) {
    std::vector<Color>& exact = exact_[scene.shading.highlight == Highlight::halfway ? 0 : 1];
    if (exact.empty()) exact = render_phong(scene, geometry_, whole_.visibility);
    return exact;
  }

  const Scene& scene_;
  const Geometry& geometry_;
  Comparison& comparison_;
  Drawn whole_, pieces_;
  Parts parts_;
  std::array<std::vector<Color>, 2> exact_;
};

}  // namespace

Comparison compare(const Scene& scene, const Hardware& hardware,
                   const std::function<void(const std::string&)>& progress, PowerKind power) {
  Comparison comparison;
  comparison.power = power;
  comparison.scene = scene.source;
  const Geometry geometry = make_geometry(scene);
  if (!covers_a_pixel(scene, geometry)) throw nothing_covered(scene);
  const EffectBlocks blocks = derive_blocks(hardware.formats, scene, geometry);
  comparison.hardware = resolved(hardware, blocks);
  comparison.clock = hardware.technology.clock({hardware.formats, blocks});
  comparison.width = scene.image.width;
  comparison.height = scene.image.height;
  comparison.channels = is_grey(scene, geometry) ? 1 : 3;
  SceneComparison measured(scene, geometry, comparison);
  for (const ShadingMethod& method : shading_methods()) {
    progress(fmt::format("{}: {}", scene.source, method.name));
    comparison.methods.push_back(measured.measure(method));
  }
  progress(fmt::format("{}: best", scene.source));
  comparison.methods.push_back(measured.measure_limit());
  return comparison;
}

}  // namespace phongpipe
