// Quadratics of the general reflection equation against the exact reference, form by form.
#include "model/shading/quadratics/reflection_series.h"

#include <gtest/gtest.h>

#include "testbench/tests/model/shading/quadratics/reflection_cases.h"
#include "testbench/tests/model/shading/six.h"

namespace phongpipe {
namespace {

constexpr unsigned kReflectionSeriesSeed = 17;
const std::array<SeriesFit, 4> kReflectionSeriesFits = {SeriesFit::taylor, SeriesFit::six_point,
                                                        SeriesFit::weighted, SeriesFit::focused};

void expect_near(const Quadratic<double>& a, const Quadratic<double>& b, double tolerance) {
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_NEAR(six(a)[k], six(b)[k], tolerance) << "coefficient " << k;
  }
}
void expect_finite(const CosineSeries<double>& series) {
  for (const auto& q : {series.light, series.highlight}) {
    for (const double t : six(q)) EXPECT_TRUE(std::isfinite(t));
  }
}

// Every form that fit_series does not know.
struct Form {
  LightType light;
  Viewer viewer;
  Highlight highlight;
};
std::vector<Form> general_forms() {
  std::vector<Form> forms;
  for (const LightType light : {LightType::directional, LightType::point, LightType::spot}) {
    for (const Viewer viewer : {Viewer::infinite, Viewer::local}) {
      for (const Highlight highlight : {Highlight::halfway, Highlight::reflection}) {
        if (light == LightType::directional && highlight == Highlight::halfway) continue;
        forms.push_back({light, viewer, highlight});
      }
    }
  }
  return forms;
}
std::ostream& operator<<(std::ostream& out, const Form& form) {
  return out << "light " << static_cast<int>(form.light) << ", viewer "
             << static_cast<int>(form.viewer) << ", highlight " << static_cast<int>(form.highlight);
}

ReflectionCase random_case(ReflectionCases& random, const Form& form, double turn, double distance,
                           double power = 20, double spot_exponent = 10) {
  return random.reflection(form.light, form.viewer, form.highlight, turn, distance, power,
                           spot_exponent);
}

// What is left of an equation after its second-degree series is of third degree: about an eighth
// at half the distance. A wrong coefficient leaves a quarter, a half or all.
TEST(ReflectionSeries, TaylorIsExactToSecondDegree) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const Form& form : general_forms()) {
    for (int i = 0; i < 50; ++i) {
      const ReflectionCase c = random_case(random, form, 20, random.uniform(1.5, 5));
      const CosineSeries<double> q = c.series(c.form(SeriesFit::taylor));
      const double reference = c.reference();
      const auto left = [&](double step) {
        Reflected<double> largest;
        for (int k = 0; k < 12; ++k) {
          const double x = step * std::cos(k), y = step * std::sin(k);
          const double u = 1.0 / 3 + x, v = 1.0 / 3 + y;
          const double folded =
              std::pow(c.attenuation(u, v) / reference, 1 / c.power) * c.cosine(u, v);
          largest.light =
              std::max(largest.light, std::fabs(q.light(x, y) - c.diffuse(u, v) / reference));
          largest.highlight = std::max(largest.highlight, std::fabs(q.highlight(x, y) - folded));
        }
        return largest;
      };
      const Reflected<double> far = left(4e-3), near = left(2e-3);
      constexpr double kRounding = 1e-13;
      EXPECT_LT(near.light, far.light / 6 + kRounding) << form << ", case " << i;
      EXPECT_LT(near.highlight, far.highlight / 6 + kRounding) << form << ", case " << i;
    }
  }
}

// Largest errors on triangles that turn by 10 degrees, light and eye five times their size away.
TEST(ReflectionSeries, IsNearTheExactReflection) {
  struct Row {
    SeriesFit fit;
    double light, highlight;  // LSB
  };
  for (const Row& row : {Row{SeriesFit::taylor, 7, 14}, Row{SeriesFit::six_point, 1.7, 4.5},
                         Row{SeriesFit::weighted, 1.3, 3}, Row{SeriesFit::focused, 1.3, 2.6}}) {
    SCOPED_TRACE(kReflectionSeriesSeed);
    ReflectionCases random(kReflectionSeriesSeed);
    for (const Form& form : general_forms()) {
      for (int i = 0; i < 100; ++i) {
        const ReflectionCase c = random_case(random, form, 10, 5);
        const Reflected<double> error = largest_errors(c, c.series(c.form(row.fit)));
        EXPECT_LT(error.light, row.light) << form << ", fit " << static_cast<int>(row.fit);
        EXPECT_LT(error.highlight, row.highlight) << form << ", fit " << static_cast<int>(row.fit);
      }
    }
  }
}

