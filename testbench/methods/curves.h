// How the shading methods compare over curvature, triangle size and exponent: on seeded random
// triangles in screen space, or from the operations counted. The same seed gives the same numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/shading/methods/shading_method.h"
#include "testbench/drawing/plot.h"

namespace phongpipe {

// One series a method, named as it is.
struct Curve {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<PlotSeries> series;
};

Chart chart_of(const Curve& curve);
// The column x, then one a series; empty where a series has no point at that x.
std::string curve_csv(const Curve& curve);

struct CurveOptions {
  std::uint32_t seed = 1;
  int triangles = 101;                       // of which each error is the median
  Highlight highlight = Highlight::halfway;  // methods that have only the other are left out
  std::function<void(const std::string&)> progress;  // told what is being measured; may be empty
};

// Largest error in LSB against the angle the normals of a triangle span, 5 to 90 degrees. Diffuse
// light alone, or full Phong shading with this exponent, the highlight inside the triangle.
Curve curvature_curve(Parts parts, double shininess, const CurveOptions& options = {});

// Clocks of what has been counted, on given units.
using ClockFunction = std::function<double(const OperationCounts&)>;

// Clocks a pixel against the pixels of a triangle, 1 to 10,000: set-up and starts of spans are
// shared out among them. The triangle is about as high as wide.
Curve size_curve(Parts parts, PowerKind power, const ClockFunction& clocks,
                 const CurveOptions& options = {});
double amortised_clocks(const MethodCosts& costs, int pixels, const ClockFunction& clocks);

// The least size in pixels, up to those of size_curve, from which on `method` takes less time than
// `other`; none if it never does.
std::optional<int> break_even_pixels(const MethodCosts& method, const MethodCosts& other,
                                     const ClockFunction& clocks);

// Largest error of the highlight alone in LSB against the exponent, 1 to 10,000, on triangles of
// one curvature: each method with an exact power, then exact and Taylor's cosines with each way to
// the power. The eye is at the light, as interpolation of angles assumes.
Curve exponent_curve(double spread_degrees = 10, const CurveOptions& options = {});

}  // namespace phongpipe
