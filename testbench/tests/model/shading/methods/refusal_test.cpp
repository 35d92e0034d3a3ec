// What each method cannot render, it refuses with the reason.
#include <gtest/gtest.h>

#include <set>

#include "testbench/tests/model/shading/methods/triangles.h"

namespace phongpipe {
namespace {

using Names = std::set<std::string_view>;

Names renderers(const OneTriangle& t) {
  Names names;
  for (const ShadingMethod& method : shading_methods()) {
    if (!refusal(method, t.scene, {t.material})) names.insert(method.name);
  }
  return names;
}

std::string reason(const char* method, const OneTriangle& t) {
  return refusal(*find_shading_method(method), t.scene, {t.material}).value_or("");
}

TEST(Refusal, NamesAreUnique) {
  Names names;
  for (const ShadingMethod& method : shading_methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_EQ(find_shading_method(method.name), &method);
  }
  EXPECT_EQ(find_shading_method("toon"), nullptr);
}

TEST(Refusal, TheHighlightsFormDecides) {
  OneTriangle t;
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong", "duff", "duff-table", "taylor",
                                 "taylor-local", "otm", "otm-halfway", "reflection", "duff-blinn",
                                 "reflection-blinn", "six-point", "six-point-local", "weighted",
                                 "weighted-local", "focused", "focused-local"}));
  EXPECT_EQ(reason("hybrid", t), "its highlight is R·V, the scene's N·H");
  t.scene.shading.highlight = Highlight::reflection;
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong", "hybrid", "duff-eq17", "duff-eq33",
                                 "duff-eq34", "reflection-hybrid", "reflection-eq34",
                                 "point-reflection", "viewpoint-reflection"}));
  EXPECT_EQ(reason("taylor", t), "its highlight is N·H, the scene's R·V");
}

TEST(Refusal, LocalViewer) {
  OneTriangle t;
  t.eye_at(Vec3(0, 0, 100));
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong", "taylor-local", "six-point-local",
                                 "weighted-local", "focused-local"}));
  EXPECT_EQ(reason("otm", t), "it has the eye at infinity, the scene a local viewer");
  t.scene.shading.highlight = Highlight::reflection;
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong", "viewpoint-reflection"}));
}

TEST(Refusal, WithoutHighlightsTheViewerDoesNotMatter) {
  OneTriangle t;
  t.eye_at(Vec3(0, 0, 100));
  t.material.specular = Color::Zero();
  EXPECT_EQ(renderers(t).size(), shading_methods().size() - 1);
  EXPECT_EQ(reason("spot-reflection", t), "it has spot lights, the scene a directional light");
}

TEST(Refusal, Lights) {
  OneTriangle t;
  t.scene.shading.highlight = Highlight::reflection;
  t.scene.lights[0].type = LightType::point;
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong", "point-reflection"}));
  t.scene.lights[0].attenuation = {1, 0, 0.01};
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong"}));
  EXPECT_EQ(reason("point-reflection", t),
            "it never computes the light's distance, by which the scene's light fades");
  t.scene.lights[0] = Light();
  t.scene.lights[0].type = LightType::spot;
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong", "spot-reflection"}));
  t.scene.lights.assign(2, Light());
  EXPECT_EQ(renderers(t), (Names{"flat", "gouraud", "phong"}));
  EXPECT_EQ(reason("duff-eq34", t), "it has one light, the scene has 2");
}

}  // namespace
}  // namespace phongpipe
