#include "model/fixed/setup_engine.h"

namespace phongpipe {
namespace {

FixedQuadratic round_coefficients(const Quadratic<double>& t, int fraction_bits, bool& overflow) {
  const auto rounded = [&](double coefficient) {
    return to_fixed(coefficient, fraction_bits, overflow);
  };
  return {rounded(t.t0), rounded(t.t1), rounded(t.t2), rounded(t.t3), rounded(t.t4), rounded(t.t5)};
}

}  // namespace

SetupEngine::SetupEngine(const FrameSetup& frame, const Geometry& geometry)
    : frame_(&frame), geometry_(&geometry) {}

TriangleCoefficients<double> SetupEngine::coefficients(std::uint32_t triangle, int x, int y) const {
  const ScreenTriangle& source = geometry_->triangles[triangle];
  TriangleInput<double> input;
  for (std::size_t i = 0; i < 3; ++i) {
    const ScreenVertex& vertex = source.vertices[i];
    input.x[i] = in_pixels(vertex.x) - (x + 0.5);
    input.y[i] = in_pixels(vertex.y) - (y + 0.5);
    input.z[i] = (vertex.z - frame_->depth_offset) * frame_->depth_scale;
    input.normal[i] = vertex.normal;
    input.eye[i] = vertex.eye;
  }
  return setup_triangle(frame_->plan, input, frame_->materials[source.material].light);
}

TriangleSetup SetupEngine::set_up(std::uint32_t triangle, int x, int y) const {
  const DatapathConfiguration& configuration = frame_->configuration;
  const TriangleCoefficients<double> exact = coefficients(triangle, x, y);
  TriangleSetup setup;
  setup.x = x;
  setup.y = y;
  setup.triangle = triangle;
  setup.material = geometry_->triangles[triangle].material;

  const int fraction = configuration.diffuse_fraction_bits;
  const int diffuse_bits = setup_fraction_bits(configuration, fraction);
  for (std::size_t c = 0; c < static_cast<std::size_t>(configuration.channels); ++c) {
    setup.diffuse[c] = round_coefficients(exact.diffuse[c], diffuse_bits, setup.overflow);
    const std::int64_t level = frame_->materials[setup.material].level[c];
    setup.diffuse[c].t0 = wrap_add(setup.diffuse[c].t0, level << (diffuse_bits - fraction));
  }
  if (frame_->plan.gate_series) {
    setup.gate = round_coefficients(exact.gate, diffuse_bits, setup.overflow);
  }
  setup.specular = round_coefficients(
      exact.specular, setup_fraction_bits(configuration, configuration.specular_fraction_bits),
      setup.overflow);
  setup.depth = to_fixed(exact.depth.c, kDepthFraction, setup.overflow);
  setup.depth_x = to_fixed(exact.depth.a, kDepthFraction, setup.overflow);
  setup.depth_y = to_fixed(exact.depth.b, kDepthFraction, setup.overflow);
  return setup;
}

}  // namespace phongpipe
