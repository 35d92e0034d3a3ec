// Placement of labels beside the points of a chart.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace phongpipe {

constexpr double kCharacter = 6.1, kTextHeight = 12;  // average width, and height, of 11-pixel text

inline double text_width(const std::string& text) {
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) == 0x80; };
  const auto characters = text.size() - static_cast<std::size_t>(std::count_if(
                                            text.begin(), text.end(), continues));  // of UTF-8
  return kCharacter * static_cast<double>(characters);
}

struct Box {
  double left, top, right, bottom;
  bool meets(const Box& b) const {
    return left < b.right && b.left < right && top < b.bottom && b.top < bottom;
  }
  bool within(const Box& b) const {
    return left >= b.left && right <= b.right && top >= b.top && bottom <= b.bottom;
  }
};

// Finds places for labels beside points, clear of all points and lines and of earlier labels.
class Labels {
 public:
  explicit Labels(const Box& frame) : frame_(frame) {}

  void avoid(double x, double y) { taken_.push_back({x - 4, y - 4, x + 4, y + 4}); }

  // The line from one point to another, in steps that no label fits between.
  void avoid_line(double x0, double y0, double x1, double y1) {
    const int steps = 1 + static_cast<int>(std::hypot(x1 - x0, y1 - y0) / (kTextHeight / 2));
    for (int i = 0; i <= steps; ++i) {
      const double x = x0 + (x1 - x0) * i / steps, y = y0 + (y1 - y0) * i / steps;
      taken_.push_back({x - 1, y - 1, x + 1, y + 1});
    }
  }

  // The nearest free place. If none is free, beside the point, over whatever is there.
  Box place(double x, double y, double width) {
    constexpr std::array<std::array<int, 2>, 8> kDirections = {
        {{1, 0}, {1, -1}, {1, 1}, {-1, 0}, {-1, -1}, {-1, 1}, {0, -1}, {0, 1}}};
    constexpr double kRings = 16, kNear = 7, kStep = 7;
    for (int ring = 0; ring < kRings; ++ring) {
      for (const auto& direction : kDirections) {
        const double distance = kNear + kStep * ring;
        const double left =
            x + direction[0] * distance + (static_cast<double>(direction[0]) - 1) / 2 * width;
        const double top = y + direction[1] * distance - kTextHeight / 2;
        const Box box = {left, top, left + width, top + kTextHeight};
        const auto meets = [&box](const Box& other) { return box.meets(other); };
        if (!box.within(frame_) || std::any_of(taken_.begin(), taken_.end(), meets)) continue;
        taken_.push_back(box);
        return box;
      }
    }
    const double left = std::min(x + kNear, frame_.right - width);
    return {left, y - kTextHeight / 2, left + width, y + kTextHeight / 2};
  }

 private:
  Box frame_;
  std::vector<Box> taken_;
};

}  // namespace phongpipe
