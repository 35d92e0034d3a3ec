// Error statistics, the split of errors, and how accurate the shipped scenes are.
#include "testbench/accuracy/accuracy.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "model/files/scene_file.h"
#include "model/fixed/coverage.h"
#include "model/fixed/prepared_frame.h"
#include "model/shading/screen_interpolator.h"
#include "testbench/accuracy/error_chain.h"
#include "testbench/hardware/hardware.h"

namespace phongpipe {
namespace {

struct Measured {
  Hardware hardware;
  PreparedFrame frame;
  ModelFrame model;

  explicit Measured(const std::string& name, const std::vector<std::string>& overrides = {})
      : Measured(load_scene(std::string(PHONGPIPE_SCENES) + "/" + name + ".toml"), overrides) {}
  explicit Measured(const Scene& source, const std::vector<std::string>& overrides = {})
      : hardware(load_hardware("paper-1k", overrides)),
        frame(source, hardware.formats, hardware.setup),
        model(run_model(frame.setup)) {}

  Accuracy accuracy() const { return measure_accuracy(frame.setup, model); }
};

TEST(ErrorStatistics, ByHand) {
  ErrorStatistics s;
  for (const double error : {0.0, -0.6, 1.5, -3.0}) s.add(error);
  EXPECT_EQ(s.largest_lsb, 3.0);
  EXPECT_NEAR(s.rms_lsb(), std::sqrt((0.36 + 2.25 + 9) / 4), 1e-15);
  EXPECT_NEAR(s.psnr_db(), 20 * std::log10(255 / s.rms_lsb()), 1e-12);
  EXPECT_EQ(s.over_half, 3U);
  EXPECT_EQ(s.over_one, 2U);
  EXPECT_EQ(s.over_two, 1U);
  EXPECT_EQ(s.share(s.over_two), 0.25);
}

TEST(ErrorChain, PartsAddUpToTheWholeAtEveryPixel) {
  const Measured m("torus");
  std::size_t visited = 0;
  for_each_visible_pixel(m.frame.setup, m.model, [&](const ErrorChain& c) {
    ++visited;
    const Color parts = (c.shown - c.exact) + (c.polynomial - c.shown) +
                        (c.rounded - c.polynomial) + (c.table - c.rounded) + (c.output - c.table);
    ASSERT_LT((parts - (c.output - c.exact)).abs().maxCoeff(), 1e-10);
  });
  std::size_t covered = 0;
  for (std::size_t i = 0; i < m.model.framebuffer.size(); ++i) {
    covered += m.model.framebuffer.covered(i);
  }
  EXPECT_EQ(visited, covered);
}

// The torus under two lights, or fading from its front to its back, or both.
Scene torus(bool two_lights, bool depth_cue) {
  Scene scene = load_scene(PHONGPIPE_SCENES "/torus.toml");
  if (two_lights) {
    scene.lights.emplace_back();
    scene.lights.back().direction = Vec3(0.8, -0.2, -0.6).normalized();
    scene.lights.back().color = Color(0.2, 0.3, 0.4);
  }
  if (depth_cue) scene.depth_cue = DepthCue{2, 4, Color(0.1, 0.2, 0.3)};
  return scene;
}

// Each pass rounds by half an LSB; with depth cueing twice so, and the share of its own colour is
// cut off by less than 1/1024, of sums that are below 512 LSB here.
TEST(ErrorChain, OutputIsTheTableValueRoundedInEveryPass) {
  for (const bool two_lights : {false, true}) {
    for (const bool depth_cue : {false, true}) {
      const Measured m(torus(two_lights, depth_cue));
      const double a_pass = depth_cue ? 0.5 + 0.5 + 512.0 / 1024 : 0.5;
      const double bound = (two_lights ? 2 : 1) * a_pass + 1e-9;
      for_each_visible_pixel(m.frame.setup, m.model, [&](const ErrorChain& c) {
        ASSERT_LE((c.output - c.table).abs().maxCoeff(), bound) << two_lights << depth_cue;
      });
    }
  }
}

// What measures the series knows all lights and the cue: it would be off by tens if it did not.
TEST(Accuracy, SeveralLightsAndDepthCueingStayCloseToExactPhong) {
  for (const bool two_lights : {false, true}) {
    for (const bool depth_cue : {false, true}) {
      const Accuracy accuracy = Measured(torus(two_lights, depth_cue)).accuracy();
      EXPECT_LT(accuracy.series.largest_lsb, 1) << two_lights << depth_cue;
      EXPECT_LT(accuracy.total.largest_lsb, 3) << two_lights << depth_cue;
      EXPECT_LT(accuracy.total.rms_lsb(), 0.8) << two_lights << depth_cue;
    }
  }
}

// Bounds in LSB, a little above what was measured: a wrong halfway vector, level or scale is off by
// tens.
TEST(Accuracy, ShippedScenesStayCloseToExactPhong) {
  struct Expectation {
    const char* scene;
    double largest, rms;
  };
  for (const Expectation& e : {Expectation{"sphere", 1.7, 0.45},
                               {"torus", 2.3, 0.42},
                               {"two-planes", 0.9, 0.9},
                               {"pawn", 3.5, 0.45},
                               {"mesh", 2.2, 0.45},
                               {"screen-triangles", 10.5, 1.3}}) {
    const Accuracy accuracy = Measured(e.scene).accuracy();
    EXPECT_LT(accuracy.total.largest_lsb, e.largest) << e.scene;
    EXPECT_LT(accuracy.total.rms_lsb(), e.rms) << e.scene;
  }
}

// The triangle nearest at a pixel by a depth test in double precision, in the order of the scene.
std::vector<std::uint32_t> nearest_triangles(const PreparedFrame& frame) {
  const int width = frame.setup.width, height = frame.setup.height;
  std::vector<std::uint32_t> nearest(static_cast<std::size_t>(width * height));
  std::vector<double> depths(nearest.size(), std::numeric_limits<double>::infinity());
  const auto& triangles = frame.geometry().triangles;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const auto& v = triangles[t].vertices;
    const Linear<double> depth = screen_interpolator(triangles[t])(v[0].z, v[1].z, v[2].z);
    std::vector<RowSpan> rows;
    cover(triangles[t], width, height, rows);
    for (const RowSpan& row : rows) {
      for (int x = row.x; x < row.x + row.length; ++x) {
        const auto index = static_cast<std::size_t>(row.y * width + x);
        const double z = depth.a * (x + 0.5) + depth.b * (row.y + 0.5) + depth.c;
        if (z >= depths[index] - 1e-12) continue;
        depths[index] = z;
        nearest[index] = t;
      }
    }
  }
  return nearest;
}

// Depths of 8 bits cannot tell the teapot's lid from its handle, and 24 bits can.
TEST(ExactVisibility, FindsEveryPixelThatShowsAnotherTriangle) {
  for (const auto& [bits, some] : {std::pair{"depth_bits=8", true}, {"depth_bits=24", false}}) {
    const Measured m("teapot", {bits});
    const std::vector<std::uint32_t> nearest = nearest_triangles(m.frame);
    std::vector<std::pair<std::size_t, std::uint32_t>> expected, found;
    for (std::size_t i = 0; i < m.model.framebuffer.size(); ++i) {
      if (m.model.framebuffer.covered(i) && !m.model.framebuffer.owned(i, nearest[i])) {
        expected.emplace_back(i, nearest[i]);
      }
    }
    for (const bool one_core : {false, true}) {
      found.clear();
      for (const MisplacedPixel& pixel : misplaced_pixels(m.frame.setup, m.model, one_core)) {
        found.emplace_back(pixel.index, pixel.triangle);
      }
      EXPECT_EQ(found, expected) << bits;
    }
    EXPECT_EQ(!expected.empty(), some) << bits;
    EXPECT_EQ(m.accuracy().visibility.largest_lsb > 100, some) << bits;
  }
}

// At depths of 2 and 12, registers scaled for 1e9 hold the same.
TEST(ExactVisibility, CountsDepthsThatTheRegistersCannotTell) {
  Scene scene = Measured("screen-triangles").frame.scene();
  std::vector<ScreenTriangle> triangles(3, scene.objects[0].screen_triangles->front());
  const double depths[] = {12, 2, 1e9};
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (ScreenVertex& vertex : triangles[t].vertices) {
      vertex.z = depths[t];
      if (t == 1) vertex.normal = Vec3(0.6, 0, -0.8);
    }
  }
  scene.objects = {scene.objects[0]};
  scene.objects[0].screen_triangles =
      std::make_shared<const std::vector<ScreenTriangle>>(std::move(triangles));
  const Accuracy accuracy = Measured(scene).accuracy();
  EXPECT_EQ(accuracy.misplaced.size(), accuracy.visible_pixels);
  for (const MisplacedPixel& pixel : accuracy.misplaced) EXPECT_EQ(pixel.triangle, 1U);
  EXPECT_GT(accuracy.visibility.largest_lsb, 2);
  EXPECT_GT(accuracy.pixels_over_limit, 0U);
}

