// What setup and datapath leave out, and that it changes nothing: highlights that cannot be seen,
// light that triangles face away from, series that stay what they are on planes.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "model/files/scene_file.h"
#include "model/fixed/front_end.h"
#include "model/fixed/model_frame.h"
#include "model/fixed/prepared_frame.h"
#include "model/scene/subdivision.h"
#include "model/shading/phong.h"
#include "sim/pipeline.h"
#include "sim/schedule.h"
#include "testbench/cases/random_effects.h"
#include "testbench/hardware/hardware.h"
#include "testbench/system/process.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

// A shipped scene as `verify` prepares it for the default hardware with some settings, changed
// before.
class Prepared {
 public:
  using Change = std::function<void(Scene&)>;
  explicit Prepared(const std::string& name, const Change& change = {},
                    const std::vector<std::string>& settings = {})
      : scene_(changed(name, change)), hardware_(load_hardware("default", settings)) {}

  PreparedFrame frame(Effects effects = Effects::derived) const {
    return PreparedFrame(scene_, hardware_.formats, hardware_.setup, effects);
  }
  const Scene& scene() const { return scene_; }

 private:
  static Scene changed(const std::string& name, const Change& change) {
    Scene scene = load_scene(std::string(PHONGPIPE_SCENES) + "/" + name + ".toml");
    if (change) change(scene);
    return scene;
  }

  Scene scene_;
  Hardware hardware_;
};

// Everything that is set up, pass by pass.
void for_each_setup(const FrameSetup& frame,
                    const std::function<void(SetupOutcome, const TriangleWork&)>& visit) {
  const FrontEnd front_end(frame);
  TriangleWork work;
  for (TriangleOrder next(front_end); !next.done(); next.advance()) {
    const SetupOutcome outcome = front_end.set_up(next.triangle(), next.pass(), work);
    if (outcome != SetupOutcome::nothing) visit(outcome, work);
  }
}

std::uint64_t pixels_of(const TriangleWork& work) {
  std::uint64_t pixels = 0;
  for (const RowSpan& row : work.rows) pixels += static_cast<std::uint64_t>(row.length);
  return pixels;
}

std::size_t total(const OperationCounts& counts) {
  return counts.add + counts.multiply + counts.rsqrt + counts.power;
}

SimulationCounts execute(const FrameSetup& frame, Detail detail = Detail::span) {
  Child child([&] {
    SimulationOptions options;
    options.detail = detail;
    const SimulationCounts counts = simulate(frame, PipelineConfiguration(), options);
    return to_bytes(counts);
  });
  return from_bytes<SimulationCounts>(child.get());
}

bool has_module(const SimulationCounts& counts, const std::string& part) {
  return std::any_of(counts.modules.begin(), counts.modules.end(), [&](const std::string& module) {
    return module.find(part) != std::string::npos;
  });
}

class OperationsOf {
 public:
  std::size_t operator()(const SeriesPlan& plan) { return total(times_.of(plan).operations); }
  // What would be executed for this without tests and without the highlight.
  std::size_t without_highlight(SeriesPlan plan) {
    plan.specular = plan.gate = SeriesForm::absent;
    plan.highlight_invisible = false;
    return (*this)(untested(plan));
  }
  static SeriesPlan untested(SeriesPlan plan) {
    plan.bound_light = plan.bound_highlight = false;
    return plan;
  }

 private:
  PipelineConfiguration units_;
  SetupTimes times_{units_};
};

// By the paper's table of 8k bytes, which shows a highlight from ½ LSB on.
class SharpPawn : public testing::TestWithParam<int> {
 protected:
  Prepared pawn_{"pawn",
                 [](Scene& scene) {
                   scene.image.width = scene.image.height = GetParam();
                   for (Material& material : scene.materials) material.shininess = 164;
                 },
                 {"rom_layout=plain", "rom_data_bits=8"}};
};

// All tests are paid for, those of light too, and all that they save counts.
TEST_P(SharpPawn, HalfTheHighlightsSetupIsSavedTestsIncluded) {
  const PreparedFrame prepared = pawn_.frame();
  const FrameSetup& frame = prepared.setup;
  OperationsOf operations;
  std::size_t full = 0, highlights = 0, executed = 0, more = 0;
  for_each_setup(frame, [&](SetupOutcome, const TriangleWork& work) {
    const SeriesPlan &whole = work.setup.material->plan, &own = work.setup.plan;
    full += operations(OperationsOf::untested(whole));
    highlights += operations(OperationsOf::untested(whole)) - operations.without_highlight(whole);
    executed += operations(own);
    more += operations(own) - operations.without_highlight(own);
  });
  const double of_highlights = static_cast<double>(highlights);
  EXPECT_GE((static_cast<double>(full) - static_cast<double>(executed)) / of_highlights, 0.5);
  // Of the highlight alone, though it pays for all tests.
  EXPECT_GE(1 - static_cast<double>(more) / of_highlights, 0.5);
  EXPECT_EQ(executed, total(execute(frame).setup_operations)) << "the simulation counts the same";
}