TEST(ReflectionSeries, FitsLeaveLessErrorThanTaylor) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  for (const Form& form : general_forms()) {
    std::array<std::vector<double>, 4> light, highlight;
    ReflectionCases random(kReflectionSeriesSeed);
    for (int i = 0; i < 101; ++i) {
      const ReflectionCase c = random_case(random, form, 20, 3, 60);
      for (std::size_t fit = 0; fit < kReflectionSeriesFits.size(); ++fit) {
        const Reflected<double> error =
            largest_errors(c, c.series(c.form(kReflectionSeriesFits[fit])));
        light[fit].push_back(error.light);
        highlight[fit].push_back(error.highlight);
      }
    }
    EXPECT_LT(2.5 * spread_of(light[1]).median, spread_of(light[0]).median) << form;
    EXPECT_LT(spread_of(light[2]).median, spread_of(light[1]).median) << form;
    EXPECT_LT(1.5 * spread_of(highlight[3]).median, spread_of(highlight[0]).median) << form;
    EXPECT_LT(spread_of(highlight[3]).median, spread_of(highlight[1]).median) << form;
    EXPECT_LT(spread_of(highlight[2]).median, spread_of(highlight[1]).median) << form;
  }
}

// Light and eye the same at all corners: what the constant forms compute, by the general ones.
TEST(ReflectionSeries, OfConstantVectorsIsTheCosines) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (int i = 0; i < 300; ++i) {
    ReflectionCase c =
        random.reflection(LightType::point, Viewer::local, Highlight::halfway, 30, 3, 20);
    for (std::size_t k = 0; k < 3; ++k) c.to_light[k] = c.to_light[0], c.eye[k] = c.eye[0];
    c.light.attenuation = {0.4, 0, 0};
    ReflectionCase constant = c;
    constant.light.type = LightType::directional;
    constant.scene.shading.viewer = Viewer::infinite;
    for (const SeriesFit fit : kReflectionSeriesFits) {
      SCOPED_TRACE(testing::Message() << "fit " << static_cast<int>(fit) << ", case " << i);
      const CosineSeries<double> q = c.series(c.form(fit)), p = constant.series(constant.form(fit));
      // The fits solve a system that amplifies rounding.
      const double tolerance = fit == SeriesFit::taylor ? 1e-12 : 1e-9;
      expect_near(q.light, p.light, tolerance);
      expect_near(q.highlight, p.highlight, tolerance);
    }
  }
}

TEST(ReflectionSeries, OfALightFarAwayIsTheDirectionalOne) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const Highlight highlight : {Highlight::halfway, Highlight::reflection}) {
    for (const Viewer viewer : {Viewer::infinite, Viewer::local}) {
      for (int i = 0; i < 100; ++i) {
        constexpr double kFar = 1e6;  // what is left of its finiteness is of the order 1/kFar
        const ReflectionCase c =
            random.reflection(LightType::point, viewer, highlight, 20, kFar, 20);
        ReflectionCase infinite = c;
        infinite.light.type = LightType::directional;
        for (const SeriesFit fit : kReflectionSeriesFits) {
          SCOPED_TRACE(testing::Message() << "fit " << static_cast<int>(fit) << ", case " << i);
          const CosineSeries<double> q = c.series(c.form(fit));
          const CosineSeries<double> p = infinite.series(infinite.form(fit));
          expect_near(q.light, p.light, 30 / kFar);
          expect_near(q.highlight, p.highlight, 30 / kFar);
        }
      }
    }
  }
}

TEST(ReflectionSeries, DoesNotDependOnTheLengthOfTheNormalsOrTheUnitOfDistance) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const Form& form : general_forms()) {
    for (int i = 0; i < 20; ++i) {
      const ReflectionCase c = random_case(random, form, 20, 3);
      ReflectionCase scaled = c;
      constexpr double kUnit = 12;
      for (std::size_t k = 0; k < 3; ++k) {
        scaled.normal[k] *= 3.7;
        scaled.eye[k] *= kUnit;
        scaled.to_light[k] *= kUnit;
      }
      scaled.light.attenuation[1] /= kUnit;
      scaled.light.attenuation[2] /= kUnit * kUnit;
      for (const SeriesFit fit : kReflectionSeriesFits) {
        SCOPED_TRACE(testing::Message() << form << ", fit " << static_cast<int>(fit));
        const CosineSeries<double> q = c.series(c.form(fit)), p = scaled.series(scaled.form(fit));
        expect_near(q.light, p.light, 1e-10);
        expect_near(q.highlight, p.highlight, 1e-10);
      }
    }
  }
}

// Light and A^fold s of half the reference are twice and 2^fold times those of the reference.
TEST(ReflectionSeries, TheReferenceIsAScale) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (int i = 0; i < 100; ++i) {
    const ReflectionCase c =
        random.reflection(LightType::spot, Viewer::local, Highlight::halfway, 20, 3, 20, 10);
    for (const SeriesFit fit : {SeriesFit::taylor, SeriesFit::six_point}) {
      const auto series = [&](double scale) {
        ReflectionTerms<double> terms = c.terms();
        for (double& k : terms.attenuation) k *= scale;
        return reflection_series(c.form(fit), unit_triangle<double>(), c.normal, c.eye, c.to_light,
                                 terms);
      };
      const CosineSeries<double> whole = series(1), half = series(0.5);
      expect_near(half.light, whole.light.scaled(2), 1e-11);
      expect_near(half.highlight, whole.highlight.scaled(std::pow(2, 1 / c.power)), 1e-11);
    }
  }
}

