// The frontier of a triangle's setup: operations and cycles against the error they leave, for the
// quadratics the setup engine knows, for some it does not, and for the best there are. Seeded;
// prints one table for diffuse light and one for highlights.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <string>

#include "sim/schedule.h"
#include "testbench/tests/model/shading/quadratics/random_cases.h"

namespace phongpipe {
namespace {

constexpr unsigned kSeed = 7;
constexpr int kTriangles = 301;
constexpr double kNearBest = 1.5;

template <typename T>
struct FitInput {
  Interpolator<T> interpolate;
  Corners<T> normal;
  Vector3<T> to_light, halfway;
  T sharpness;
};

// One candidate, in values and in operations.
struct Candidate {
  std::string name;
  std::function<CosineSeries<double>(const FitInput<double>&)> values;
  Dataflow setup;  // the whole triangle's, one channel, eye at infinity
};

template <typename Fit>
Candidate candidate(const std::string& name, const Fit& fit) {
  Recording recording;
  const Interpolator<Recorded> interpolate({}, {});
  LightInput<Recorded> light{};
  const TriangleInput<Recorded> triangle{};
  interpolate(triangle.z[0], triangle.z[1], triangle.z[2]);
  const CosineSeries<Recorded> series =
      fit(FitInput<Recorded>{interpolate, triangle.normal, light.terms.to_light,
                             light.terms.halfway, light.terms.sharpness});
  series.light.scaled(light.diffuse_scale[0]);
  series.highlight.scaled(light.specular_scale);
  return {name, fit, recording.dataflow()};
}

Candidate engine(SeriesFit fit) {
  return candidate(
      std::string(series_fit_names()[static_cast<std::size_t>(fit)]), [fit](const auto& in) {
        return fit_series(fit, in.interpolate, in.normal, in.to_light, in.halfway, in.sharpness);
      });
}

// Taylor's series about the middle of the highlight instead of the triangle's.
struct TaylorAtHighlight {
  template <typename T>
  CosineSeries<T> operator()(const FitInput<T>& in) const {
    const Linear<Vector3<T>> n = in.interpolate(in.normal[0], in.normal[1], in.normal[2]);
    const NormalSamples<T, kSixPoints> samples(in.normal);
    const Focus<T> focus(samples.cosines(in.halfway), in.sharpness);
    // The expansion point in x and y: where the barycentric coordinates are the focus's.
    const Linear<T> u = in.interpolate.coordinate_1(), v = in.interpolate.coordinate_2();
    const T du = focus.coordinate_of(1) - u.c, dv = focus.coordinate_of(2) - v.c;
    const T inverse = reciprocal(u.a * v.b - u.b * v.a);
    const T x = (du * v.b - dv * u.b) * inverse, y = (dv * u.a - du * v.a) * inverse;
    const Linear<Vector3<T>> moved = {n.a, n.b, n.c + n.a * x + n.b * y};
    Quadratic<T> q = NormalExpansion<T>(moved).infinite(in.halfway);
    q.t0 = q.t0 - q.t2 * x - q.t1 * y + (q.t5 * x + q.t4 * y) * x + q.t3 * y * y;
    q.t2 = q.t2 - twice(q.t5 * x) - q.t4 * y;
    q.t1 = q.t1 - twice(q.t3 * y) - q.t4 * x;
    return {NormalExpansion<T>(n).infinite(in.to_light), q};
  }
};

// Seven points, the six and the centroid: one difference, −ΣC + 4ΣM − 9G, so no system to solve.
struct SevenPoints {
  bool weighted;