TEST_P(SharpPawn, HalfTheHighlightsStepsAndReadsAreSaved) {
  const PreparedFrame prepared = pawn_.frame();
  const FrameSetup& frame = prepared.setup;
  std::uint64_t pixels = 0, stepped = 0, read = 0;
  const SpanWalker walker(frame);
  for_each_setup(frame, [&](SetupOutcome, const TriangleWork& work) {
    for (const RowSpan& row : work.rows) {
      const auto length = static_cast<std::uint64_t>(row.length);
      const Span span = walker.start(work.setup, row);
      pixels += length;
      if (span.step_specular) stepped += length;
      if (span.highlight) read += length;
    }
  });
  EXPECT_LE(2 * stepped, pixels);
  EXPECT_LE(2 * read, pixels);
  const SimulationCounts own = execute(frame);
  const SimulationCounts all = execute(pawn_.frame(Effects::all).setup);
  EXPECT_EQ(own.pixel_operations.reads, read);
  EXPECT_EQ(all.pixel_operations.reads, pixels);
}

// Everything has three channels, of which the pawn's are alike.
TEST_P(SharpPawn, LooksAsIfNothingWereLeftOut) {
  std::vector<std::uint32_t> own = run_model(pawn_.frame().setup).colors();
  for (std::uint32_t& color : own) color *= 0x010101;
  EXPECT_TRUE(own == run_model(pawn_.frame(Effects::all).setup).colors());
}

INSTANTIATE_TEST_SUITE_P(Sizes, SharpPawn, testing::Values(512, 2048));

class ElisionIn : public testing::TestWithParam<Detail> {};

TEST_P(ElisionIn, ADiffuseSceneHasNoHighlightAnywhere) {
  const Prepared diffuse("effects/diffuse");
  const PreparedFrame prepared = diffuse.frame();
  const FrameSetup& frame = prepared.setup;
  const SimulationCounts executed = execute(frame, GetParam());
  for (const char* module : {"specular_series", "exponent_rom", "gate_series"}) {
    EXPECT_FALSE(has_module(executed, module)) << module;
  }
  EXPECT_TRUE(has_module(executed, "diffuse_series"));
  EXPECT_EQ(executed.pixel_operations.reads, 0U);
  EXPECT_EQ(executed.rom_load_cycles, 0);
  // The two of each diffuse series' pixel where it has one, and nothing else.
  OperationsOf operations;
  std::size_t setup = 0;
  std::uint64_t steps = 0;
  for_each_setup(frame, [&](SetupOutcome, const TriangleWork& work) {
    EXPECT_FALSE(is_present(work.setup.plan.specular) || work.setup.plan.bound_highlight);
    setup += operations(work.setup.plan);
    if (is_present(work.setup.plan.diffuse)) steps += 2 * pixels_of(work);
  });
  EXPECT_EQ(total(executed.setup_operations), setup);
  EXPECT_EQ(executed.pixel_operations.additions, steps);
}

// No step, no more than the highlight's sum and one read for each pixel.
TEST_P(ElisionIn, PlanesHaveNoSteps) {
  const Prepared planes("two-planes");
  const PreparedFrame prepared = planes.frame();
  const FrameSetup& frame = prepared.setup;
  const SimulationCounts executed = execute(frame, GetParam());
  std::uint64_t pixels = 0;
  for_each_setup(frame, [&](SetupOutcome, const TriangleWork& work) {
    EXPECT_EQ(work.setup.plan.light(), SeriesForm::constant);
    EXPECT_EQ(work.setup.plan.specular, SeriesForm::constant);
    pixels += pixels_of(work);
  });
  EXPECT_EQ(executed.pixel_operations.reads, pixels);
  // One to add the highlight, and one in the ROM.
  EXPECT_EQ(executed.pixel_operations.additions, 2 * pixels);
}

INSTANTIATE_TEST_SUITE_P(Pipeline, ElisionIn, testing::Values(Detail::span, Detail::cycle),
                         [](const testing::TestParamInfo<Detail>& info) {
                           return info.param == Detail::span ? "BySpan" : "ByCycle";
                         });

