#include "testbench/cosim/stream_checker.h"

namespace phongpipe {
namespace {

constexpr std::uint32_t kGreyToColor = 0x010101;

std::uint32_t in_color(std::uint32_t color, int channels) {
  return channels == 1 ? color * kGreyToColor : color;
}

}  // namespace

Fingerprint StreamHash::fingerprint(const Framebuffer& framebuffer, int channels) const {
  FnvHash frame;
  framebuffer.for_each_covered([&](std::size_t index, std::uint32_t color) {
    frame.add(std::uint64_t{index} << 32 | in_color(color, channels));
  });
  Fingerprint result = fingerprint();
  result.frame_hash = frame.value();
  return result;
}

std::uint64_t count_frame_mismatches(const Framebuffer& model, int model_channels,
                                     const Framebuffer& found, int channels) {
  std::uint64_t mismatches = 0;
  for (std::size_t i = 0; i < model.size(); ++i) {
    mismatches += model.covered(i) != found.covered(i) ||
                  in_color(model.color(i), model_channels) != in_color(found.color(i), channels);
  }
  return mismatches;
}

bool StreamChecker::next(ShadedPixel& pixel) {
  if (next_in_span_ == span_length_) {
    if (!model_.next()) {
      next_in_span_ = span_length_ = 0;
      return false;
    }
    next_in_span_ = 0;
    ++spans_;
    span_length_ = model_.span().row.length;
    triangle_ = model_.span().triangle;
  }
  const RowSpan& row = model_.span().row;
  pixel = {static_cast<std::uint16_t>(row.x + next_in_span_), static_cast<std::uint16_t>(row.y),
           model_.colors()[next_in_span_]};
  ++next_in_span_;
  return true;
}

void StreamChecker::record(Divergence difference) {
  ++mismatches_;
  if (first_) return;
  difference.stream_index = stream_index_;
  difference.span = spans_ == 0 ? 0 : spans_ - 1;
  difference.triangle = triangle_;
  first_ = difference;
}

void StreamChecker::observe(const ShadedPixel& pixel, std::int64_t cycle) {
  if (enough()) return;
  Divergence difference;
  difference.cycle = cycle;
  difference.found = pixel;
  difference.model = {pixel.x, pixel.y, 0};
  difference.extra = !next(difference.model);
  if (difference.extra || difference.model != pixel) record(difference);
  ++stream_index_;
}

void StreamChecker::finish(std::int64_t cycle) {
  Divergence difference;
  difference.cycle = cycle;
  difference.missing = true;
  for (; !enough() && next(difference.model); ++stream_index_) record(difference);
}

}  // namespace phongpipe
