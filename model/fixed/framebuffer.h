// framebuffer: depth test and write. The nearer pixel wins, the earlier one where depths are equal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
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

  // One pixel, number `place` of the stream; true where it was written.
  bool write(const ShadedPixel& pixel, std::uint32_t depth, std::uint32_t place) {
    Cell& cell = cells_[index(pixel)];
    const std::uint32_t nearness = ~depth;
    if (nearness <= cell.nearness) return false;
    cell = {nearness, pixel.color, place};
    return true;
  }

  int width() const { return width_; }
  int height() const { return height_; }
  // Of the image's pixels, row by row from the top: the colour, channel 0 in the low byte, and the
  // place in the stream it was written from, or kNoPixel.
  std::size_t size() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  std::uint32_t color(std::size_t index) const {
    return cells_[index].nearness == 0 ? background_ : cells_[index].color;
  }
  std::uint32_t place(std::size_t index) const {
    return cells_[index].nearness == 0 ? kNoPixel : cells_[index].place;
  }
  std::vector<std::uint32_t> colors() const;

 private:
  // All zero where nothing was written: calloc gives that without touching memory, most of which a
  // frame leaves alone. Depths are of 30 bits at most, so that ~depth is never 0.
  struct Cell {
    std::uint32_t nearness;
    std::uint32_t color;
    std::uint32_t place;
  };
  struct Free {
    void operator()(Cell* cells) const { std::free(cells); }
  };

  std::size_t index(const ShadedPixel& pixel) const {
    return static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width_) + pixel.x;
  }

  int width_, height_;
  std::uint32_t background_;
  std::unique_ptr<Cell[], Free> cells_;
};

}  // namespace phongpipe
