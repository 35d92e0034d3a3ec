#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <unordered_map>

#include "model/files/meshes/imported_mesh.h"
#include "model/files/meshes/mesh_format.h"
#include "model/files/meshes/mtl_reader.h"
#include "model/files/meshes/statements.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

// Statements that change nothing in the picture: groups, smoothing groups, display attributes.
constexpr std::array<std::string_view, 14> kStatementsWithoutEffect = {
    "g",   "o",      "s",      "mg",         "bevel",     "c_interp", "d_interp",
    "lod", "maplib", "usemap", "shadow_obj", "trace_obj", "ctech",    "stech"};
// Free-form curves and surfaces, of which only a surface would be drawn.
constexpr std::array<std::string_view, 15> kFreeForm = {"vp",   "cstype", "deg",  "bmat", "step",
                                                        "curv", "curv2",  "surf", "parm", "trim",
                                                        "hole", "scrv",   "sp",   "end",  "con"};

template <std::size_t kCount>
bool contains(const std::array<std::string_view, kCount>& keywords, std::string_view keyword) {
  return std::find(keywords.begin(), keywords.end(), keyword) != keywords.end();
}

class ObjReader {
 public:
  explicit ObjReader(const MeshSource& source) : source_(source) {}

  ImportedMesh run() try {
    // A face may refer to what follows it, so that vertices come first.
    for_each_statement(source_.bytes, [this](const Statement& statement) {
      line_ = statement.line;
      read_vertex(statement);
    });
    declared_ = declared_so_far_;
    declared_so_far_ = {0, 0, 0};
    for_each_statement(source_.bytes, [this](const Statement& statement) {
      line_ = statement.line;
      read_face(statement);
    });
    line_ = 0;
    finish_materials();
    if (imported_.file_normals == FileNormals::partly_missing && normals_.empty()) {
      imported_.file_normals = FileNormals::missing;
    }
    return std::move(imported_);
  } catch (const MeshFault& fault) {
    fail(fault.what());
  }

 private:
  static constexpr std::array<const char*, 3> kLists = {"v", "vt", "vn"};  // as in f v/vt/vn
  using Counts = std::array<long, kLists.size()>;
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  static void count(const Statement& statement, Counts& counts) {
    for (std::size_t list = 0; list < kLists.size(); ++list) {
      counts[list] += statement.keyword == kLists[list] ? 1 : 0;
    }
  }

  void read_vertex(const Statement& statement) {
    count(statement, declared_so_far_);
    if (statement.keyword == "v") {
      positions_.push_back(read_vector(statement, "vertex"));
      if (positions_.size() > kMaxMeshVertices) {
        fail(fmt::format("a mesh may have at most {} vertices", kMaxMeshVertices));
      }
      read_extra_numbers(statement);
    } else if (statement.keyword == "vn") {
      if (statement.values.size() > 3) fail("a normal has three coordinates");
      normals_.push_back(read_vector(statement, "normal", parse_any_number));
    }
  }

