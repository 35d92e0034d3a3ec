// The life of a pixel: its error's parts add up without rest, and its values are the picture's.
#include "testbench/trace/pixel_story.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <set>

#include "model/scene/input_error.h"
#include "model/shading/phong.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cases/random_run.h"
#include "testbench/system/random.h"
#include "testbench/tests/sim/simulations.h"

namespace phongpipe {
namespace {

constexpr std::uint64_t kPixelStorySeed = 20;

struct Shaded {
  Hardware hardware;
  PreparedFrame frame;
  ModelFrame model;
  std::vector<MisplacedPixel> misplaced;

  explicit Shaded(const std::string& scene, const std::string& preset = "default",
                  const std::vector<std::string>& settings = {})
      : hardware(load_hardware(preset, settings)),
        frame(load_named_scene(scene, settings), hardware.formats, hardware.setup),
        model(run_model(frame.setup)),
        misplaced(misplaced_pixels(frame.setup, model, false)) {}
  explicit Shaded(const RunRequest& run) : Shaded(run.scene, run.hardware, run.settings) {}

  int channels() const { return frame.setup.configuration.channels; }
  std::vector<Pixel> covered() const {
    std::vector<Pixel> pixels;
    for (int y = 0; y < frame.setup.height; ++y) {
      for (int x = 0; x < frame.setup.width; ++x) {
        if (model.framebuffer.covered(model.framebuffer.index_of(x, y))) pixels.push_back({x, y});
      }
    }
    return pixels;
  }
  PixelStory tell(const Pixel& pixel) const {
    return tell_story(frame, hardware, model, pixel.x, pixel.y);
  }
};

// A random run's frame, or null if its hardware is refused for the scene.
std::unique_ptr<const Shaded> shade(const RunRequest& run) {
  try {
    return std::make_unique<const Shaded>(run);
  } catch (const InputError&) {
    return nullptr;
  }
}

// Calls visit(shaded, pixel) for `count` random pixels, at most `of_each` of a random run.
template <typename Visit>
void for_each_random_pixel(std::size_t count, std::size_t of_each, Visit visit) {
  Random random(kPixelStorySeed);
  std::uint64_t refused = 0;
  for (std::uint64_t run = 0; count > 0; ++run) {
    SCOPED_TRACE(fmt::format("run {} of seed {}", run, kPixelStorySeed));
    const auto shaded = shade(random_run(kPixelStorySeed, run));
    if (!shaded) {
      ASSERT_LT(++refused, 10 + run / 2) << "most hardware is legal";
      continue;
    }
    const std::vector<Pixel> covered = shaded->covered();
    for (std::size_t i = 0; i < of_each && count > 0 && !covered.empty(); ++i, --count) {
      const Pixel& pixel = covered[random.below(covered.size())];
      SCOPED_TRACE(fmt::format("pixel {},{}", pixel.x, pixel.y));
      visit(*shaded, pixel);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(ErrorSplit, PartsAddUpWithoutRestOnTenThousandRandomPixels) {
  std::array<int, kErrorParts.size()> largest = {};
  for_each_random_pixel(10'000, 50, [&](const Shaded& shaded, const Pixel& pixel) {
    const ErrorSplit split =
        split_error(shaded.frame, shaded.model, shaded.misplaced, pixel.x, pixel.y);
    for (int c = 0; c < shaded.channels(); ++c) {
      // Whole multiples of 2^-40 LSB, added as integers and in both orders as doubles.
      std::int64_t whole = 0;
      double forwards = 0, backwards = 0;
      for (std::size_t i = 0; i < kErrorParts.size(); ++i) {
        const double scaled = std::ldexp(split.parts[i][c], 40);
        ASSERT_EQ(scaled, std::floor(scaled)) << kErrorParts[i].name;
        whole += static_cast<std::int64_t>(scaled);
        forwards += split.parts[i][c];
        backwards += split.parts[kErrorParts.size() - 1 - i][c];
      }
      ASSERT_EQ(whole, static_cast<std::int64_t>(std::ldexp(split.error()[c], 40)));
      ASSERT_EQ(forwards, split.error()[c]);
      ASSERT_EQ(backwards, split.error()[c]);
      ASSERT_EQ(split.exact[c] + forwards, split.output[c]);
    }
    ++largest[split.largest_part()];
  });
  // The nearest triangles are mostly shown, and the normals of pieces are those of the whole.
  for (std::size_t i = 2; i < kErrorParts.size(); ++i) {
    EXPECT_GT(largest[i], 0) << kErrorParts[i].name << " is never the largest part";
  }
}

TEST(ErrorSplit, StartsAtExactPhongAndEndsAtThePicture) {
  for_each_random_pixel(500, 5, [](const Shaded& shaded, const Pixel& pixel) {
    const Framebuffer& framebuffer = shaded.model.framebuffer;
    const ErrorSplit split =
        split_error(shaded.frame, shaded.model, shaded.misplaced, pixel.x, pixel.y);
    const std::size_t index = framebuffer.index_of(pixel.x, pixel.y);
    const Geometry& geometry = shaded.frame.prepared->geometry;
    const ScreenTriangle& whole =
        geometry.triangles[shaded.frame.subdivision().whole[framebuffer.owner(index)]];
    Color exact;
    PhongTriangle(shaded.frame.scene(), geometry.materials[whole.material], whole)
        .shade(pixel.x, pixel.y, 1, &exact);
    for (int c = 0; c < shaded.channels(); ++c) {
      EXPECT_NEAR(split.exact[c], exact[c], 1e-12);
      EXPECT_EQ(split.output[c], (framebuffer.color(index) >> (8 * c)) & 0xff);
    }
    EXPECT_LT(split.parts[1].abs().maxCoeff(), 1e-9) << "interpolation over the piece";
  });
}

// The same links as the statistics of `verify`, whose rom is address and word together.
TEST(ErrorSplit, HasThePartsOfTheStatistics) {
  for (const char* scene : {"torus", "effects/two-lights", "effects/depth-cue"}) {
    const Shaded shaded(scene);
    std::size_t visited = 0;
    for_each_visible_pixel(shaded.frame.setup, shaded.model, [&](const ErrorChain& links) {
      if (visited++ % 501 != 0) return;
      const auto width = static_cast<std::size_t>(shaded.frame.setup.width);
      const ErrorSplit split =
          split_error(shaded.frame, shaded.model, shaded.misplaced,
                      static_cast<int>(links.index % width), static_cast<int>(links.index / width));
      for (int c = 0; c < shaded.channels(); ++c) {
        const auto part = [&](std::size_t i) { return split.parts[i][c]; };
        constexpr double kTwoRoundings = 0x1p-39;
        ASSERT_NEAR(part(0), links.shown[c] - links.exact[c], kTwoRoundings) << scene;
        ASSERT_NEAR(part(2), links.polynomial[c] - links.shown[c], 1e-9) << scene;
        ASSERT_NEAR(part(3), links.rounded[c] - links.polynomial[c], kTwoRoundings) << scene;
        ASSERT_NEAR(part(4) + part(5), links.table[c] - links.rounded[c], kTwoRoundings) << scene;
        ASSERT_NEAR(part(6), links.output[c] - links.table[c], kTwoRoundings) << scene;
      }
    });
  }
}

// A word errs by half a unit, an address by what the table's entry is off at most.
TEST(ErrorSplit, AddressAndWordKeepTheirBounds) {
  const Shaded shaded("torus", "paper-1k");
  const FrameConfiguration& f = shaded.frame.setup.configuration;
  const HighlightTable& table = shaded.frame.setup.tables.front();
  const double most_address =
      kOutputMax * table.specular.maxCoeff() * ExponentRom::largest_error(f, table.shininess);
  double address = 0, word = 0;
  const std::vector<Pixel> covered = shaded.covered();
  for (std::size_t i = 0; i < covered.size(); i += 97) {
    const ErrorSplit split =
        split_error(shaded.frame, shaded.model, shaded.misplaced, covered[i].x, covered[i].y);
    address = std::max(address, split.parts[4].abs().maxCoeff());
    word = std::max(word, split.parts[5].abs().maxCoeff());
  }
  EXPECT_LE(address, most_address + 1e-9);
  EXPECT_GT(address, 0.7 * most_address);
  EXPECT_LE(word, std::ldexp(0.5, kOutputBits - f.rom_data_bits) + 1e-9);
  EXPECT_GT(word, std::ldexp(0.49, kOutputBits - f.rom_data_bits));
}

// Everything of a story fits together, for any scene and hardware.
TEST(PixelStory, AgreesWithThePictureForRandomPixels) {
  int hidden = 0, several_lights = 0, split = 0;
  for_each_random_pixel(600, 4, [&](const Shaded& shaded, const Pixel& pixel) {
    const PixelStory story = shaded.tell(pixel);
    const std::size_t index = shaded.model.framebuffer.index_of(pixel.x, pixel.y);
    ASSERT_EQ(story.color, shaded.model.framebuffer.color(index));
    ASSERT_EQ(story.lights.size(), shaded.frame.scene().lights.size());
    // The nearest triangle wins, and of several the first.
    const PixelVisit* winner = nullptr;
    for (const PixelVisit& visit : story.visits) {
      if (visit.light > 0) {
        ++several_lights;
        EXPECT_EQ(visit.taken, visit.triangle == story.triangle);
      } else if (winner == nullptr || visit.depth < winner->depth) {
        EXPECT_TRUE(visit.taken);
        EXPECT_EQ(visit.held_by.has_value(), winner != nullptr);
        winner = &visit;
      } else {
        ++hidden;
        EXPECT_FALSE(visit.taken);
        EXPECT_EQ(*visit.held_by, winner->triangle);
      }
    }
    ASSERT_NE(winner, nullptr);
    EXPECT_EQ(winner->triangle, story.triangle);
    split += story.piece.has_value();
    for (const LightStory& light : story.lights) {
      if (!light.span) continue;
      std::set<int> stages;
      // Of a wide datapath, the first lane carries the place.
      const int lanes = story.configuration.lanes();
      const bool has_place = light.span->step % lanes == 0;
      for (const RegisterValue& value : light.span->registers) {
        const std::string& name = value.signal.name;
        const auto ends = [&name](std::string_view end) {
          return name.size() >= end.size() && name.substr(name.size() - end.size()) == end;
        };
        stages.insert(value.signal.stage);
        if (ends("_x") && has_place) {
          EXPECT_EQ(value.bits, pixel.x) << name;
        }
        if (ends("_y") && has_place) {
          EXPECT_EQ(value.bits, pixel.y) << name;
        }
        if (name == "remaining") {
          EXPECT_EQ(value.bits,
                    (light.span->row.length + lanes - 1) / lanes - light.span->step / lanes);
        }
      }
      // All stages, but for 1 and 2 of the serial datapath, which has only digits there.
      const bool serial = story.configuration.kind == DatapathKind::serial;
      EXPECT_EQ(static_cast<int>(stages.size()),
                datapath_stages(story.configuration) - (serial ? 2 : 0));
      const auto& start = light.span->start;
      const auto x = std::find_if(start.begin(), start.end(), [&](const RegisterValue& value) {
        return value.signal.name == (serial ? "s0_x" : "s1_x");
      });
      ASSERT_NE(x, start.end());
      if (has_place) {
        EXPECT_EQ(x->bits, light.span->row.x);
      }
      // A coefficient is rounded to half a unit, if the plan is whole and in double precision.
      if (!light.left_out.empty() || shaded.hardware.setup.mantissa_bits < 53) continue;
      for (const SeriesCoefficients& series : light.coefficients) {
        for (std::size_t i = 0; i < series.real.size(); ++i) {
          const double real = std::ldexp(series.real[i], series.fraction_bits);
          if (std::fabs(real) > 0x1p50) continue;
          EXPECT_NEAR(static_cast<double>(series.rounded[i]), real, 0.5 + 1e-3)
              << series.name << " T" << i;
        }
      }
    }
  });
  EXPECT_GT(hidden, 10);
  EXPECT_GT(several_lights, 100);
  EXPECT_GT(split, 10);
}

// What the lights of some pixels of a scene leave out and why, as a text for each light.
std::set<std::string> left_out(const std::string& scene, std::size_t every) {
  const Shaded shaded(scene);
  std::set<std::string> found;
  const std::vector<Pixel> covered = shaded.covered();
  for (std::size_t i = 0; i < covered.size(); i += every) {
    for (const LightStory& light : shaded.tell(covered[i]).lights) {
      std::string text;
      for (const LeftOut& left_out : light.left_out) {
        text += fmt::format("{}: {}\n", left_out.what, left_out.why);
      }
      found.insert(text);
    }
  }
  return found;
}

TEST(PixelStory, TellsWhatWasLeftOutByWhichBound) {
  EXPECT_EQ(left_out("sphere", 53),
            (std::set<std::string>{
                "",
                "diffuse: the triangle faces away from the light, by the bound of N·L\n"
                "specular: the triangle faces away from the light, by the bound of N·L\n",
                "specular: the highlight is invisible, by its bound\n"}));
  EXPECT_EQ(left_out("two-planes", 10'007),
            (std::set<std::string>{"T1 to T5 of diffuse: all normals are equal\n"
                                   "T1 to T5 of specular: all normals are equal\n"}));
  EXPECT_EQ(left_out("effects/spotlight", 211)
                .count("specular: the material has none under this light\n"
                       "the light: the pixel is outside its cone\n"),
            1U);
}

TEST(PixelStory, RefusesPixelsThatHaveNoLife) {
  const Shaded shaded("sphere");
  const auto message = [&](int x, int y) -> std::string {
    try {
      shaded.tell({x, y});
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  for (const auto& [x, y] : {std::pair{-1, 3}, {256, 3}, {3, -1}, {3, 256}}) {
    EXPECT_EQ(message(x, y),
              fmt::format("sphere: pixel {},{} is outside the image; x goes from 0 to 255, y from "
                          "0 to 255",
                          x, y));
  }
  // The nearest covered pixel, found by hand.
  const Pixel* nearest = nullptr;
  const std::vector<Pixel> covered = shaded.covered();
  const auto distance = [](const Pixel& p) { return p.x * p.x + (p.y - 9) * (p.y - 9); };
  for (const Pixel& pixel : covered) {
    if (nearest == nullptr || distance(pixel) < distance(*nearest)) nearest = &pixel;
  }
  EXPECT_EQ(message(0, 9),
            fmt::format("sphere: pixel 0,9 is not covered; the nearest that is: {},{}, of "
                        "triangle {}",
                        nearest->x, nearest->y, shaded.tell(*nearest).triangle));
}

TEST(PixelStory, CyclesAreThoseOfTheWholeSimulationByTheClock) {
  setenv("XDG_CACHE_HOME", PHONGPIPE_RTL_CACHE, 1);
  const Shaded shaded("screen-triangles");
  SimulationOptions options;
  options.detail = Detail::cycle;
  const Trace trace = simulate_apart(shaded.frame.setup, shaded.hardware.pipeline, options);
  const RtlLibrary library(shaded.frame.setup.configuration, {});
  std::size_t visits = 0;
  const std::vector<Pixel> covered = shaded.covered();
  for (std::size_t i = 0; i < covered.size(); i += 3001) {
    PixelStory story = shaded.tell(covered[i]);
    add_cycles(shaded.frame, library, {}, story);
    auto visit = story.visits.begin();
    for (std::size_t k = 0; k < trace.stream.size(); ++k) {
      if (trace.stream[k].x != story.x || trace.stream[k].y != story.y) continue;
      ASSERT_NE(visit, story.visits.end());
      EXPECT_EQ(visit->color, trace.stream[k].color);
      EXPECT_EQ(visit->systemc_cycle, trace.cycles[k]);
      EXPECT_EQ(visit->rtl_cycle, trace.cycles[k]);
      ++visit;
      ++visits;
    }
    EXPECT_EQ(visit, story.visits.end());
  }
  EXPECT_GT(visits, 5U);
}

}  // namespace
}  // namespace phongpipe
