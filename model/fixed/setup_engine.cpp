#include "model/fixed/setup_engine.h"

#include <algorithm>
#include <cmath>

#include "model/fixed/rounding_bound.h"
#include "model/shading/rounded.h"

namespace phongpipe {
namespace {

FixedQuadratic round_coefficients(const Quadratic<double>& t, int fraction_bits, bool& overflow) {
  const auto rounded = [&](double coefficient) {
    return to_fixed(coefficient, fraction_bits, overflow);
  };
  return {rounded(t.t0), rounded(t.t1), rounded(t.t2), rounded(t.t3), rounded(t.t4), rounded(t.t5)};
}

FixedLinear round_coefficients(const Linear<double>& q, int fraction_bits, bool& overflow) {
  return {to_fixed(q.c, fraction_bits, overflow), to_fixed(q.a, fraction_bits, overflow),
          to_fixed(q.b, fraction_bits, overflow)};
}

// What double precision may lose in cosines: a few units in the last place, times the square of the
// steepest gradient, 256 a pixel, and that of the extent in pixels. Every bit of the mantissa less
// doubles it.
constexpr double kArithmeticNoise = 2e-11;

// The inputs and constants of setup in the arithmetic of a scalar.
template <typename T>
Vector3<T> in(const Vector3<double>& v) {
  return v.cast<T>();
}
template <typename T>
std::array<T, 3> in(const std::array<double, 3>& v) {
  return {T(v[0]), T(v[1]), T(v[2])};
}
template <typename T>
Corners<T> in(const Corners<double>& corners) {
  return {in<T>(corners[0]), in<T>(corners[1]), in<T>(corners[2])};
}
template <typename T>
TriangleInput<T> in(const TriangleInput<double>& input) {
  const auto& [x, y, z, normal, eye, light, cue_factor] = input;
  return {in<T>(x), in<T>(y), in<T>(z), in<T>(normal), in<T>(eye), in<T>(light), in<T>(cue_factor)};
}
template <typename T>
LightInput<T> in(const LightInput<double>& input) {
  const auto& [to_light, eye, halfway, attenuation, spot_axis, spot_exponent, fold, sharpness] =
      input.terms;
  return {{in<T>(to_light), in<T>(eye), in<T>(halfway), in<T>(attenuation), in<T>(spot_axis),
           T(spot_exponent), T(fold), T(sharpness)},
          in<T>(input.diffuse_scale),
          T(input.specular_scale),
          T(input.gate_scale)};
}

double value(double x) {
  return x;
}
double value(const Rounded& x) {
  return x.value();
}
template <typename T>
SeriesRange<double> values(const SeriesRange<T>& range) {
  return {value(range.low), value(range.high)};
}
template <typename T>
Quadratic<double> values(const Quadratic<T>& t) {
  return {value(t.t0), value(t.t1), value(t.t2), value(t.t3), value(t.t4), value(t.t5)};
}
template <typename T>
Linear<double> values(const Linear<T>& q) {
  return {value(q.a), value(q.b), value(q.c)};
}
template <typename T>
TriangleCoefficients<double> values(const TriangleCoefficients<T>& t) {
  return {{values(t.diffuse[0]), values(t.diffuse[1]), values(t.diffuse[2])},
          values(t.specular),
          values(t.gate),
          values(t.depth),
          values(t.cue_factor)};
}

}  // namespace

SetupEngine::SetupEngine(const FrameSetup& frame) : frame_(&frame) {}

TriangleInput<double> SetupEngine::input(std::uint32_t triangle, std::uint32_t pass, int x,
                                         int y) const {
  const ScreenTriangle& source = frame_->geometry->triangles[triangle];
  const std::optional<DepthCue>& cue = frame_->scene->depth_cue;
  TriangleInput<double> input;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& vertex = source.vertices[i];
    input.x[i] = in_pixels(vertex.x) - (x + 0.5);
    input.y[i] = in_pixels(vertex.y) - (y + 0.5);
    input.z[i] = (vertex.z - frame_->depth_offset) * frame_->depth_scale;
    input.normal[i] = vertex.normal;
    input.eye[i] = vertex.eye;
    input.light[i] = light_vector(frame_->scene->lights[pass], vertex);
    input.cue_factor[i] =
        cue ? (cue->far - view_distance(*frame_->scene, vertex)) / (cue->far - cue->near) : 1;
  }
  // Wholly beyond an end the share is the end's, however far beyond.
  const auto [least, most] = std::minmax_element(input.cue_factor.begin(), input.cue_factor.end());
  if (*least >= 1 || *most <= 0) input.cue_factor.fill(*least >= 1 ? 1 : 0);
  return input;
}

TriangleCoefficients<double> SetupEngine::coefficients(std::uint32_t triangle, std::uint32_t pass,
                                                       int x, int y) const {
  const MaterialSetup& material =
      frame_->material(pass, frame_->geometry->triangles[triangle].material);
  return setup_triangle(material.plan, input(triangle, pass, x, y), material.light);
}

