#include "model/fixed/setup_engine.h"

#include <algorithm>
#include <cmath>

#include "model/fixed/rounding_bound.h"

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

// What double precision may lose in bounds and coefficients, far less than this.
constexpr double kArithmeticSlack = 1e-9;

// What it may lose in cosines that are equal all over a triangle, some twenty units in the last
// place.
constexpr double kCosineNoise = 4e-15;

}  // namespace

SetupEngine::SetupEngine(const FrameSetup& frame, const Geometry& geometry)
    : frame_(&frame), geometry_(&geometry) {}

TriangleInput<double> SetupEngine::input(std::uint32_t triangle, std::uint32_t pass, int x,
                                         int y) const {
  const ScreenTriangle& source = geometry_->triangles[triangle];
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
    input.own_share[i] =
        cue ? (cue->far - view_distance(*frame_->scene, vertex)) / (cue->far - cue->near) : 1;
  }
  // Wholly beyond an end the share is the end's, however far beyond.
  const auto [least, most] = std::minmax_element(input.own_share.begin(), input.own_share.end());
  if (*least >= 1 || *most <= 0) input.own_share.fill(*least >= 1 ? 1 : 0);
  return input;
}

TriangleCoefficients<double> SetupEngine::coefficients(std::uint32_t triangle, std::uint32_t pass,
                                                       int x, int y) const {
  const MaterialSetup& material = frame_->material(pass, geometry_->triangles[triangle].material);
  return setup_triangle(material.plan, input(triangle, pass, x, y), material.light);
}

SeriesPlan SetupEngine::reduced_plan(const MaterialSetup& material,
                                     const TriangleInput<double>& vertices, int longest_row) const {
  const DatapathConfiguration& configuration = frame_->configuration;
  const bool leave_out = frame_->effects == Effects::derived;
  SeriesPlan plan = material.plan;
  const TriangleBounds<double> bounds = bound_triangle(plan, vertices, material.light);
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    extent = std::max({extent, std::fabs(vertices.x[i]), std::fabs(vertices.y[i])});
  }
  if (plan.bound_light) {
    const double slack =
        rounding_bound(configuration, configuration.diffuse_fraction_bits, extent, longest_row);
    double least_scale = kOutputMax;  // the gate's
    for (const double scale : material.light.diffuse_scale) {
      if (scale > 0) least_scale = std::min(least_scale, scale);
    }
    if (leave_out && (bounds.light + kArithmeticSlack) * least_scale + slack <= 0) {
      plan.diffuse = false;
      if (configuration.gate != GateSource::off) plan.specular = plan.gate_series = false;
    }
  }
  if (plan.bound_highlight && plan.specular) {
    const double slack =
        rounding_bound(configuration, configuration.specular_fraction_bits, extent, longest_row);
    const double highest =
        (bounds.highlight + kArithmeticSlack) * material.light.specular_scale + slack;
    plan.dim = highest < material.first_visible_address;
    if (plan.dim && leave_out) plan.specular = plan.gate_series = false;
  }
  // Equal to the bit: a turn below 1e-8 is lost in the squares that bounds are made of.
  const auto& normal = vertices.normal;
  const bool flat =
      leave_out && plan.bound_light && normal[0] == normal[1] && normal[0] == normal[2];
  plan.flat_light = flat && (plan.diffuse || plan.gate_series);
  plan.flat_highlight = flat && plan.specular && plan.bound_highlight;
  return plan;
}

bool SetupEngine::rounds_alike(const SeriesPlan& plan, const MaterialSetup& material,
                               const TriangleCoefficients<double>& flat) const {
  const DatapathConfiguration& configuration = frame_->configuration;
  const auto alike = [&](double t0, double scale, int fraction_bits) {
    const double unit = std::ldexp(1.0, setup_fraction_bits(configuration, fraction_bits));
    const double noise = kCosineNoise * scale * unit, value = t0 * unit;
    return noise < 0.5 && std::fabs(value - std::floor(value) - 0.5) > noise;
  };
  const LightInput<double>& light = material.light;
  bool all = true;
  if (plan.flat_light) {
    const int bits = configuration.diffuse_fraction_bits;
    for (std::size_t c = 0; plan.diffuse && c < static_cast<std::size_t>(plan.channels); ++c) {
      all = all && alike(flat.diffuse[c].t0, light.diffuse_scale[c], bits);
    }
    all = all && (!plan.gate_series || alike(flat.gate.t0, light.gate_scale, bits));
  }
  return all && (!plan.flat_highlight || alike(flat.specular.t0, light.specular_scale,
                                               configuration.specular_fraction_bits));
}

TriangleSetup SetupEngine::set_up(std::uint32_t triangle, std::uint32_t pass, int x, int y,
                                  int longest_row) const {
  const DatapathConfiguration& configuration = frame_->configuration;
  TriangleSetup setup;
  setup.x = x;
  setup.y = y;
  setup.triangle = triangle;
  setup.pass = pass;
  setup.material = &frame_->material(pass, geometry_->triangles[triangle].material);
  const TriangleInput<double> vertices = input(triangle, pass, x, y);
  setup.plan = reduced_plan(*setup.material, vertices, longest_row);
  TriangleCoefficients<double> exact = setup_triangle(setup.plan, vertices, setup.material->light);
  if ((setup.plan.flat_light || setup.plan.flat_highlight) &&
      !rounds_alike(setup.plan, *setup.material, exact)) {
    setup.plan.flat_light = setup.plan.flat_highlight = false;
    exact = setup_triangle(setup.plan, vertices, setup.material->light);
  }

  const int fraction = configuration.diffuse_fraction_bits;
  const int diffuse_bits = setup_fraction_bits(configuration, fraction);
  for (std::size_t c = 0; c < static_cast<std::size_t>(configuration.channels); ++c) {
    if (setup.plan.diffuse) {
      setup.diffuse[c] = round_coefficients(exact.diffuse[c], diffuse_bits, setup.overflow);
    }
    const std::int64_t level = setup.material->level[c];
    setup.diffuse[c].t0 = wrap_add(setup.diffuse[c].t0, level << (diffuse_bits - fraction));
  }
  if (setup.plan.gate_series) {
    setup.gate = round_coefficients(exact.gate, diffuse_bits, setup.overflow);
  }
  if (setup.plan.specular) {
    setup.specular = round_coefficients(
        exact.specular, setup_fraction_bits(configuration, configuration.specular_fraction_bits),
        setup.overflow);
  }
  if (setup.plan.depth) {
    setup.depth = round_coefficients(exact.depth, kDepthFraction, setup.overflow);
  }
  if (setup.plan.depth_cue) {
    setup.own_share = round_coefficients(
        exact.own_share, setup_fraction_bits(configuration, kCueFraction), setup.overflow);
  }
  return setup;
}

}  // namespace phongpipe