// A triangle is dropped in a further light's pass only if all its pixels face away from the light;
// of a sphere and a torus most of those that do are.
TEST(Elision, DropsTrianglesThatFaceAwayFromAFurtherLight) {
  const Prepared lights("effects/two-lights");
  const PreparedFrame prepared = lights.frame();
  const FrameSetup& frame = prepared.setup;
  const ModelFrame model = run_model(frame);
  std::size_t dropped = 0, facing_away = 0, set_up = 0;
  for_each_setup(frame, [&](SetupOutcome outcome, const TriangleWork& work) {
    ++set_up;
    if (work.setup.pass == 0) return;
    const ScreenTriangle& triangle = prepared.geometry().triangles[work.setup.triangle];
    double highest = -1;
    for (const ScreenVertex& vertex : triangle.vertices) {
      highest =
          std::max(highest, -vertex.normal.normalized().dot(lights.scene().lights[1].direction));
    }
    facing_away += highest <= 0;
    if (outcome == SetupOutcome::left_out) {
      ++dropped;
      EXPECT_LE(highest, 0) << "triangle " << work.setup.triangle;
    }
  });
  EXPECT_EQ(model.triangles.left_out, dropped);
  EXPECT_EQ(model.triangles.set_up, set_up);
  EXPECT_GT(dropped, facing_away * 8 / 10);
  EXPECT_TRUE(model.colors() == run_model(lights.frame(Effects::all).setup).colors());
}

// Triangles whose corners have one normal: their series are T0 alone, and its bits are those that
// the whole computation gives, whichever fit.
TEST(Elision, OfFlatTrianglesLeavesTheBitsOfT0) {
  constexpr unsigned kFirstSeed = 307, kSeeds = 1500;
  std::size_t flat = 0;
  for (unsigned seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Scene scene = lit_scene(100, 100);
    Geometry geometry = random_geometry(random, scene, 4, 30);
    for (ScreenTriangle& triangle : geometry.triangles) {
      const Vec3 normal = random.unit_near(Vec3(0, 0, 1), 80) * random.uniform(0.5, 1.5);
      // One in five is bent ever so little, at all corners or at one, and no longer flat.
      const double bend = seed % 5 == 1 ? std::pow(10, random.uniform(-13, -3)) : 0;
      for (ScreenVertex& vertex : triangle.vertices) vertex.normal = normal;
      for (std::size_t i = seed % 2 == 0 ? 0 : 2; i < 3; ++i) {
        triangle.vertices[i].normal += bend * random.unit();
      }
    }
    // Now and then the light comes along a normal, so that the cosine is 1 and T0, with a colour of
    // 1/32 in sixteenths of an LSB, half way between two numbers.
    if (seed % 3 == 0) {
      scene.lights.front().direction = -geometry.triangles[0].vertices[0].normal.normalized();
      for (Material& material : geometry.materials) material.diffuse = Color::Constant(1.0 / 32);
    }
    FrameConfiguration c;
    c.series_fit = static_cast<SeriesFit>(random.integer(1, 3));
    c.anchor = random.integer(0, 1) == 0 ? Anchor::triangle : Anchor::span;
    if (seed % 3 == 0) c.anchor = Anchor::triangle;
    c.diffuse_fraction_bits = seed % 3 == 0 ? 4 : 16;
    c.gate = random.integer(0, 1) == 0 ? GateSource::diffuse : GateSource::series;
    const FrameSetup own(scene, geometry, c), all(scene, geometry, c, Effects::all);
    for (std::uint32_t t = 0; t < geometry.triangles.size(); ++t) {
      TriangleWork work;
      if (FrontEnd(own).set_up(t, 0, work) != SetupOutcome::ready) continue;
      const TriangleSetup some = work.setup;
      FrontEnd(all).set_up(t, 0, work);
      const TriangleSetup whole = work.setup;
      const auto expect_same = [&](const FixedQuadratic& a, const FixedQuadratic& b) {
        EXPECT_EQ(a.t0, b.t0);
        for (const std::int64_t higher : {a.t1, a.t2, a.t3, a.t4, a.t5}) ASSERT_EQ(higher, 0);
      };
      if (some.plan.diffuse == SeriesForm::constant) {
        ++flat;
        expect_same(some.diffuse[0], whole.diffuse[0]);
      }
      if (some.plan.gate == SeriesForm::constant) expect_same(some.gate, whole.gate);
      if (some.plan.specular == SeriesForm::constant) expect_same(some.specular, whole.specular);
      ASSERT_FALSE(::testing::Test::HasFailure());
    }
  }
  EXPECT_GT(flat, kSeeds) << "the cases are not what they are for";
}

// Registers of few fraction bits, whose rounding lifts series over the gate or into the table's
// words though the exact ones stay below: what is left out must allow for it.
class CoarseRegisters : public testing::TestWithParam<Anchor> {
 protected:
  static constexpr unsigned kFirstSeed = 401, kSeeds = 4000;

