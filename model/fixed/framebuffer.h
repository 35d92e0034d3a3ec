// framebuffer: depth test and write. The nearer pixel wins, the earlier one where depths are equal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

class Framebuffer {
 public:
  static constexpr std::uint32_t kNoPixel = ~std::uint32_t{0};

  explicit Framebuffer(const FrameSetup& frame);

  // The depth of pixel `i` of a span, 0 to 2^depth_bits − 1; saturates.
  static std::uint32_t depth(const FrameSetup& frame, const Span& span, int i) {
    const std::int64_t depth = wrap_add(span.depth, wrap_mul(span.depth_step, i)) >> kDepthFraction;
    const std::int64_t farthest = (std::int64_t{1} << frame.depth_bits) - 1;
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(depth, 0, farthest));
  }

  // One pixel of the stream; true where it was written. `place` is its number in the stream.
  bool write(const ShadedPixel& pixel, std::uint32_t depth, std::uint32_t place);

  int width() const { return width_; }
  int height() const { return height_; }
  const std::vector<std::uint32_t>& colors() const { return colors_; }
  // For each pixel, the place in the stream it was written from, or kNoPixel.
  const std::vector<std::uint32_t>& places() const { return places_; }

 private:
  int width_, height_;
  std::vector<std::uint32_t> colors_;
  std::vector<std::uint32_t> depths_;
  std::vector<std::uint32_t> places_;
};

}  // namespace phongpipe
