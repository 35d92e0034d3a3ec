// framebuffer: depth test and write. The nearer pixel wins, the earlier one where depths are equal.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "model/fixed/frame_setup.h"
#include "model/fixed/span.h"

namespace phongpipe {

class Framebuffer {
 public:
  explicit Framebuffer(const FrameSetup& frame);

  // The depth of pixel `i` of a span, 0 to 2^depth_bits − 1; saturates.
  static std::uint32_t depth(const FrameSetup& frame, const Span& span, int i) {
    const std::int64_t depth = wrap_add(span.depth, wrap_mul(span.depth_step, i)) >> kDepthFraction;
    const std::int64_t farthest = (std::int64_t{1} << frame.depth_bits) - 1;
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(depth, 0, farthest));
  }

  // Pixel (x, y), inside the image. `value` is what is kept of it: its colour, or its place in a
  // stream. True where it was written.
  bool write(int x, int y, std::uint32_t depth, std::uint32_t value) {
    Cell& cell = cells_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                        static_cast<std::size_t>(x)];
    const std::uint32_t nearness = ~depth;
    if (nearness <= cell.nearness) return false;
    cell = {nearness, value};
    return true;
  }

  // All pixels of a span inside the image; `written` tells of each what write() would.
  void write_span(const FrameSetup& frame, const Span& span, const std::uint32_t* values,
                  std::uint8_t* written) {
    for (int i = 0; i < span.row.length; ++i) {
      written[i] = write(span.row.x + i, span.row.y, depth(frame, span, i), values[i]);
    }
  }

  // Of the image's pixels, row by row from the top.
  std::size_t size() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  bool covered(std::size_t index) const { return cells_[index].nearness != 0; }
  std::uint32_t value(std::size_t index) const { return cells_[index].value; }
  // The value as a colour, or the background's, channel 0 in the low byte.
  std::uint32_t color(std::size_t index) const {
    return covered(index) ? value(index) : background_;
  }
  std::uint32_t background() const { return background_; }

 private:
  // All zero where nothing was written: calloc gives that without touching memory, most of which a
  // frame leaves alone. Depths are of 30 bits at most, so that ~depth is never 0.
  struct Cell {
    std::uint32_t nearness;
    std::uint32_t value;
  };
  struct Free {
    void operator()(Cell* cells) const { std::free(cells); }
  };

  int width_, height_;
  std::uint32_t background_;
  std::unique_ptr<Cell[], Free> cells_;
};

}  // namespace phongpipe
