#include "model/files/meshes/gltf_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nettle/base64.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

using Json = GltfDocument::Json;

constexpr std::size_t kMaxDepth = 64;  // of JSON
constexpr std::size_t kMaxBuffers = 1024;
// Extensions that a file may require: what they describe is not drawn (textures, lights), or is
// understood.
constexpr std::array<std::string_view, 4> kKnownExtensions = {
    "KHR_texture_", "EXT_texture_", "KHR_lights_punctual", "KHR_mesh_quantization"};

// The keys that the objects of the format have, besides name, extensions and extras.
const std::map<std::string_view, std::set<std::string_view>> kKeys = {
    {"glTF",
     {"accessors", "animations", "asset", "buffers", "bufferViews", "cameras", "extensionsRequired",
      "extensionsUsed", "images", "materials", "meshes", "nodes", "samplers", "scene", "scenes",
      "skins", "textures"}},
    {"scenes", {"nodes"}},
    {"nodes",
     {"camera", "children", "matrix", "mesh", "rotation", "scale", "skin", "translation",
      "weights"}},
    {"meshes", {"primitives", "weights"}},
    {"primitives", {"attributes", "indices", "material", "mode", "targets"}},
    {"materials",
     {"alphaCutoff", "alphaMode", "doubleSided", "emissiveFactor", "emissiveTexture",
      "normalTexture", "occlusionTexture", "pbrMetallicRoughness"}},
    {"pbrMetallicRoughness",
     {"baseColorFactor", "baseColorTexture", "metallicFactor", "metallicRoughnessTexture",
      "roughnessFactor"}},
    {"accessors",
     {"bufferView", "byteOffset", "componentType", "count", "max", "min", "normalized", "sparse",
      "type"}},
    {"bufferViews", {"buffer", "byteLength", "byteOffset", "byteStride", "target"}},
    {"buffers", {"byteLength", "uri"}},
};

constexpr std::array<const char*, 7> kLists = {"scenes",  "nodes",       "meshes",   "accessors",
                                               "buffers", "bufferViews", "materials"};
constexpr std::size_t kMaxOffset = std::numeric_limits<std::uint32_t>::max();

std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  if (bytes.size() < at + sizeof(std::uint32_t)) throw MeshFault("the file ends within a header");
  std::uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof word);
  return word;
}

// Requires only whitespace behind the padding.
std::string base64_decoded(std::string_view text) {
  base64_decode_ctx context;
  base64_decode_init(&context);
  std::string data(BASE64_DECODE_LENGTH(text.size()), '\0');
  std::size_t size = data.size();
  if (base64_decode_update(&context, &size, reinterpret_cast<std::uint8_t*>(data.data()),
                           text.size(), text.data()) == 0) {
    throw MeshFault("its data is not base64");
  }
  // Padding may be missing, but not bits of a byte.
  if (base64_decode_final(&context) == 0 && context.bits >= 6) {
    throw MeshFault("its base64 ends within a byte");
  }
  data.resize(size);
  return data;
}

// The file that a URI names: %20 is a blank.
std::string file_of_uri(const std::string& uri) {
  std::string name;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] != '%') {
      name += uri[i];
      continue;
    }
    unsigned code = 0;
    const char* const end = uri.data() + std::min(i + 3, uri.size());
    const auto [rest, error] = std::from_chars(uri.data() + i + 1, end, code, 16);
    if (error != std::errc() || rest != uri.data() + i + 3 || code == 0) {
      throw MeshFault(fmt::format("URI '{}' has a % without a code", excerpt(uri)));
    }
    name += static_cast<char>(code);
    i += 2;
  }
  return name;
}

std::size_t component_bytes(std::size_t component_type) {
  switch (component_type) {
    case 5120:  // BYTE
    case 5121:  // UNSIGNED_BYTE
      return 1;
    case 5122:  // SHORT
    case 5123:  // UNSIGNED_SHORT
      return 2;
    default:  // UNSIGNED_INT, FLOAT
      return 4;
  }
}

template <typename Number>
double number_at(const char* bytes, bool normalized) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  const auto value = static_cast<double>(number);
  return normalized
             ? std::max(value / static_cast<double>(std::numeric_limits<Number>::max()), -1.0)
             : value;
}

