// Compares all shading methods on one scene: cost, and error against exact Phong shading.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "model/shading/methods/shading_method.h"
#include "testbench/accuracy/accuracy.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {

struct MethodResult {
  std::string_view name, source;
  std::string refused;  // why it cannot render the scene; nothing below is filled in then
  std::string note;
  bool of_hardware = false;  // what the configured hardware computes, in real arithmetic
  // True for the best quadratics, computed offline and by no method; costs and times are then not
  // filled in.
  bool is_limit = false;

  MethodCosts costs;
  double clocks_per_pixel = 0;  // on the configured units, setup amortised over the scene
  double ns_per_pixel = 0;
  double operations_per_pixel = 0;  // executed one by one as in the paper, setup amortised
  // Least triangle size in pixels from which the method costs less than exact Phong, with
  // operations executed one after the other; empty if there is none.
  std::optional<int> break_even_pixels;
  double wall_clock_ns_per_pixel = 0;  // measured, per shaded pixel, fastest of 3 runs, with setup
  ErrorStatistics error;
  // Largest jump of the error between neighbouring pixels on both sides of an edge shared by two
  // triangles.
  double largest_seam_lsb = 0;

  std::vector<Color> colors;
  std::vector<float> errors_lsb;  // the largest of the channels, NaN where nothing is covered
};

struct Comparison {
  std::string scene;  // its name in messages
  Hardware hardware;  // resolved
  ClockFigure clock;
  int width = 0, height = 0, channels = 3;
  std::size_t triangles = 0, spans = 0, pixels = 0;  // triangles with a pixel, rows, shaded pixels
  PowerKind power = PowerKind::exact;
  std::size_t split = 0, pieces = 0;  // split triangles for fitted quadratics, and their pieces
  std::vector<MethodResult> methods;  // the limit of quadratics last
};

// Throws InputError if nothing of the scene covers a pixel. `power`: how methods compute the power
// of highlights; an exact power is counted as a table read.
Comparison compare(const Scene& scene, const Hardware& hardware,
                   const std::function<void(const std::string&)>& progress,
                   PowerKind power = PowerKind::exact);

}  // namespace phongpipe
