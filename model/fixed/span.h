// Data passed from the span walker to the pixel datapath and the framebuffer.
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
  // Of a pixel of exact_path: its place in TriangleSetup::exact_values. Such rows have one pixel.
  std::int32_t exact = -1;

  bool is_exact() const { return exact >= 0; }
};

struct Span {
  RowSpan row;
  std::uint32_t triangle = 0;  // index into Geometry::triangles
  std::uint32_t table = 0;     // index into FrameSetup::tables, for the highlight
  bool first_pass = true;      // first light: written; further lights: added
  // False where the datapath can save work: on series that keep their first value, and on a
  // highlight whose words are all 0.
  bool step_diffuse = true, step_specular = true;
  bool highlight = true;
  std::array<std::int64_t, 3> level = {};  // ambient plus the rounding half, as in MaterialSetup
  SeriesStart specular;
  std::array<SeriesStart, 3> diffuse;      // of the channels in use
  SeriesStart gate;                        // if it is a separate series
  SeriesStart cue;                         // with depth cueing
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
