#include "model/scene/scene_objects.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "model/scene/input_error.h"
#include "model/scene/primitives.h"
#include "model/scene/scene_values.h"

namespace phongpipe {
namespace {

constexpr int kMaxSegments = 65536;
constexpr std::size_t kMaxPrimitiveTriangles = std::size_t{1} << 22;

void read_primitive(const TomlTable& table, Object& object) {
  object.source = Object::Source::primitive;
  object.name = table.text("primitive");
  const Primitive* primitive = find_primitive(object.name);
  if (primitive == nullptr) {
    std::vector<std::string_view> names;
    for (const Primitive& known : primitives()) {
      names.push_back(known.name);
    }
    table.fail("primitive", fmt::format("primitive is '{}', must be one of: {}", object.name,
                                        fmt::join(names, ", ")));
  }
  if (!table.has("segments")) {
    return;
  }
  object.segments = table.integer_pair("segments", 1, kMaxSegments);
  const Segments& least = primitive->min_segments;
  if (object.segments[0] < least[0] || object.segments[1] < least[1]) {
    table.fail("segments", fmt::format("segments of a {} must be at least [{}, {}]", object.name,
                                       least[0], least[1]));
  }
  if (primitive->triangles(object.segments) > kMaxPrimitiveTriangles) {
    table.fail("segments",
               fmt::format("segments make {} triangles, must be at most {}",
                           primitive->triangles(object.segments), kMaxPrimitiveTriangles));
  }
}

void read_file_name(const TomlTable& table, std::string_view key, Object& object) {
  object.name = table.text(key);
  object.file = table.file().parent_path() / object.name;
  std::error_code ignored;
  if (!std::filesystem::exists(object.file, ignored)) {
    table.fail(key, fmt::format("{} file '{}' does not exist", key, object.file.string()));
  }
  if (std::filesystem::is_directory(object.file, ignored)) {
    table.fail(key, fmt::format("{} '{}' is a directory", key, object.file.string()));
  }
}

void read_placement(const TomlTable& table, Object& object) {
  if (object.source == Object::Source::triangle_file) {
    for (const std::string_view key : {"translate", "rotate_degrees", "scale"}) {
      table.refuse(key, "screen-space triangles stay where they are");
    }
    return;
  }
  object.translate = vector(table, "translate", object.translate);
  object.rotate_degrees = vector(table, "rotate_degrees", object.rotate_degrees);
  object.scale = table.number("scale", kSize, object.scale);
}

Object read_object(const TomlTable& table, const std::set<std::string>& materials) {
  Object object;
  object.line = table.line();
  if (table.has("mesh") + table.has("primitive") + table.has("triangles") != 1) {
    throw InputError(table.file(), table.line(),
                     "[[object]] needs exactly one of 'mesh', 'primitive' and 'triangles'");
  }
  if (table.has("primitive")) {
    read_primitive(table, object);
  } else {
    table.refuse("segments", "only a primitive has them");
    const bool mesh = table.has("mesh");
    object.source = mesh ? Object::Source::mesh_file : Object::Source::triangle_file;
    read_file_name(table, mesh ? "mesh" : "triangles", object);
  }
  read_placement(table, object);
  if (table.has("material")) {
    object.material = table.text("material");
    if (materials.count(*object.material) == 0) {
      table.fail("material",
                 materials.empty()
                     ? fmt::format("material '{0}' is not defined, add a table [material.{0}]",
                                   *object.material)
                     : fmt::format("material '{}' is not defined, known are: {}", *object.material,
                                   fmt::join(materials, ", ")));
    }
  }
  table.finish();
  return object;
}

}  // namespace

std::vector<Object> read_objects(const TomlTable& root, const std::vector<Material>& materials) {
  std::set<std::string> names;
  for (const Material& material : materials) {
    names.insert(material.name);
  }
  std::vector<Object> objects;
  for (const TomlTable& table : root.tables("object")) {
    objects.push_back(read_object(table, names));
    if (objects.back().source != objects.front().source &&
        (objects.back().source == Object::Source::triangle_file ||
         objects.front().source == Object::Source::triangle_file)) {
      throw InputError(table.file(), table.line(),
                       "screen-space triangles cannot be mixed with meshes or primitives");
    }
  }
  return objects;
}

}  // namespace phongpipe
