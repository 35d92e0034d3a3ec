#include "model/files/meshes/mesh_transfer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMaxMeshBytes = std::size_t{128} << 20;  // with the files that it names
constexpr std::size_t kMaxCompanions = 64;                     // files that a mesh names
constexpr std::size_t kMaxMessageBytes = 4096;
constexpr std::size_t kMaxNotes = 20;
constexpr std::size_t kMaxNameBytes = 1000;  // of a material
constexpr std::size_t kMaxNamesBytes = std::size_t{16} << 20;
// The child's text and what it makes of it; with the file, 512 MiB at most.
constexpr std::size_t kChildMemory = std::size_t{352} << 20;

// A second of processor time for any file, and one for every 4 MiB.
unsigned processor_seconds(std::size_t bytes) {
  return 1 + static_cast<unsigned>(bytes >> 22U);
}

struct Facts {
  std::uint64_t file_normals, left_out;
};

// Of a material; its name is sent apart.
using MaterialNumbers = std::array<double, 10>;

// Each text behind its size.
std::string joined(const std::vector<std::string>& texts) {
  std::string result;
  for (const std::string& text : texts) {
    const std::uint64_t size = text.size();
    result.append(reinterpret_cast<const char*>(&size), sizeof size).append(text);
  }
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
    names.push_back(excerpt(m.name, kMaxNameBytes));
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

void decode(const Channel& channel, const MeshFormat& format, const fs::path& file,
            std::string_view bytes) {
  MeshSource source{file, bytes, [&](const std::string& name) {
                      channel.send(kRequest, name);
                      const Channel::Header answer = channel.receive_header();
                      if (answer.kind == kNoFile) return std::optional<std::string>();
                      std::string text(answer.size, '\0');
                      channel.receive(text.data(), answer.size);
                      return std::make_optional(std::move(text));
                    }};
  std::string error;
  try {
    return send_mesh(channel, format.read(source));
  } catch (const InputError& fault) {
    error = fault.what();
  } catch (const Channel::Closed&) {
    return;
  } catch (const std::exception& fault) {
    error = fmt::format("{}: its reader failed: {}", file.string(), fault.what());
  }
  channel.send(kError, excerpt(error, kMaxMessageBytes - 8));
}

// Takes what the child sends. Sizes are checked before there is memory for them.
class MeshReceiver {
 public:
  MeshReceiver(const MeshFormat& format, const fs::path& file, std::size_t bytes,
               ConfinedChild& child)
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
    const std::vector<std::string> names = next_texts(kMaterialNames, kMaxNamesBytes);
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
      if (has_extension_of(path, format_.companions)) continue;
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
    for (std::string_view rest = all; !rest.empty();) {
      std::uint64_t size = 0;
      if (rest.size() < sizeof size) fail("a text that was cut");
      std::memcpy(&size, rest.data(), sizeof size);
      rest.remove_prefix(sizeof size);
      if (size > rest.size()) fail("a text that was cut");
      texts.emplace_back(rest.substr(0, size));
      rest.remove_prefix(size);
    }
    return texts;
  }

  // The child is not the program that was started.
  [[noreturn]] void fail(const char* what) const {
    throw InputError(file_, 0, fmt::format("its reader was led astray and sent {}", what));
  }

  const MeshFormat& format_;
  const fs::path& file_;
  std::size_t bytes_;  // read so far
  ConfinedChild& child_;
  std::size_t companions_ = 0;
};

}  // namespace

ImportedMesh receive_mesh(ConfinedChild& child, const MeshFormat& format, const fs::path& file,
                          std::size_t bytes) {
  try {
    return MeshReceiver(format, file, bytes, child).run();
  } catch (const Channel::Closed&) {
    throw InputError(file, 0, fmt::format("its reader {}", child.ending()));
  }
}

ImportedMesh import_mesh(const fs::path& file) {
  const MeshFormat& format = mesh_format_of(file);
  const std::string bytes = read_whole_file(file, kMaxMeshBytes);
  ConfinedChild child([&](const Channel& channel) { decode(channel, format, file, bytes); },
                      {kChildMemory, processor_seconds(bytes.size())});
  return receive_mesh(child, format, file, bytes.size());
}

}  // namespace phongpipe
