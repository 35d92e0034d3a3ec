// Bounds of a light's functions and of the errors of their quadratics: none is exceeded on random
// triangles of every form, and each is nearly reached.
#include "model/shading/quadratics/reflection_bound.h"

#include <gtest/gtest.h>

#include "testbench/system/random.h"

namespace phongpipe {
namespace {

constexpr unsigned kReflectionBoundSeed = 31;
constexpr double kReflectionBoundNoise = 1e-10;  // of double precision

using Weights = std::array<double, 3>;  // barycentric coordinates

Weights at(int i, int j, int steps) {
  const double u = static_cast<double>(i) / steps, v = static_cast<double>(j) / steps;
  return {1 - u - v, u, v};
}
template <typename Visit>
void for_each_point(int steps, const Visit& visit) {
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) visit(at(i, j, steps));
  }
}

// Values at six points of the quadratics that are 1 at one of them; nodes in the same order.
std::array<double, 6> shapes(const Weights& w) {
  return {w[0] * (2 * w[0] - 1), w[1] * (2 * w[1] - 1), w[2] * (2 * w[2] - 1),
          4 * w[1] * w[2],       4 * w[2] * w[0],       4 * w[0] * w[1]};
}
constexpr std::array<Weights, 6> kNodes = {
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0.5, 0.5}, {0.5, 0, 0.5}, {0.5, 0.5, 0}}};

double distance(const Weights& a, const Weights& b) {
  return std::max({std::fabs(a[0] - b[0]), std::fabs(a[1] - b[1]), std::fabs(a[2] - b[2])});
}

// A point is at most one step from a point of the grid, which changes a shape by at most four.
TEST(ErrorConstants, BoundTheWholeTriangle) {
  constexpr int kSteps = 1500;
  constexpr double kStep = 1.0 / kSteps;
  double six = 0, linear = 0;
  for_each_point(kSteps, [&](const Weights& w) {
    const std::array<double, 6> shape = shapes(w);
    double cell = 0, second = 0;
    for (std::size_t i = 0; i < 6; ++i) {
      const double way = distance(w, kNodes[i]) + kStep;
      cell += (std::fabs(shape[i]) + 4 * kStep) * way * way * way / 6;
    }
    for (const double share : w)
      second += (share + kStep) * (1 - share + kStep) * (1 - share + kStep) / 2;
    six = std::max(six, cell);
    linear = std::max(linear, second);
  });
  EXPECT_LE(six, kSixPointError);
  EXPECT_GT(six, 0.97 * kSixPointError);
  EXPECT_NEAR(linear, kLinearError, 4 * kStep);
}

struct Case {
  const char* name;
  ReflectionForm form;
  double widest_degrees;  // of the normals
  double nearly;          // share of the error's bound that some triangle reaches
};

std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << c.name;
}

ReflectionForm form_of(bool point_light, bool local_viewer, Highlight highlight,
                       bool attenuated = false, bool spot = false) {
  ReflectionForm form;
  form.fit = SeriesFit::six_point;
  form.point_light = point_light;
  form.local_viewer = local_viewer;
  form.highlight = highlight;
  form.attenuated = attenuated;
  form.spot_factor = spot;
  return form;
}

class ReflectionBounds : public testing::TestWithParam<Case> {
 protected:
  Random random_{kReflectionBoundSeed};
  ReflectionTerms<double> terms_;
  Corners<double> normal_, eye_, light_;

  void draw() {
    const Vec3 axis = random_.unit();
    const double spread = random_.uniform(0, GetParam().widest_degrees / 2);
    terms_.to_light = random_.unit_near(axis, 100);
    terms_.eye = random_.unit_near(axis, 80);
    terms_.halfway = (terms_.to_light + terms_.eye).normalized();
    terms_.attenuation = {random_.uniform(1, 2), random_.uniform(0, 1), random_.uniform(0, 1)};
    terms_.spot_axis = random_.unit_near(terms_.to_light, 40);
    terms_.spot_exponent = random_.uniform(1, 8);
    terms_.fold = 1 / random_.uniform(1, 40);
    const double far = random_.uniform(1.5, 6);
    for (std::size_t i = 0; i < 3; ++i) {
      normal_[i] = random_.uniform(0.7, 1) * random_.unit_near(axis, spread);
      const Vec3 place = random_.uniform(0, 0.8) * random_.unit();
      light_[i] = far * terms_.to_light - place;
      eye_[i] = far * terms_.eye - place;
    }
  }

