// Curves that compare shading methods over curvature, triangle size and exponent: on seeded random
// triangles in screen space, or from operation counts. The same seed gives the same numbers.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/fixed/prepared_frame.h"
#include "model/shading/methods/shading_method.h"
#include "testbench/drawing/plot.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {

// One series per method, with the method's name.
struct Curve {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  std::vector<PlotSeries> series;
};

Chart chart_of(const Curve& curve);

struct CurveOptions {
  std::uint32_t seed = 1;
  int triangles = 101;                       // each error is the median over these
  Highlight highlight = Highlight::halfway;  // methods that have only the other are left out
  std::function<void(const std::string&)> progress;  // called with the current step; may be empty
};

// Largest error in LSB against the largest angle between the normals of a triangle, 5 to 90
// degrees. For diffuse light alone, or for full Phong shading with this exponent and the highlight
// inside the triangle.
Curve curvature_curve(Parts parts, double shininess, const CurveOptions& options = {});

// Clocks that counted operations take on given units.
using ClockFunction = std::function<double(const OperationCounts&)>;

// Clocks per pixel against the pixels of a triangle, 1 to 10,000, with setup and starts of spans
// amortised over them. The triangle is about as high as wide.
Curve size_curve(Parts parts, PowerKind power, const ClockFunction& clocks,
                 const CurveOptions& options = {});
double amortised_clocks(const MethodCosts& costs, int pixels, const ClockFunction& clocks);

// Nanoseconds a pixel that each block of the pipeline is occupied by a triangle of 1 to 10,000
// pixels under the scene's first light, by itself: blocks work at the same time, so that the
// highest curve is what a frame of such triangles takes. The setup engine once for each fit of the
// series; the scene's first material.
Curve block_curve(const std::shared_ptr<const PreparedScene>& scene, const Hardware& hardware,
                  double budget_ns);

// Time of full Phong shading by a series over that by a method that shades each pixel anew, for
// triangles of 1 to 10,000 pixels: below 1 the series pays; names tell from which size. On a
// processor that executes one operation after the other, as the paper counts, and on the hardware's
// shared units.
Curve break_even_curve(const PipelineConfiguration& units);

// The least triangle size in pixels, within the range of size_curve, from which `method` takes less
// time than `other`; empty if there is none.
std::optional<int> break_even_pixels(const MethodCosts& method, const MethodCosts& other,
                                     const ClockFunction& clocks);

// Largest error of the highlight alone in LSB against the exponent, 1 to 10,000, on triangles of
// one curvature: each method with an exact power, then exact and Taylor's cosines with each
// PowerKind. The eye is at the light, as interpolation of angles assumes.
Curve exponent_curve(double spread_degrees = 10, const CurveOptions& options = {});

}  // namespace phongpipe
