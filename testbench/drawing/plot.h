// Charts as SVG text: lines or labelled points over two axes, on white. Without scripts, other
// files and ids, so the text can stand in an HTML page as it is.
#pragma once

#include <string>
#include <vector>

namespace phongpipe {

struct PlotPoint {
  double x = 0, y = 0;
  std::string label;  // drawn beside the point
};

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;
  bool joined = true;  // in this order, if the chart has lines
};

struct Chart {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  bool lines = true;  // join the points of each series that wants it
  std::vector<PlotSeries> series;
};

// Points that are not finite, or not positive on a logarithmic axis, are left out, and a line is
// broken there; the legend says which series have no point left.
std::string svg(const Chart& chart);

}  // namespace phongpipe
