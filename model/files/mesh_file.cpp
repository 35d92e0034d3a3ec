#include "model/files/mesh_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <new>
#include <utility>

#include "model/files/confined_child.h"
#include "model/files/meshes/imported_mesh.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{128} << 20;  // of one file
constexpr std::size_t kMaxCompanions = 64;                     // files that a mesh names
constexpr std::size_t kMaxMessageBytes = 4096;
constexpr std::size_t kMaxNotes = 20;
constexpr std::size_t kChildMemory = std::size_t{384} << 20;

struct Format {
  std::vector<std::string> extensions;
  ImportedMesh (*read)(const MeshSource&);
  std::vector<std::string> companions;  // extensions of the files that it may name
};

const std::vector<Format>& formats() {
  static const std::vector<Format> known = {
      {{".obj"}, read_obj, {".mtl"}},
      {{".ply"}, read_ply, {}},
      {{".stl"}, read_stl, {}},
      {{".gltf", ".glb"}, read_gltf, {".bin", ".glbin", ".glbuf"}},
  };
  return known;
}

bool ends_with_one_of(const fs::path& file, const std::vector<std::string>& extensions) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

const Format& format_of(const fs::path& file) {
  std::vector<std::string> known;
  for (const Format& format : formats()) {
    if (ends_with_one_of(file, format.extensions)) return format;
    known.insert(known.end(), format.extensions.begin(), format.extensions.end());
  }
  throw InputError(file, 0,
                   fmt::format("meshes are read from files that end with {}; convert it to one of "
                               "these",
                               fmt::join(known, ", ")));
}

// A second of processor time for any file, and one for every 8 MiB.
unsigned processor_seconds(std::size_t bytes) {
  return 1 + static_cast<unsigned>(bytes >> 23U);
}

// What the child sends: requests for files, then an error, or the arrays in this order.
enum Kind : std::uint64_t {
  kRequest,
  kError,
  kFacts,
  kPositions,
  kNormals,
  kFaces,
  kMaterialNames,  // each ends with a zero byte
  kMaterialNumbers,
  kNotes,  // each ends with a zero byte
};
// What the parent answers to a request.
enum Answer : std::uint64_t { kFile, kNoFile };

struct Facts {
  std::uint64_t file_normals, left_out;
};

// Of a material; its name is sent apart.
using MaterialNumbers = std::array<double, 10>;

std::string joined(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) result.append(text).push_back('\0');
  return result;
}

template <typename Item>
void send_array(const Channel& channel, Kind kind, const std::vector<Item>& items) {
  channel.send(kind, items.data(), items.size() * sizeof(Item));
}

void send_mesh(const Channel& channel, const ImportedMesh& imported) {
  const Mesh& mesh = imported.mesh;
  send_array(
      channel, kFacts,
      std::vector<Facts>{{static_cast<std::uint64_t>(imported.file_normals), imported.left_out}});
  send_array(channel, kPositions, mesh.positions);
  send_array(channel, kNormals, mesh.normals);
  send_array(channel, kFaces, mesh.faces);
  std::vector<std::string> names;
  std::vector<MaterialNumbers> numbers;
  for (const Material& m : mesh.materials) {
    names.push_back(m.name);
    numbers.push_back({m.ambient[0], m.ambient[1], m.ambient[2], m.diffuse[0], m.diffuse[1],
                       m.diffuse[2], m.specular[0], m.specular[1], m.specular[2], m.shininess});
  }
  channel.send(kMaterialNames, joined(names));
  send_array(channel, kMaterialNumbers, numbers);
  std::vector<std::string> notes = mesh.notes;
  if (notes.size() > kMaxNotes) {
    const std::size_t more = notes.size() - kMaxNotes;
    notes.resize(kMaxNotes);
    notes.push_back(fmt::format("and {} more notes", more));
  }
  channel.send(kNotes, joined(notes));
}

void decode(const Channel& channel, const Format& format, const fs::path& file,
            std::string_view bytes) {
  MeshSource source{file, bytes, [&](const std::string& name) {
                      channel.send(kRequest, name);
                      const Channel::Header answer = channel.receive_header();
                      std::optional<std::string> text;
                      if (answer.kind == kFile) {
                        text.emplace(answer.size, '\0');
                        channel.receive(text->data(), text->size());
                      }
                      return text;
                    }};
  std::string error;
  try {
    return send_mesh(channel, format.read(source));
  } catch (const InputError& fault) {
    error = fault.what();
  } catch (const Channel::Closed&) {
    return;
  } catch (const std::bad_alloc&) {
    error = fmt::format("{}: its reader needs more than {} MiB of memory", file.string(),
                        kChildMemory >> 20U);
  } catch (const std::exception& fault) {
    error = fmt::format("{}: its reader failed: {}", file.string(), fault.what());
  }
  channel.send(kError, excerpt(error, kMaxMessageBytes - 8));
}