  // A triangle of small turn whose highest corner has the cosine `highest` to `m`.
  static ScreenTriangle triangle_below(Random& random, const Scene& scene, const Vec3& m,
                                       double highest) {
    ScreenTriangle triangle = random_triangle(random, scene.image, random.uniform(5, 40));
    const Vec3 side = m.cross(random.unit()).normalized();
    const double widest = random.uniform(0.001, 0.03);
    for (ScreenVertex& vertex : triangle.vertices) {
      const double cosine = highest - random.uniform(0, widest);
      const Vec3 across = (side + random.uniform(-widest, widest) * m.cross(side)).normalized();
      vertex.normal = cosine * m + std::sqrt(1 - cosine * cosine) * across;
    }
    return triangle;
  }

  // Draws both ways; whether the own way leaves out what `left_out` asks for.
  template <typename LeftOut>
  static bool agrees(const Scene& scene, const Geometry& geometry, const FrameConfiguration& c,
                     LeftOut left_out) {
    const FrameSetup own(scene, geometry, c), all(scene, geometry, c, Effects::all);
    EXPECT_TRUE(run_model(own).colors() == run_model(all).colors());
    TriangleWork work;
    return FrontEnd(own).set_up(0, 0, work) == SetupOutcome::ready && left_out(work.setup.plan);
  }
  static FrameConfiguration configuration(Random& random) {
    FrameConfiguration c;
    c.anchor = GetParam();
    c.series_fit = static_cast<SeriesFit>(random.integer(1, 3));
    return c;
  }
};

// Just behind the light's horizon, with a highlight that the gate alone hides.
TEST_P(CoarseRegisters, LeaveOutNoLightThatRoundingLetsThrough) {
  std::size_t dark = 0;
  for (unsigned seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = lit_scene(100, 100);
    Geometry geometry;
    // Channels of unlike scales, or none, where the gate's series alone decides.
    geometry.materials = {grey_material(0, 0.8, 1)};
    if (random.integer(0, 3) > 0) {
      geometry.materials[0].diffuse = Color{random.uniform(0.1, 1), random.uniform(0, 0.1), 0};
    }
    geometry.triangles = {triangle_below(random, scene, -scene.lights.front().direction,
                                         -std::pow(10, random.uniform(-6, -0.5)))};
    FrameConfiguration c = configuration(random);
    c.channels = 3;
    c.diffuse_fraction_bits = random.integer(4, 12);
    // A level that the least number more rounds to the next LSB.
    const double last = 0.5 - std::ldexp(1.0, -c.diffuse_fraction_bits);
    geometry.materials[0].ambient = Color::Constant((20 + last) / kOutputMax);
    const bool lit = (geometry.materials[0].diffuse > 0).any();
    c.gate = !lit || random.integer(0, 1) == 0 ? GateSource::series
             : random.integer(0, 2) == 0       ? GateSource::off
                                               : GateSource::diffuse;
    dark += agrees(scene, geometry, c,
                   [](const SeriesPlan& plan) { return !is_present(plan.light()); });
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(dark, kSeeds / 20);
  EXPECT_LT(dark, kSeeds * 19 / 20);
}

// Just outside the highlight.
TEST_P(CoarseRegisters, LeaveOutNoHighlightThatRoundingShows) {
  std::size_t dim = 0;
  for (unsigned seed = kFirstSeed; seed < kFirstSeed + kSeeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Scene scene = lit_scene(100, 100);
    Geometry geometry;
    geometry.materials = {grey_material(0.3, 1, random.uniform(5, 200))};
    geometry.triangles.resize(1);
    FrameConfiguration c = configuration(random);
    c.specular_fraction_bits = random.integer(1, 10);
    const MaterialSetup material = FrameSetup(scene, geometry, c).materials.front();
    const double least = material.first_visible_address / material.light.specular_scale;
    geometry.triangles = {triangle_below(random, scene, material.light.terms.halfway,
                                         least - std::pow(10, random.uniform(-6, -0.5)))};
    dim += agrees(scene, geometry, c,
                  [](const SeriesPlan& plan) { return !is_present(plan.specular); });
    ASSERT_FALSE(HasFailure());
  }
  EXPECT_GT(dim, kSeeds / 20);
  EXPECT_LT(dim, kSeeds * 19 / 20);
}

INSTANTIATE_TEST_SUITE_P(Anchors, CoarseRegisters, testing::Values(Anchor::triangle, Anchor::span),
                         [](const testing::TestParamInfo<Anchor>& info) {
                           return info.param == Anchor::triangle ? "ByTriangle" : "BySpan";
                         });

}  // namespace
}  // namespace phongpipe
