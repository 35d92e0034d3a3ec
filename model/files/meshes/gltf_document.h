// The JSON and the buffers of a glTF file, with every reference and every range checked.
#pragma once

#include <cstdint>
#include <deque>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "model/files/meshes/imported_mesh.h"

namespace phongpipe {

// Everything throws MeshFault for what is not as glTF 2.0 wants it.
class GltfDocument {
 public:
  using Json = nlohmann::json;

  explicit GltfDocument(const MeshSource& source);

  const Json& root() const { return root_; }
  // An array of objects at the root; empty where there is none.
  const Json& list(const char* name) const;
  // The same in an object.
  static const Json& list(const Json& object, const char* name);
  // The index into list(target) that an object has at `key`; -1 where there is none.
  std::ptrdiff_t reference(const Json& object, const char* key, const char* target) const;
  // The same of a value, which `key` names in messages.
  std::ptrdiff_t reference_of(const Json& value, const char* key, const char* target) const;

  // A whole number of an object, which it must have unless there is a fallback.
  static std::size_t whole(const Json& object, const char* key, std::size_t most);
  static std::size_t whole(const Json& object, const char* key, std::size_t most,
                           std::size_t fallback);
  // `count` finite numbers.
  static std::vector<double> numbers(const Json& value, const char* what, std::size_t count);
  static std::string text(const Json& object, const char* key);  // empty where there is none

  // The vectors of an accessor, one number after another. Normalized integers become numbers from
  // -1 to 1.
  std::vector<double> vectors(std::ptrdiff_t accessor) const;
  // The unsigned numbers of an accessor.
  std::vector<double> indices(std::ptrdiff_t accessor) const;

  // Keys that the format does not have and extensions that were used, as "node.sale" and
  // "KHR_materials_unlit".
  const std::set<std::string>& left_out() const { return left_out_; }

 private:
  // Numbers in a buffer: `count` rows of `width` numbers.
  struct Layout {
    std::size_t component_type, width, count;
    std::size_t row_bytes() const;
  };

  std::string_view glb_chunks(std::string_view bytes);
  void parse(const std::filesystem::path& file, std::string_view json);
  void check_extensions();
  void note_strangers(const Json& value, const char* kind);
  void read_buffers(const MeshSource& source);
  std::string_view buffer_data(const MeshSource& source, const Json& buffer);
  std::vector<double> read_accessor(std::ptrdiff_t index, std::string_view type, std::size_t most,
                                    const std::vector<std::size_t>& component_types) const;
  std::vector<double> read_view(const Json& owner, const Layout& layout, bool normalized) const;
  void overwrite_sparse(const Json& sparse, const Layout& layout, bool normalized,
                        std::vector<double>& values) const;

  Json root_;
  std::string_view binary_chunk_;
  std::deque<std::string> buffer_files_;  // what buffers_ show, unless it is in the source
  std::vector<std::string_view> buffers_;
  std::set<std::string> left_out_;
};

}  // namespace phongpipe
