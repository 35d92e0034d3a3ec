// Error of the picture against exact Phong shading, split into its causes, pixel by pixel along the
// chain exact Phong → the triangle shown → real polynomial → rounded coefficients → ROM → 8-bit
// output.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "testbench/accuracy/exact_visibility.h"
#include "testbench/drawing/pictures.h"

namespace phongpipe {

// Statistics over all channels of covered pixels, in output LSB.
struct ErrorStatistics {
  double largest_lsb = 0;
  double sum_of_squares = 0;
  std::uint64_t samples = 0;
  std::uint64_t over_half = 0, over_one = 0, over_two = 0;

  void add(double error_lsb) {
    const double size = std::fabs(error_lsb);
    largest_lsb = std::max(largest_lsb, size);
    sum_of_squares += error_lsb * error_lsb;
    ++samples;
    over_half += size > 0.5;
    over_one += size > 1;
    over_two += size > 2;
  }
  void add(const ErrorStatistics& others);
  double rms_lsb() const;
  double psnr_db() const;  // against full scale; infinite without any error
  double share(std::uint64_t count) const;
};

constexpr std::size_t kWorstPixels = 10;
struct PixelError {
  std::size_t index = 0;  // of the pixel, row by row from the top
  double error_lsb = 0;   // the largest of its channels, without sign
};

struct AccuracyOptions {
  bool pictures = true;
  bool one_core = false;  // else all cores; the result is the same
  double limit_lsb = 2;   // pixels with larger errors are counted
};

struct Accuracy {
  std::uint64_t visible_pixels = 0;
  std::uint64_t pixels_over_limit = 0;
  std::vector<PixelError> worst_pixels;  // at most kWorstPixels, the largest error first
  ErrorStatistics total;
  // Each is one step of the chain; at every pixel they add up to the total.
  ErrorStatistics visibility;  // another triangle shown than the nearest
  ErrorStatistics series;      // second-degree polynomial in place of the exact reflection
  ErrorStatistics rounding;    // of coefficients and starts of spans
  ErrorStatistics rom;         // rounding of index and word of the power's table
  ErrorStatistics output;      // rounding to 8 bits

  std::vector<MisplacedPixel> misplaced;  // at which another triangle is the nearest

  // If pictures are requested.
  Picture exact_picture;  // rounded to 8 bits
  Picture error_picture;  // an error_map() of the largest errors of the channels
};

// Measures all visible pixels of the model's frame.
Accuracy measure_accuracy(const FrameSetup& frame, const ModelFrame& model,
                          const AccuracyOptions& options = {});

}  // namespace phongpipe
