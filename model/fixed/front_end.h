// The blocks before the datapath, triangle by triangle: coverage, expansion point, coefficients,
// starts of spans.
#pragma once

#include <algorithm>
#include <vector>

#include "model/fixed/cone.h"
#include "model/fixed/exact_path.h"
#include "model/fixed/shading_path.h"
#include "model/fixed/span_walker.h"

namespace phongpipe {

struct TriangleWork {
  TriangleSetup setup;
  std::vector<RowSpan> rows;
};

enum class SetupOutcome {
  nothing,   // no pixel is covered, or the pass's light does not reach the material: no time spent
  left_out,  // set up according to `work.setup.plan`, but adds nothing to the picture
  ready
};

class FrontEnd {
 public:
  explicit FrontEnd(const FrameSetup& frame)
      : frame_(&frame), setup_engine_(frame), span_walker_(frame) {}

  SetupOutcome set_up(std::uint32_t triangle, std::uint32_t pass, TriangleWork& work) const {
    const ScreenTriangle& source = frame_->geometry->triangles[triangle];
    const auto adds = [](const SeriesPlan& plan) {
      return is_present(plan.diffuse) || is_present(plan.specular);
    };
    if (pass > 0 && !adds(frame_->material(pass, source.material).plan)) {
      return SetupOutcome::nothing;
    }
    frame_->cover_triangle(triangle, work.rows);
    if (frame_->takes_exact_path(triangle)) return set_up_exact(triangle, pass, work);
    split_at_cone(frame_->scene->lights[pass], source, work.rows);
    const auto dark = [](const RowSpan& row) { return !row.lit; };
    if (pass > 0) {
      work.rows.erase(std::remove_if(work.rows.begin(), work.rows.end(), dark), work.rows.end());
    }
    if (work.rows.empty()) return SetupOutcome::nothing;
    const Pixel origin = expansion_pixel(source, work.rows);
    work.setup =
        setup_engine_.set_up(triangle, pass, origin.x, origin.y, longest_row(work.rows),
                             frame_->certificates ? &frame_->fits(triangle, pass) : nullptr);
    return pass > 0 && !adds(work.setup.plan) ? SetupOutcome::left_out : SetupOutcome::ready;
  }

  const SpanWalker& span_walker() const { return span_walker_; }
  std::uint32_t triangles() const {
    return static_cast<std::uint32_t>(frame_->geometry->triangles.size());
  }
  std::uint32_t passes() const { return frame_->passes; }

 private:
  // All lights come with the first; of the others only the certificate is computed.
  SetupOutcome set_up_exact(std::uint32_t triangle, std::uint32_t pass, TriangleWork& work) const {
    if (work.rows.empty()) return SetupOutcome::nothing;
    const ScreenTriangle& source = frame_->geometry->triangles[triangle];
    const Pixel origin = expansion_pixel(source, work.rows);
    work.setup = setup_engine_.set_up_exact(triangle, pass, origin.x, origin.y);
    if (pass > 0) return SetupOutcome::left_out;
    work.setup.exact_values = shade_exactly(*frame_, source, work.rows).values;
    work.rows = one_pixel_rows(work.rows);
    return SetupOutcome::ready;
  }

  const FrameSetup* frame_;
  SetupEngine setup_engine_;
  SpanWalker span_walker_;
};

// Visits all triangles in the order of the scene, pass by pass.
class TriangleOrder {
 public:
  explicit TriangleOrder(const FrontEnd& front_end)
      : triangles_(front_end.triangles()),
        end_(std::uint64_t{front_end.passes()} * front_end.triangles()) {}

  bool done() const { return next_ == end_; }
  void advance() { ++next_; }
  std::uint32_t pass() const { return static_cast<std::uint32_t>(next_ / triangles_); }
  std::uint32_t triangle() const { return static_cast<std::uint32_t>(next_ % triangles_); }

 private:
  std::uint64_t triangles_, end_, next_ = 0;
};

}  // namespace phongpipe
