#include "testbench/accuracy/exact_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

#include "testbench/system/parallel.h"

namespace phongpipe {
namespace {

// Depths of the nearest and the farthest vertex.
struct DepthRange {
  double nearest, farthest;

  explicit DepthRange(const ScreenTriangle& triangle) {
    const auto& v = triangle.vertices;
    std::tie(nearest, farthest) = std::minmax({v[0].z, v[1].z, v[2].z});
  }
};

// A pixel that a triangle covers in front of the one that the frame shows there.
struct Candidate {
  MisplacedPixel pixel;
  BoundedDepth depth;
};

class VisibilityCheck {
 public:
  VisibilityCheck(const FrameSetup& frame, const ModelFrame& model)
      : frame_(frame), framebuffer_(model.framebuffer) {
    const auto& triangles = frame.geometry->triangles;
    ranges_.reserve(triangles.size());
    for (const ScreenTriangle& triangle : triangles) ranges_.emplace_back(triangle);
  }

  void find(std::uint32_t triangle, std::vector<Candidate>& candidates) const {
    const ScreenTriangle& shape = frame_.geometry->triangles[triangle];
    const ExactDepth depth(shape);
    std::vector<RowSpan> rows;
    frame_.cover_triangle(triangle, rows);
    for (const RowSpan& row : rows) {
      for (int x = row.x; x < row.x + row.length; ++x) {
        const std::size_t index = framebuffer_.index_of(x, row.y);
        const std::uint32_t shown = framebuffer_.owner(x, row.y);
        if (shown == triangle || ranges_[triangle].nearest > ranges_[shown].farthest) continue;
        const BoundedDepth here = depth.at(x, row.y);
        const BoundedDepth there = ExactDepth(frame_.geometry->triangles[shown]).at(x, row.y);
        const bool wins = triangle < shown ? !there.is_nearer_than(here)  // the earlier one
                                           : here.is_nearer_than(there);
        if (wins) candidates.push_back({{index, triangle}, here});
      }
    }
  }

 private:
  const FrameSetup& frame_;
  const Framebuffer& framebuffer_;
  std::vector<DepthRange> ranges_;
};

}  // namespace

ExactDepth::ExactDepth(const ScreenTriangle& triangle)
    : doubled_area_(static_cast<double>(signed_area(triangle))), rounding_(0) {
  constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();
  const auto& v = triangle.vertices;
  for (std::size_t i = 0; i < weights_.size(); ++i) {
    const ScreenVertex &from = v[(i + 1) % 3], &to = v[(i + 2) % 3];
    Weight& weight = weights_[i];
    weight.a = std::int64_t{from.y} - to.y;
    weight.b = std::int64_t{to.x} - from.x;
    weight.c = -weight.a * from.x - weight.b * from.y;
    weight.z = v[i].z;
    rounding_ = std::max(rounding_, kRounding * std::fabs(weight.z));
  }
}

BoundedDepth ExactDepth::at(int x, int y) const {
  const auto centre = [](int pixel) { return std::int64_t{pixel} * kSubpixels + kSubpixels / 2; };
  double sum = 0;
  for (const Weight& weight : weights_) {
    sum += static_cast<double>(weight.a * centre(x) + weight.b * centre(y) + weight.c) * weight.z;
  }
  return {sum / doubled_area_, rounding_};
}

std::vector<MisplacedPixel> misplaced_pixels(const FrameSetup& frame, const ModelFrame& model,
                                             bool one_core) {
  if (!frame.depth_test) return {};
  const VisibilityCheck check(frame, model);
  constexpr std::uint32_t kParts = 16;
  std::array<std::vector<Candidate>, kParts> found;
  const std::size_t triangles = frame.geometry->triangles.size();
  run_parts(kParts, one_core, [&](std::uint32_t part) {
    const std::uint32_t end = first_of_part(triangles, part + 1, kParts);
    for (std::uint32_t t = first_of_part(triangles, part, kParts); t < end; ++t) {
      check.find(t, found[part]);
    }
  });
  std::vector<Candidate> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.pixel.index, a.depth.z) < std::tuple(b.pixel.index, b.depth.z);
  });
  std::vector<MisplacedPixel> result;
  for (std::size_t i = 0; i < all.size();) {
    const Candidate& nearest = all[i];
    result.push_back(nearest.pixel);
    // Of those as near, the earliest triangle.
    for (; i < all.size() && all[i].pixel.index == nearest.pixel.index; ++i) {
      if (nearest.depth.is_nearer_than(all[i].depth)) continue;
      result.back().triangle = std::min(result.back().triangle, all[i].pixel.triangle);
    }
  }
  return result;
}

}  // namespace phongpipe
