// What is computed once a frame, and the scenes that are refused by name.
#include "model/fixed/frame_setup.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "model/fixed/model_frame.h"
#include "model/scene/input_error.h"
#include "testbench/cases/random_effects.h"
#include "testbench/cases/random_frame.h"

namespace phongpipe {
namespace {

Geometry one_material(const Material& material) {
  Geometry geometry;
  geometry.materials = {material};
  return geometry;
}

std::string refusal(const std::function<void(Scene&)>& change) {
  Scene scene = lit_scene(64, 64);
  scene.source = "ball.toml";
  change(scene);
  try {
    FrameSetup(scene, one_material(Material()), FrameConfiguration());
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(FrameSetup, TakesEveryEffect) {
  EXPECT_EQ(refusal([](Scene&) {}), "no error");
  EXPECT_EQ(refusal([](Scene& scene) { scene.lights.resize(5); }), "no error");
  EXPECT_EQ(refusal([](Scene& scene) {
              scene.depth_cue = DepthCue{1, 2, Color::Zero()};
            }),
            "no error");
  EXPECT_EQ(refusal([](Scene& scene) { scene.shading.viewer = Viewer::local; }), "no error");
  EXPECT_EQ(refusal([](Scene& scene) { scene.shading.highlight = Highlight::reflection; }),
            "no error");
  for (const LightType type : {LightType::point, LightType::spot}) {
    EXPECT_EQ(refusal([type](Scene& scene) { scene.lights[0].type = type; }), "no error");
  }
}

// A highlight is attenuated by the power's base, and x⁰ knows nothing of x.
TEST(FrameSetup, RefusesAnExponentOfZeroUnderALightThatFades) {
  const auto fading = [](Scene& scene) {
    scene.lights[0].type = LightType::point;
    scene.lights[0].attenuation = {1, 0, 0.5};
  };
  EXPECT_EQ(refusal(fading), "no error");
  Scene scene = lit_scene(64, 64);
  scene.source = "ball.toml";
  Material blunt;
  blunt.name = "blunt";
  blunt.shininess = 0;
  const auto set_up = [&] {
    return FrameSetup(scene, one_material(blunt), FrameConfiguration()).passes;
  };
  EXPECT_EQ(set_up(), 1U);
  fading(scene);
  try {
    set_up();
    FAIL() << "not refused";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("ball.toml: material blunt"), std::string::npos) << message;
    EXPECT_NE(message.find("shininess = 1"), std::string::npos) << message;
  }
  blunt.specular = Color::Zero();
  EXPECT_EQ(set_up(), 1U);
}

TEST(FrameSetup, ChecksItsConfiguration) {
  FrameConfiguration configuration;
  configuration.rom_data_bits = 13;
  EXPECT_THROW(FrameSetup(lit_scene(8, 8), Geometry(), configuration), InputError);
}

TEST(FrameSetup, ScalesAndLevelsOfAMaterial) {
  Scene scene = lit_scene(64, 64);
  scene.lights[0].direction = Vec3(0.6, 0, -0.8);
  scene.lights[0].color = Color(1, 0.5, 0.25);
  scene.shading.ambient_light = Color(0.5, 1, 0);
  scene.image.background = Color(0, 0.5, 1);
  Material material = grey_material(0.6, 0.5, 2);
  material.ambient = Color(0.2, 0.1, 0.7);
  FrameConfiguration configuration;
  configuration.channels = 3;
  configuration.diffuse_fraction_bits = 8;
  const FrameSetup frame(scene, one_material(material), configuration);
  ASSERT_EQ(frame.materials.size(), 1U);
  const MaterialSetup& setup = frame.materials[0];
  EXPECT_DOUBLE_EQ(setup.light.diffuse_scale[0], 255 * 0.6);
  EXPECT_DOUBLE_EQ(setup.light.diffuse_scale[1], 255 * 0.3);
  EXPECT_DOUBLE_EQ(setup.light.diffuse_scale[2], 255 * 0.15);
  EXPECT_EQ(setup.light.specular_scale, 1024);
  EXPECT_EQ(setup.level[0], 26 * 256);  // 255·0.1 + ½
  EXPECT_EQ(setup.level[1], 26 * 256);
  EXPECT_EQ(setup.level[2], 128);
  ASSERT_EQ(frame.tables.size(), 1U);
  EXPECT_EQ(setup.table, 0U);
  const std::vector<ExponentRom>& roms = frame.tables[0].roms;
  ASSERT_EQ(roms.size(), 3U);
  EXPECT_EQ(roms[0].words().back(), 127);  // 127.5·(1023.5/1024)²
  EXPECT_EQ(roms[1].words().back(), 64);
  EXPECT_EQ(roms[2].words().back(), 32);
  EXPECT_LT((setup.light.terms.to_light - Vec3(-0.6, 0, 0.8)).norm(), 1e-15);
  EXPECT_LT((setup.light.terms.halfway - Vec3(-0.6, 0, 1.8).normalized()).norm(), 1e-15);
  EXPECT_EQ(frame.background, (OutputColor{0, 128, 255}));
}

TEST(FrameSetup, LookingIntoTheLightThereIsNoHighlight) {
  Scene scene = lit_scene(64, 64);
  scene.lights[0].direction = Vec3(0, 0, 1);  // the eye looks along −z
  const FrameSetup frame(scene, one_material(Material()), FrameConfiguration());
  EXPECT_EQ(frame.materials[0].light.terms.halfway.norm(), 0);
}

Geometry of_materials(const std::vector<Material>& materials) {
  Geometry geometry;
  geometry.materials = materials;
  return geometry;
}

TEST(FrameSetup, MaterialsThatDifferInDiffuseColorOnlyShareATable) {
  const Scene scene = lit_scene(8, 8);
  const FrameSetup frame(scene,
                         of_materials({grey_material(0.6, 0.3, 20), grey_material(0.2, 0.3, 20),
                                       grey_material(0.6, 0.3, 21), grey_material(0.6, 0.4, 20),
                                       grey_material(0.1, 0.3, 20)}),
                         FrameConfiguration());
  EXPECT_EQ(frame.tables.size(), 3U);
  std::vector<std::uint32_t> tables;
  for (const MaterialSetup& material : frame.materials) tables.push_back(material.table);
  EXPECT_EQ(tables, (std::vector<std::uint32_t>{0, 0, 1, 2, 0}));
  EXPECT_EQ(frame.tables[1].shininess, 21);
  EXPECT_EQ(frame.tables[2].specular[0], 0.4);
}

TEST(FrameSetup, EachColorOfLightHasItsTable) {
  Scene scene = lit_scene(8, 8);
  scene.lights.resize(4, scene.lights[0]);
  scene.lights[1].direction = Vec3(0, 0, -1);
  scene.lights[2].color = Color::Constant(0.5);
  scene.lights[3].color = Color::Zero();
  const FrameSetup frame(scene, one_material(grey_material(0.6, 0.3, 20)), FrameConfiguration());
  EXPECT_EQ(frame.passes, 4U);
  ASSERT_EQ(frame.tables.size(), 2U) << "the first two share theirs, the last has no highlight";
  EXPECT_EQ(frame.material(0, 0).table, 0U);
  EXPECT_EQ(frame.material(1, 0).table, 0U);
  EXPECT_EQ(frame.material(2, 0).table, 1U);
  EXPECT_EQ(frame.tables[1].specular[0], 0.15);
  EXPECT_FALSE(is_present(frame.material(3, 0).plan.specular));
  EXPECT_FALSE(is_present(frame.material(3, 0).plan.diffuse));
}

TEST(FrameSetup, NothingShinyHasNoTable) {
  const Scene scene = lit_scene(8, 8);
  const Geometry matt = one_material(grey_material(0.6, 0, 20));
  EXPECT_TRUE(FrameSetup(scene, matt, FrameConfiguration()).tables.empty());
  EXPECT_EQ(FrameSetup(scene, matt, FrameConfiguration(), Effects::all).tables.size(), 1U);
}

TEST(FrameSetup, AmbientLightComesWithTheFirstPassOnly) {
  Scene scene = lit_scene(8, 8);
  scene.lights.resize(2, scene.lights[0]);
  const FrameSetup frame(scene, one_material(Material()), FrameConfiguration());
  EXPECT_EQ(frame.material(0, 0).level[0], 26 << 16);  // 25.5 and the rounding half
  EXPECT_EQ(frame.material(1, 0).level[0], 1 << 15);
}

TEST(FrameSetup, EachMaterialsPlanHasItsOwnSeriesOnly) {
  const Scene scene = lit_scene(8, 8);
  const Geometry geometry = of_materials({grey_material(0.6, 0.3, 20), grey_material(0.6, 0, 20),
                                          grey_material(0, 0.3, 20), grey_material(0, 0, 20)});
  const FrameConfiguration suited = with_derived_blocks({}, scene, geometry);
  ASSERT_EQ(suited.gate, GateSource::series);
  const FrameSetup derived(scene, geometry, suited);
  const FrameSetup all(scene, geometry, suited, Effects::all);
  for (std::uint32_t m = 0; m < 4; ++m) {
    const SeriesPlan& plan = derived.material(0, m).plan;
    EXPECT_EQ(is_present(plan.diffuse), m < 2) << "material " << m;
    EXPECT_EQ(is_present(plan.specular), m % 2 == 0) << "material " << m;
    EXPECT_EQ(is_present(plan.gate), m % 2 == 0) << "material " << m;
    EXPECT_FALSE(plan.depth || plan.depth_cue);
    const SeriesPlan& whole = all.material(0, m).plan;
    EXPECT_TRUE(is_present(whole.diffuse) && is_present(whole.specular) && is_present(whole.gate) &&
                whole.depth);
  }
}

// The corners of a quad of 8 × 8 pixels, split along its diagonal.
Geometry split_quad() {
  Geometry geometry = one_material(Material());
  const std::array<std::array<int, 2>, 4> corners = {{{4, 4}, {12, 4}, {12, 12}, {4, 12}}};
  for (const std::array<std::size_t, 3>& triangle :
       {std::array<std::size_t, 3>{0, 1, 2}, std::array<std::size_t, 3>{0, 2, 3}}) {
    geometry.triangles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      geometry.triangles.back().vertices[i].x = corners[triangle[i]][0] * kSubpixels;
      geometry.triangles.back().vertices[i].y = corners[triangle[i]][1] * kSubpixels;
      geometry.triangles.back().vertices[i].normal = Vec3(0, 0, 1);
    }
  }
  return geometry;
}

TEST(FrameSetup, DepthIsTestedWhereAPixelIsCoveredTwice) {
  Scene scene = lit_scene(16, 16);
  scene.lights.resize(2, scene.lights[0]);
  Geometry geometry = split_quad();
  const auto tested = [&](Effects effects) {
    const FrameSetup frame(scene, geometry, FrameConfiguration(), effects);
    EXPECT_EQ(frame.material(0, 0).plan.depth, frame.depth_test);
    EXPECT_FALSE(frame.material(1, 0).plan.depth) << "the owner decides for further lights";
    return frame.depth_test;
  };
  EXPECT_FALSE(tested(Effects::derived)) << "the two share an edge, and no pixel";
  EXPECT_TRUE(tested(Effects::all));
  for (ScreenVertex& vertex : geometry.triangles[1].vertices) vertex.x += kSubpixels;
  EXPECT_TRUE(tested(Effects::derived));
  for (ScreenTriangle& triangle : geometry.triangles) {
    for (ScreenVertex& vertex : triangle.vertices) vertex.x += 12 * kSubpixels;
  }
  EXPECT_FALSE(tested(Effects::derived)) << "what overlaps is outside the image";
}

TEST(FrameSetup, DepthSpansTheTriangles) {
  Random random(1);
  const Scene scene = lit_scene(64, 64);
  Geometry geometry = random_geometry(random, scene, 3, 20);
  for (ScreenTriangle& triangle : geometry.triangles) {
    for (ScreenVertex& vertex : triangle.vertices) vertex.z = 5;
  }
  FrameConfiguration configuration;
  configuration.depth_bits = 16;
  EXPECT_EQ(FrameSetup(scene, geometry, configuration).depth_scale, 0);
  geometry.triangles[1].vertices[2].z = 3;
  geometry.triangles[2].vertices[0].z = 7;
  const FrameSetup frame(scene, geometry, configuration);
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

TEST(IsGrey, AsksTheCuesColor) {
  Scene scene = lit_scene(8, 8);
  scene.depth_cue = DepthCue{1, 2, Color::Constant(0.5)};
  EXPECT_TRUE(is_grey(scene, one_material(Material())));
  scene.depth_cue->color = Color(0.5, 0.5, 0.4);
  EXPECT_FALSE(is_grey(scene, one_material(Material())));
}

TEST(SuitScene, BuildsTheBlocksTheSceneNeeds) {
  struct Case {
    double diffuse, specular;
    bool depth_cue;
  };
  for (const auto& [diffuse, specular, depth_cue] :
       {Case{0.5, 0.5, false}, {0.5, 0, false}, {0, 0.5, true}, {0, 0, true}, {0, 0, false}}) {
    Scene scene = lit_scene(8, 8);
    if (depth_cue) scene.depth_cue = DepthCue{1, 2, Color::Zero()};
    const Geometry geometry = one_material(grey_material(diffuse, specular, 20));
    const FrameConfiguration suited = with_derived_blocks({}, scene, geometry);
    EXPECT_EQ(suited.diffuse, diffuse > 0);
    EXPECT_EQ(suited.specular, specular > 0);
    EXPECT_EQ(suited.depth_cue, depth_cue);
    EXPECT_NO_THROW(suited.check());
    const FrameConfiguration all = with_derived_blocks({}, scene, geometry, Effects::all);
    EXPECT_TRUE(all.diffuse && all.specular && all.depth_cue);
    EXPECT_EQ(all.gate, suited.gate);
    EXPECT_NO_THROW(all.check());
  }
}

TEST(SuitScene, WhatNoLightShowsIsLeftOut) {
  Scene scene = lit_scene(8, 8);
  scene.lights[0].color = Color(0, 1, 1);
  Material red = grey_material(0, 0, 20);
  red.diffuse = red.specular = Color(0.5, 0, 0);
  FrameConfiguration suited = with_derived_blocks({}, scene, one_material(red));
  EXPECT_FALSE(suited.diffuse || suited.specular);
  scene.lights.emplace_back();  // white
  suited = with_derived_blocks({}, scene, one_material(red));
  EXPECT_TRUE(suited.diffuse && suited.specular);
}

TEST(SuitScene, GivesTheGateASeriesWhereDiffuseCannotTell) {
  Scene scene = lit_scene(8, 8);
  const auto gate = [&scene](const Geometry& geometry, GateSource chosen) {
    FrameConfiguration configuration;
    configuration.gate = chosen;
    return with_derived_blocks(configuration, scene, geometry).gate;
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

// Twice the width of the narrowest highlight must fit above full scale.
TEST(SuitScene, GivesNarrowHighlightsGuardBits) {
  const Scene scene = lit_scene(8, 8);
  const auto guard_bits = [&scene](RomLayout layout, const Material& material) {
    FrameConfiguration configuration;
    configuration.rom_layout = layout;
    return with_derived_blocks(configuration, scene, one_material(material)).specular_guard_bits;
  };
  for (const auto& [shininess, bits] :
       {std::pair{1.0, 4}, {20.0, 4}, {40.0, 8}, {400.0, 8}, {10'000.0, 12}}) {
    const Material material = grey_material(0.5, 0.5, shininess);
    EXPECT_EQ(guard_bits(RomLayout::bipartite, material), bits) << shininess;
    EXPECT_EQ(guard_bits(RomLayout::plain, material), kGuardBits) << shininess;
  }
  EXPECT_EQ(guard_bits(RomLayout::octave, grey_material(0.5, 0, 10'000)), 4) << "no highlight";
}

TEST(FrameSetup, OctaveLayoutsRefuseAShininessTheyCannotHold) {
  const Scene scene = lit_scene(8, 8);
  const auto set_up = [&scene](double specular, double shininess) {
    FrameConfiguration configuration;
    configuration.rom_layout = RomLayout::octave;
    const Geometry geometry = one_material(grey_material(0.5, specular, shininess));
    FrameSetup(scene, geometry, with_derived_blocks(configuration, scene, geometry));
  };
  for (const double legal : {0.0, 0.5, 1.0, 10'000.0}) EXPECT_NO_THROW(set_up(0.5, legal)) << legal;
  for (const double refused : {0.3, 20'000.0, 1e30}) {
    EXPECT_THROW(set_up(0.5, refused), InputError) << refused;
    EXPECT_NO_THROW(set_up(0, refused)) << "no highlight";
  }
}

// A matt material's shininess must not widen its series, which all hardware has.
TEST(FrameSetup, MattMaterialsOfAnyShininessFitWithEveryEffect) {
  RandomEffects effects;
  Random random(5);
  effects = random_effects(random);
  effects.configuration.rom_layout = RomLayout::bipartite;
  for (Material& material : effects.geometry.materials) {
    material.specular = Color::Zero();
    material.shininess = 1e6;
  }
  effects.geometry.materials[0].specular = Color::Ones();
  effects.geometry.materials[0].shininess = 20;
  const FrameSetup frame(
      effects.scene, effects.geometry,
      with_derived_blocks(effects.configuration, effects.scene, effects.geometry, Effects::all),
      Effects::all);
  EXPECT_EQ(run_model(frame).triangles.overflows, 0U);
}

}  // namespace
}  // namespace phongpipe
