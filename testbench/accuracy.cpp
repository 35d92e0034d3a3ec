#include "testbench/accuracy.h"

#include <cmath>
#include <limits>

#include "testbench/error_chain.h"

namespace phongpipe {

void ErrorStatistics::add(double error) {
  const double size = std::fabs(error);
  largest = std::max(largest, size);
  sum_of_squares += error * error;
  ++samples;
  over_half += size > 0.5;
  over_one += size > 1;
  over_two += size > 2;
}

double ErrorStatistics::rms() const {
  return samples == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(samples));
}

double ErrorStatistics::psnr_db() const { return 20 * std::log10(kOutputMax / rms()); }

double ErrorStatistics::share(std::uint64_t count) const {
  return samples == 0 ? 0 : static_cast<double>(count) / static_cast<double>(samples);
}

Accuracy measure_accuracy(const Scene& scene, const Geometry& geometry, const FrameSetup& frame,
                          const ModelFrame& model) {
  Accuracy accuracy;
  const std::size_t pixels = model.framebuffer.colors().size();
  accuracy.exact.assign(pixels, scene.image.background * kOutputMax);
  accuracy.error.assign(pixels, std::numeric_limits<float>::quiet_NaN());
  for_each_visible_pixel(scene, geometry, frame, model, [&](const ErrorChain& links) {
    double largest = 0;
    for (int c = 0; c < frame.configuration.channels; ++c) {
      accuracy.series.add(links.polynomial[c] - links.exact[c]);
      accuracy.rounding.add(links.rounded[c] - links.polynomial[c]);
      accuracy.rom.add(links.table[c] - links.rounded[c]);
      accuracy.output.add(links.output[c] - links.table[c]);
      accuracy.total.add(links.output[c] - links.exact[c]);
      largest = std::max(largest, std::fabs(links.output[c] - links.exact[c]));
    }
    accuracy.exact[links.index] = links.exact;
    accuracy.error[links.index] = static_cast<float>(largest);
  });
  return accuracy;
}

}  // namespace phongpipe
