// An axis of a chart: its range and its ticks.
#pragma once

#include <string>
#include <vector>

namespace phongpipe {

// Largest number of decades of a logarithmic axis, below its largest value. Rounding errors of
// 10^-13 LSB would otherwise squeeze all other values.
constexpr int kMostDecades = 7;

// The labelled ticks of an axis that shows `low` to `high`; the axis ends at the first and last
// tick. On a logarithmic axis: decades (and 2 and 5 times them if there are few); else multiples of
// 1, 2 or 5 times a power of ten.
std::vector<double> axis_ticks(double low, double high, bool logarithmic);

// Whether a coordinate can be drawn: finite, and positive on a logarithmic axis.
bool usable(double value, bool logarithmic);

// An axis for usable() values.
class PlotAxis {
 public:
  // Shows at least `low` to `high`, limited by kMostDecades.
  PlotAxis(double low, double high, bool logarithmic);

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
