// Runs: the identity covers everything a result depends on; the command says it all.
#include "testbench/cosim/run.h"

#include <gtest/gtest.h>

#include <set>

#include "model/scene/input_error.h"
#include "testbench/cases/named_scene.h"
#include "testbench/cosim/metrics_json.h"
#include "testbench/cosim/scene_hash.h"
#include "testbench/system/record_json.h"

namespace phongpipe {
namespace {

std::string identity(const Hardware& hardware, const VerificationOptions& options = {},
                     std::uint64_t scene = 1, const RunLimits& limits = {}) {
  return identity_of(canonical_text(scene, hardware, options, limits, 0));
}

TEST(RunIdentity, EverySettingOptionAndLimitCounts) {
  const Hardware hardware = load_hardware("default", {});
  std::set<std::string> identities = {identity(hardware), identity(hardware, {}, 2),
                                      identity(hardware, {}, 1, {601, 4096}),
                                      identity(hardware, {}, 1, {600, 4095})};
  std::size_t expected = 4;
  for (const Setting<Hardware>& setting : hardware_settings()) {
    Hardware changed = hardware;
    const int value = setting.get(changed);
    setting.put(changed, value == setting.low ? setting.high : setting.low);
    identities.insert(identity(changed));
    EXPECT_EQ(identities.size(), ++expected) << setting.name();
  }
  const std::pair<const char*, const char*> options[] = {{"detail", "cycle"}, {"stall", "25"},
                                                         {"seed", "7"},       {"effects", "all"},
                                                         {"budget", "80.5"},  {"max-error", "1.5"}};
  EXPECT_EQ(std::size(options), run_options().size());
  for (const auto& [key, value] : options) {
    RunRequest request;
    set_key(request, key, value);
    identities.insert(identity(hardware, request.options));
    EXPECT_EQ(identities.size(), ++expected) << key;
  }
  Hardware card = hardware;
  card.technology.measured.front().clock_ns += 0.001;
  identities.insert(identity(card));
  EXPECT_EQ(identities.size(), ++expected) << "the content of the technology card";
}

TEST(RunIdentity, AScenesContentCountsAndNotItsName) {
  const std::uint64_t sphere = scene_hash(load_named_scene("sphere"));
  const std::string file = std::string(PHONGPIPE_SCENES) + "/sphere.toml";
  EXPECT_EQ(scene_hash(load_named_scene(file)), sphere);
  std::set<std::uint64_t> hashes = {sphere, scene_hash(load_named_scene("torus")),
                                    scene_hash(load_named_scene("mesh")),
                                    scene_hash(load_named_scene("screen-triangles"))};
  EXPECT_EQ(hashes.size(), 4U);
  hashes.insert(scene_hash(load_named_scene("sphere", {"scene.light.0.color=[1, 1, 0.5]"})));
  hashes.insert(scene_hash(load_named_scene("sphere", {"scene.image.width=100"})));
  EXPECT_EQ(hashes.size(), 6U);
}

TEST(RunCommand, SaysEverythingThatIsNotTheDefault) {
  RunRequest request;
  set_key(request, "scene", "my scene.toml");
  EXPECT_EQ(command_of(request), "phongpipe verify 'my scene.toml'");
  set_key(request, "hardware", "paper-1k");
  set_key(request, "datapath.rom_address_bits", "12");
  set_key(request, "scene.light.0.color", "[1, 1, 1]");
  set_key(request, "detail", "cycle");
  set_key(request, "stall", "25");
  set_key(request, "budget", "80.5");
  EXPECT_EQ(command_of(request),
            "phongpipe verify 'my scene.toml' --hardware paper-1k --set "
            "datapath.rom_address_bits=12 --set 'scene.light.0.color=[1, 1, 1]' --detail cycle "
            "--stall 25 --budget 80.5");
  EXPECT_THROW(set_key(request, "detail", "gate"), InputError);
  EXPECT_THROW(set_key(request, "stall", "101"), InputError);
  EXPECT_THROW(set_key(request, "budget", "0"), InputError);
}

TEST(RunCommand, IsReadBackAsItWas) {
  RunRequest request;
  for (const auto& [key, value] :
       std::vector<std::pair<std::string, std::string>>{{"scene", "it's my \\ scene.toml"},
                                                        {"hardware", ""},
                                                        {"rom_address_bits", "12"},
                                                        {"scene.object.0.segments", "[12, 8]"},
                                                        {"scene.name", "'"},
                                                        {"detail", "cycle"},
                                                        {"stall", "25"},
                                                        {"max-error", "0.75"},
                                                        {"seed", "9"},
                                                        {"effects", "both"},
                                                        {"budget", "80.5"}}) {
    set_key(request, key, value);
  }
  request.options.rtl_sources = "some folder/hw";
  const RunRequest back = parse_command(command_of(request));
  EXPECT_EQ(back.scene, request.scene);
  EXPECT_EQ(back.hardware, request.hardware);
  EXPECT_EQ(back.settings, request.settings);
  EXPECT_EQ(back.options.rtl_sources, request.options.rtl_sources);
  for (const RunOption& option : run_options()) {
    EXPECT_EQ(option.get(back.options), option.get(request.options)) << option.name;
    EXPECT_NE(option.get(back.options), option.get(RunRequest().options)) << option.name;
  }
  EXPECT_EQ(command_of(parse_command("phongpipe verify teapot")), "phongpipe verify teapot");
}

TEST(RunCommand, OthersAreRefused) {
  for (const char* command :
       {"", "phongpipe verify", "phongpipe render teapot", "phongpipe verify 'teapot",
        "phongpipe verify teapot --stall", "phongpipe verify teapot --stall x",
        "phongpipe verify teapot --color red"}) {
    EXPECT_THROW(parse_command(command), InputError) << command;
  }
}

TEST(RunResult, ComesThroughAPipeAsItIs) {
  RunResult result;
  result.outcome = Outcome::failed;
  result.message = "a message";
  result.metrics = {MetricValue(), MetricValue(std::int64_t{-5}), MetricValue(1.0 / 3),
                    MetricValue(2.0)};
  const auto back = from_bytes<RunResult>(to_bytes(result));
  EXPECT_TRUE(equal_fields(result, back));
}

TEST(RandomScene, IsTheSameForItsSeed) {
  EXPECT_EQ(scene_hash(load_named_scene("random:7")), scene_hash(load_named_scene("random:7")));
  EXPECT_NE(scene_hash(load_named_scene("random:7")), scene_hash(load_named_scene("random:8")));
  EXPECT_THROW(load_named_scene("random:x"), InputError);
  EXPECT_THROW(load_named_scene("random:-1"), InputError);
  EXPECT_THROW(load_named_scene("random:7", {"scene.image.width=5"}), InputError);
}

// Over many seeds every effect occurs.
TEST(RandomScene, CoversEveryEffect) {
  std::set<std::string> seen;
  for (int seed = 0; seed < 200; ++seed) {
    const Scene scene = load_named_scene("random:" + std::to_string(seed));
    seen.insert(is_screen_space(scene) ? "screen" : scene.objects.front().primitive);
    seen.insert(scene.shading.viewer == Viewer::local ? "local viewer" : "infinite viewer");
    seen.insert(scene.shading.highlight == Highlight::reflection ? "R·V" : "N·H");
    seen.insert(scene.lights.size() > 1 ? "several lights" : "one light");
    if (scene.depth_cue) seen.insert("depth cue");
    for (const Light& light : scene.lights) {
      if (is_attenuated(light)) seen.insert("attenuation");
      if (has_spot_factor(light)) seen.insert("spot");
    }
    for (const Material& material : scene.materials) {
      seen.insert(is_shiny(material) ? "shiny" : "matt");
      if (material.diffuse.isZero()) seen.insert("no diffuse");
    }
  }
  EXPECT_EQ(seen.size(), 6U + 2 + 2 + 2 + 3 + 3) << testing::PrintToString(seen);
}

}  // namespace
}  // namespace phongpipe
