#include "model/files/scene_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "model/files/mesh_file.h"
#include "model/files/scene_values.h"
#include "model/files/triangle_csv.h"
#include "model/scene/input_error.h"
#include "model/scene/primitives.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

constexpr int kMaxSegments = 65536;

void read_primitive(const TomlTable& table, Object& object) {
  object.primitive = table.text("primitive");
  const Primitive* primitive = find_primitive(object.primitive);
  if (primitive == nullptr) {
    std::vector<std::string_view> names;
    for (const Primitive& known : primitives()) {
      names.push_back(known.name);
    }
    table.fail("primitive", fmt::format("primitive is '{}', must be one of: {}", object.primitive,
                                        fmt::join(names, ", ")));
  }
  if (!table.has("segments")) {
    return;
  }
  object.segments = table.integer_pair("segments", 1, kMaxSegments);
  const Segments& least = primitive->min_segments;
  if (object.segments[0] < least[0] || object.segments[1] < least[1]) {
    table.fail("segments", fmt::format("segments of a {} must be at least [{}, {}]",
                                       object.primitive, least[0], least[1]));
  }
  if (primitive->triangles(object.segments) > kMaxMeshTriangles) {
    table.fail("segments", fmt::format("segments make {} triangles, must be at most {}",
                                       primitive->triangles(object.segments), kMaxMeshTriangles));
  }
}

// vertices = [[x, y, z, nx, ny, nz], …], faces = [[a, b, c, material], …], whose materials are the
// tables [[object.face_materials]].
Mesh read_mesh(const TomlTable& table) {
  Mesh mesh;
  for (const std::vector<double>& v : table.rows("vertices", 6, kCoordinate)) {
    mesh.positions.emplace_back(v[0], v[1], v[2]);
    const Vec3 normal(v[3], v[4], v[5]);
    if (normal.norm() < kShortestVector) {
      table.fail("vertices", fmt::format("the normal of vertex {} is zero", mesh.normals.size()));
    }
    constexpr double kUnit = 1e-12;  // what we wrote keeps its last bits
    mesh.normals.push_back(std::abs(normal.norm() - 1) > kUnit ? Vec3(normal.normalized())
                                                               : normal);
  }
  if (table.has("face_materials")) {
    for (const TomlTable& material : table.tables("face_materials")) {
      mesh.materials.push_back(read_material(material.text("name"), material));
    }
  }
  const std::size_t materials = std::max<std::size_t>(mesh.materials.size(), 1);
  for (const std::vector<double>& f : table.rows("faces", 4, {0, 1e9})) {
    if (std::any_of(f.begin(), f.end(), [](double index) { return index != std::floor(index); })) {
      table.fail("faces", fmt::format("face {}: [{:g}, {:g}, {:g}, {:g}], must be whole numbers",
                                      mesh.faces.size(), f[0], f[1], f[2], f[3]));
    }
    MeshFace face;
    for (std::size_t i = 0; i < 3; ++i) face.vertices[i] = static_cast<std::uint32_t>(f[i]);
    face.material = static_cast<std::uint32_t>(f[3]);
    const bool known = std::all_of(face.vertices.begin(), face.vertices.end(),
                                   [&](auto vertex) { return vertex < mesh.positions.size(); });
    if (!known || face.material >= materials) {
      table.fail(
          "faces",
          fmt::format("face {}: [{:g}, {:g}, {:g}, {:g}] names a vertex or a material that "
                      "is not there: vertices go from 0 to {}, materials from 0 to {}",
                      mesh.faces.size(), f[0], f[1], f[2], f[3],
                      static_cast<std::ptrdiff_t>(mesh.positions.size()) - 1, materials - 1));
    }
    mesh.faces.push_back(face);
  }
  return mesh;
}

fs::path existing_file(const TomlTable& table, std::string_view key) {
  fs::path file = table.file().parent_path() / table.text(key);
  std::error_code ignored;
  if (!fs::exists(file, ignored)) {
    table.fail(key, fmt::format("{} file '{}' does not exist", key, file.string()));
  }
  if (fs::is_directory(file, ignored)) {
    table.fail(key, fmt::format("{} '{}' is a directory", key, file.string()));
  }
  return file;
}

void read_placement(const TomlTable& table, Object& object) {
  if (table.has("triangles") || table.has("triangle_rows")) {
    for (const std::string_view key : {"translate", "rotate_degrees", "scale"}) {
      table.refuse(key, "screen-space triangles stay where they are");
    }
    return;
  }
  object.translate = vector(table, "translate", object.translate);
  object.rotate_degrees = vector(table, "rotate_degrees", object.rotate_degrees);
  object.scale = table.number("scale", kSize, object.scale);
}

// Reads each mesh file once, however many objects show it.
class ObjectReader {
 public:
  ObjectReader(const std::set<std::string>& materials, const Image& image)
      : materials_(materials), image_(image) {}

  Object read(const TomlTable& table);

 private:
  const std::set<std::string>& materials_;  // names
  const Image& image_;
  std::map<fs::path, std::shared_ptr<const Mesh>> meshes_;
};

Object ObjectReader::read(const TomlTable& table) {
  Object object;
  fs::path file;
  const bool in_file = table.has("mesh") || table.has("triangles");
  if (table.has("mesh") + table.has("primitive") + table.has("triangles") + table.has("vertices") +
          table.has("triangle_rows") !=
      1) {
    throw InputError(table.file(), table.line(),
                     "[[object]] needs exactly one of 'mesh', 'primitive', 'triangles', 'vertices' "
                     "and 'triangle_rows'");
  }
  if (table.has("primitive")) {
    read_primitive(table, object);
  } else {
    table.refuse("segments", "only a primitive has them");
  }
  if (table.has("vertices")) object.mesh = std::make_shared<const Mesh>(read_mesh(table));
  if (table.has("triangle_rows")) {
    object.screen_triangles =
        std::make_shared<const std::vector<ScreenTriangle>>(parse_triangle_csv(
            table.text("triangle_rows"), table.file(), image_, table.line("triangle_rows")));
  }
  if (in_file) {
    file = existing_file(table, table.has("mesh") ? "mesh" : "triangles");
  }
  read_placement(table, object);
  if (table.has("material")) {
    object.material = table.text("material");
    if (materials_.count(*object.material) == 0) {
      table.fail("material",
                 materials_.empty()
                     ? fmt::format("material '{0}' is not defined, add a table [material.{0}]",
                                   *object.material)
                     : fmt::format("material '{}' is not defined, known are: {}", *object.material,
                                   fmt::join(materials_, ", ")));
    }
  }
  table.finish();
  if (table.has("mesh")) {
    std::shared_ptr<const Mesh>& mesh = meshes_[file];
    if (!mesh) mesh = std::make_shared<const Mesh>(load_mesh(file));
    object.mesh = mesh;
  } else if (table.has("triangles")) {
    object.screen_triangles =
        std::make_shared<const std::vector<ScreenTriangle>>(read_triangle_csv(file, image_));
  }
  return object;
}

}  // namespace

std::vector<Object> read_objects(const TomlTable& root, const std::vector<Material>& materials,
                                 const Image& image) {
  std::set<std::string> names;
  for (const Material& material : materials) {
    names.insert(material.name);
  }
  ObjectReader reader(names, image);
  std::vector<Object> objects;
  for (const TomlTable& table : root.tables("object")) {
    objects.push_back(reader.read(table));
    if (!objects.back().screen_triangles != !objects.front().screen_triangles) {
      throw InputError(table.file(), table.line(),
                       "screen-space triangles cannot be mixed with meshes or primitives");
    }
  }
  return objects;
}

}  // namespace phongpipe
