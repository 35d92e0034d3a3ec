#include "model/fixed/framebuffer.h"

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

Framebuffer::Framebuffer(const FrameSetup& frame)
    : width_(frame.width),
      height_(frame.height),
      colors_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
              background_color(frame)),
      depths_(colors_.size(), ~std::uint32_t{0}),
      places_(colors_.size(), kNoPixel) {}

bool Framebuffer::write(const ShadedPixel& pixel, std::uint32_t depth, std::uint32_t place) {
  const std::size_t index =
      static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(width_) + pixel.x;
  if (depth >= depths_[index]) return false;
  depths_[index] = depth;
  colors_[index] = pixel.color;
  places_[index] = place;
  return true;
}

}  // namespace phongpipe
