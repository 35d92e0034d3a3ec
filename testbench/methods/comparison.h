// All shading methods on one scene: what each costs, and how far it is from exact Phong shading.
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
  // The best quadratics: computed offline, by no method. Costs and times are not filled in then.
  bool is_limit = false;

  MethodCosts costs;
  double clocks_per_pixel = 0;  // on the configured units, setup amortised over the scene
  double ns_per_pixel = 0;
  double operations_per_pixel = 0;  // one after the other, as the paper counts, setup amortised
  // Triangles of so many pixels and more cost less than exact Phong's, one operation after the
  // other.
  std::optional<int> break_even_pixels;
  double wall_clock_ns_per_pixel = 0;  // per shaded pixel, on this machine, one run, setup included
  ErrorStatistics error;
  // Largest jump of the error between pixels on both sides of an edge that triangles share.
  double largest_seam_lsb = 0;

  std::vector<Color> colors;
  std::vector<float> errors_lsb;  // the largest of the channels, NaN where nothing is covered
};

struct Comparison {
  std::string scene;  // what messages call it
  Hardware hardware;  // resolved
  double clock_ns = 0;
  int width = 0, height = 0, channels = 3;
  std::size_t triangles = 0, spans = 0, pixels = 0;  // with a pixel; rows; shaded
  PowerKind power = PowerKind::exact;
  std::size_t split = 0, pieces = 0;  // triangles that fitted quadratics get in so many pieces
  std::vector<MethodResult> methods;  // the limit of quadratics last
};

// `power`: of the methods' highlights; an exact one is counted as a table read.
Comparison compare(const Scene& scene, const Hardware& hardware,
                   const std::function<void(const std::string&)>& progress,
                   PowerKind power = PowerKind::exact);

}  // namespace phongpipe