  static Vec3 mix(const Corners<double>& v, const Weights& w) {
    return v[0] * w[0] + v[1] * w[1] + v[2] * w[2];
  }
  Reflected<double> exact(const Weights& w) const {
    const ReflectionForm& form = GetParam().form;
    const PointVectors<double> vectors = {mix(normal_, w),
                                          form.point_light ? mix(light_, w) : terms_.to_light,
                                          form.local_viewer ? mix(eye_, w) : terms_.eye};
    return reflected(form, {true, true}, terms_, cosines_at(form, terms_, vectors));
  }
};

TEST_P(ReflectionBounds, HoldForValuesAndForTheErrorsOfBothFits) {
  ReflectionForm form = GetParam().form;
  const bool taylor = !form.point_light && !form.local_viewer;
  constexpr double kThird = 1.0 / 3;
  const Interpolator<double> interpolate({-kThird, 2 * kThird, -kThird},
                                         {-kThird, -kThird, 2 * kThird});
  double nearest = 0;
  for (int i = 0; i < 1500; ++i) {
    SCOPED_TRACE(i);
    draw();
    const auto bound = bound_reflection(form, terms_, normal_, eye_, light_);
    const auto fitted = [&](SeriesFit fit) {
      form.fit = fit;
      form.wanted = {true, true};
      return reflection_series(form, interpolate, normal_, eye_, light_, terms_);
    };
    const CosineSeries<double> six = fitted(SeriesFit::six_point);
    const CosineSeries<double> series = taylor ? fitted(SeriesFit::taylor) : six;
    const double taylor_share = taylor ? taylor_error(2 * kThird) : kSixPointError;
    for_each_point(16, [&](const Weights& w) {
      const Reflected<double> value = exact(w);
      const auto check = [&](double f, const ReflectionBound<double>& b, const Quadratic<double>& q,
                             double share) {
        EXPECT_LE(f, b.high + kReflectionBoundNoise);
        EXPECT_GE(f, b.low - kReflectionBoundNoise);
        const double error = std::fabs(q(w[1] - kThird, w[2] - kThird) - f);
        EXPECT_LE(error, share * b.third + kReflectionBoundNoise);
        if (b.third < 1)
          nearest = std::max(nearest, error / (share * b.third + kReflectionBoundNoise));
      };
      check(value.light, bound.light, six.light, kSixPointError);
      check(value.highlight, bound.highlight, six.highlight, kSixPointError);
      check(value.light, bound.light, series.light, taylor_share);
      check(value.highlight, bound.highlight, series.highlight, taylor_share);
    });
    if (HasFailure()) return;
  }
  RecordProperty("nearest", std::to_string(nearest));
  EXPECT_GE(nearest, GetParam().nearly);
}

INSTANTIATE_TEST_SUITE_P(
    Forms, ReflectionBounds,
    testing::Values(
        Case{"infinite", form_of(false, false, Highlight::halfway), 120, 0.45},
        Case{"infinite_reflection", form_of(false, false, Highlight::reflection), 120, 0.45},
        Case{"local_viewer", form_of(false, true, Highlight::halfway), 60, 0.1},
        Case{"local_viewer_reflection", form_of(false, true, Highlight::reflection), 60, 0.1},
        Case{"lamp", form_of(true, false, Highlight::halfway), 60, 0.1},
        Case{"lamp_local_reflection", form_of(true, true, Highlight::reflection), 60, 0.1},
        Case{"fading_lamp", form_of(true, true, Highlight::halfway, true), 60, 0.05},
        Case{"spot", form_of(true, false, Highlight::halfway, false, true), 60, 0.02},
        Case{"fading_spot", form_of(true, true, Highlight::reflection, true, true), 60, 0.02}),
    [](const auto& info) { return std::string(info.param.name); });

}  // namespace
}  // namespace phongpipe
