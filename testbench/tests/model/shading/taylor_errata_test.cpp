// What the paper prints wrongly about its two Taylor forms (NUMERICS section 1): each printed form
// is far off somewhere, while the same formula with that one correction agrees everywhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "model/shading/taylor.h"

#include "testbench/system/random.h"
#include "testbench/tests/model/shading/six.h"

namespace phongpipe {
namespace {

using Vec = Vector3<double>;

constexpr unsigned kTaylorErrataSeed = 1986;
constexpr int kTaylorErrataCases = 2000;
constexpr double kTaylorErrataAgree = 1e-12;  // measured below 3e-14
constexpr double kFarOff = 1e-3;

double power(double x, int n) {
  return n == 0 ? 1 : x * power(x, n - 1);
}

// One thing at a time is as the paper prints it.
enum class Printed {
  nothing,
  infinite_t5,     // 3ig² for 3cg²
  coefficient_m,   // m = E·E for D·D
  coefficient_o,   // o = 2D·E for E·E
  finite_t5_ajlr,  // −4ajlr² for −4djlr²
  finite_t5_fjlp,  // 2fjlp for 2fjlpr
  finite_t4_fjlr,  // −fjlr for +fjlqr
  finite_t4_f2nr,  // −2f²nr for −2fl²nr
};

Six paper_infinite(const Linear<Vec>& normal, const Vec& light, Printed printed) {
  const double a = light.dot(normal.a), b = light.dot(normal.b), c = light.dot(normal.c);
  const double d = normal.a.dot(normal.a), e = 2 * normal.a.dot(normal.b);
  const double f = normal.b.dot(normal.b), g = 2 * normal.a.dot(normal.c);
  const double h = 2 * normal.b.dot(normal.c), i = normal.c.dot(normal.c);
  const double root = std::sqrt(i);
  const double first = printed == Printed::infinite_t5 ? 3 * i * g * g : 3 * c * g * g;
  return {c / root,
          (2 * b * i - c * h) / (2 * i * root),
          (2 * a * i - c * g) / (2 * i * root),
          (3 * c * h * h - 4 * c * f * i - 4 * b * h * i) / (8 * i * i * root),
          (3 * c * g * h - 2 * c * e * i - 2 * b * g * i - 2 * a * h * i) / (4 * i * i * root),
          (first - 4 * c * d * i - 4 * a * g * i) / (8 * i * i * root)};
}

Six paper_finite(const Linear<Vec>& normal, const Linear<Vec>& halfway, Printed printed) {
  const Vec &A = normal.a, &B = normal.b, &C = normal.c;
  const Vec &D = halfway.a, &E = halfway.b, &F = halfway.c;
  const double a = A.dot(D), b = A.dot(E) + B.dot(D), c = B.dot(E);
  const double d = A.dot(F) + C.dot(D), e = B.dot(F) + C.dot(E), f = C.dot(F);
  const double g = A.dot(A), h = 2 * A.dot(B), i = B.dot(B);
  const double j = 2 * A.dot(C), k = 2 * B.dot(C), l = C.dot(C);
  const double m = printed == Printed::coefficient_m ? E.dot(E) : D.dot(D), n = 2 * D.dot(E);
  const double o = printed == Printed::coefficient_o ? 2 * D.dot(E) : E.dot(E);
  const double p = 2 * D.dot(F), q = 2 * E.dot(F), r = F.dot(F);
  const double l2 = l * l, r2 = r * r, root = std::sqrt(l * r);
  const double djlr = (printed == Printed::finite_t5_ajlr ? a : d) * j * l * r2;
  const double fjlp = f * j * l * p * (printed == Printed::finite_t5_fjlp ? 1 : r);
  const double fjlr = printed == Printed::finite_t4_fjlr ? -f * j * l * r : f * j * l * q * r;
  const double fnr = printed == Printed::finite_t4_f2nr ? f * f * n * r : f * l2 * n * r;
  const double t5 = 8 * a * l2 * r2 - 4 * djlr - 4 * f * g * l * r2 + 3 * f * j * j * r2 -
                    4 * d * l2 * p * r + 2 * fjlp - 4 * f * l2 * m * r + 3 * f * l2 * p * p;
  const double t4 = 4 * b * l2 * r2 - 2 * d * k * l * r2 - 2 * e * j * l * r2 - 2 * f * h * l * r2 +
                    3 * f * j * k * r2 - 2 * d * l2 * q * r + fjlr - 2 * e * l2 * p * r +
                    f * k * l * p * r - 2 * fnr + 3 * f * l2 * p * q;
  const double t3 = 8 * c * l2 * r2 - 4 * e * k * l * r2 - 4 * f * i * l * r2 + 3 * f * k * k * r2 -
                    4 * e * l2 * q * r + 2 * f * k * l * q * r - 4 * f * l2 * o * r +
                    3 * f * l2 * q * q;
  return {f / root,
          (2 * e * l * r - f * k * r - f * l * q) / (2 * l * r * root),
          (2 * d * l * r - f * j * r - f * l * p) / (2 * l * r * root),
          t3 / (8 * l2 * r2 * root),
          t4 / (4 * l2 * r2 * root),
          t5 / (8 * l2 * r2 * root)};
}

// Of T_i, relative to the largest of the six.
double difference_of(std::size_t i, const Six& t, const Six& expected) {
  double size = 0;
  for (const double value : expected) size = std::max(size, std::fabs(value));
  return std::fabs(t[i] - expected[i]) / size;
}

Linear<Vec> linear_away_from_zero(Random& random) {
  const auto component = [&random] { return random.uniform(-1, 1); };
  const auto vector = [&] { return Vec{component(), component(), component()}; };
  Vec c = vector();
  while (c.norm() < 0.1) c = vector();
  const double size = random.uniform(0.5, 2);
  return {vector(), vector(), size * c.normalized()};
}

struct Erratum {
  const char* name;
  Printed printed;
  bool finite;
  std::size_t coefficient;  // the T_i that it spoils
};

class PaperErrata : public testing::TestWithParam<Erratum> {};

TEST_P(PaperErrata, OnlyTheCorrectedFormAgrees) {
  SCOPED_TRACE(kTaylorErrataSeed);
  const auto& [name, printed, finite, coefficient] = GetParam();
  Random random(kTaylorErrataSeed);
  double worst_printed = 0;
  for (int i = 0; i < kTaylorErrataCases; ++i) {
    const Linear<Vec> normal = linear_away_from_zero(random),
                      halfway = linear_away_from_zero(random);
    const NormalExpansion<double> expansion(normal);
    const Vec light = halfway.c.normalized();
    const Six ours = six(finite ? expansion.finite(halfway) : expansion.infinite(light));
    const auto paper = [&](Printed what) {
      return finite ? paper_finite(normal, halfway, what) : paper_infinite(normal, light, what);
    };
    for (std::size_t k = 0; k < 6; ++k) {
      ASSERT_LT(difference_of(k, ours, paper(Printed::nothing)), kTaylorErrataAgree)
          << "case " << i << ": T" << k << " is " << ours[k] << ", the corrected form has "
          << paper(Printed::nothing)[k];
    }
    worst_printed = std::max(worst_printed, difference_of(coefficient, ours, paper(printed)));
  }
  EXPECT_GT(worst_printed, kFarOff) << "the paper's own " << name << " would do";
}

INSTANTIATE_TEST_SUITE_P(Taylor, PaperErrata,
                         testing::Values(Erratum{"InfiniteT5", Printed::infinite_t5, false, 5},
                                         Erratum{"CoefficientM", Printed::coefficient_m, true, 5},
                                         Erratum{"CoefficientO", Printed::coefficient_o, true, 3},
                                         Erratum{"FiniteT5ajlr", Printed::finite_t5_ajlr, true, 5},
                                         Erratum{"FiniteT5fjlp", Printed::finite_t5_fjlp, true, 5},
                                         Erratum{"FiniteT4fjlr", Printed::finite_t4_fjlr, true, 4},
                                         Erratum{"FiniteT4f2nr", Printed::finite_t4_f2nr, true, 4}),
                         [](const auto& erratum) { return std::string(erratum.param.name); });

// Why images do not show the infinite form's erratum: about the centre of a symmetric triangle g =
// 0.
TEST(PaperErrata, TheErratumOfT5VanishesOnASymmetricTriangle) {
  const Linear<Vec> normal = {Vec(0.1, 0, 0), Vec(0, 0.1, 0), Vec(0, 0, 1)};
  const Vec light = Vec(1, 2, 3).normalized();
  const Six printed = paper_infinite(normal, light, Printed::infinite_t5);
  EXPECT_DOUBLE_EQ(printed[5], six(NormalExpansion<double>(normal).infinite(light))[5]);
}

}  // namespace
}  // namespace phongpipe
