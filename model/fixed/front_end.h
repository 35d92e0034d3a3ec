// The blocks before the datapath, triangle by triangle: coverage, expansion point, coefficients,
// starts of spans.
#pragma once

#include <vector>

#include "model/fixed/span_walker.h"

namespace phongpipe {

struct TriangleWork {
  TriangleSetup setup;
  std::vector<RowSpan> rows;
};

class FrontEnd {
 public:
  FrontEnd(const FrameSetup& frame, const Geometry& geometry)
      : frame_(&frame), geometry_(&geometry), setup_engine_(frame, geometry), span_walker_(frame) {}

  // False where the triangle covers no pixel, and there is nothing to set up.
  bool set_up(std::uint32_t triangle, TriangleWork& work) const {
    const ScreenTriangle& source = geometry_->triangles[triangle];
    cover(source, frame_->width, frame_->height, work.rows);
    if (work.rows.empty()) return false;
    const Pixel origin = expansion_pixel(source, work.rows);
    work.setup = setup_engine_.set_up(triangle, origin.x, origin.y);
    return true;
  }

  const SpanWalker& span_walker() const { return span_walker_; }
  std::uint32_t triangles() const {
    return static_cast<std::uint32_t>(geometry_->triangles.size());
  }

 private:
  const FrameSetup* frame_;
  const Geometry* geometry_;
  SetupEngine setup_engine_;
  SpanWalker span_walker_;
};

}  // namespace phongpipe