double component_at(const char* bytes, std::size_t component_type, bool normalized) {
  switch (component_type) {
    case 5120:
      return number_at<std::int8_t>(bytes, normalized);
    case 5121:
      return number_at<std::uint8_t>(bytes, normalized);
    case 5122:
      return number_at<std::int16_t>(bytes, normalized);
    case 5123:
      return number_at<std::uint16_t>(bytes, normalized);
    case 5125:
      return number_at<std::uint32_t>(bytes, normalized);
    default:
      return number_at<float>(bytes, false);
  }
}

// A number that is whole, though it may be written 3.0.
std::optional<std::size_t> whole_value(const Json& value, std::size_t most) {
  if (!value.is_number()) return std::nullopt;
  const auto number = value.get<double>();
  if (!(number >= 0 && number <= static_cast<double>(most) && number == std::floor(number))) {
    return std::nullopt;
  }
  return static_cast<std::size_t>(number);
}

const Json& none() {
  static const Json empty = Json::array();
  return empty;
}

const std::vector<std::size_t> kUnsigned = {5121, 5123, 5125};
constexpr std::size_t kFloat = 5126;

std::size_t component_type_of(const Json& object, const std::vector<std::size_t>& allowed) {
  const std::size_t type = GltfDocument::whole(object, "componentType", kMaxOffset);
  if (std::find(allowed.begin(), allowed.end(), type) == allowed.end()) {
    throw MeshFault(
        fmt::format("componentType is {}, must be one of {}", type, fmt::join(allowed, ", ")));
  }
  return type;
}

bool flag(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return false;
  if (!found->is_boolean()) throw MeshFault(fmt::format("'{}' must be true or false", key));
  return found->get<bool>();
}

// What the parser would accept: JSON that is deep enough to fill the stack of who walks it, and
// objects with two values for a key, of which it would keep the last.
class ShapeCheck : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return true; }
  bool boolean(bool /*value*/) override { return true; }
  bool number_integer(std::int64_t /*value*/) override { return true; }
  bool number_unsigned(std::uint64_t /*value*/) override { return true; }
  bool number_float(double /*value*/, const std::string& /*text*/) override { return true; }
  bool string(std::string& /*value*/) override { return true; }
  bool binary(Json::binary_t& /*value*/) override { return true; }
  bool start_object(std::size_t /*size*/) override { return enter(); }
  bool end_object() override { return leave(); }
  bool start_array(std::size_t /*size*/) override { return enter(); }
  bool end_array() override { return leave(); }
  bool key(std::string& value) override {
    if (!keys_.back().insert(value).second) {
      throw MeshFault(fmt::format("its JSON has an object with two keys '{}'", excerpt(value)));
    }
    return true;
  }
  bool parse_error(std::size_t /*position*/, const std::string& /*token*/,
                   const nlohmann::detail::exception& /*error*/) override {
    return false;  // the parser tells
  }

 private:
  bool enter() {
    keys_.emplace_back();
    if (keys_.size() > kMaxDepth) {
      throw MeshFault(fmt::format("its JSON is nested more than {} deep", kMaxDepth));
    }
    return true;
  }
  bool leave() {
    keys_.pop_back();
    return true;
  }

  std::vector<std::set<std::string>> keys_;  // of each array or object around
};

}  // namespace

GltfDocument::GltfDocument(const MeshSource& source) {
  parse(source.file, source.bytes.substr(0, 4) == "glTF" ? glb_chunks(source.bytes) : source.bytes);
  const auto asset = root_.find("asset");
  if (asset == root_.end() || !asset->is_object()) {
    throw MeshFault("it has no 'asset', so it is not glTF 2.0");
  }
  const std::string version = text(*asset, "version");
  if (version.substr(0, 2) != "2.") {
    throw MeshFault(fmt::format("it is glTF version '{}', must be 2.0", excerpt(version)));
  }
  for (const char* name : kLists) list(root_, name);
  check_extensions();
  note_strangers(root_, "glTF");
  for (const char* name : kLists) note_strangers(list(name), name);
  read_buffers(source);
}

