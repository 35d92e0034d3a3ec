#include "model/shading/quadratics/best_quadratic.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace phongpipe {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

// Values of the quadratics that are 1 at one of the six points and 0 at the others.
Vector6 shapes(double u, double v) {
  const double w = 1 - u - v;
  Vector6 result;
  result << w * (2 * w - 1), u * (2 * u - 1), v * (2 * v - 1), 4 * u * v, 4 * v * w, 4 * w * u;
  return result;
}

// Quadratics are six numbers; with how far they leave their bands, seven.
using Vector7 = Eigen::Matrix<double, 7, 1>;
using Matrix7 = Eigen::Matrix<double, 7, 7>;

class Search {
 public:
  Search(const std::vector<CosineSample>& samples, double power)
      : power_(power), samples_(samples.size()) {
    Matrix6 normal = Matrix6::Zero();
    Vector6 right = Vector6::Zero();
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const Vector6 at = shapes(samples[i].u, samples[i].v);
      samples_[i].shapes = at;
      samples_[i].displayed = displayed(samples[i].cosine);
      normal.noalias() += at * at.transpose();
      right += samples[i].cosine * at;
    }
    // Few samples may leave directions open.
    normal.diagonal().array() += 1e-14 * normal.trace();
    keep(normal.ldlt().solve(right));
  }

  double error() const { return error_; }
  const Vector6& values() const { return best_; }

  enum class Answer { yes, no, unknown };

  // Whether some quadratic errs by no more than `allowed`: the least t by which all bands must be
  // widened to hold one is found as a linear programme, by a primal-dual interior point method.
  Answer within(double allowed) {
    set_bands(allowed);
    Vector7 x;  // the quadratic and t
    x << best_, 0;
    for (const Sample& s : samples_) x[6] = std::max(x[6], 1.1 * std::fabs(s.above(best_)));
    for (Sample& s : samples_) s.dual = {1 / s.slack(x, 1), 1 / s.slack(x, -1)};
    constexpr int kIterations = 60;
    const double decided = 1e-3 * allowed / std::max(1.0, power_);  // in cosines
    double gap = decided;
    for (int iteration = 0; iteration < kIterations && gap >= decided; ++iteration) {
      gap = step(x);
      keep(x.head<6>());
      if (error_ <= allowed) return Answer::yes;
      if (x[6] - gap > 0) return Answer::no;
    }
    return Answer::unknown;
  }

 private:
  struct Sample {
    Vector6 shapes;
    double displayed = 0;
    double centre = 0, width = 1;     // of the band
    std::array<double, 2> dual = {};  // of its upper and lower end

    double above(const Vector6& q) const { return q.dot(shapes) - centre; }
    double slack(const Vector7& x, int end) const {
      return width + x[6] - end * above(x.head<6>());
    }
    // What the slack of an end loses with x.
    Vector7 row(int end) const {
      Vector7 result;
      result << end * shapes, -1;
      return result;
    }
  };

  double displayed(double cosine) const { return std::pow(std::clamp(cosine, 0.0, 1.0), power_); }
  double cosine_of(double displayed) const { return std::pow(displayed, 1 / power_); }

  void set_bands(double allowed) {
    // Where a power may be 0 the cosine may be less, and where it may be 1 more, as far as cosines
    // and registers go.
    constexpr double kLowest = -1, kHighest = 2;
    for (Sample& s : samples_) {
      const double low = s.displayed > allowed ? cosine_of(s.displayed - allowed) : kLowest;
      const double high = s.displayed + allowed < 1 ? cosine_of(s.displayed + allowed) : kHighest;
      s.centre = (low + high) / 2;
      s.width = (high - low) / 2;
    }
  }

  template <typename Visit>
  void for_ends(Visit visit) {
    for (Sample& s : samples_) {
      visit(s, s.dual[0], 1);
      visit(s, s.dual[1], -1);
    }
  }

  // One Newton step; what t may still be too large by, once the duals are feasible.
  double step(Vector7& x) {
    constexpr double kCentring = 0.1, kToBoundary = 0.95;
    const double ends = 2 * static_cast<double>(samples_.size());
    double gap = 0;
    for_ends([&](const Sample& s, double dual, int end) { gap += dual * s.slack(x, end); });
    const double target = kCentring * gap / ends;
    Matrix7 hessian = Matrix7::Zero();
    Vector7 gradient = Vector7::Unit(6);
    for_ends([&](const Sample& s, double dual, int end) {
      const double inverse = 1 / s.slack(x, end);
      const Vector7 row = s.row(end);
      hessian.noalias() += (dual * inverse) * row * row.transpose();
      gradient += (target * inverse) * row;
    });
    hessian.diagonal() *= 1 + 1e-13;
    const Vector7 move = -hessian.ldlt().solve(gradient);
    double along = 1, along_dual = 1;
    const auto change_of_dual = [&](const Sample& s, double dual, int end) {
      const double slack = s.slack(x, end);
      return target / slack - dual + dual / slack * s.row(end).dot(move);
    };
    for_ends([&](const Sample& s, double dual, int end) {
      const double loss = s.row(end).dot(move), change = change_of_dual(s, dual, end);
      if (loss > 0) along = std::min(along, kToBoundary * s.slack(x, end) / loss);
      if (change < 0) along_dual = std::min(along_dual, -kToBoundary * dual / change);
    });
    for_ends([&](const Sample& s, double& dual, int end) {
      dual += along_dual * change_of_dual(s, dual, end);
    });
    x += along * move;
    Vector7 infeasible = Vector7::Unit(6);
    gap = 0;
    for_ends([&](const Sample& s, double dual, int end) {
      infeasible += dual * s.row(end);
      gap += dual * s.slack(x, end);
    });
    return gap + infeasible.lpNorm<1>() * (1 + x.lpNorm<Eigen::Infinity>());
  }

  void keep(const Vector6& q) {
    double largest = 0;
    for (const Sample& s : samples_) {
      largest = std::max(largest, std::fabs(displayed(q.dot(s.shapes)) - s.displayed));
    }
    if (error_ < 0 || largest < error_) {
      error_ = largest;
      best_ = q;
    }
  }

  double power_;
  std::vector<Sample> samples_;
  Vector6 best_ = Vector6::Zero();
  double error_ = -1;
};

}  // namespace

BestQuadratic best_quadratic(const std::vector<CosineSample>& samples, double power,
                             double good_enough) {
  constexpr double kClose = 1.02, kRoundOff = 1e-13;
  Search search(samples, power);
  double tried = 0, lower_bound = 0;
  while (search.error() > std::max({kClose * tried, good_enough, kRoundOff})) {
    const double allowed = (tried + search.error()) / 2;
    const Search::Answer answer = search.within(allowed);
    if (answer != Search::Answer::yes) tried = allowed;
    if (answer == Search::Answer::no) lower_bound = allowed;
  }
  const Vector6& q = search.values();
  return {{{q[0], q[1], q[2]}, {q[3], q[4], q[5]}}, search.error(), lower_bound};
}

}  // namespace phongpipe