// Takes what the child sends. Sizes are checked before there is memory for them.
class MeshReceiver {
 public:
  MeshReceiver(const Format& format, const fs::path& file, std::size_t bytes, ConfinedChild& child)
      : format_(format), file_(file), bytes_(bytes), child_(child) {}

  ImportedMesh run() {
    Channel::Header header = channel().receive_header();
    for (; header.kind == kRequest; header = channel().receive_header()) answer(header);
    if (header.kind == kError) throw InputError(text(header, kMaxMessageBytes));
    ImportedMesh imported;
    const auto facts = array<Facts>(header, kFacts, 1);
    if (facts.size() != 1 ||
        facts[0].file_normals > static_cast<std::uint64_t>(FileNormals::of_facets)) {
      fail("no facts");
    }
    imported.file_normals = static_cast<FileNormals>(facts[0].file_normals);
    imported.left_out = facts[0].left_out;
    Mesh& mesh = imported.mesh;
    mesh.positions = next_array<Vec3>(kPositions, kMaxMeshVertices);
    mesh.normals = next_array<Vec3>(kNormals, kMaxMeshVertices);
    mesh.faces = next_array<MeshFace>(kFaces, kMaxMeshTriangles);
    const std::vector<std::string> names = next_texts(kMaterialNames, kMaxMeshMaterials * 64);
    const auto numbers = next_array<MaterialNumbers>(kMaterialNumbers, kMaxMeshMaterials);
    mesh.notes = next_texts(kNotes, (kMaxNotes + 1) * kMaxMessageBytes);
    if (mesh.normals.size() != mesh.positions.size() || names.size() != numbers.size()) {
      fail("arrays of unequal size");
    }
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      const MaterialNumbers& n = numbers[i];
      mesh.materials.push_back(
          {names[i], {n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]}, n[9]});
    }
    return imported;
  }

 private:
  const Channel& channel() const { return child_.channel(); }

  void answer(const Channel::Header& header) {
    const std::string name = text(header, kMaxMessageBytes);
    if (++companions_ > kMaxCompanions) {
      throw InputError(file_, 0, fmt::format("names more than {} files", kMaxCompanions));
    }
    const fs::path companion = file_.parent_path() / name;
    std::error_code error;
    fs::path target = fs::canonical(companion, error);
    if (error) target = companion;
    for (const fs::path& path : {companion, target}) {
      if (ends_with_one_of(path, format_.companions)) continue;
      throw InputError(file_, 0,
                       fmt::format("names the file '{}', may only name files that end with {}",
                                   excerpt(name), fmt::join(format_.companions, ", ")));
    }
    if (error == std::errc::no_such_file_or_directory) {
      channel().send(kNoFile, "");
      return;
    }
    const std::string contents =
        fs::is_regular_file(target, error) && fs::file_size(target, error) == 0
            ? ""
            : read_whole_file(companion, kMaxMeshBytes - std::min(bytes_, kMaxMeshBytes));
    bytes_ += contents.size();
    child_.allow_processor_seconds(processor_seconds(bytes_));
    channel().send(kFile, contents);
  }

  std::string text(const Channel::Header& header, std::size_t max_bytes) const {
    if (header.size > max_bytes) fail("a text that is too long");
    std::string result(header.size, '\0');
    channel().receive(result.data(), result.size());
    return result;
  }

  template <typename Item>
  std::vector<Item> array(const Channel::Header& header, Kind kind, std::size_t most) const {
    if (header.kind != kind || header.size % sizeof(Item) != 0 ||
        header.size / sizeof(Item) > most) {
      fail("an array that is out of order or too large");
    }
    std::vector<Item> items(header.size / sizeof(Item));
    channel().receive(items.data(), header.size);
    return items;
  }
  template <typename Item>
  std::vector<Item> next_array(Kind kind, std::size_t most) const {
    return array<Item>(channel().receive_header(), kind, most);
  }

  std::vector<std::string> next_texts(Kind kind, std::size_t max_bytes) const {
    const Channel::Header header = channel().receive_header();
    if (header.kind != kind) fail("a text out of order");
    const std::string all = text(header, max_bytes);
    std::vector<std::string> texts;
    for (std::size_t begin = 0; begin < all.size();) {
      const std::size_t end = std::min(all.find('\0', begin), all.size());
      texts.push_back(all.substr(begin, end - begin));
      begin = end + 1;
    }
    return texts;
  }

  // The child is not the program that was started.
  [[noreturn]] void fail(const char* what) const {
    throw InputError(file_, 0, fmt::format("its reader was led astray and sent {}", what));
  }

  const Format& format_;
  const fs::path& file_;
  std::size_t bytes_;  // read so far
  ConfinedChild& child_;
  std::size_t companions_ = 0;
};

