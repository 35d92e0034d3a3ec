// What travels from the span walker to the pixel datapath and the framebuffer.
#pragma once

#include <array>
#include <cstdint>

#include "model/fixed/forward_differencer.h"
#include "model/shading/fields.h"

namespace phongpipe {

// Covered pixels of one row of a triangle.
struct RowSpan {
  int x = 0, y = 0, length = 0;
  bool lit = true;  // false: outside the light's cone
};

struct Span {
  RowSpan row;
  std::uint32_t triangle = 0;  // its place in Geometry::triangles
  std::uint32_t table = 0;     // of the highlight, its place in FrameSetup::tables
  bool first_pass = true;      // of the first light: writes; those of further lights add
  // What the datapath is spared: series that stay as they start, and a highlight of words 0.
  bool step_diffuse = true, step_specular = true;
  bool highlight = true;
  std::array<std::int64_t, 3> level = {};  // ambient light and the rounding half, as MaterialSetup
  SeriesStart specular;
  std::array<SeriesStart, 3> diffuse;      // those of the channels in use
  SeriesStart gate;                        // where it has a series of its own
  SeriesStart cue;                         // where there is depth cueing
  std::int64_t depth = 0, depth_step = 0;  // kDepthFraction bits below one step of depth
};

// Fraction bits of the depth series; a span of 4096 pixels drifts by less than a step.
constexpr int kDepthFraction = 16;

// A pixel as it leaves pixel_datapath: channel 0 in the low byte.
struct ShadedPixel {
  std::uint16_t x = 0, y = 0;
  std::uint32_t color = 0;

  static constexpr auto fields() {
    using P = ShadedPixel;
    return std::make_tuple(field("x", &P::x), field("y", &P::y), field("color", &P::color));
  }
  friend bool operator==(const ShadedPixel& a, const ShadedPixel& b) {
    return a.x == b.x && a.y == b.y && a.color == b.color;
  }
  friend bool operator!=(const ShadedPixel& a, const ShadedPixel& b) { return !(a == b); }
};

}  // namespace phongpipe
