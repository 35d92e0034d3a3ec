#include "model/files/scene_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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
constexpr std::size_t kMaxPrimitiveTriangles = std::size_t{1} << 22;

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
  if (primitive->triangles(object.segments) > kMaxPrimitiveTriangles) {
    table.fail("segments",
               fmt::format("segments make {} triangles, must be at most {}",
                           primitive->triangles(object.segments), kMaxPrimitiveTriangles));
  }
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
  if (table.has("triangles")) {
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
  if (table.has("mesh") + table.has("primitive") + table.has("triangles") != 1) {
    throw InputError(table.file(), table.line(),
                     "[[object]] needs exactly one of 'mesh', 'primitive' and 'triangles'");
  }
  if (table.has("primitive")) {
    read_primitive(table, object);
  } else {
    table.refuse("segments", "only a primitive has them");
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