template <typename L, typename E>
void expect_same_edge(const ReflectionCase& c, const L& light, const E& eye,
                      const Corners<double>& other) {
  const ReflectionForm form = c.form(SeriesFit::six_point);
  const ReflectionTerms<double> terms = c.terms();
  // The edge from corner 1 to corner 2 faces corner 0 here, and corner 1 on the other side.
  const auto across = [&](const auto& v, const Vec& beyond) {
    if constexpr (std::is_same_v<std::decay_t<decltype(v)>, Vec>) {
      return v;
    } else {
      return Corners<double>{v[2], beyond, v[1]};
    }
  };
  const GeneralReflection<double, L, E> here(form, terms, c.normal, light, eye);
  const GeneralReflection<double, L, E> there(form, terms, across(c.normal, other[0]),
                                              across(light, other[1]), across(eye, other[2]));
  const auto a = here.template sampled<kSixPoints, kSixPoints>();
  const auto b = there.template sampled<kSixPoints, kSixPoints>();
  for (const auto& [i, j] : {std::pair(3, 4), std::pair(1, 2), std::pair(2, 0)}) {
    const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
    EXPECT_EQ(a.light[p], b.light[q]);
    EXPECT_EQ(a.highlight[p], b.highlight[q]);
  }
}

TEST(ReflectionSeries, SixPointSamplesAreTheSameToTheBitFromBothSidesOfAnEdge) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const Form& form : general_forms()) {
    for (int i = 0; i < 200; ++i) {
      const ReflectionCase c = random_case(random, form, 30, 2);
      const Corners<double> other = {random.unit(), random.unit(), random.unit()};
      const Vec light = c.to_light[0].normalized(), eye = c.eye[0].normalized();
      if (form.light == LightType::directional) {
        form.viewer == Viewer::local ? expect_same_edge(c, light, c.eye, other)
                                     : expect_same_edge(c, light, eye, other);
      } else {
        form.viewer == Viewer::local ? expect_same_edge(c, c.to_light, c.eye, other)
                                     : expect_same_edge(c, c.to_light, eye, other);
      }
    }
  }
}

TEST(ReflectionSeries, BehindASpotIsDark) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const SeriesFit fit : kReflectionSeriesFits) {
    for (int i = 0; i < 50; ++i) {
      ReflectionCase c =
          random.reflection(LightType::spot, Viewer::local, Highlight::halfway, 20, 3, 20, 10);
      ReflectionTerms<double> terms = c.terms();
      terms.spot_axis = -terms.spot_axis;
      const CosineSeries<double> q = reflection_series(c.form(fit), unit_triangle<double>(),
                                                       c.normal, c.eye, c.to_light, terms);
      expect_near(q.light, {}, 0);
      expect_near(q.highlight, {}, 0);
      // The limit of the cone runs through the triangle: edge and dark side are numbers.
      terms.spot_axis = terms.spot_axis.cross(c.normal[0]).normalized();
      expect_finite(reflection_series(c.form(fit), unit_triangle<double>(), c.normal, c.eye,
                                      c.to_light, terms));
    }
  }
}

// A light or an eye on the surface, at a corner, at the middle of an edge and at the centre, and an
// attenuation without bound there.
TEST(ReflectionSeries, OnTheSurfaceIsANumber) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const Form& form : general_forms()) {
    for (const auto& [u, v] :
         {std::pair(0.0, 0.0), std::pair(0.5, 0.0), std::pair(1.0 / 3, 1.0 / 3)}) {
      const ReflectionCase c = random_case(random, form, 20, 3);
      ReflectionTerms<double> terms = c.terms();
      terms.attenuation = {0, 0, 1};
      Corners<double> to_light = c.to_light, eye = c.eye;
      for (std::size_t k = 0; k < 3; ++k) {
        to_light[k] -= c.at(c.to_light, u, v);
        eye[k] -= c.at(c.eye, u, v);
      }
      for (const SeriesFit fit : kReflectionSeriesFits) {
        SCOPED_TRACE(testing::Message() << form << ", fit " << static_cast<int>(fit));
        const auto series = [&](const Corners<double>& l, const Corners<double>& e) {
          return reflection_series(c.form(fit), unit_triangle<double>(), c.normal, e, l, terms);
        };
        expect_finite(series(to_light, c.eye));
        expect_finite(series(c.to_light, eye));
        expect_finite(series(to_light, eye));
      }
    }
  }
}

TEST(ReflectionSeries, OpposedLightAndEyeHaveNoHighlight) {
  SCOPED_TRACE(kReflectionSeriesSeed);
  ReflectionCases random(kReflectionSeriesSeed);
  for (const SeriesFit fit : kReflectionSeriesFits) {
    ReflectionCase c =
        random.reflection(LightType::point, Viewer::local, Highlight::halfway, 20, 3, 20);
    for (std::size_t k = 0; k < 3; ++k) c.eye[k] = -c.to_light[k];
    const CosineSeries<double> q = c.series(c.form(fit));
    expect_finite(q);
    EXPECT_NEAR(q.highlight(0, 0), 0, 1e-9);
  }
}

}  // namespace
}  // namespace phongpipe
