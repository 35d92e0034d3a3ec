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

// The inputs and constants of setup, rounded.
Vector3<Rounded> in_rounded(const Vector3<double>& v) {
  return v.cast<Rounded>();
}
std::array<Rounded, 3> in_rounded(const std::array<double, 3>& v) {
  return {Rounded(v[0]), Rounded(v[1]), Rounded(v[2])};
}
Corners<Rounded> in_rounded(const Corners<double>& corners) {
  return {in_rounded(corners[0]), in_rounded(corners[1]), in_rounded(corners[2])};
}
TriangleInput<Rounded> in_rounded(const TriangleInput<double>& input) {
  const auto& [x, y, z, normal, eye, light, cue_factor] = input;
  return {in_rounded(x),   in_rounded(y),     in_rounded(z),         in_rounded(normal),
          in_rounded(eye), in_rounded(light), in_rounded(cue_factor)};
}
LightInput<Rounded> in_rounded(const LightInput<double>& input) {
  const auto& [to_light, eye, halfway, attenuation, spot_axis, spot_exponent, fold, sharpness] =
      input.terms;
  return {{in_rounded(to_light), in_rounded(eye), in_rounded(halfway), in_rounded(attenuation),
           in_rounded(spot_axis), Rounded(spot_exponent), Rounded(fold), Rounded(sharpness)},
          in_rounded(input.diffuse_scale),
          Rounded(input.specular_scale),
          Rounded(input.gate_scale)};
}

SeriesRange<double> values(const SeriesRange<Rounded>& range) {
  return {range.low.value(), range.high.value()};
}
Quadratic<double> values(const Quadratic<Rounded>& t) {
  return {t.t0.value(), t.t1.value(), t.t2.value(), t.t3.value(), t.t4.value(), t.t5.value()};
}
Linear<double> values(const Linear<Rounded>& q) {
  return {q.a.value(), q.b.value(), q.c.value()};
}
TriangleCoefficients<double> values(const TriangleCoefficients<Rounded>& t) {
  return {{values(t.diffuse[0]), values(t.diffuse[1]), values(t.diffuse[2])},
          values(t.specular),
          values(t.gate),
          values(t.depth),
          values(t.cue_factor)};
}

// Both compute the unrounded coefficients. `leave_out` is called with the bounds of the series, and
// may remove series from the plan. In double, only what is not known of the triangle is computed.
template <typename LeaveOut>
TriangleCoefficients<double> compute_in_double(SeriesPlan& plan, const LightInput<double>& light,
                                               const TriangleInput<double>& vertices,
                                               GeometryMemo::Series& known,
                                               const LeaveOut& leave_out) {
  const TriangleBounds<double>& bounds =
      known.bounds(vertices, plan, [&] { return bound_triangle(plan, vertices, light); });
  leave_out(bounds.light, bounds.highlight);
  const Interpolator<double> interpolate(vertices.x, vertices.y);
  const CosineSeries<double>& series = known.series(
      plan, [&] { return cosine_series(plan, interpolate, vertices, light.terms, bounds); });
  TriangleCoefficients<double> result = linear_coefficients(plan, interpolate, vertices);
  scale_series(plan, light, series, result);
  return result;
}

template <typename LeaveOut>
TriangleCoefficients<double> compute_rounded(SeriesPlan& plan, const LightInput<double>& light,
                                             const TriangleInput<double>& vertices,
                                             int mantissa_bits, const LeaveOut& leave_out) {
  const Rounded::Precision precision(mantissa_bits);
  const TriangleInput<Rounded> rounded_vertices = in_rounded(vertices);
  const LightInput<Rounded> rounded_light = in_rounded(light);
  const TriangleBounds<Rounded> bounds = bound_triangle(plan, rounded_vertices, rounded_light);
  leave_out(values(bounds.light), values(bounds.highlight));
  return values(setup_triangle(plan, rounded_vertices, rounded_light, bounds));
}

void choose_fits(SeriesPlan& plan, const CertifiedFits& fits) {
  plan.form.fit = fits.light;
  plan.certified_highlight = fits.highlight;
}

}  // namespace

SetupEngine::SetupEngine(const FrameSetup& frame) : frame_(&frame) {}

GeometryMemo::Triangle& SetupEngine::known(std::uint32_t triangle, std::uint32_t pass,
                                           GeometryMemo::Triangle& otherwise) const {
  GeometryMemo* const memo = frame_->memo;
  GeometryMemo::Triangle* const found = memo == nullptr ? nullptr : memo->triangle(triangle, pass);
  return found == nullptr ? otherwise : *found;
}

