#include "model/files/scene_file.h"

#include <gtest/gtest.h>

#include "testbench/tests/model/scene/scene_files.h"

namespace phongpipe {
namespace {

// Line 1 is [image]; each table below it starts at the line its name says.
const std::string kImage = "[image]\nwidth = 64\nheight = 48\n";
const std::string kCameraAt4 =
    "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\nvertical_fov_degrees = 40\n";
const std::string kLightAt8 = "[[light]]\ntype = \"directional\"\ndirection = [0, 0, -2]\n";
const std::string kObjectAt11 = "[[object]]\nprimitive = \"sphere\"\n";
const std::string kHead = kImage + kCameraAt4 + kLightAt8;
const std::string kGood = kHead + kObjectAt11;
const std::string kMaterial =
    "[material.red]\nambient = 0.1\ndiffuse = [1, 0, 0]\nspecular = 0.5\nshininess = 20\n";

class SceneFile : public ::testing::Test {
 protected:
  Scene load(const std::string& text) { return load_scene(folder_.write("s.toml", text)); }
  std::string error(const std::string& text) {
    return error_of(folder_, [&] { load(text); });
  }
  TempFolder folder_;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(SceneFile, SmallestSceneHasDefaults) {
  const Scene scene = load(kGood);
  EXPECT_EQ(scene.image.width, 64);
  EXPECT_EQ(scene.image.height, 48);
  EXPECT_TRUE((scene.image.background == 0).all());
  EXPECT_EQ(scene.camera.projection, Projection::perspective);
  EXPECT_EQ(scene.camera.up, Vec3(0, 1, 0));
  EXPECT_EQ(scene.shading.viewer, Viewer::infinite);
  EXPECT_EQ(scene.shading.highlight, Highlight::halfway);
  ASSERT_EQ(scene.lights.size(), 1U);
  EXPECT_EQ(scene.lights[0].direction, Vec3(0, 0, -1)) << "made unit";
  ASSERT_EQ(scene.objects.size(), 1U);
  EXPECT_FALSE(scene.objects[0].material);
  EXPECT_FALSE(scene.depth_cue);
  EXPECT_FALSE(is_screen_space(scene));
}

TEST_F(SceneFile, EveryKeyIsRead) {
  const Scene scene = load(
      "[image]\nwidth=1\nheight=4096\nbackground=[0, 0.5, 1]\n"
      "[camera]\nprojection='orthographic'\neye=[1,2,3]\ntarget=[0,0,1]\nup=[0,0,2]\n"
      "vertical_extent=7\n"
      "[shading]\nviewer='local'\nhighlight='reflection'\nambient_light=0.25\n"
      "[[light]]\ntype='spot'\ndirection=[3,0,4]\nposition=[1,1,1]\ncolor=[1,0.5,0]\n"
      "attenuation=[1,2,3]\nspot_exponent=8\nspot_cutoff_degrees=30\n"
      "[[object]]\nprimitive='torus'\nsegments=[5,6]\ntranslate=[1,2,3]\n"
      "rotate_degrees=[10,20,30]\nscale=2\nmaterial='red'\n" +
      kMaterial + "[depth_cue]\nnear=1\nfar=9\ncolor=0.5\n");
  EXPECT_EQ(scene.image.background[1], 0.5);
  EXPECT_EQ(scene.camera.projection, Projection::orthographic);
  EXPECT_EQ(scene.camera.vertical_extent, 7);
  EXPECT_EQ(scene.shading.viewer, Viewer::local);
  EXPECT_EQ(scene.shading.highlight, Highlight::reflection);
  EXPECT_EQ(scene.shading.ambient_light[2], 0.25);
  const Light& light = scene.lights.at(0);
  EXPECT_TRUE(light.direction.isApprox(Vec3(0.6, 0, 0.8), 1e-15));
  EXPECT_EQ(light.attenuation, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(light.spot_exponent, 8);
  EXPECT_EQ(light.spot_cutoff_degrees, 30);
  const Object& object = scene.objects.at(0);
  EXPECT_EQ(object.segments, (std::array<int, 2>{5, 6}));
  EXPECT_EQ(object.rotate_degrees, Vec3(10, 20, 30));
  EXPECT_EQ(object.scale, 2);
  EXPECT_EQ(object.material, "red");
  EXPECT_EQ(scene.materials.at(0).diffuse[0], 1);
  EXPECT_EQ(scene.materials.at(0).specular[2], 0.5);
  ASSERT_TRUE(scene.depth_cue);
  EXPECT_EQ(scene.depth_cue->far, 9);
}

TEST_F(SceneFile, FilesThatAreNone) {
  EXPECT_EQ(error(""), "s.toml: the file is empty");
  EXPECT_EQ(error_of(folder_, [&] { load_scene(folder_.path() / "none.toml"); }),
            "none.toml: no such file");
  std::filesystem::create_directory(folder_.path() / "d");
  EXPECT_EQ(error_of(folder_, [&] { load_scene(folder_.path() / "d"); }),
            "d: is a directory, not a file");
}

TEST_F(SceneFile, BrokenTomlNamesItsLine) {
  EXPECT_EQ(error("[image]\nwidth = \n").substr(0, 9), "s.toml:2:");
  EXPECT_EQ(error(kGood + "[image]\n").substr(0, 10), "s.toml:13:") << "a table given twice";
}

struct BadScene {
  const char* name;
  std::string text;
  std::string message;
};

class BadSceneFile : public ::testing::TestWithParam<BadScene> {};

TEST_P(BadSceneFile, IsRefusedInOneLine) {
  const TempFolder folder;
  const auto file = folder.write("s.toml", GetParam().text);
  EXPECT_EQ(error_of(folder, [&] { load_scene(file); }), GetParam().message);
}

const std::vector<BadScene> kBadImages = {
    {"missing_image", replaced(kGood, kImage, ""), "s.toml: missing table [image]"},
    {"missing_width", replaced(kGood, "width = 64\n", ""), "s.toml:1: [image] needs 'width'"},
    {"misspelt_width", replaced(kGood, "width", "widht"),
     "s.toml:2: unknown key 'widht', did you mean 'width'?"},
    {"width_0", replaced(kGood, "width = 64", "width = 0"),
     "s.toml:2: width is 0, must be from 1 to 4096"},
    {"width_4097", replaced(kGood, "width = 64", "width = 4097"),
     "s.toml:2: width is 4097, must be from 1 to 4096"},
    {"width_real", replaced(kGood, "width = 64", "width = 64.5"),
     "s.toml:2: width must be a whole number"},
    {"unknown_key", replaced(kGood, "height = 48\n", "height = 48\nfrobnicate = 1\n"),
     "s.toml:4: unknown key 'frobnicate' in [image], known are: background, height, width"},
    {"background_range", replaced(kGood, "height = 48\n", "height = 48\nbackground = [0, 2, 0]\n"),
     "s.toml:4: background[1] is 2, must be from 0 to 1"},
    {"background_pair", replaced(kGood, "height = 48\n", "height = 48\nbackground = [0, 2]\n"),
     "s.toml:4: background must be three numbers, such as [0, 0, 1]"},
    {"background_text", replaced(kGood, "height = 48\n", "height = 48\nbackground = 'red'\n"),
     "s.toml:4: background must be [red, green, blue] or one number, from 0 to 1"},
    {"unknown_table", kGood + "[lihgt]\n", "s.toml:13: unknown key 'lihgt', did you mean 'light'?"},
    {"image_no_table", "image = 3\n" + replaced(kGood, kImage, ""),
     "s.toml:1: 'image' must be a table, written [image]"},
};

const std::vector<BadScene> kBadCameras = {
    {"missing_camera", kImage + kLightAt8 + kObjectAt11, "s.toml: missing table [camera]"},
    {"projection", replaced(kGood, "[camera]\n", "[camera]\nprojection = 'fisheye'\n"),
     "s.toml:5: projection is 'fisheye', must be one of: perspective, orthographic"},
    {"eye_nan", replaced(kGood, "eye = [0, 0, 5]", "eye = [0, nan, 5]"),
     "s.toml:5: eye[1] must be finite"},
    {"eye_inf", replaced(kGood, "eye = [0, 0, 5]", "eye = [0, 0, inf]"),
     "s.toml:5: eye[2] must be finite"},
    {"eye_is_target", replaced(kGood, "eye = [0, 0, 5]", "eye = [0, 0, 0]"),
     "s.toml:6: eye and target must not be the same point"},
    {"up_parallel", replaced(kGood, "[camera]\n", "[camera]\nup = [0, 0, 1]\n"),
     "s.toml:5: up must not be parallel to the view from eye to target"},
    {"up_zero", replaced(kGood, "[camera]\n", "[camera]\nup = [0, 0, 0]\n"),
     "s.toml:5: up must not be zero"},
    {"fov_missing", replaced(kGood, "vertical_fov_degrees = 40\n", ""),
     "s.toml:4: [camera] needs 'vertical_fov_degrees'"},
    {"fov_180", replaced(kGood, "= 40", "= 180"),
     "s.toml:7: vertical_fov_degrees is 180, must be from 0.01 to 179"},
    {"fov_text", replaced(kGood, "= 40", "= '40'"),
     "s.toml:7: vertical_fov_degrees must be a number"},
    {"extent_in_perspective", replaced(kGood, "= 40", "= 40\nvertical_extent = 2"),
     "s.toml:8: 'vertical_extent' does not belong here: a perspective camera has "
     "vertical_fov_degrees"},
    {"fov_in_orthographic", replaced(kGood, "[camera]\n", "[camera]\nprojection='orthographic'\n"),
     "s.toml:8: 'vertical_fov_degrees' does not belong here: an orthographic camera has "
     "vertical_extent"},
};

const std::vector<BadScene> kBadLights = {
    {"no_light", kImage + kCameraAt4 + kObjectAt11, "s.toml: missing table [[light]]"},
    {"light_single", replaced(kGood, "[[light]]", "[light]"),
     "s.toml:8: 'light' must be tables, written [[light]]"},
    {"light_type", replaced(kGood, "\"directional\"", "\"laser\""),
     "s.toml:9: type is 'laser', must be one of: directional, point, spot"},
    {"direction_zero", replaced(kGood, "[0, 0, -2]", "[0, 0, 0]"),
     "s.toml:10: direction must not be zero"},
    {"direction_missing", replaced(kGood, "direction = [0, 0, -2]\n", ""),
     "s.toml:8: [[light]] needs 'direction'"},
    {"position_of_directional", replaced(kGood, "[0, 0, -2]", "[0, 0, -2]\nposition = [0, 0, 0]"),
     "s.toml:11: 'position' does not belong here: a directional light is at infinity"},
    {"direction_of_point", replaced(kGood, "\"directional\"", "\"point\""),
     "s.toml:10: 'direction' does not belong here: a point light shines all round"},
    {"position_missing", replaced(kGood, "\"directional\"", "\"spot\""),
     "s.toml:8: [[light]] needs 'position'"},
    {"attenuation_zero",
     replaced(kGood, "\"directional\"\ndirection = [0, 0, -2]",
              "\"point\"\nposition = [0, 0, 2]\nattenuation = [0, 0, 0]"),
     "s.toml:11: attenuation must not be all zero"},
    {"attenuation_negative",
     replaced(kGood, "\"directional\"\ndirection = [0, 0, -2]",
              "\"point\"\nposition = [0, 0, 2]\nattenuation = [0, -1, 0]"),
     "s.toml:11: attenuation[1] is -1, must be from 0 to 1000000000"},
    {"spot_of_directional", replaced(kGood, "[0, 0, -2]", "[0, 0, -2]\nspot_exponent = 2"),
     "s.toml:11: 'spot_exponent' does not belong here: only a spot light has one"},
    {"spot_cutoff",
     replaced(kGood, "\"directional\"", "\"spot\"\nposition = [0,0,1]\nspot_cutoff_degrees = 91"),
     "s.toml:11: spot_cutoff_degrees is 91, must be from 0.01 to 90"},
};

const std::vector<BadScene> kBadObjects = {
    {"no_object", kHead, "s.toml: missing table [[object]]"},
    {"no_source", kHead + "[[object]]\nscale = 1\n",
     "s.toml:11: [[object]] needs exactly one of 'mesh', 'primitive', 'triangles', 'vertices' and "
     "'triangle_rows'"},
    {"two_sources", kGood + "mesh = 'a.obj'\n",
     "s.toml:11: [[object]] needs exactly one of 'mesh', 'primitive', 'triangles', 'vertices' and "
     "'triangle_rows'"},
    {"primitive", replaced(kGood, "\"sphere\"", "\"cube\""),
     "s.toml:12: primitive is 'cube', must be one of: teapot, sphere, torus, pawn, plane"},
    {"segments_least", kGood + "segments = [2, 9]\n",
     "s.toml:13: segments of a sphere must be at least [3, 2]"},
    {"segments_zero", kGood + "segments = [9, 0]\n",
     "s.toml:13: segments[1] is 0, must be from 1 to 65536"},
    {"segments_gigantic", kGood + "segments = [60000, 60001]\n",
     "s.toml:13: segments make 7200000000 triangles, must be at most 4194304"},
    {"segments_of_mesh", kHead + "[[object]]\nmesh = 'x.obj'\nsegments = [3, 3]\n",
     "s.toml:13: 'segments' does not belong here: only a primitive has them"},
    {"scale_zero", kGood + "scale = 0\n",
     "s.toml:13: scale is 0, must be from 1e-09 to 1000000000"},
    {"mesh_missing", kHead + "[[object]]\nmesh = 'x.obj'\n",
     "s.toml:12: mesh file 'x.obj' does not exist"},
    {"material_unknown", kGood + "material = 'blue'\n" + kMaterial,
     "s.toml:13: material 'blue' is not defined, known are: red"},
    {"material_none", kGood + "material = 'blue'\n",
     "s.toml:13: material 'blue' is not defined, add a table [material.blue]"},
    {"material_key", kGood + replaced(kMaterial, "shininess = 20\n", ""),
     "s.toml:13: [material.red] needs 'shininess'"},
    {"material_range", kGood + replaced(kMaterial, "ambient = 0.1", "ambient = 1.1"),
     "s.toml:14: ambient is 1.1, must be from 0 to 1"},
    {"shininess_negative", kGood + replaced(kMaterial, "= 20", "= -1"),
     "s.toml:17: shininess is -1, must be from 0 to 1000000000"},
    {"cue_order", kGood + "[depth_cue]\nnear = 2\nfar = 2\n",
     "s.toml:15: far must be greater than near"},
    {"viewer", kGood + "[shading]\nviewer = 'finite'\n",
     "s.toml:14: viewer is 'finite', must be one of: infinite, local"},
};

const auto kName = [](const auto& info) { return std::string(info.param.name); };
INSTANTIATE_TEST_SUITE_P(Image, BadSceneFile, ::testing::ValuesIn(kBadImages), kName);
INSTANTIATE_TEST_SUITE_P(Camera, BadSceneFile, ::testing::ValuesIn(kBadCameras), kName);
INSTANTIATE_TEST_SUITE_P(Light, BadSceneFile, ::testing::ValuesIn(kBadLights), kName);
INSTANTIATE_TEST_SUITE_P(Object, BadSceneFile, ::testing::ValuesIn(kBadObjects), kName);

TEST_F(SceneFile, ScreenSpaceTrianglesNeedNoCamera) {
  folder_.write("t.csv",
                "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n"
                "1,1,3,0,0,-1,9,1,3,0,0,-1,1,9,3,0,0,-1\n");
  const std::string object = "[[object]]\ntriangles = 't.csv'\n";
  EXPECT_TRUE(is_screen_space(load(kImage + kLightAt8 + object)));
  EXPECT_EQ(error(kImage + kCameraAt4 + kLightAt8 + object),
            "s.toml:4: 'camera' does not belong here: screen-space triangles need no camera");
  EXPECT_EQ(error(kImage + kLightAt8 + object + "scale = 2\n"),
            "s.toml:9: 'scale' does not belong here: screen-space triangles stay where they are");
  EXPECT_EQ(error(kImage + kLightAt8 + object + "[shading]\nviewer = 'local'\n"),
            "s.toml:10: screen-space triangles have the eye at infinity, viewer cannot be 'local'");
  EXPECT_EQ(error(kGood + object),
            "s.toml:13: screen-space triangles cannot be mixed with meshes or primitives");
}

TEST(ShippedScenes, AllLoad) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PHONGPIPE_SCENES)) {
    if (entry.path().extension() == ".toml") {
      EXPECT_NO_THROW(load_scene(entry.path())) << entry.path();
      ++scenes;
    }
  }
  EXPECT_GE(scenes, 7);
}

}  // namespace
}  // namespace phongpipe
