#include "model/files/scene_writer.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

#include "model/scene/geometry.h"
#include "model/scene/mesh.h"

namespace phongpipe {
namespace {

toml::array numbers(std::initializer_list<double> values) {
  toml::array array;
  for (const double value : values) array.push_back(value);
  return array;
}
toml::array numbers(const Vec3& v) {
  return numbers({v.x(), v.y(), v.z()});
}
toml::array numbers(const Color& c) {
  return numbers({c[0], c[1], c[2]});
}

toml::table image_table(const Image& image) {
  return toml::table{
      {"width", image.width}, {"height", image.height}, {"background", numbers(image.background)}};
}

toml::table camera_table(const Camera& camera) {
  toml::table table{
      {"eye", numbers(camera.eye)}, {"target", numbers(camera.target)}, {"up", numbers(camera.up)}};
  if (camera.projection == Projection::perspective) {
    table.insert("projection", "perspective");
    table.insert("vertical_fov_degrees", camera.vertical_fov_degrees);
  } else {
    table.insert("projection", "orthographic");
    table.insert("vertical_extent", camera.vertical_extent);
  }
  return table;
}

toml::table shading_table(const Shading& shading) {
  return toml::table{
      {"viewer", shading.viewer == Viewer::local ? "local" : "infinite"},
      {"highlight", shading.highlight == Highlight::halfway ? "halfway" : "reflection"},
      {"ambient_light", numbers(shading.ambient_light)}};
}

toml::table light_table(const Light& light) {
  toml::table table{{"type", name(light.type)}, {"color", numbers(light.color)}};
  if (light.type != LightType::point) table.insert("direction", numbers(light.direction));
  if (light.type != LightType::directional) {
    table.insert("position", numbers(light.position));
    const auto& [c, l, q] = light.attenuation;
    table.insert("attenuation", numbers({c, l, q}));
  }
  if (light.type == LightType::spot) {
    table.insert("spot_exponent", light.spot_exponent);
    table.insert("spot_cutoff_degrees", light.spot_cutoff_degrees);
  }
  return table;
}

toml::table material_table(const Material& material) {
  return toml::table{{"ambient", numbers(material.ambient)},
                     {"diffuse", numbers(material.diffuse)},
                     {"specular", numbers(material.specular)},
                     {"shininess", material.shininess}};
}

void add_mesh(const Mesh& mesh, toml::table& table) {
  toml::array vertices, faces, materials;
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 &p = mesh.positions[i], &n = mesh.normals[i];
    vertices.push_back(numbers({p.x(), p.y(), p.z(), n.x(), n.y(), n.z()}));
  }
  for (const MeshFace& face : mesh.faces) {
    toml::array corners;
    for (const std::uint32_t vertex : face.vertices) corners.push_back(vertex);
    corners.push_back(face.material);
    faces.push_back(std::move(corners));
  }
  for (const Material& material : mesh.materials) {
    toml::table described = material_table(material);
    described.insert("name", material.name);
    materials.push_back(std::move(described));
  }
  table.insert("vertices", std::move(vertices));
  table.insert("faces", std::move(faces));
  if (!mesh.materials.empty()) table.insert("face_materials", std::move(materials));
}

// As a CSV file has them.
std::string screen_triangles_text(const std::vector<ScreenTriangle>& triangles) {
  std::string text = "x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,x2,y2,z2,nx2,ny2,nz2\n";
  for (const ScreenTriangle& triangle : triangles) {
    std::string row;
    for (const ScreenVertex& v : triangle.vertices) {
      row += fmt::format("{}{},{},{},{},{},{}", row.empty() ? "" : ",", in_pixels(v.x),
                         in_pixels(v.y), v.z, v.normal.x(), v.normal.y(), v.normal.z());
    }
    text += row + "\n";
  }
  return text;
}

toml::table object_table(const Object& object) {
  toml::table table;
  if (object.material) table.insert("material", *object.material);
  if (object.screen_triangles) {
    table.insert("triangle_rows", screen_triangles_text(*object.screen_triangles));
    return table;
  }
  if (object.mesh) {
    add_mesh(*object.mesh, table);
  } else {
    table.insert("primitive", object.primitive);
    if (object.segments != std::array<int, 2>{0, 0}) {
      table.insert("segments", toml::array{object.segments[0], object.segments[1]});
    }
  }
  table.insert("translate", numbers(object.translate));
  table.insert("rotate_degrees", numbers(object.rotate_degrees));
  table.insert("scale", object.scale);
  return table;
}

}  // namespace

std::string scene_toml(const Scene& scene) {
  toml::table root{{"image", image_table(scene.image)}, {"shading", shading_table(scene.shading)}};
  if (!is_screen_space(scene)) root.insert("camera", camera_table(scene.camera));
  toml::array lights, objects;
  for (const Light& light : scene.lights) lights.push_back(light_table(light));
  for (const Object& object : scene.objects) objects.push_back(object_table(object));
  root.insert("light", std::move(lights));
  root.insert("object", std::move(objects));
  toml::table materials;
  for (const Material& material : scene.materials) {
    materials.insert(material.name, material_table(material));
  }
  if (!materials.empty()) root.insert("material", std::move(materials));
  if (scene.depth_cue) {
    const DepthCue& cue = *scene.depth_cue;
    root.insert("depth_cue",
                toml::table{{"near", cue.near}, {"far", cue.far}, {"color", numbers(cue.color)}});
  }
  std::ostringstream text;
  text << root << "\n";
  return text.str();
}

}  // namespace phongpipe