SeriesPlan SetupEngine::simplified_plan(const MaterialSetup& material,
                                        const TriangleInput<double>& vertices) const {
  SeriesPlan plan = material.plan;
  const auto& [a, b, c] = vertices.normal;
  if (plan.form.point_light || a != b || b != c) return plan;
  if (is_present(plan.diffuse)) plan.diffuse = SeriesForm::constant;
  if (is_present(plan.gate)) plan.gate = SeriesForm::constant;
  if (is_present(plan.specular) && !plan.form.local_viewer &&
      plan.form.highlight == Highlight::halfway) {
    plan.specular = SeriesForm::constant;
  }
  return plan;
}

void SetupEngine::leave_out(SeriesPlan& plan, const MaterialSetup& material,
                            const TriangleInput<double>& vertices, const SeriesRange<double>& light,
                            const SeriesRange<double>& highlight, int longest_row) const {
  const FrameConfiguration& configuration = frame_->configuration;
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    extent = std::max({extent, std::fabs(vertices.x[i]), std::fabs(vertices.y[i])});
  }
  const double noise = std::ldexp(kArithmeticNoise * (1 + extent * extent),
                                  kDoubleMantissaBits - configuration.mantissa_bits);
  const auto slack = [&](int fraction_bits) {
    return rounding_bound(configuration, fraction_bits, extent, longest_row);
  };
  if (plan.bound_light) {
    double least_scale = kOutputMax;  // the gate's
    for (const double scale : material.light.diffuse_scale) {
      if (scale > 0) least_scale = std::min(least_scale, scale);
    }
    const double highest =
        (light.high + noise) * least_scale + slack(configuration.diffuse_fraction_bits);
    if (highest <= 0) {
      plan.diffuse = SeriesForm::absent;
      if (configuration.gate != GateSource::off) plan.specular = plan.gate = SeriesForm::absent;
    }
  }
  if (plan.bound_highlight && is_present(plan.specular)) {
    // What is below 0 reads the word at 0, as long as it does not wrap.
    const double addresses = material.light.specular_scale;
    const double off = noise * addresses + slack(configuration.specular_fraction_bits);
    plan.highlight_invisible = material.first_visible_address > 0 &&
                               highlight.high * addresses + off < material.first_visible_address &&
                               highlight.low * addresses - off > -addresses * (1 << kGuardBits);
    if (plan.highlight_invisible && frame_->effects == Effects::derived) {
      plan.specular = plan.gate = SeriesForm::absent;
    }
  }
}

template <typename T>
TriangleCoefficients<double> SetupEngine::compute(SeriesPlan& plan, const MaterialSetup& material,
                                                  const TriangleInput<double>& vertices,
                                                  int longest_row) const {
  const TriangleInput<T> triangle = in<T>(vertices);
  const LightInput<T> light = in<T>(material.light);
  const TriangleBounds<T> bounds = bound_triangle(plan, triangle, light);
  leave_out(plan, material, vertices, values(bounds.light), values(bounds.highlight), longest_row);
  return values(setup_triangle(plan, triangle, light, bounds));
}

TriangleSetup SetupEngine::set_up(std::uint32_t triangle, std::uint32_t pass, int x, int y,
                                  int longest_row) const {
  const FrameConfiguration& configuration = frame_->configuration;
  TriangleSetup setup;
  setup.x = x;
  setup.y = y;
  setup.triangle = triangle;
  setup.pass = pass;
  setup.material = &frame_->material(pass, frame_->geometry->triangles[triangle].material);
  const TriangleInput<double> vertices = input(triangle, pass, x, y);
  SeriesPlan plan = simplified_plan(*setup.material, vertices);
  TriangleCoefficients<double> exact;
  if (configuration.mantissa_bits == kDoubleMantissaBits) {
    exact = compute<double>(plan, *setup.material, vertices, longest_row);
  } else {
    const Rounded::Precision precision(configuration.mantissa_bits);
    exact = compute<Rounded>(plan, *setup.material, vertices, longest_row);
  }
  setup.plan = plan;
  if (frame_->effects == Effects::all) {
    // The same numbers, at the cost of the whole computation.
    for (SeriesForm* form : {&setup.plan.diffuse, &setup.plan.gate, &setup.plan.specular}) {
      if (is_present(*form)) *form = SeriesForm::fitted;
    }
  }

  const int fraction = configuration.diffuse_fraction_bits;
  const int diffuse_bits = setup_fraction_bits(configuration, fraction);
  for (std::size_t c = 0; c < static_cast<std::size_t>(configuration.channels); ++c) {
    if (is_present(setup.plan.diffuse)) {
      setup.diffuse[c] = round_coefficients(exact.diffuse[c], diffuse_bits, setup.overflow);
    }
    const std::int64_t level = setup.material->level[c];
    setup.diffuse[c].t0 = wrap_add(setup.diffuse[c].t0, level << (diffuse_bits - fraction));
  }
  if (is_present(setup.plan.gate)) {
    setup.gate = round_coefficients(exact.gate, diffuse_bits, setup.overflow);
  }
  if (is_present(setup.plan.specular)) {
    setup.specular = round_coefficients(
        exact.specular, setup_fraction_bits(configuration, configuration.specular_fraction_bits),
        setup.overflow);
  }
  if (setup.plan.depth) {
    setup.depth = round_coefficients(exact.depth, kDepthFraction, setup.overflow);
  }
  if (setup.plan.depth_cue) {
    setup.cue_factor = round_coefficients(
        exact.cue_factor, setup_fraction_bits(configuration, kCueFraction), setup.overflow);
  }
  return setup;
}

}  // namespace phongpipe