// Keeps the binary chunk; returns the JSON chunk.
std::string_view GltfDocument::glb_chunks(std::string_view bytes) {
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
  const std::uint32_t version = word_at(bytes, 4), length = word_at(bytes, 8);
  if (version != 2) throw MeshFault(fmt::format("it is GLB version {}, must be 2", version));
  if (length != bytes.size()) {
    throw MeshFault(
        fmt::format("its header says {} bytes, but the file has {}", length, bytes.size()));
  }
  std::string_view json;
  for (std::size_t at = 12, chunk = 0; at < bytes.size(); ++chunk) {
    const std::uint32_t size = word_at(bytes, at), type = word_at(bytes, at + 4);
    at += 8;
    if (size > bytes.size() - at) {
      throw MeshFault(fmt::format("chunk {} has {} bytes, but only {} are left", chunk, size,
                                  bytes.size() - at));
    }
    if (chunk == 0) json = bytes.substr(at, size);
    if (chunk == 0 && type != kJsonChunk) throw MeshFault("the first chunk is not JSON");
    if (chunk == 1 && type == kBinaryChunk) binary_chunk_ = bytes.substr(at, size);
    at += size;
  }
  return json;
}

void GltfDocument::parse(const std::filesystem::path& file, std::string_view json) {
  try {
    ShapeCheck check;
    Json::sax_parse(json.begin(), json.end(), &check);
    root_ = Json::parse(json.begin(), json.end());
  } catch (const Json::exception& error) {
    const auto* const place = dynamic_cast<const Json::parse_error*>(&error);
    const auto read =
        static_cast<std::ptrdiff_t>(place == nullptr ? 0 : std::min(place->byte, json.size()));
    throw InputError(file,
                     static_cast<unsigned>(1 + std::count(json.begin(), json.begin() + read, '\n')),
                     fmt::format("no JSON: {}", excerpt(error.what(), 200)));
  }
  if (!root_.is_object()) throw MeshFault("its JSON is not an object");
}

// Throws for an extension that must be understood and is not.
void GltfDocument::check_extensions() {
  const auto is_known = [](const std::string& name) {
    return std::any_of(kKnownExtensions.begin(), kKnownExtensions.end(),
                       [&](std::string_view prefix) { return name.rfind(prefix, 0) == 0; });
  };
  for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
    const auto found = root_.find(list);
    if (found == root_.end()) continue;
    if (!found->is_array()) throw MeshFault(fmt::format("'{}' must be an array", list));
    for (const Json& item : *found) {
      const std::string name = item.is_string() ? item.get<std::string>() : item.dump();
      if (name == "KHR_mesh_quantization") continue;
      left_out_.insert(excerpt(name));
      // Of materials, only one replaces the colours that are drawn.
      const bool is_material =
          name.rfind("KHR_materials_", 0) == 0 && name != "KHR_materials_pbrSpecularGlossiness";
      if (list == std::string_view("extensionsRequired") && !is_known(name) && !is_material) {
        throw MeshFault(
            fmt::format("it requires the extension {}, which is not supported", excerpt(name)));
      }
    }
  }
}

// Keys that nobody reads are mistakes, such as "sale" for "scale". `value`: an object of the kind,
// or an array of them.
void GltfDocument::note_strangers(const Json& value, const char* kind) {
  if (value.is_array()) {
    for (const Json& item : value) note_strangers(item, kind);
    return;
  }
  if (!value.is_object()) return;
  const std::set<std::string_view>& known = kKeys.at(kind);
  for (const auto& [key, item] : value.items()) {
    if (key == "extensions" && item.is_object()) {
      for (const auto& [extension, contents] : item.items()) left_out_.insert(excerpt(extension));
    } else if (kKeys.count(key) != 0 && kind != std::string_view("glTF")) {
      note_strangers(item, kKeys.find(key)->first.data());
    } else if (known.count(key) == 0 && key != "name" && key != "extras" && key != "extensions") {
      left_out_.insert(fmt::format("{}.{}", kind, excerpt(key)));
    }
  }
}

void GltfDocument::read_buffers(const MeshSource& source) {
  const Json& buffers = list("buffers");
  if (buffers.size() > kMaxBuffers) {
    throw MeshFault(
        fmt::format("it has {} buffers, may have at most {}", buffers.size(), kMaxBuffers));
  }
  for (const Json& buffer : buffers) {
    try {
      const std::size_t length = whole(buffer, "byteLength", kMaxOffset);
      const std::string_view data = buffer_data(source, buffer);
      // A buffer without data may stand for one that an extension describes.
      if (!data.empty() && data.size() < length) {
        throw MeshFault(
            fmt::format("it has {} bytes, but byteLength says {}", data.size(), length));
      }
      buffers_.push_back(data.substr(0, length));
    } catch (const MeshFault& fault) {
      throw MeshFault(fmt::format("buffer {}: {}", buffers_.size(), fault.what()));
    }
  }
}

