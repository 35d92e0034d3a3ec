#include "testbench/accuracy/accuracy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "testbench/accuracy/error_chain.h"
#include "testbench/system/parallel.h"

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

void ErrorStatistics::add(const ErrorStatistics& others) {
  largest_lsb = std::max(largest_lsb, others.largest_lsb);
  sum_of_squares += others.sum_of_squares;
  samples += others.samples;
  over_half += others.over_half;
  over_one += others.over_one;
  over_two += others.over_two;
}

namespace {

// Larger errors first; of equal ones, the lower index.
bool is_worse(const PixelError& a, const PixelError& b) {
  return a.error_lsb != b.error_lsb ? a.error_lsb > b.error_lsb : a.index < b.index;
}

// Adds a pixel to the worst ones, which are in order, if it belongs there.
void keep_worst(std::vector<PixelError>& worst, const PixelError& pixel) {
  if (worst.size() == kWorstPixels) {
    if (!is_worse(pixel, worst.back())) return;
    worst.pop_back();
  }
  worst.insert(std::upper_bound(worst.begin(), worst.end(), pixel, is_worse), pixel);
}

// Statistics of some triangles; their pixels of the pictures, which no other triangle shows, are
// drawn into `whole`.
Accuracy measure_triangles(const FrameSetup& frame, const ModelFrame& model,
                           const AccuracyOptions& options, std::uint32_t first, std::uint32_t end,
                           Accuracy& whole) {
  Accuracy accuracy;
  const int channels = frame.configuration.channels;
  for_each_visible_pixel(frame, model, whole.misplaced, first, end, [&](const ErrorChain& links) {
    ++accuracy.visible_pixels;
    double largest = 0;
    for (int c = 0; c < channels; ++c) {
      accuracy.visibility.add(links.shown[c] - links.exact[c]);
      accuracy.series.add(links.polynomial[c] - links.shown[c]);
      accuracy.rounding.add(links.rounded[c] - links.polynomial[c]);
      accuracy.rom.add(links.table[c] - links.rounded[c]);
      accuracy.output.add(links.output[c] - links.table[c]);
      accuracy.total.add(links.output[c] - links.exact[c]);
      largest = std::max(largest, std::fabs(links.output[c] - links.exact[c]));
    }
    keep_worst(accuracy.worst_pixels, {links.index, largest});
    accuracy.pixels_over_limit += largest > options.limit_lsb;
    if (!options.pictures) return;
    std::uint8_t* const exact = whole.exact_picture.pixel(links.index);
    for (int c = 0; c < channels; ++c) {
      // Not below 0; std::lround costs much of the whole loop.
      exact[c] =
          static_cast<std::uint8_t>(links.exact[c] + 0.5);  // NOLINT(bugprone-incorrect-roundings)
    }
    *whole.error_picture.pixel(links.index) = error_level(largest);
  });
  return accuracy;
}

}  // namespace

Accuracy measure_accuracy(const FrameSetup& frame, const ModelFrame& model,
                          const AccuracyOptions& options) {
  Accuracy whole;
  whole.misplaced = misplaced_pixels(frame, model, options.one_core);
  if (options.pictures) {
    whole.exact_picture =
        Picture(frame.width, frame.height, frame.configuration.channels, frame.background.data());
    whole.error_picture = error_map(frame.width, frame.height);
  }
  // Always the same parts, added in the same order, so that sums do not depend on the machine.
  constexpr std::uint32_t kParts = 16;
  const std::size_t triangles = frame.geometry->triangles.size();
  std::array<Accuracy, kParts> parts;
  run_parts(kParts, options.one_core, [&](std::uint32_t part) {
    parts[part] = measure_triangles(frame, model, options, first_of_part(triangles, part, kParts),
                                    first_of_part(triangles, part + 1, kParts), whole);
  });
  for (const Accuracy& part : parts) {
    whole.visible_pixels += part.visible_pixels;
    whole.pixels_over_limit += part.pixels_over_limit;
    for (const PixelError& pixel : part.worst_pixels) keep_worst(whole.worst_pixels, pixel);
    whole.total.add(part.total);
    whole.visibility.add(part.visibility);
    whole.series.add(part.series);
    whole.rounding.add(part.rounding);
    whole.rom.add(part.rom);
    whole.output.add(part.output);
  }
  return whole;
}

}  // namespace phongpipe