TriangleInput<double> triangle_input(const FrameSetup& frame, const ScreenTriangle& source,
                                     std::uint32_t pass, int x, int y) {
  const std::optional<DepthCue>& cue = frame.scene->depth_cue;
  TriangleInput<double> input;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& vertex = source.vertices[i];
    input.x[i] = in_pixels(vertex.x) - (x + 0.5);
    input.y[i] = in_pixels(vertex.y) - (y + 0.5);
    input.z[i] = (vertex.z - frame.depth_offset) * frame.depth_scale;
    input.normal[i] = vertex.normal;
    input.eye[i] = vertex.eye;
    input.light[i] = light_vector(frame.scene->lights[pass], vertex);
    input.cue_factor[i] =
        cue ? (cue->far - view_distance(*frame.scene, vertex)) / (cue->far - cue->near) : 1;
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
  SeriesPlan plan = material.plan;
  if (frame_->certificates) choose_fits(plan, frame_->fits(triangle, pass));
  const TriangleInput<double> vertices =
      triangle_input(*frame_, frame_->geometry->triangles[triangle], pass, x, y);
  GeometryMemo::Triangle alone;
  return compute_in_double(plan, material.light, vertices, known(triangle, pass, alone).whole,
                           [](const auto&...) {});
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
    const double scale = material.light.specular_scale, offset = material.offset_in_addresses();
    const double off = noise * scale + slack(configuration.specular_fraction_bits);
    const double lowest =
        -std::ldexp(configuration.rom_addresses(), configuration.specular_guard_bits);
    plan.highlight_invisible =
        material.first_visible_address > 0 &&
        highlight.high * scale + offset + off < material.first_visible_address &&
        highlight.low * scale + offset - off > lowest;
    if (plan.highlight_invisible && frame_->effects == Effects::derived) {
      plan.specular = plan.gate = SeriesForm::absent;
    }
  }
}

TriangleSetup SetupEngine::begin(std::uint32_t triangle, std::uint32_t pass, int x, int y) const {
  TriangleSetup setup;
  setup.x = x;
  setup.y = y;
  setup.triangle = triangle;
  setup.pass = pass;
  setup.material = &frame_->material(pass, frame_->geometry->triangles[triangle].material);
  return setup;
}

TriangleSetup SetupEngine::set_up(std::uint32_t triangle, std::uint32_t pass, int x, int y,
                                  int longest_row, const CertifiedFits* fits) const {
  const FrameConfiguration& configuration = frame_->configuration;
  TriangleSetup setup = begin(triangle, pass, x, y);
  const TriangleInput<double> vertices =
      triangle_input(*frame_, frame_->geometry->triangles[triangle], pass, x, y);
  SeriesPlan plan = simplified_plan(*setup.material, vertices);
  if (fits != nullptr) choose_fits(plan, *fits);
  const auto leave_out_of_plan = [&](const SeriesRange<double>& light_range,
                                     const SeriesRange<double>& highlight) {
    leave_out(plan, *setup.material, vertices, light_range, highlight, longest_row);
  };
  const LightInput<double>& light = setup.material->light;
  GeometryMemo::Triangle alone;
  const TriangleCoefficients<double> exact =
      configuration.mantissa_bits == kDoubleMantissaBits
          ? compute_in_double(plan, light, vertices, known(triangle, pass, alone).set_up,
                              leave_out_of_plan)
          : compute_rounded(plan, light, vertices, configuration.mantissa_bits, leave_out_of_plan);
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
    setup.specular.t0 = wrap_add(setup.specular.t0, setup.material->specular_offset);
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

TriangleSetup SetupEngine::set_up_exact(std::uint32_t triangle, std::uint32_t pass, int x,
                                        int y) const {
  TriangleSetup setup = begin(triangle, pass, x, y);
  setup.plan = setup.material->plan;
  setup.plan.diffuse = setup.plan.specular = setup.plan.gate = SeriesForm::absent;
  setup.plan.exact_path = true;
  setup.plan.certify = frame_->certificates->triangles[triangle].bounded;
  if (!setup.plan.depth) return setup;
  const TriangleInput<double> vertices =
      triangle_input(*frame_, frame_->geometry->triangles[triangle], pass, x, y);
  const Interpolator<double> interpolate(vertices.x, vertices.y);
  setup.depth = round_coefficients(interpolate(vertices.z[0], vertices.z[1], vertices.z[2]),
                                   kDepthFraction, setup.overflow);
  return setup;
}

}  // namespace phongpipe
