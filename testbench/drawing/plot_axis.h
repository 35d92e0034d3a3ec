// An axis of a chart: its range and its ticks.
#pragma once

#include <string>
#include <vector>

namespace phongpipe {

// A logarithmic axis ends this many decades below its largest value: errors of rounding, 10^-13 of
// an LSB, would squeeze all others.
constexpr int kMostDecades = 7;

// The labelled ticks of an axis that shows `low` to `high`, from its one end to its other: decades
// (and 2 and 5 times them where there are few) on a logarithmic axis, else multiples of 1, 2 or 5
// times a power of ten.
std::vector<double> axis_ticks(double low, double high, bool logarithmic);

// Whether a coordinate can be drawn: finite, and positive on a logarithmic axis.
bool usable(double value, bool logarithmic);

// Shows usable values only.
class Axis {
 public:
  // Of at least the range from `low` to `high`, but see kMostDecades.
  Axis(double low, double high, bool logarithmic);

  const std::vector<double>& ticks() const { return ticks_; }
  std::vector<double> minor_ticks() const;  // lines without a label, on a logarithmic axis
  double place(double value) const;         // from 0 to 1 along the axis
  bool below(double value) const;           // more than kMostDecades under the largest
  std::string label(double tick) const;

 private:
  double scaled(double value) const;

  bool logarithmic_;
  std::vector<double> ticks_;
  double low_, high_;  // scaled
};

}  // namespace phongpipe
