#include "testbench/accuracy/accuracy.h"

#include <algorithm>
#include <cmath>

#include "testbench/accuracy/error_chain.h"

namespace phongpipe {

double ErrorStatistics::rms_lsb() const {
  return samples == 0 ? 0 : std::sqrt(sum_of_squares / static_cast<double>(samples));
}

double ErrorStatistics::psnr_db() const {
  return 20 * std::log10(kOutputMax / rms_lsb());
}

double ErrorStatistics::share(std::uint64_t count) const {
  return samples == 0 ? 0 : static_cast<double>(count) / static_cast<double>(samples);
}

Accuracy measure_accuracy(const FrameSetup& frame, const ModelFrame& model, bool pictures) {
  Accuracy accuracy;
  const int channels = frame.configuration.channels;
  if (pictures) {
    accuracy.exact_picture = Picture(frame.width, frame.height, channels, frame.background.data());
    accuracy.error_picture = Picture(frame.width, frame.height, 3, kUncoveredColor.data());
  }
  for_each_visible_pixel(frame, model, [&](const ErrorChain& links) {
    ++accuracy.visible_pixels;
    double largest = 0;
    for (int c = 0; c < channels; ++c) {
      accuracy.series.add(links.polynomial[c] - links.exact[c]);
      accuracy.rounding.add(links.rounded[c] - links.polynomial[c]);
      accuracy.rom.add(links.table[c] - links.rounded[c]);
      accuracy.output.add(links.output[c] - links.table[c]);
      accuracy.total.add(links.output[c] - links.exact[c]);
      largest = std::max(largest, std::fabs(links.output[c] - links.exact[c]));
    }
    if (!pictures) return;
    std::uint8_t* const exact = accuracy.exact_picture.pixel(links.index);
    for (int c = 0; c < channels; ++c) {
      exact[c] = static_cast<std::uint8_t>(std::lround(links.exact[c]));
    }
    const Rgb color = error_color(largest);
    std::copy(color.begin(), color.end(), accuracy.error_picture.pixel(links.index));
  });
  return accuracy;
}

}  // namespace phongpipe