ImportedMesh import(const fs::path& file) {
  const Format& format = format_of(file);
  const std::string bytes = read_whole_file(file, kMaxMeshBytes);
  ConfinedChild child([&](const Channel& channel) { decode(channel, format, file, bytes); },
                      {kChildMemory, processor_seconds(bytes.size())});
  try {
    return MeshReceiver(format, file, bytes.size(), child).run();
  } catch (const Channel::Closed&) {
    throw InputError(file, 0, fmt::format("its reader {}", child.ending()));
  }
}

void check_faces(const fs::path& file, const Mesh& mesh) {
  if (mesh.faces.empty()) throw InputError(file, 0, "the mesh has no faces");
  const std::size_t materials = std::max<std::size_t>(mesh.materials.size(), 1);
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (vertex < mesh.positions.size() && face.material < materials) continue;
      throw InputError(file, 0, "a face names a vertex or a material that is not there");
    }
  }
}

void check_positions(const fs::path& file, const Mesh& mesh) {
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    // NaN fails every comparison.
    if (!(mesh.positions[i].array().abs() <= kMaxCoordinate).all()) {
      throw InputError(file, 0,
                       fmt::format("vertex {} is at ({}, {}, {}), must be numbers of at most {}", i,
                                   mesh.positions[i].x(), mesh.positions[i].y(),
                                   mesh.positions[i].z(), kMaxCoordinate));
    }
  }
}

void check_materials(const fs::path& file, const Mesh& mesh) {
  const auto is_color = [](const Color& color) { return ((color >= 0) && (color <= 1)).all(); };
  for (const Material& material : mesh.materials) {
    if (is_color(material.ambient) && is_color(material.diffuse) && is_color(material.specular) &&
        material.shininess >= 0 && std::isfinite(material.shininess)) {
      continue;
    }
    throw InputError(file, 0,
                     fmt::format("material '{}': a color is not from 0 to 1, or the shininess not "
                                 "at least 0",
                                 material.name));
  }
}

void make_normals_unit(const fs::path& file, Mesh& mesh) {
  for (Vec3& normal : mesh.normals) normal = Vec3(normal.stableNormalized());
  for (const MeshFace& face : mesh.faces) {
    for (const std::uint32_t vertex : face.vertices) {
      if (!(std::abs(mesh.normals[vertex].norm() - 1) < 1e-6)) {
        throw InputError(file, 0,
                         fmt::format("the normal of vertex {} is zero or not a number", vertex));
      }
    }
  }
}

void note_reversed_faces(const fs::path& file, Mesh& mesh) {
  const auto reversed = std::count_if(mesh.faces.begin(), mesh.faces.end(), [&](const MeshFace& f) {
    const Vec3 sum =
        mesh.normals[f.vertices[0]] + mesh.normals[f.vertices[1]] + mesh.normals[f.vertices[2]];
    return face_area_vector(mesh, f).dot(sum) < 0;
  });
  if (reversed > 0) {
    mesh.notes.push_back(fmt::format("{}: {} of {} faces turn against their normals", file.string(),
                                     reversed, mesh.faces.size()));
  }
}

const char* why_generated(FileNormals normals) {
  switch (normals) {
    case FileNormals::missing:
      return "no normals";
    case FileNormals::partly_missing:
      return "some faces have no normals";
    case FileNormals::of_facets:
      // Many programs leave them zero, and a surface shaded with them is flat.
      return "only facet normals";
    case FileNormals::given:
      break;
  }
  return nullptr;
}

}  // namespace

Mesh load_mesh(const fs::path& file) {
  ImportedMesh imported = import(file);
  Mesh mesh = std::move(imported.mesh);
  check_faces(file, mesh);
  check_positions(file, mesh);
  check_materials(file, mesh);
  if (imported.left_out > 0) {
    mesh.notes.push_back(
        fmt::format("{}: {} points and lines left out", file.string(), imported.left_out));
  }
  if (const char* why = why_generated(imported.file_normals)) {
    generate_smooth_normals(mesh);
    if (mesh.faces.empty()) {
      throw InputError(file, 0, "all faces of the mesh have zero area");
    }
    mesh.notes.push_back(fmt::format("{}: {}, smooth normals generated", file.string(), why));
  }
  make_normals_unit(file, mesh);
  note_reversed_faces(file, mesh);
  return mesh;
}

}  // namespace phongpipe
