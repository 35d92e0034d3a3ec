#include "testbench/drawing/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace phongpipe {
namespace {

constexpr int kFewDecades = 2;  // up to which 2 and 5 are labelled too
constexpr double kFuzz = 1e-9;  // a power of ten may have a rounded logarithm

// Decades 10^first to 10^last.
struct Decades {
  int first, last;

  Decades(double low, double high) {
    last = static_cast<int>(std::ceil(std::log10(high) - kFuzz));
    first = std::max(static_cast<int>(std::floor(std::log10(low) + kFuzz)), last - kMostDecades);
    if (first == last) ++last;
  }
};

double nice_step(double range) {
  constexpr double kIntervals = 6;
  const double raw = range / kIntervals, decade = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (raw <= factor * decade) return factor * decade;
  }
  return 10 * decade;
}

}  // namespace

bool usable(double value, bool logarithmic) {
  constexpr double kLargest = 1e300;  // the difference of two is finite too
  return std::fabs(value) <= kLargest && (!logarithmic || value > 0);
}

std::vector<double> axis_ticks(double low, double high, bool logarithmic) {
  std::vector<double> ticks;
  if (logarithmic) {
    const Decades decades(low, high);
    for (int k = decades.first; k <= decades.last; ++k) {
      ticks.push_back(std::pow(10, k));
      if (k == decades.last || decades.last - decades.first > kFewDecades) continue;
      ticks.push_back(2 * ticks.back());
      ticks.push_back(2.5 * ticks.back());
    }
    return ticks;
  }
  const double size = std::max(std::fabs(low), std::fabs(high));
  if (high - low <= 1e-9 * size) {  // nearly one value: some room about it
    low -= size / 10;
    high += size / 10;
  }
  if (low > 0 && low < high / 2) low = 0;  // lengths can be compared
  if (!(high > low)) high = low + 1;
  const double step = nice_step(high - low), first = std::floor(low / step);
  const auto intervals = static_cast<int>(std::ceil(high / step) - first);
  for (int i = 0; i <= intervals; ++i) ticks.push_back((first + i) * step);
  return ticks;
}

PlotAxis::PlotAxis(double low, double high, bool logarithmic)
    : logarithmic_(logarithmic), ticks_(axis_ticks(low, high, logarithmic)) {
  low_ = scaled(ticks_.front());
  high_ = scaled(ticks_.back());
}

double PlotAxis::scaled(double value) const {
  return logarithmic_ ? std::log10(value) : value;
}

double PlotAxis::place(double value) const {
  return (scaled(value) - low_) / (high_ - low_);
}

bool PlotAxis::below(double value) const {
  return logarithmic_ && (value <= 0 || scaled(value) < low_ - 2 * kFuzz);
}

std::vector<double> PlotAxis::minor_ticks() const {
  std::vector<double> ticks;
  for (double k = low_; logarithmic_ && k < high_ - 0.5; ++k) {
    for (int factor = 2; factor < 10; ++factor) ticks.push_back(std::pow(10, k) * factor);
  }
  return ticks;
}

std::string PlotAxis::label(double tick) const {
  constexpr double kPlainFrom = 0.9e-4, kPlainTo = 1.1e5;
  if (!logarithmic_ || (tick > kPlainFrom && tick < kPlainTo)) return fmt::format("{:.10g}", tick);
  const double decade = std::floor(std::log10(tick) + kFuzz);
  return fmt::format("{:.0f}e{:.0f}", tick / std::pow(10, decade), decade);
}

}  // namespace phongpipe