  Vec3 read_vector(const Statement& statement, const char* what,
                   std::optional<double> (*parse)(std::string_view) = parse_number) const {
    if (statement.values.size() < 3) fail(fmt::format("{} needs three coordinates", what));
    Vec3 vector;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string_view word = statement.values[i];
      const std::optional<double> value = parse(word);
      if (!value) {
        fail(fmt::format("{} coordinate '{}' is not a finite number", what, excerpt(word)));
      }
      if (std::abs(*value) > kMaxCoordinate) {
        fail(fmt::format("{} coordinate {} is beyond {}", what, excerpt(word), kMaxCoordinate));
      }
      vector[static_cast<Eigen::Index>(i)] = *value;
    }
    return vector;
  }

  // x y z w, whose weight w only free-form surfaces have, or x y z red green blue.
  void read_extra_numbers(const Statement& statement) {
    const auto& words = statement.values;
    if (words.size() == 3) return;
    if (words.size() != 4 && words.size() != 6 && words.size() != 7) {
      fail(fmt::format("vertex has {} numbers, must be 3, or 4 with a weight, or 6 with a color",
                       words.size()));
    }
    for (std::size_t i = 3; i < words.size(); ++i) {
      if (!parse_number(words[i])) {
        fail(fmt::format("'{}' is not a finite number", excerpt(words[i])));
      }
    }
    if (words.size() == 4) {
      note_once(parse_number(words[3]) != 1.0, weights_noted_, "weights of vertices left out");
    } else {
      note_once(true, colors_noted_, "colors of vertices left out");
    }
  }

  void note_once(bool occasion, bool& noted, const char* text) {
    if (!occasion || noted) return;
    noted = true;
    imported_.mesh.notes.push_back(fmt::format("{}:{}: {}", source_.file.string(), line_, text));
  }

  void read_face(const Statement& statement) {
    count(statement, declared_so_far_);
    const std::string_view keyword = statement.keyword;
    if (keyword == "v" || keyword == "vn" || keyword == "vt") return;
    if (keyword == "f" || keyword == "fo") {  // fo: a face in old files
      add_face(statement);
    } else if (keyword == "l" || keyword == "p") {
      ++imported_.left_out;
    } else if (keyword == "usemtl") {
      use_material(statement);
    } else if (keyword == "mtllib") {
      read_libraries(statement);
    } else if (contains(kFreeForm, keyword)) {
      note_once(keyword == "surf" || keyword == "curv" || keyword == "curv2", free_form_noted_,
                "free-form curves and surfaces left out");
    } else if (!contains(kStatementsWithoutEffect, keyword)) {
      fail(fmt::format("'{}' is not a statement of OBJ files", excerpt(keyword)));
    }
  }

  void add_face(const Statement& statement) {
    if (statement.values.size() < 3) {
      fail(fmt::format("face has {} vertices, needs at least 3", statement.values.size()));
    }
    if (current_material_ == kNone) current_material_ = material_index("");
    corners_.clear();
    for (const std::string_view word : statement.values) corners_.push_back(add_corner(word));
    imported_.add_polygon(corners_, current_material_);
  }

  // v, v/vt, v//vn or v/vt/vn
  std::uint32_t add_corner(std::string_view word) {
    std::array<std::uint32_t, kLists.size()> indices = {kNone, kNone, kNone};
    std::string_view rest = word;
    for (std::size_t list = 0; list < kLists.size(); ++list) {
      const std::size_t slash = std::min(rest.find('/'), rest.size());
      const std::string_view index = rest.substr(0, slash);
      if (!index.empty() || list == 0) indices[list] = resolved(index, list);
      rest.remove_prefix(slash);
      if (rest.empty()) break;
      rest.remove_prefix(1);
      if (list + 1 == kLists.size()) {
        fail(fmt::format("face corner '{}' is not v, v/vt, v//vn or v/vt/vn", excerpt(word)));
      }
    }
    const auto [vertex, normal] = std::make_pair(indices[0], indices[2]);
    if (normal == kNone) {
      imported_.file_normals = FileNormals::partly_missing;
    } else if (const double length = normals_[normal].stableNorm();
               !(length > 0 && std::isfinite(length))) {
      fail(fmt::format("face refers to vn {}, which is zero or not a number", normal + 1));
    }
    const auto [known, is_new] =
        vertices_.try_emplace((std::uint64_t{vertex} << 32U) | normal, kNone);
    if (is_new) {
      known->second = imported_.add_vertex(positions_[vertex],
                                           normal == kNone ? Vec3::Zero() : normals_[normal]);
    }
    return known->second;
  }

  // From 1 up, or from -1 down counted back from here; the result counts from 0.
  std::uint32_t resolved(std::string_view word, std::size_t list) const {
    const std::optional<long> index = parse_integer(word);
    if (!index || *index == 0) {
      fail(fmt::format("face index '{}' is not a whole number other than 0", excerpt(word)));
    }
    const long known = *index > 0 ? declared_[list] : declared_so_far_[list];
    if (*index > known || *index < -known) {
      fail(fmt::format("face refers to {} {}, but the file has {}", kLists[list], *index, known));
    }
    return static_cast<std::uint32_t>(*index > 0 ? *index - 1 : known + *index);
  }

  void use_material(const Statement& statement) {
    note_once(statement.rest.empty(), unnamed_noted_, "usemtl without a name: default material");
    current_material_ = material_index(statement.rest);
  }

  // The empty name is that of faces before the first usemtl.
  std::uint32_t material_index(std::string_view name) {
    const auto [found, is_new] = material_indices_.try_emplace(
        std::string(name), static_cast<std::uint32_t>(material_indices_.size()));
    if (material_indices_.size() > kMaxMeshMaterials) {
      fail(fmt::format("a mesh may have at most {} materials", kMaxMeshMaterials));
    }
    return found->second;
  }

  void read_libraries(const Statement& statement) {
    if (statement.values.empty()) fail("mtllib needs a file");
    // A name may contain blanks; otherwise they stand between names.
    if (read_library(std::string(statement.rest))) return;
    const auto is_library = [](std::string_view name) {
      return has_extension_of(std::string(name), {".mtl"});
    };
    if (!std::all_of(statement.values.begin(), statement.values.end(), is_library)) {
      return note_missing_library(statement.rest);
    }
    for (const std::string_view name : statement.values) {
      if (statement.values.size() == 1 || !read_library(std::string(name))) {
        note_missing_library(name);
      }
    }
  }

  void note_missing_library(std::string_view name) {
    library_missing_ = true;
    imported_.mesh.notes.push_back(
        fmt::format("{}:{}: material library '{}' not found, default material used",
                    source_.file.string(), line_, excerpt(name)));
  }

  bool read_library(const std::string& name) {
    if (libraries_.count(name) != 0) return true;
    const std::optional<std::string> text = source_.open(name);
    if (!text) return false;
    libraries_.insert(name);
    for (Material& material :
         read_mtl(source_.file.parent_path() / name, *text, imported_.mesh.notes)) {
      const std::string key = material.name;
      library_.try_emplace(key, std::move(material));  // the first library has precedence
    }
    return true;
  }

  // The materials that faces use. None where no library was read.
  void finish_materials() {
    Mesh& mesh = imported_.mesh;
    if (libraries_.empty()) {
      for (MeshFace& face : mesh.faces) face.material = 0;
    } else {
      mesh.materials.resize(material_indices_.size());
    }
    for (const auto& [name, index] : material_indices_) {
      const auto found = library_.find(name);
      if (found != library_.end()) {
        mesh.materials[index] = found->second;
      } else if (!name.empty() && !library_missing_) {
        mesh.notes.push_back(
            fmt::format("{}: material '{}' is defined in no library, default "
                        "material used",
                        source_.file.string(), excerpt(name)));
      }
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    throw InputError(source_.file, line_, message);
  }

  const MeshSource& source_;
  unsigned line_ = 0;
  Counts declared_ = {0, 0, 0};         // in the whole file
  Counts declared_so_far_ = {0, 0, 0};  // what negative indices count back from
  std::vector<Vec3> positions_, normals_;
  ImportedMesh imported_;
  std::vector<std::uint32_t> corners_;                         // of a face
  std::unordered_map<std::uint64_t, std::uint32_t> vertices_;  // by position and normal
  std::map<std::string, std::uint32_t> material_indices_;      // in the order of their use
  std::uint32_t current_material_ = kNone;
  std::map<std::string, Material> library_;
  std::set<std::string> libraries_;  // that were read
  bool library_missing_ = false;
  bool weights_noted_ = false, colors_noted_ = false, free_form_noted_ = false,
       unnamed_noted_ = false;
};

}  // namespace

ImportedMesh read_obj(const MeshSource& source) {
  return ObjReader(source).run();
}

}  // namespace phongpipe