// A diffuse colour that its register cannot hold must not switch highlights off.
TEST(Accuracy, HighlightsOverNearlyBlackMaterialsStay) {
  for (const char* preset : {"default", "paper-1k", "paper-8k"}) {
    for (const double diffuse : {1e-9, 1e-4, 1e-3, 1e-2}) {
      Scene scene = torus(false, false);
      for (Material& material : scene.materials) {
        material.diffuse = Color::Constant(diffuse);
        material.specular = Color::Ones();
      }
      const Hardware hardware = load_hardware(preset, {});
      const PreparedFrame frame(scene, hardware.formats, hardware.setup);
      AccuracyOptions options;
      options.pictures = false;
      options.limit_lsb = 32;
      const Accuracy accuracy = measure_accuracy(frame.setup, run_model(frame.setup), options);
      // Pixels at the terminator's very edge may fall on either side of the gate.
      EXPECT_LT(accuracy.pixels_over_limit, accuracy.visible_pixels / 1000) << preset << diffuse;
      EXPECT_LT(accuracy.total.rms_lsb(), 3) << preset << " " << diffuse;
    }
  }
}

TEST(Accuracy, WorstPixelsAreTheTenLargestErrorsOnAnyNumberOfCores) {
  for (const char* scene : {"torus", "two-planes"}) {  // of the latter, many are equal
    const Measured m(scene);
    std::vector<std::pair<double, std::size_t>> all;  // minus the error, and the index
    for_each_visible_pixel(m.frame.setup, m.model, [&](const ErrorChain& c) {
      double largest = 0;
      for (int k = 0; k < m.frame.setup.configuration.channels; ++k) {
        largest = std::max(largest, std::fabs(c.output[k] - c.exact[k]));
      }
      all.emplace_back(-largest, c.index);
    });
    std::sort(all.begin(), all.end());
    for (const bool one_core : {false, true}) {
      const Accuracy accuracy = measure_accuracy(m.frame.setup, m.model, {false, one_core});
      ASSERT_EQ(accuracy.worst_pixels.size(), kWorstPixels);
      EXPECT_EQ(accuracy.worst_pixels.front().error_lsb, accuracy.total.largest_lsb);
      for (std::size_t i = 0; i < kWorstPixels; ++i) {
        EXPECT_EQ(accuracy.worst_pixels[i].error_lsb, -all[i].first) << scene;
        EXPECT_EQ(accuracy.worst_pixels[i].index, all[i].second) << scene;
      }
    }
  }
}

