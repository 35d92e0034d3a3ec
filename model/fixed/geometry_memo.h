// Intermediate results of setup that depend on the geometry and its lights alone, kept for other
// frames of the same geometry, whose formats differ.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

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

  GeometryMemo(std::size_t triangles, std::size_t passes) : triangles_(triangles) {
    constexpr std::size_t kMost = 50'000;  // some 40 MB
    if (triangles * passes <= kMost) series_.resize(triangles * passes);
  }

  // Null if there are too many triangles to keep them all. Threads may use different triangles at
  // the same time.
  Triangle* triangle(std::uint32_t triangle, std::uint32_t pass) {
    return series_.empty() ? nullptr : &series_[pass * triangles_ + triangle];
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
  std::optional<bool> overlap_;
};

}  // namespace phongpipe
