#include "model/fixed/framebuffer.h"

#include <cmath>
#include <cstdint>
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

#if defined(__linux__)
constexpr std::size_t kLargePage = std::size_t{2} << 20;

// What is mapped for so many bytes: whole large pages, if at least half of the first is used.
std::size_t mapped_bytes(std::size_t bytes) {
  return bytes < kLargePage / 2 ? bytes : (bytes + kLargePage - 1) / kLargePage * kLargePage;
}
#endif

// Zeros. Memory fresh from the system is zero without being touched; what the allocator gives a
// second time is not. In large pages where the system has them: the first touch of a page takes
// about as long as 1000 pixels do.
void* zeros(std::size_t bytes) {
#if defined(__linux__)
  const auto map = [](std::size_t size) {
    void* const memory =
        mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::bad_alloc();
    return static_cast<char*>(memory);
  };
  if (bytes < kLargePage / 2) return map(bytes);
  const std::size_t mapped = mapped_bytes(bytes);
  // A large page begins at a multiple of its size.
  char* const memory = map(mapped + kLargePage);
  const std::size_t before = -reinterpret_cast<std::uintptr_t>(memory) % kLargePage;
  char* const aligned = memory + before;
  if (before > 0) munmap(memory, before);
  munmap(aligned + mapped, kLargePage - before);
  madvise(aligned, mapped, MADV_HUGEPAGE);
  return aligned;
#else
  void* const memory = std::calloc(bytes, 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
#endif
}

}  // namespace

Framebuffer::Framebuffer(const FrameSetup& frame, Owners owners)
    : width_(frame.width), height_(frame.height), background_(background_color(frame)) {
  bound(*frame.geometry);
  const auto cells =
      static_cast<std::size_t>(right_ - left_) * static_cast<std::size_t>(bottom_ - top_);
  const auto make = [cells](auto& memory) {
    using T = std::remove_reference_t<decltype(memory[0])>;
    const std::size_t bytes = std::max<std::size_t>(cells, 1) * sizeof(T);
    memory = Zeroed<T>(static_cast<T*>(zeros(bytes)), Free{bytes});
  };
  make(cells_);
  if (owners == Owners::where_needed && !(frame.depth_test && frame.passes > 1)) return;
  make(owners_);
}

void Framebuffer::Free::operator()(void* memory) const {
#if defined(__linux__)
  munmap(memory, mapped_bytes(bytes));
#else
  std::free(memory);
#endif
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
