// What is computed once a frame, and the scenes that are refused by name.
#include "model/fixed/frame_setup.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "model/scene/input_error.h"
#include "testbench/tests/fixed/random_frame.h"

namespace phongpipe {
namespace {

Geometry one_material(const Material& material) {
  Geometry geometry;
  geometry.materials = {material};
  return geometry;
}

std::string refusal(const std::function<void(Scene&)>& change) {
  Scene scene = lit_scene(64, 64);
  scene.file = "ball.toml";
  change(scene);
  try {
    FrameSetup(scene, one_material(Material()), DatapathConfiguration(), 24);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FrameSetup, TakesOneDirectionalLight) {
  EXPECT_EQ(refusal([](Scene&) {}), "no error");
  EXPECT_EQ(refusal([](Scene& scene) { scene.shading.viewer = Viewer::local; }), "no error");
}

TEST(FrameSetup, RefusesByNameWhatIsNotSimulated) {
  const auto expect_refusal = [](const std::function<void(Scene&)>& change, const char* what,
                                 const char* instead) {
    const std::string message = refusal(change);
    EXPECT_NE(message.find("ball.toml: "), std::string::npos) << message;
    EXPECT_NE(message.find(what), std::string::npos) << message;
    EXPECT_NE(message.find(instead), std::string::npos) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  };
  expect_refusal([](Scene& s) { s.lights.emplace_back(); }, "several lights", "keep one [[light]]");
  expect_refusal([](Scene& s) { s.lights[0].type = LightType::point; }, "point lights",
                 "type = \"directional\"");
  expect_refusal([](Scene& s) { s.lights[0].type = LightType::spot; }, "spot lights",
                 "type = \"directional\"");
  expect_refusal([](Scene& s) { s.shading.highlight = Highlight::reflection; }, "reflection",
                 "highlight = \"halfway\"");
  expect_refusal([](Scene& s) { s.depth_cue.emplace(); }, "depth cueing", "[depth_cue]");
}

TEST(FrameSetup, ChecksItsConfiguration) {
  DatapathConfiguration configuration;
  configuration.rom_data_bits = 13;
  EXPECT_THROW(FrameSetup(lit_scene(8, 8), Geometry(), configuration, 24), InputError);
}

TEST(FrameSetup, ScalesAndLevelsOfAMaterial) {
  Scene scene = lit_scene(64, 64);
  scene.lights[0].direction = Vec3(0.6, 0, -0.8);
  scene.lights[0].color = Color(1, 0.5, 0.25);
  scene.shading.ambient_light = Color(0.5, 1, 0);
  scene.image.background = Color(0, 0.5, 1);
  Material material = grey_material(0.6, 0.5, 2);
  material.ambient = Color(0.2, 0.1, 0.7);
  DatapathConfiguration configuration;
  configuration.channels = 3;
  configuration.diffuse_fraction_bits = 8;
  const FrameSetup frame(scene, one_material(material), configuration, 24);
  ASSERT_EQ(frame.materials.size(), 1U);
  const MaterialSetup& setup = frame.materials[0];
  EXPECT_DOUBLE_EQ(setup.light.diffuse_scale[0], 255 * 0.6);
  EXPECT_DOUBLE_EQ(setup.light.diffuse_scale[1], 255 * 0.3);
  EXPECT_DOUBLE_EQ(setup.light.diffuse_scale[2], 255 * 0.15);
  EXPECT_EQ(setup.light.specular_scale, 1024);
  EXPECT_EQ(setup.level[0], 26 * 256);  // 255·0.1 + ½
  EXPECT_EQ(setup.level[1], 26 * 256);
  EXPECT_EQ(setup.level[2], 128);
  ASSERT_EQ(setup.roms.size(), 3U);
  EXPECT_EQ(setup.roms[0].words().back(), 127);  // 127.5·(1023.5/1024)²
  EXPECT_EQ(setup.roms[1].words().back(), 64);
  EXPECT_EQ(setup.roms[2].words().back(), 32);
  EXPECT_LT((setup.light.to_light - Vec3(-0.6, 0, 0.8)).norm(), 1e-15);
  EXPECT_LT((setup.light.halfway - Vec3(-0.6, 0, 1.8).normalized()).norm(), 1e-15);
  EXPECT_EQ(frame.background, (std::array<std::uint8_t, 3>{0, 128, 255}));
}

TEST(FrameSetup, LookingIntoTheLightThereIsNoHighlight) {
  Scene scene = lit_scene(64, 64);
  scene.lights[0].direction = Vec3(0, 0, 1);  // the eye looks along −z
  const FrameSetup frame(scene, one_material(Material()), DatapathConfiguration(), 24);
  EXPECT_EQ(frame.materials[0].light.halfway.norm(), 0);
}

TEST(FrameSetup, DepthSpansTheTriangles) {
  Random random(1);
  const Scene scene = lit_scene(64, 64);
  Geometry geometry = random_geometry(random, scene, 3, 20);
  for (ScreenTriangle& triangle : geometry.triangles) {
    for (ScreenVertex& vertex : triangle.vertices) vertex.z = 5;
  }
  EXPECT_EQ(FrameSetup(scene, geometry, DatapathConfiguration(), 16).depth_scale, 0);
  geometry.triangles[1].vertices[2].z = 3;
  geometry.triangles[2].vertices[0].z = 7;
  const FrameSetup frame(scene, geometry, DatapathConfiguration(), 16);
  EXPECT_EQ(frame.depth_offset, 3);
  EXPECT_EQ((7 - frame.depth_offset) * frame.depth_scale, 65535);
}

TEST(IsGrey, AsksEveryColour) {
  const Scene scene = lit_scene(8, 8);
  EXPECT_TRUE(is_grey(scene, one_material(Material())));
  const Color red(0.5, 0.25, 0.25);
  for (Color Material::*color : {&Material::ambient, &Material::diffuse, &Material::specular}) {
    Geometry geometry = one_material(Material());
    geometry.materials.emplace_back();
    geometry.materials.back().*color = red;
    EXPECT_FALSE(is_grey(scene, geometry));
  }
  Scene colored = scene;
  colored.image.background = red;
  EXPECT_FALSE(is_grey(colored, one_material(Material())));
  colored = scene;
  colored.shading.ambient_light = red;
  EXPECT_FALSE(is_grey(colored, one_material(Material())));
  colored = scene;
  colored.lights[0].color = red;
  EXPECT_FALSE(is_grey(colored, one_material(Material())));
}

TEST(SuitScene, GivesTheGateASeriesWhereDiffuseCannotTell) {
  Scene scene = lit_scene(8, 8);
  const auto gate = [&scene](const Geometry& geometry, GateSource chosen) {
    DatapathConfiguration configuration;
    configuration.gate = chosen;
    return suit_scene(configuration, scene, geometry).gate;
  };
  const Geometry usual = one_material(grey_material(0.5, 0.5, 20));
  const Geometry blind = one_material(grey_material(0, 0.5, 20));
  const Geometry black = one_material(grey_material(0, 0, 20));
  EXPECT_EQ(gate(usual, GateSource::diffuse), GateSource::diffuse);
  EXPECT_EQ(gate(usual, GateSource::series), GateSource::diffuse);
  EXPECT_EQ(gate(blind, GateSource::diffuse), GateSource::series);
  EXPECT_EQ(gate(black, GateSource::diffuse), GateSource::diffuse) << "no highlight to gate";
  EXPECT_EQ(gate(blind, GateSource::off), GateSource::off);
  Geometry both = usual;
  both.materials.push_back(blind.materials[0]);
  EXPECT_EQ(gate(both, GateSource::diffuse), GateSource::series);
  // Diffuse colour that this light does not show cannot tell, either.
  Geometry red = usual;
  red.materials[0].diffuse = Color(0.5, 0, 0);
  scene.lights[0].color = Color(0, 1, 1);
  EXPECT_EQ(gate(red, GateSource::diffuse), GateSource::series);
}

}  // namespace
}  // namespace phongpipe