TEST(Accuracy, MoreFractionBitsRoundLess) {
  const double coarse = Measured("sphere", {"diffuse_fraction_bits=4", "specular_fraction_bits=1"})
                            .accuracy()
                            .rounding.rms_lsb();
  const double fine = Measured("sphere", {"diffuse_fraction_bits=20", "specular_fraction_bits=16"})
                          .accuracy()
                          .rounding.rms_lsb();
  EXPECT_GT(coarse, 16 * fine);
}

TEST(Accuracy, RoundedIndexHalvesTheErrorOfATruncatedOne) {
  // Wide words, so that the index is what errs.
  const auto error = [](const std::string& rounding) {
    return Measured("sphere", {"rom_data_bits=12", "index_rounding=" + rounding})
        .accuracy()
        .rom.largest_lsb;
  };
  EXPECT_GT(error("truncate"), 1.8 * error("nearest"));
}

TEST(Accuracy, AnchoringAtTheSpanRoundsLessThanAtTheTriangle) {
  const std::vector<std::string> few = {"diffuse_fraction_bits=8", "specular_fraction_bits=6"};
  std::vector<std::string> triangle = few;
  triangle.emplace_back("anchor=triangle");
  EXPECT_LT(Measured("screen-triangles", few).accuracy().rounding.rms_lsb(),
            Measured("screen-triangles", triangle).accuracy().rounding.rms_lsb());
}

}  // namespace
}  // namespace phongpipe
