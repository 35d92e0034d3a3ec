// Pictures whose pixels are known beforehand: the golden sphere's flat disc and highlight, and two
// parallel planes, which only an eye at infinity sees alike.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "model/files/scene_file.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "model/scene/subdivision.h"
#include "model/shading/phong.h"
#include "testbench/cases/recorded_model.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {
namespace {

struct Shaded {
  PreparedFrame frame;
  RecordedModel model;

  explicit Shaded(const Scene& source)
      : frame(source, hardware().formats, hardware().setup), model(record_model(frame.setup)) {}

  static const Hardware& hardware() {
    static const Hardware preset = load_hardware("default", {});
    return preset;
  }
  // Of a covered pixel.
  std::array<int, 3> color(std::size_t index) const {
    const std::uint32_t packed = model.framebuffer.color(index);
    return {static_cast<int>(packed & 0xff), static_cast<int>(packed >> 8 & 0xff),
            static_cast<int>(packed >> 16)};
  }
  // visit(triangle, x, y, index) of each pixel that is seen.
  template <typename Visit>
  void for_each_pixel(Visit visit) const {
    for (std::size_t s = 0; s < model.spans.size(); ++s) {
      const auto& [row, triangle] = model.spans[s];
      for (int x = row.x; x < row.x + row.length; ++x) {
        const auto index = static_cast<std::size_t>(row.y * frame.setup.width + x);
        if (model.framebuffer.owned(index, triangle)) visit(triangle, x, row.y, index);
      }
    }
  }
};

Scene shipped(const std::string& name) {
  return load_scene(std::string(PHONGPIPE_SCENES) + "/" + name + ".toml");
}

TEST(GoldenSphere, IsAFlatDiscWithAHighlight) {
  const Shaded golden(shipped("effects/golden-sphere"));
  const std::array<int, 3> ambient = {51, 40, 10};  // 255 · (0.2, 0.157, 0.04), rounded
  std::size_t disc = 0, highlight = 0;
  std::array<int, 3> brightest = {};
  golden.for_each_pixel([&](std::uint32_t triangle, int x, int y, std::size_t index) {
    Color exact;
    const ScreenTriangle& source = golden.frame.geometry().triangles[triangle];
    PhongTriangle(golden.frame.scene(), golden.frame.geometry().materials[source.material], source)
        .shade(x, y, 1, &exact);
    const std::array<int, 3> color = golden.color(index);
    // Words are rounded to whole LSB. Rounding a cosine near 0.73 to an address changes its power
    // by 20 / 2048 / 0.73 of it at most, the series by less; below 0.45 LSB all words read are 0.
    const bool outside = exact[0] - 51 < 0.45;
    for (std::size_t c = 0; c < 3; ++c) {
      if (outside) {
        ASSERT_EQ(color[c], ambient[c]) << "pixel " << x << ", " << y;
      }
      ASSERT_GE(color[c], ambient[c]) << "pixel " << x << ", " << y;
      brightest[c] = std::max(brightest[c], color[c]);
    }
    ++(outside ? disc : highlight);
  });
  EXPECT_GT(disc, 20'000U);
  EXPECT_GT(highlight, 10'000U);
  // Some pixel looks along the highlight's axis to a degree, where the power is 0.997; rounding to
  // an address at the table's end costs 255·20/2048, 2½ LSB.
  EXPECT_EQ(brightest[0], 255) << "saturated: 51 and 255";
  EXPECT_NEAR(brightest[1], 255 * (0.157 + 0.785), 3.5);
  EXPECT_NEAR(brightest[2], 255 * (0.04 + 0.2), 1.5);
}

// The side that a light at grazing angles leaves dark has no highlight, though N·H is high there.
TEST(GoldenSphere, HasNoHighlightWhereItFacesAwayFromTheLight) {
  Scene scene = shipped("effects/golden-sphere");
  scene.lights.front().direction = Vec3(-0.9, -0.1, 0.45).normalized();  // from behind
  scene.materials.front().shininess = 4;
  const Shaded golden(scene);
  std::size_t dark = 0, lit = 0;
  golden.for_each_pixel([&](std::uint32_t triangle, int x, int y, std::size_t index) {
    const auto& v = golden.frame.geometry().triangles[triangle].vertices;
    const bool away = std::all_of(v.begin(), v.end(), [&](const ScreenVertex& vertex) {
      return vertex.normal.dot(scene.lights.front().direction) > 0.02 * vertex.normal.norm();
    });
    if (!away) {
      lit += golden.color(index)[0] > 51;
      return;
    }
    ++dark;
    ASSERT_EQ(golden.color(index), (std::array<int, 3>{51, 40, 10})) << "pixel " << x << ", " << y;
  });
  EXPECT_GT(dark, 10'000U);
  EXPECT_GT(lit, 1'000U);
}

// For each row, the intensities of the left plane and of the right one, from left to right. The
// planes are as wide and their rows as far from the eye, so that what has the same place in a row
// is at corresponding points, to a pixel.
using Planes = std::map<int, std::array<std::vector<int>, 2>>;
Planes planes_of(const std::string& scene) {
  const Shaded shaded(shipped(scene));
  std::map<std::array<int, 2>, int> sorted;
  shaded.for_each_pixel([&](std::uint32_t, int x, int y, std::size_t index) {
    sorted[{y, x}] = shaded.color(index)[0];
  });
  Planes planes;
  for (const auto& [place, value] : sorted) {
    planes[place[0]][place[1] < shaded.frame.scene().image.width / 2 ? 0 : 1].push_back(value);
  }
  return planes;
}

// visit(left, right) for corresponding pixels.
template <typename Visit>
std::size_t for_each_pair(const Planes& planes, Visit visit) {
  std::size_t pairs = 0;
  for (const auto& [y, row] : planes) {
    const auto &left = row[0], &right = row[1];
    EXPECT_LE(std::max(left.size(), right.size()) - std::min(left.size(), right.size()), 1U);
    for (std::size_t i = 0; i < std::min(left.size(), right.size()); ++i, ++pairs) {
      visit(left[i], right[i]);
    }
  }
  return pairs;
}

// Figure 4 of the paper: equal normals, light and eye at infinity.
TEST(ParallelPlanes, LookAlikeToAnEyeAtInfinity) {
  const Planes planes = planes_of("two-planes");
  const int everywhere = planes.begin()->second[0].front();
  const std::size_t pairs = for_each_pair(planes, [&](int left, int right) {
    ASSERT_EQ(left, right);
    ASSERT_EQ(left, everywhere);
  });
  EXPECT_GT(pairs, 40'000U);
}

// The light comes from the left, so that the highlight lies beyond the left plane.
TEST(ParallelPlanes, LookDifferentToALocalViewer) {
  int least = kOutputMax;
  const std::size_t pairs =
      for_each_pair(planes_of("effects/local-viewer"),
                    [&](int left, int right) { least = std::min(least, left - right); });
  EXPECT_GT(pairs, 40'000U);
  EXPECT_GE(least, 25) << "no two corresponding pixels are equal";
}

}  // namespace
}  // namespace phongpipe