std::string_view GltfDocument::buffer_data(const MeshSource& source, const Json& buffer) {
  if (!buffer.contains("uri")) return buffers_.empty() ? binary_chunk_ : std::string_view();
  const std::string uri = text(buffer, "uri");
  if (uri.substr(0, 5) != "data:") {
    auto data = source.open(file_of_uri(uri));
    if (!data) throw MeshFault(fmt::format("there is no file '{}'", excerpt(uri)));
    return buffer_files_.emplace_back(*std::move(data));
  }
  constexpr std::string_view kBase64 = ";base64,";
  const std::size_t comma = std::min(uri.find(','), uri.size() - 1);
  if (comma + 1 < kBase64.size() ||
      uri.compare(comma + 1 - kBase64.size(), kBase64.size(), kBase64) != 0) {
    throw MeshFault("its data URI is not base64");
  }
  return buffer_files_.emplace_back(base64_decoded(std::string_view(uri).substr(comma + 1)));
}

const Json& GltfDocument::list(const char* name) const {
  const auto found = root_.find(name);  // checked before
  return found == root_.end() ? none() : *found;
}

const Json& GltfDocument::list(const Json& object, const char* name) {
  const auto found = object.find(name);
  if (found == object.end()) return none();
  if (!found->is_array()) throw MeshFault(fmt::format("'{}' must be an array", name));
  for (const Json& item : *found) {
    if (!item.is_object()) throw MeshFault(fmt::format("'{}' must be an array of objects", name));
  }
  return *found;
}

std::ptrdiff_t GltfDocument::reference(const Json& object, const char* key,
                                       const char* target) const {
  const auto found = object.find(key);
  return found == object.end() ? -1 : reference_of(*found, key, target);
}

std::ptrdiff_t GltfDocument::reference_of(const Json& value, const char* key,
                                          const char* target) const {
  const std::size_t size = list(target).size();
  const auto index = whole_value(value, kMaxOffset);
  if (!index || *index >= size) {
    throw MeshFault(fmt::format("'{}' is {}, but the file has {} {} (counted from 0)", key,
                                excerpt(value.dump()), size, target));
  }
  return static_cast<std::ptrdiff_t>(*index);
}

std::size_t GltfDocument::whole(const Json& object, const char* key, std::size_t most) {
  const auto found = object.find(key);
  if (found == object.end()) throw MeshFault(fmt::format("it has no '{}'", key));
  const auto value = whole_value(*found, most);
  if (!value) {
    throw MeshFault(fmt::format("'{}' is {}, must be a whole number up to {}", key,
                                excerpt(found->dump()), most));
  }
  return *value;
}

std::size_t GltfDocument::whole(const Json& object, const char* key, std::size_t most,
                                std::size_t fallback) {
  return object.contains(key) ? whole(object, key, most) : fallback;
}

std::vector<double> GltfDocument::numbers(const Json& value, const char* what, std::size_t count) {
  std::vector<double> result;
  if (value.is_array() && value.size() == count) {
    for (const Json& item : value) {
      if (item.is_number() && std::abs(item.get<double>()) <= kMaxCoordinate) {
        result.push_back(item.get<double>());
      }
    }
  }
  if (result.size() != count) {
    throw MeshFault(
        fmt::format("'{}' must be {} numbers of at most {}", what, count, kMaxCoordinate));
  }
  return result;
}

std::string GltfDocument::text(const Json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return {};
  if (!found->is_string()) throw MeshFault(fmt::format("'{}' must be a string", key));
  return found->get<std::string>();
}

std::size_t GltfDocument::Layout::row_bytes() const {
  return width * component_bytes(component_type);
}

std::vector<double> GltfDocument::vectors(std::ptrdiff_t accessor) const {
  return read_accessor(accessor, "VEC3", kMaxMeshVertices, {5120, 5121, 5122, 5123, kFloat});
}

std::vector<double> GltfDocument::indices(std::ptrdiff_t accessor) const {
  return read_accessor(accessor, "SCALAR", 3 * kMaxMeshTriangles, kUnsigned);
}

