// Intermediate results that depend on the scene and its geometry alone, kept for other frames of
// the same geometry, whose hardware differs.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
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

  // `room_bytes`: for rows and exact colours.
  GeometryMemo(std::size_t triangles, std::size_t passes,
               std::int64_t room_bytes = std::int64_t{64} << 20)
      : triangles_(triangles), room_bytes_(room_bytes) {
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

  // Sets `rows` to what a triangle covers, by compute(rows) if that is not known.
  template <typename Compute>
  void cover(std::uint32_t triangle, std::vector<RowSpan>& rows, const Compute& compute) {
    Coverage* const known = coverage_.empty() ? nullptr : &coverage_[triangle];
    if (known != nullptr && known->rows) {
      rows = *known->rows;
      return;
    }
    compute(rows);
    if (known != nullptr && take_room(rows.size() * sizeof(RowSpan))) known->rows = rows;
  }

  // The exact colours of the `pixels` that a triangle covers, by compute(colors) if they are not
  // known. Null if there is none, or no room for them.
  template <typename Compute>
  const Color* exact_colors(std::uint32_t triangle, std::size_t pixels, const Compute& compute) {
    if (coverage_.empty() || pixels == 0) return nullptr;
    std::vector<Color>& known = coverage_[triangle].exact;
    if (known.empty()) {
      if (!take_room(pixels * sizeof(Color))) return nullptr;
      std::vector<Color> fresh(pixels);
      compute(fresh.data());
      known = std::move(fresh);
    }
    return known.data();
  }

  // Whether two triangles cover the same pixel.
  template <typename Compute>
  bool overlap(const Compute& compute) {
    if (!overlap_) overlap_ = compute();
    return *overlap_;
  }

 private:
  struct Coverage {
    std::optional<std::vector<RowSpan>> rows;
    std::vector<Color> exact;  // of all pixels, row by row; under all lights
  };

  bool take_room(std::size_t bytes) {
    const auto wanted = static_cast<std::int64_t>(bytes);
    if (room_bytes_.fetch_sub(wanted) >= wanted) return true;
    room_bytes_ += wanted;
    return false;
  }

  std::size_t triangles_;
  std::vector<Triangle> series_;  // pass by pass
  std::vector<Coverage> coverage_;
  std::atomic<std::int64_t> room_bytes_;
  std::optional<bool> overlap_;
};

}  // namespace phongpipe
