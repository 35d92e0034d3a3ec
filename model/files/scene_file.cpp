#include "model/files/scene_file.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "model/files/meshes/mesh_format.h"
#include "model/files/scene_objects.h"
#include "model/files/scene_values.h"
#include "model/files/toml_reader.h"

namespace phongpipe {
namespace {

Image read_image(const TomlTable& table) {
  Image image;
  image.width = table.integer("width", 1, kMaxImageSize);
  image.height = table.integer("height", 1, kMaxImageSize);
  image.background = color(table, "background", Color::Zero());
  table.finish();
  return image;
}

Camera read_camera(const TomlTable& table) {
  Camera camera;
  camera.projection = table.choice<Projection>(
      "projection",
      {{"perspective", Projection::perspective}, {"orthographic", Projection::orthographic}},
      Projection::perspective);
  camera.eye = vector(table, "eye");
  camera.target = vector(table, "target");
  camera.up = vector(table, "up", Vec3::UnitY());
  const Vec3 view = camera.target - camera.eye;
  if (view.norm() < kShortestVector) {
    table.fail("target", "eye and target must not be the same point");
  }
  if (camera.up.norm() < kShortestVector) {
    table.fail("up", "up must not be zero");
  }
  if (camera.up.normalized().cross(view.normalized()).norm() < 1e-6) {
    table.fail("up", "up must not be parallel to the view from eye to target");
  }
  if (camera.projection == Projection::perspective) {
    table.refuse("vertical_extent", "a perspective camera has vertical_fov_degrees");
    camera.vertical_fov_degrees = table.number("vertical_fov_degrees", {0.01, 179});
  } else {
    table.refuse("vertical_fov_degrees", "an orthographic camera has vertical_extent");
    camera.vertical_extent = table.number("vertical_extent", kSize);
  }
  table.finish();
  return camera;
}

Shading read_shading(const TomlTable& table) {
  Shading shading;
  shading.viewer = table.choice<Viewer>(
      "viewer", {{"infinite", Viewer::infinite}, {"local", Viewer::local}}, shading.viewer);
  shading.highlight = table.choice<Highlight>(
      "highlight", {{"halfway", Highlight::halfway}, {"reflection", Highlight::reflection}},
      shading.highlight);
  shading.ambient_light = color(table, "ambient_light", shading.ambient_light);
  table.finish();
  return shading;
}

Light read_light(const TomlTable& table) {
  Light light;
  light.type = table.choice<LightType>("type", {{"directional", LightType::directional},
                                                {"point", LightType::point},
                                                {"spot", LightType::spot}});
  if (light.type == LightType::point) {
    table.refuse("direction", "a point light shines all round");
  } else {
    light.direction = unit_vector(table, "direction");
  }
  if (light.type == LightType::directional) {
    table.refuse("position", "a directional light is at infinity");
    table.refuse("attenuation", "a directional light is at infinity");
  } else {
    light.position = vector(table, "position");
    if (table.has("attenuation")) {
      light.attenuation = table.triple("attenuation", kNotNegative);
      if (light.attenuation == std::array<double, 3>{0, 0, 0}) {
        table.fail("attenuation", "attenuation must not be all zero");
      }
    }
  }
  if (light.type == LightType::spot) {
    light.spot_exponent = table.number("spot_exponent", kNotNegative, light.spot_exponent);
    light.spot_cutoff_degrees =
        table.number("spot_cutoff_degrees", {0.01, 90}, light.spot_cutoff_degrees);
  } else {
    table.refuse("spot_exponent", "only a spot light has one");
    table.refuse("spot_cutoff_degrees", "only a spot light has one");
  }
  light.color = color(table, "color", light.color);
  table.finish();
  return light;
}

DepthCue read_depth_cue(const TomlTable& table) {
  DepthCue cue;
  cue.near = table.number("near", kCoordinate);
  cue.far = table.number("far", kCoordinate);
  if (cue.near >= cue.far) {
    table.fail("far", "far must be greater than near");
  }
  cue.color = color(table, "color", cue.color);
  table.finish();
  return cue;
}

Scene read_scene(const TomlTable& root) {
  // Known before the first error, so that "did you mean" has all words.
  for (const char* key :
       {"image", "camera", "shading", "light", "object", "material", "depth_cue"}) {
    root.has(key);
  }
  root.finish();
  Scene scene;
  scene.source = root.file().string();
  scene.image = read_image(root.table("image"));
  for (const auto& [name, table] : root.named_tables("material")) {
    scene.materials.push_back(read_material(name, table));
  }
  scene.objects = read_objects(root, scene.materials, scene.image);
  if (const auto shading = root.optional_table("shading")) {
    scene.shading = read_shading(*shading);
    if (is_screen_space(scene) && scene.shading.viewer == Viewer::local) {
      shading->fail("viewer",
                    "screen-space triangles have the eye at infinity, viewer cannot be 'local'");
    }
  }
  if (is_screen_space(scene)) {
    root.refuse("camera", "screen-space triangles need no camera");
  } else {
    scene.camera = read_camera(root.table("camera"));
  }
  for (const TomlTable& table : root.tables("light")) {
    scene.lights.push_back(read_light(table));
  }
  if (const auto cue = root.optional_table("depth_cue")) {
    scene.depth_cue = read_depth_cue(*cue);
  }
  return scene;
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  if (is_mesh(file)) {
    throw InputError(file, 0,
                     fmt::format("a mesh, not a scene: write a scene with camera, lights and "
                                 "[[object]] mesh = \"{}\"",
                                 file.filename().string()));
  }
  return read_scene(TomlTable::read_file(file, overrides));
}

Scene parse_scene(const std::string& text, const std::filesystem::path& source) {
  return read_scene(TomlTable::read_text(text, source));
}

}  // namespace phongpipe