std::vector<double> GltfDocument::read_accessor(
    std::ptrdiff_t index, std::string_view type, std::size_t most,
    const std::vector<std::size_t>& component_types) const try {
  const Json& accessor = list("accessors")[static_cast<std::size_t>(index)];
  if (text(accessor, "type") != type) {
    throw MeshFault(
        fmt::format("its type is '{}', must be {}", excerpt(text(accessor, "type")), type));
  }
  const Layout layout = {component_type_of(accessor, component_types),
                         type == "SCALAR" ? std::size_t{1} : std::size_t{3},
                         whole(accessor, "count", most)};
  const bool normalized = flag(accessor, "normalized");
  if (normalized && type == "SCALAR") throw MeshFault("indices cannot be normalized");
  std::vector<double> values = accessor.contains("bufferView")
                                   ? read_view(accessor, layout, normalized)
                                   : std::vector<double>(layout.count * layout.width, 0.0);
  const auto sparse = accessor.find("sparse");
  if (sparse != accessor.end()) overwrite_sparse(*sparse, layout, normalized, values);
  return values;
} catch (const MeshFault& fault) {
  throw MeshFault(fmt::format("accessor {}: {}", index, fault.what()));
}

std::vector<double> GltfDocument::read_view(const Json& owner, const Layout& layout,
                                            bool normalized) const {
  const std::ptrdiff_t view_index = reference(owner, "bufferView", "bufferViews");
  if (view_index < 0) throw MeshFault("it has no 'bufferView'");
  const Json& view = list("bufferViews")[static_cast<std::size_t>(view_index)];
  const std::ptrdiff_t buffer = reference(view, "buffer", "buffers");
  if (buffer < 0) throw MeshFault(fmt::format("bufferView {} has no 'buffer'", view_index));
  const std::string_view data = buffers_[static_cast<std::size_t>(buffer)];
  const std::size_t begin = whole(view, "byteOffset", kMaxOffset, 0),
                    length = whole(view, "byteLength", kMaxOffset),
                    stride = whole(view, "byteStride", 252, layout.row_bytes()),
                    offset = whole(owner, "byteOffset", kMaxOffset, 0);
  if (begin > data.size() || length > data.size() - begin) {
    throw MeshFault(fmt::format("bufferView {} ends at byte {}, but buffer {} has {}", view_index,
                                begin + length, buffer, data.size()));
  }
  if (stride < layout.row_bytes()) {
    throw MeshFault(fmt::format("bufferView {} has a stride of {}, must be at least {}", view_index,
                                stride, layout.row_bytes()));
  }
  const std::size_t needed =
      layout.count == 0 ? 0 : offset + (layout.count - 1) * stride + layout.row_bytes();
  if (needed > length) {
    throw MeshFault(
        fmt::format("it needs {} bytes, but bufferView {} has {}", needed, view_index, length));
  }
  std::vector<double> values;
  values.reserve(layout.count * layout.width);
  const std::size_t bytes = component_bytes(layout.component_type);
  for (std::size_t row = 0; row < layout.count; ++row) {
    const char* const at = data.data() + begin + offset + row * stride;
    for (std::size_t i = 0; i < layout.width; ++i) {
      values.push_back(component_at(at + i * bytes, layout.component_type, normalized));
    }
  }
  return values;
}

void GltfDocument::overwrite_sparse(const Json& sparse, const Layout& layout, bool normalized,
                                    std::vector<double>& values) const {
  const auto part = [&](const char* name) -> const Json& {
    const auto found = sparse.is_object() ? sparse.find(name) : sparse.end();
    if (found == sparse.end() || !found->is_object()) {
      throw MeshFault(fmt::format("'sparse' needs an object '{}'", name));
    }
    return *found;
  };
  const Json& places = part("indices");
  const std::size_t count = whole(sparse, "count", layout.count);
  const std::vector<double> rows =
      read_view(places, {component_type_of(places, kUnsigned), 1, count}, false);
  const std::vector<double> replaced =
      read_view(part("values"), {layout.component_type, layout.width, count}, normalized);
  for (std::size_t i = 0; i < count; ++i) {
    if (!(rows[i] >= 0 && rows[i] < static_cast<double>(layout.count))) {
      throw MeshFault(fmt::format("'sparse' refers to row {} of {}", rows[i], layout.count));
    }
    std::copy_n(
        replaced.begin() + static_cast<long>(i * layout.width), layout.width,
        values.begin() + static_cast<long>(static_cast<std::size_t>(rows[i]) * layout.width));
  }
}

}  // namespace phongpipe
