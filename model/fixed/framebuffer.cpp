#include "model/fixed/framebuffer.h"

#include <new>

namespace phongpipe {
namespace {

std::uint32_t background_color(const FrameSetup& frame) {
  std::uint32_t color = 0;
  for (int c = 0; c < frame.configuration.channels; ++c) {
    color |= std::uint32_t{frame.background[static_cast<std::size_t>(c)]} << (c * kOutputBits);
  }
  return color;
}

}  // namespace

Framebuffer::Framebuffer(const FrameSetup& frame, Owners owners)
    : width_(frame.width), height_(frame.height), background_(background_color(frame)) {
  cells_.reset(static_cast<Cell*>(std::calloc(size(), sizeof(Cell))));
  if (!cells_) throw std::bad_alloc();
  if (owners == Owners::where_needed && !(frame.depth_test && frame.passes > 1)) return;
  owners_.reset(static_cast<std::uint32_t*>(std::calloc(size(), sizeof(std::uint32_t))));
  if (!owners_) throw std::bad_alloc();
}

}  // namespace phongpipe