  template <typename T>
  CosineSeries<T> operator()(const FitInput<T>& in) const {
    const auto sampled = [](const auto& form, const std::array<T, 3>& corner, const T& crosses) {
      const Values<T, kSixPoints> six = form.template sampled<kSixPoints>();
      std::array<T, kSixPoints + 1> seven;
      std::copy(six.begin(), six.end(), seven.begin());
      seven[6] = corner[0] + six[3] + crosses;
      return seven;
    };
    const QuadraticForm<T> square = squared_length(in.normal);
    auto inverse_length = sampled(square, square.square, square.cross[1] + square.cross[2]);
    for (T& x : inverse_length) x = rsqrt(x);
    const BarycentricBasis<T> basis(in.interpolate.coordinate_1(), in.interpolate.coordinate_2());
    const Fading<T> fading(in.sharpness * T(2.0 / 8));
    const auto fit = [&](const Vector3<T>& m, bool weigh) {
      const LinearForm<T> dot = {{in.normal[0].dot(m), in.normal[1].dot(m), in.normal[2].dot(m)}};
      auto f = sampled(dot, dot.corner, T(0)), spread = f;
      for (std::size_t i = 0; i < f.size(); ++i) {
        f[i] = f[i] * inverse_length[i];
        spread[i] = weigh ? eighth_power(fading(f[i])) : T(1);
      }
      const T around = twice(twice(f[3] + f[4] + f[5])) - (f[0] + f[1] + f[2]) - f[6] * T(9);
      const T norm = spread[0] + spread[1] + spread[2] +
                     T(16) * (spread[3] + spread[4] + spread[5]) + T(81) * spread[6];
      const T step = around * reciprocal(norm);
      SixValues<T> result;
      for (std::size_t k = 0; k < 3; ++k) {
        result.corner[k] = f[k] + spread[k] * step;
        result.middle[k] = f[3 + k] - spread[3 + k] * twice(twice(step));
      }
      return basis(result);
    };
    return {fit(in.to_light, false), fit(in.halfway, weighted)};
  }
};

// Ten points with even weights.
struct TenPoints {
  template <typename T>
  CosineSeries<T> operator()(const FitInput<T>& in) const {
    const NormalSamples<T, kTenPoints> samples(in.normal);
    const BarycentricBasis<T> basis(in.interpolate.coordinate_1(), in.interpolate.coordinate_2());
    Values<T, kTenPoints> even;
    even.fill(T(1));
    return {basis(fit_ten_points(samples.cosines(in.to_light), even)),
            basis(fit_ten_points(samples.cosines(in.halfway), even))};
  }
};

// The map for N·L, for both.
struct NinePoints {
  template <typename T>
  CosineSeries<T> operator()(const FitInput<T>& in) const {
    const NormalSamples<T, kNinePoints> samples(in.normal);
    const BarycentricBasis<T> basis(in.interpolate.coordinate_1(), in.interpolate.coordinate_2());
    return {basis(fit_nine_points(samples.cosines(in.to_light))),
            basis(fit_nine_points(samples.cosines(in.halfway)))};
  }
};

struct Column {
  double spread, power;
  std::vector<CosineCase> cases;
  std::vector<double> best_error;
};

std::vector<Column> make_columns(const std::vector<std::pair<double, double>>& kinds) {
  std::vector<Column> columns;
  for (const auto& [spread, power] : kinds) {
    RandomCases random(kSeed);
    Column column = {spread, power, {}, {}};
    for (int i = 0; i < kTriangles; ++i) {
      column.cases.push_back(power == 1 ? random.diffuse(spread) : random.specular(spread, power));
      column.best_error.push_back(largest_error(column.cases.back(), best(column.cases.back())));
    }
    columns.push_back(column);
  }
  return columns;
}

void print_row(const std::vector<Column>& columns,
               const std::function<double(const Column&, std::size_t)>& error) {
  for (const Column& column : columns) {
    std::vector<double> errors;
    int near = 0;
    for (std::size_t i = 0; i < column.cases.size(); ++i) {
      errors.push_back(error(column, i));
      near += errors.back() <= kNearBest * column.best_error[i] ? 1 : 0;
    }
    const Spread s = spread_of(errors);
    fmt::print("  {:6.2f} {:7} {:3.0f} %", s.median, fmt::format("({:.2f})", s.worst),
               100.0 * near / kTriangles);
  }
  fmt::print("\n");
}

void print_table(const std::string& title, const std::vector<Candidate>& candidates,
                 const std::vector<std::pair<double, double>>& kinds) {
  const std::vector<Column> columns = make_columns(kinds);
  fmt::print("{}\n{:<20}{:>6}{:>8}{:>8}", title, "", "ops", "×taylor", "cycles");
  for (const auto& [spread, power] : kinds) {
    fmt::print("  {:>20}",
               power == 1 ? fmt::format("{}°", spread) : fmt::format("n {}, {}°", power, spread));
  }
  fmt::print("\n");
  double taylor = 0;
  for (const Candidate& c : candidates) {
    const OperationCounts counts = c.setup.counts();
    const std::size_t operations = counts.add + counts.multiply + counts.rsqrt;
    if (taylor == 0) taylor = static_cast<double>(operations);
    fmt::print("{:<20}{:6}{:8.2f}{:8}", c.name, operations,
               static_cast<double>(operations) / taylor, schedule_cycles(c.setup, {}));
    print_row(columns, [&c](const Column& column, std::size_t i) {
      const CosineCase& k = column.cases[i];
      const CosineSeries<double> series =
          c.values({unit_triangle<double>(), k.normal, k.m, k.m, k.power - 1});
      return largest_error(k, k.power == 1 ? series.light : series.highlight);
    });
  }
  fmt::print("{:<42}", "best");
  print_row(columns, [](const Column& column, std::size_t i) { return column.best_error[i]; });
}

int study() {
  const std::vector<Candidate> candidates = {engine(SeriesFit::taylor),
                                             candidate("taylor at highlight", TaylorAtHighlight()),
                                             engine(SeriesFit::six_point),
                                             candidate("seven", SevenPoints{false}),
                                             candidate("seven weighted", SevenPoints{true}),
                                             candidate("ten", TenPoints()),
                                             candidate("nine, one map", NinePoints()),
                                             engine(SeriesFit::weighted),
                                             engine(SeriesFit::focused)};
  fmt::print(
      "Largest error of a triangle in LSB, median (worst) of {} random ones, seed {}, and the "
      "share "
      "of them within {} of the best.\nOperations of the whole setup: additions, multiplications "
      "and 1/√, one channel, eye at infinity.\n\n",
      kTriangles, kSeed, kNearBest);
  print_table("diffuse, by the spread of the normals", candidates, {{20, 1}, {30, 1}, {60, 1}});
  fmt::print("\n");
  print_table("specular, highlight inside, by power and spread", candidates,
              {{20, 20}, {30, 20}, {45, 20}, {15, 164}, {20, 164}, {30, 164}});
  return 0;
}

}  // namespace
}  // namespace phongpipe

int main() {
  return phongpipe::study();
}
