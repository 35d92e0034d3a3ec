#include "model/fixed/framebuffer.h"

#include <cmath>
#include <limits>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace phongpipe {
namespace {

std::uint32_t background_color(const FrameSetup& frame) {
  std::uint32_t color = 0;
  for (int c = 0; c < frame.configuration.channels; ++c) {
    color |= std::uint32_t{frame.background[static_cast<std::size_t>(c)]} << (c * kOutputBits);
  }
  return color;
}

// Zeros, in large pages where the system has them: the first touch of a page takes about as long as
// 1000 pixels do.
template <typename T>
T* zeros(std::size_t count) {
  void* memory = std::calloc(count, sizeof(T));
  if (memory == nullptr) throw std::bad_alloc();
#if defined(__linux__)
  constexpr std::uintptr_t kPage = 4096;
  const auto first = reinterpret_cast<std::uintptr_t>(memory);
  const std::uintptr_t begin = (first + kPage - 1) & ~(kPage - 1);
  const std::uintptr_t end = (first + count * sizeof(T)) & ~(kPage - 1);
  if (begin < end) {
    madvise(static_cast<char*>(memory) + (begin - first), end - begin, MADV_HUGEPAGE);
  }
#endif
  return static_cast<T*>(memory);
}

}  // namespace

Framebuffer::Framebuffer(const FrameSetup& frame, Owners owners)
    : width_(frame.width), height_(frame.height), background_(background_color(frame)) {
  bound(*frame.geometry);
  const auto cells =
      static_cast<std::size_t>(right_ - left_) * static_cast<std::size_t>(bottom_ - top_);
  cells_.reset(zeros<Cell>(cells));
  if (owners == Owners::where_needed && !(frame.depth_test && frame.passes > 1)) return;
  owners_.reset(zeros<std::uint32_t>(cells));
}

void Framebuffer::bound(const Geometry& geometry) {
  if (geometry.triangles.empty()) return;
  std::int32_t left = std::numeric_limits<std::int32_t>::max(), top = left;
  std::int32_t right = std::numeric_limits<std::int32_t>::min(), bottom = right;
  for (const ScreenTriangle& triangle : geometry.triangles) {
    for (const ScreenVertex& vertex : triangle.vertices) {
      left = std::min(left, vertex.x);
      right = std::max(right, vertex.x);
      top = std::min(top, vertex.y);
      bottom = std::max(bottom, vertex.y);
    }
  }
  const auto pixel = [](std::int32_t subpixels) {
    return static_cast<int>(std::floor(in_pixels(subpixels)));
  };
  left_ = std::clamp(pixel(left), 0, width_);
  right_ = std::clamp(pixel(right) + 1, left_, width_);
  top_ = std::clamp(pixel(top), 0, height_);
  bottom_ = std::clamp(pixel(bottom) + 1, top_, height_);
}

}  // namespace phongpipe
