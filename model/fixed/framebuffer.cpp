#include "model/fixed/framebuffer.h"

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
  cells_.reset(zeros<Cell>(size()));
  if (owners == Owners::where_needed && !(frame.depth_test && frame.passes > 1)) return;
  owners_.reset(zeros<std::uint32_t>(size()));
}

}  // namespace phongpipe
