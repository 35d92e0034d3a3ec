#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <functional>
#include <unordered_map>

#include "model/files/meshes/imported_mesh.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

bool same_word(std::string_view word, std::string_view keyword) {
  return std::equal(word.begin(), word.end(), keyword.begin(), keyword.end(),
                    [](unsigned char a, unsigned char b) { return std::tolower(a) == b; });
}

struct HashOfVector {
  std::size_t operator()(const Vec3& v) const {
    std::size_t hash = 0;
    for (const double coordinate : v) hash = hash * 31 + std::hash<double>()(coordinate);
    return hash;
  }
};

class StlReader {
 public:
  explicit StlReader(const MeshSource& source)
      : file_(source.file),
        bytes_(source.bytes),
        text_(without_byte_order_mark(source.bytes)),
        lines_(text_) {
    imported_.file_normals = FileNormals::of_facets;
  }

  // Binary files, too, may begin with "solid": their size tells.
  ImportedMesh run() try {
    const std::size_t begin = std::min(text_.find_first_not_of(" \t\r\n"), text_.size());
    const bool text = same_word(text_.substr(begin, 5), "solid") &&
                      bytes_.substr(0, kHeaderBytes).find('\0') == std::string_view::npos;
    if (binary_size() == bytes_.size() || !text) {
      read_binary();
    } else {
      read_text();
    }
    return std::move(imported_);
  } catch (const MeshFault& fault) {
    throw InputError(file_, line_, fault.what());
  }

 private:
  static constexpr std::size_t kHeaderBytes = 80;
  static constexpr std::size_t kFacetBytes = 50;  // normal, three vertices, two bytes of attributes

  std::size_t binary_size() const {
    if (bytes_.size() < kHeaderBytes + 4) return 0;
    std::uint32_t facets = 0;
    std::memcpy(&facets, bytes_.data() + kHeaderBytes, sizeof facets);
    return kHeaderBytes + 4 + kFacetBytes * facets;
  }

  void read_binary() {
    if (binary_size() == 0) {
      throw MeshFault(
          "not an STL file: it does not begin with 'solid', and is shorter than the "
          "header of a binary file");
    }
    if (binary_size() != bytes_.size()) {
      throw MeshFault(fmt::format("its header counts {} facets, which take {} bytes, but it has {}",
                                  (binary_size() - kHeaderBytes - 4) / kFacetBytes, binary_size(),
                                  bytes_.size()));
    }
    bool colored = bytes_.substr(0, kHeaderBytes).find("COLOR=") != std::string_view::npos;
    for (std::size_t at = kHeaderBytes + 4; at < bytes_.size(); at += kFacetBytes) {
      std::array<float, 12> numbers;  // the normal first
      std::memcpy(numbers.data(), bytes_.data() + at, sizeof numbers);
      for (std::size_t i = 3; i < numbers.size(); i += 3) {
        add_vertex(Eigen::Vector3f(numbers[i], numbers[i + 1], numbers[i + 2]).cast<double>());
      }
      colored = colored || bytes_.substr(at + sizeof numbers, 2) != std::string(2, '\0');
    }
    if (colored) {
      imported_.mesh.notes.push_back(fmt::format("{}: left out: colors of facets", file_.string()));
    }
  }

  // Corners at the same place are one vertex.
  void add_vertex(const Vec3& position) {
    const auto [known, is_new] = vertices_.try_emplace(position, 0U);
    if (is_new) known->second = imported_.add_vertex(position, Vec3::Zero());
    corners_.push_back(known->second);
    if (corners_.size() < 3) return;
    imported_.add_triangle(corners_[0], corners_[1], corners_[2], 0);
    corners_.clear();
  }

  void read_text() {
    while (next_line()) {
      expect("solid", kAnyWords);
      for (;;) {
        if (!next_line()) throw MeshFault("the file ends before 'endsolid'");
        if (same_word(words_[0], "endsolid")) break;
        read_facet();
      }
    }
  }

  void read_facet() {
    expect("facet", 5);  // normal x y z: often zero or NaN, and never used
    need_line();
    expect("outer", 2);
    for (int corner = 0; corner < 3; ++corner) {
      need_line();
      expect("vertex", 4);
      Vec3 position;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::optional<double> value = parse_number(words_[i + 1]);
        if (!value || std::abs(*value) > kMaxCoordinate) {
          throw MeshFault(fmt::format("vertex coordinate '{}' is not a number of at most {}",
                                      excerpt(words_[i + 1]), kMaxCoordinate));
        }
        position[static_cast<Eigen::Index>(i)] = *value;
      }
      add_vertex(position);
    }
    need_line();
    expect("endloop", 1);
    need_line();
    expect("endfacet", 1);
  }

  void need_line() {
    if (!next_line()) throw MeshFault("the file ends within a facet");
  }

  // Skips empty lines.
  bool next_line() {
    std::string_view line;
    while (lines_.next(line)) {
      line_ = lines_.number();
      words(line, words_);
      if (!words_.empty()) return true;
    }
    return false;
  }

  static constexpr std::size_t kAnyWords = 0;

  void expect(std::string_view keyword, std::size_t words) const {
    if (!same_word(words_[0], keyword)) {
      throw MeshFault(fmt::format("'{}' found where '{}' must stand", excerpt(words_[0]), keyword));
    }
    if (words != kAnyWords && words_.size() != words) {
      throw MeshFault(fmt::format("'{}' must have {} words behind it, has {}", keyword, words - 1,
                                  words_.size() - 1));
    }
  }

  const std::filesystem::path& file_;
  std::string_view bytes_, text_;
  LineReader lines_;
  unsigned line_ = 0;  // 0 in a binary file
  std::vector<std::string_view> words_;
  std::unordered_map<Vec3, std::uint32_t, HashOfVector> vertices_;
  std::vector<std::uint32_t> corners_;  // of the facet
  ImportedMesh imported_;
};

}  // namespace

ImportedMesh read_stl(const MeshSource& source) {
  return StlReader(source).run();
}

}  // namespace phongpipe
