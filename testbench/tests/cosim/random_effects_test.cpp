// Random scenes with random combinations of effects, three ways: no pixel and no cycle differs, and
// neither does the picture of the hardware that has every effect and leaves nothing out.
// PHONGPIPE_SEED=… replays a run.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "model/files/scene_file.h"
#include "model/scene/input_error.h"
#include "testbench/cosim/verification.h"
#include "testbench/system/random.h"

namespace phongpipe {
namespace {

namespace fs = std::filesystem;

class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {}

  std::string toml() {
    grey_ = chance(0.4);
    std::string text = "[image]\nwidth = 96\nheight = 80\n" + color("background", 0, 1);
    const bool perspective = chance(0.7);
    text += fmt::format(
        "[camera]\nprojection = \"{}\"\neye = [{:.3f}, {:.3f}, 6]\ntarget = [0, 0, 0]\n",
        perspective ? "perspective" : "orthographic", between(-2, 2), between(-1, 2));
    text += perspective ? "vertical_fov_degrees = 30\n" : "vertical_extent = 3\n";
    text += fmt::format("[shading]\nviewer = \"{}\"\nhighlight = \"{}\"\n",
                        chance(0.5) ? "local" : "infinite", chance(0.6) ? "halfway" : "reflection");
    for (int i = 0, lights = whole(1, 3); i < lights; ++i) text += light();
    materials_ = whole(1, 2);
    for (int i = 0, objects = whole(1, 3); i < objects; ++i) text += object();
    for (int i = 0; i < materials_; ++i) text += material(i);
    if (chance(0.3)) {
      text +=
          fmt::format("[depth_cue]\nnear = {:.2f}\nfar = {:.2f}\n", between(3, 5), between(6, 9)) +
          color("color", 0, 1);
    }
    return text;
  }

  SeriesFit fit() { return static_cast<SeriesFit>(whole(0, 3)); }
  bool chance(double share) { return between(0, 1) < share; }
  int whole(int low, int high) { return random_.integer(low, high); }

 private:
  double between(double low, double high) { return random_.uniform(low, high); }
  std::string color(const char* key, double low, double high) {
    if (grey_) return fmt::format("{} = {:.3f}\n", key, between(low, high));
    return fmt::format("{} = [{:.3f}, {:.3f}, {:.3f}]\n", key, between(low, high),
                       between(low, high), between(low, high));
  }
  std::string vector(const char* key, double reach) {
    return fmt::format("{} = [{:.3f}, {:.3f}, {:.3f}]\n", key, between(-reach, reach),
                       between(-reach, reach), between(-reach, reach));
  }
  std::string light() {
    const char* const types[] = {"directional", "point", "spot"};
    const int type = whole(0, 2);
    std::string text =
        fmt::format("[[light]]\ntype = \"{}\"\n", types[type]) + color("color", 0.2, 1);
    if (type != 1) {
      text += fmt::format("direction = [{:.3f}, {:.3f}, -1]\n", between(-2, 2), between(-2, 2));
    }
    if (type != 0) {
      text += fmt::format("position = [{:.3f}, {:.3f}, {:.3f}]\n", between(-2, 2), between(-2, 2),
                          between(2, 4));
      if (chance(0.6)) {
        text +=
            fmt::format("attenuation = [{:.3f}, {:.3f}, {:.3f}]\n", between(0.1, 1),
                        chance(0.5) ? between(0, 0.3) : 0.0, chance(0.5) ? between(0, 0.1) : 0.0);
      }
    }
    if (type == 2) {
      text +=
          fmt::format("spot_exponent = {}\nspot_cutoff_degrees = {}\n", whole(0, 20), whole(5, 90));
    }
    return text;
  }
  std::string object() {
    const char* const primitives[] = {"sphere", "torus", "plane"};
    return fmt::format("[[object]]\nprimitive = \"{}\"\nsegments = [{}, {}]\n",
                       primitives[whole(0, 2)], whole(6, 24), whole(4, 12)) +
           vector("translate", 0.8) + vector("rotate_degrees", 60) +
           fmt::format("scale = {:.2f}\nmaterial = \"m{}\"\n", between(0.3, 1),
                       whole(0, materials_ - 1));
  }
  std::string material(int i) {
    const auto part = [this](const char* key, double share) {
      return chance(share) ? color(key, 0.1, 0.9) : fmt::format("{} = 0\n", key);
    };
    const double shininess[] = {0.5, 1, 20, 164, 1000};
    return fmt::format("[material.m{}]\n", i) + part("ambient", 0.7) + part("diffuse", 0.8) +
           part("specular", 0.7) + fmt::format("shininess = {}\n", shininess[whole(0, 4)]);
  }

  Random random_;
  bool grey_ = false;
  int materials_ = 1;
};

TEST(RandomEffects, NothingDiffersInAnyAccount) {
  const char* const given = std::getenv("PHONGPIPE_SEED");
  const unsigned first = given != nullptr ? static_cast<unsigned>(std::atol(given))
                                          : std::random_device{}() % 1'000'000;
  const int scenes = given != nullptr ? 1 : 16;
  setenv("XDG_CACHE_HOME", PHONGPIPE_RTL_CACHE, 1);  // RTL once built is kept
  const fs::path file =
      fs::path(::testing::TempDir()) / fmt::format("phongpipe-effects-{}.toml", getpid());
  const Hardware preset = load_hardware("default", {});
  int shaded = 0;
  for (int i = 0; i < scenes && !::testing::Test::HasFailure(); ++i) {
    const unsigned seed = first + static_cast<unsigned>(i);
    RandomScene scene(seed);
    const std::string toml = scene.toml();
    std::ofstream(file) << toml;
    Hardware hardware = preset;
    hardware.setup.series_fit = scene.fit();
    if (scene.chance(0.2)) hardware.formats.anchor = Anchor::triangle;
    if (scene.chance(0.2)) hardware.formats.gate_choice = GateSource::off;
    VerificationOptions options;
    options.budget_ns = 1e9;
    options.effects = EffectsToVerify::both;
    options.detail = scene.chance(0.3) ? Detail::cycle : Detail::span;
    options.stall_percent = scene.chance(0.3) ? 20 : 0;
    options.seed = seed;
    try {
      const VerificationResult v = verify(load_scene(file), hardware, options);
      ++shaded;
      EXPECT_EQ(v.rtl->stream_mismatches + v.rtl->frame_mismatches, 0U);
      EXPECT_EQ(v.systemc.stream_mismatches + v.systemc.frame_mismatches, 0U);
      EXPECT_TRUE(v.same_cycles());
      EXPECT_EQ(v.full_hardware->systemc.frame_mismatches, 0U);
    } catch (const InputError& error) {
      // A camera may miss all objects.
      EXPECT_NE(std::string(error.what()).find("nothing of the scene covers a pixel"),
                std::string::npos)
          << error.what();
    }
    if (::testing::Test::HasFailure()) {
      std::printf("replay with PHONGPIPE_SEED=%u:\n%s\n", seed, toml.c_str());
    }
  }
  fs::remove(file);
  EXPECT_GT(shaded, scenes / 2);
}

}  // namespace
}  // namespace phongpipe
