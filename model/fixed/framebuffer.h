// framebuffer: depth test, write, and addition of further lights. The nearer pixel wins; at equal
// depths, the earlier one. A further light is added only to pixels of the triangle that won, so
// that two surfaces at the same depth are not both added.
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
  // The owner of a pixel is the triangle that won. `where_needed`: owners are kept only for a frame
  // with depth test and several lights.
  enum class Owners { where_needed, kept };
  explicit Framebuffer(const FrameSetup& frame, Owners owners = Owners::where_needed);

  // The depth of pixel `i` of a span, 0 to 2^depth_bits − 1; saturates.
  static std::uint32_t depth(const FrameSetup& frame, const Span& span, int i) {
    const std::int64_t depth = wrap_add(span.depth, wrap_mul(span.depth_step, i)) >> kDepthFraction;
    const std::int64_t farthest = (std::int64_t{1} << frame.configuration.depth_bits) - 1;
    return static_cast<std::uint32_t>(std::clamp<std::int64_t>(depth, 0, farthest));
  }

  // Whether pixel (x, y) has a cell: some triangle's bounding box reaches to it.
  bool contains(int x, int y) const { return x >= left_ && x < right_ && y >= top_ && y < bottom_; }

  // Writes or adds pixel (x, y), which must have a cell, of a span of `triangle`. False if it is
  // hidden.
  bool write(int x, int y, std::uint32_t depth, std::uint32_t triangle, std::uint32_t color) {
    const std::size_t cell_index = cell_of(x, y);
    Cell& cell = cells_[cell_index];
    const std::uint32_t nearness = ~depth;
    if (nearness <= cell.nearness) return false;
    cell = {nearness, color};
    if (owners_) owners_[cell_index] = triangle + 1;
    return true;
  }
  bool add(int x, int y, std::uint32_t triangle, std::uint32_t color) {
    const std::size_t cell_index = cell_of(x, y);
    if (owners_ && owners_[cell_index] != triangle + 1) return false;
    cells_[cell_index].color = add_saturated(cells_[cell_index].color, color);
    return true;
  }

  // Prefetches the pixels of a row into the cache.
  void prefetch(const RowSpan& row) const {
    const Cell* const first = &cells_[cell_of(row.x, row.y)];
    __builtin_prefetch(first);
    __builtin_prefetch(first + row.length - 1);
  }

  // write() in the first pass, else add().
  bool take(bool first_pass, int x, int y, std::uint32_t depth, std::uint32_t triangle,
            std::uint32_t color) {
    return first_pass ? write(x, y, depth, triangle, color) : add(x, y, triangle, color);
  }

  // take() for all pixels of a span inside the image; `taken` receives the results.
  void take_span(const FrameSetup& frame, const Span& span, const std::uint32_t* colors,
                 std::uint8_t* taken) {
    for (int i = 0; i < span.row.length; ++i) {
      taken[i] = take(span.first_pass, span.row.x + i, span.row.y, depth(frame, span, i),
                      span.triangle, colors[i]);
    }
  }

  // Indices of pixels count row by row from the top.
  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  // Number of pixels of the image.
  std::size_t size() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }
  // visit(index, color) for each covered pixel, in the order of indices.
  template <typename Visit>
  void for_each_covered(Visit visit) const {
    for (int y = top_; y < bottom_; ++y) {
      const Cell* cell = &cells_[cell_of(left_, y)];
      std::size_t index = index_of(left_, y);
      for (int x = left_; x < right_; ++x, ++cell, ++index) {
        if (cell->nearness != 0) visit(index, cell->color);
      }
    }
  }
  bool covered(std::size_t index) const {
    const Cell* const cell = find(index);
    return cell != nullptr && cell->nearness != 0;
  }
  // Whether the triangle is the owner of the pixel. Owners must be kept.
  bool owned(int x, int y, std::uint32_t triangle) const {
    return contains(x, y) && owners_[cell_of(x, y)] == triangle + 1;
  }
  bool owned(std::size_t index, std::uint32_t triangle) const {
    return owned(x_of(index), y_of(index), triangle);
  }
  // The owner of a covered pixel. Owners must be kept.
  std::uint32_t owner(int x, int y) const { return owners_[cell_of(x, y)] - 1; }
  std::uint32_t owner(std::size_t index) const { return owner(x_of(index), y_of(index)); }
  // Channel 0 in the low byte; the background if the pixel is not covered.
  std::uint32_t color(std::size_t index) const {
    const Cell* const cell = find(index);
    return cell != nullptr && cell->nearness != 0 ? cell->color : background_;
  }
  std::uint32_t background() const { return background_; }

 private:
  // All zero where nothing was written. Depths have at most 30 bits, so ~depth is never 0. Only the
  // bounding box of all triangles has cells: zeroing memory costs as much as shading does.
  struct Cell {
    std::uint32_t nearness;
    std::uint32_t color;
  };
  struct Free {
    std::size_t bytes;
    void operator()(void* memory) const;
  };
  template <typename T>
  using Zeroed = std::unique_ptr<T[], Free>;

  void bound(const Geometry& geometry);
  static std::uint32_t add_saturated(std::uint32_t a, std::uint32_t b) {
    std::uint32_t sum = 0;
    for (int shift = 0; shift < 3 * kOutputBits; shift += kOutputBits) {
      constexpr auto kMax = static_cast<std::uint32_t>(kOutputMax);
      sum |= std::min(((a >> shift) & kMax) + ((b >> shift) & kMax), kMax) << shift;
    }
    return sum;
  }

  int x_of(std::size_t index) const {
    return static_cast<int>(index % static_cast<std::size_t>(width_));
  }
  int y_of(std::size_t index) const {
    return static_cast<int>(index / static_cast<std::size_t>(width_));
  }
  std::size_t cell_of(int x, int y) const {
    return static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(right_ - left_) +
           static_cast<std::size_t>(x - left_);
  }
  const Cell* find(std::size_t index) const {
    const int x = x_of(index), y = y_of(index);
    return contains(x, y) ? &cells_[cell_of(x, y)] : nullptr;
  }

  int width_, height_;
  int left_ = 0, top_ = 0, right_ = 0, bottom_ = 0;  // of the cells, in pixels; ends not included
  std::uint32_t background_;
  Zeroed<Cell> cells_;
  Zeroed<std::uint32_t> owners_;  // triangle + 1; null where not kept
};

}  // namespace phongpipe
