// Intermediate results that depend on the geometry and its lights alone, kept for other frames of
// the same geometry, whose formats differ.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "model/fixed/span.h"
#include "model/scene/scene.h"
#include "model/shading/triangle_setup.h"

namespace phongpipe {

class GeometryMemo {
 public:
  // The series of one triangle under one light by one plan, in double.
  class Series {
   public:
    // The result of compute(), which is called if it is not known.
    template <typename Compute>
    const TriangleBounds<double>& bounds(const TriangleInput<double>& vertices,
                                         const SeriesPlan& plan, const Compute& compute) {
      if (!bounds_ || vertices.x != x_ || vertices.y != y_ || !(plan == bounded_)) {
        bounds_ = compute();
        x_ = vertices.x;
        y_ = vertices.y;
        bounded_ = plan;
        series_.reset();
      }
      return *bounds_;
    }
    // The same for the cosines, not scaled. Call bounds() before, for the same vertices.
    template <typename Compute>
    const CosineSeries<double>& series(const SeriesPlan& plan, const Compute& compute) {
      if (!series_ || !(plan == planned_)) {
        series_ = compute();
        planned_ = plan;
      }
      return *series_;
    }

   private:
    std::array<double, 3> x_{}, y_{};  // vertices, in pixels from the expansion point
    SeriesPlan bounded_, planned_;
    std::optional<TriangleBounds<double>> bounds_;
    std::optional<CosineSeries<double>> series_;
  };

  struct Triangle {
    Series set_up;  // what the pipeline computes, some series being left out
    Series whole;   // the material's whole plan
  };

  // What a triangle covers, whatever the light.
  class Coverage {
   public:
    // The covered rows, by compute() if they are not known.
    template <typename Compute>
    const std::vector<RowSpan>& rows(const Compute& compute) {
      if (!rows_) rows_ = compute();
      return *rows_;
    }

   private:
    friend class GeometryMemo;
    std::optional<std::vector<RowSpan>> rows_;
    std::vector<Color> exact_;  // of the pixels of the rows, one row after the other
  };

  GeometryMemo(std::size_t triangles, std::size_t passes) : triangles_(triangles) {
    constexpr std::size_t kMost = 50'000;  // some 40 MB
    if (triangles * passes > kMost) return;
    series_.resize(triangles * passes);
    coverage_.resize(triangles);
  }

  // Null if there are too many triangles to keep them all. Threads may use different triangles at
  // the same time.
  Triangle* triangle(std::uint32_t triangle, std::uint32_t pass) {
    return series_.empty() ? nullptr : &series_[pass * triangles_ + triangle];
  }

  // The same of its coverage.
  Coverage* coverage(std::uint32_t triangle) {
    return coverage_.empty() ? nullptr : &coverage_[triangle];
  }

  // The exact colours of the `pixels` that a triangle covers; compute(colors) is called if they are
  // not known. Null if there is no room for them.
  template <typename Compute>
  const Color* exact_colors(std::uint32_t triangle, std::int64_t pixels, const Compute& compute) {
    Coverage* const known = coverage(triangle);
    if (known == nullptr) return nullptr;
    if (known->exact_.empty()) {
      if (room_for_pixels_.fetch_sub(pixels) < pixels) {
        room_for_pixels_ += pixels;
        return nullptr;
      }
      known->exact_.resize(static_cast<std::size_t>(pixels));
      compute(known->exact_.data());
    }
    return known->exact_.data();
  }

  // Whether two triangles cover the same pixel.
  template <typename Compute>
  bool overlap(const Compute& compute) {
    if (!overlap_) overlap_ = compute();
    return *overlap_;
  }

 private:
  std::size_t triangles_;
  std::vector<Triangle> series_;  // pass by pass
  std::vector<Coverage> coverage_;
  std::atomic<std::int64_t> room_for_pixels_{std::int64_t{2} << 20};  // some 50 MB of exact colours
  std::optional<bool> overlap_;
};

}  // namespace phongpipe
