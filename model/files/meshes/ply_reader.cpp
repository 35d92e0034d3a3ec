#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>

#include "model/files/meshes/imported_mesh.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

enum class Encoding { ascii, little_endian, big_endian };
enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

const std::map<std::string_view, Encoding> kEncodings = {
    {"ascii", Encoding::ascii},
    {"binary_little_endian", Encoding::little_endian},
    {"binary_big_endian", Encoding::big_endian}};

const std::map<std::string_view, Type> kTypes = {
    {"char", Type::i8},   {"int8", Type::i8},     {"uchar", Type::u8},   {"uint8", Type::u8},
    {"short", Type::i16}, {"int16", Type::i16},   {"ushort", Type::u16}, {"uint16", Type::u16},
    {"int", Type::i32},   {"int32", Type::i32},   {"uint", Type::u32},   {"uint32", Type::u32},
    {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64},
};

struct Property {
  std::string name;
  std::optional<Type> count;  // of a list
  Type type = Type::f32;
};

struct Element {
  std::string name;
  long count = 0;
  std::vector<Property> properties;

  // The index of a property that is a list or none, or of nothing.
  std::optional<std::size_t> find(std::string_view property, bool list) const {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == property && properties[i].count.has_value() == list) return i;
    }
    return std::nullopt;
  }
};

class PlyReader {
 public:
  explicit PlyReader(const MeshSource& source)
      : file_(source.file), lines_(without_byte_order_mark(source.bytes)) {}

  ImportedMesh run() try {
    read_header();
    bytes_ = lines_.rest();
    for (const Element& element : elements_) read_element(element);
    check_end();
    add_early_items();
    element_ = nullptr;
    note_left_out();
    return std::move(imported_);
  } catch (const MeshFault& fault) {
    fail(fmt::format("{}: {}", item(), fault.what()));
  }

 private:
  bool ascii() const { return *encoding_ == Encoding::ascii; }

  void read_header() {
    std::string_view line;
    if (!lines_.next(line) || trimmed(line) != "ply") {
      fail("not a PLY file, the first line must be 'ply'");
    }
    while (lines_.next(line)) {
      words(line, words_);
      if (words_.empty() || words_[0] == "comment" || words_[0] == "obj_info") continue;
      if (words_[0] == "end_header") return check_header();
      read_header_line();
    }
    fail("the header has no 'end_header'");
  }

  void read_header_line() {
    if (words_[0] == "format" && words_.size() == 3 && words_[2] == "1.0") {
      const auto found = kEncodings.find(words_[1]);
      if (found == kEncodings.end() || encoding_) {
        fail("the format must be given once, as ascii, binary_little_endian or binary_big_endian");
      }
      encoding_ = found->second;
    } else if (words_[0] == "element" && words_.size() == 3) {
      add_element();
    } else if (words_[0] == "property" && !elements_.empty() && words_.size() > 1 &&
               words_.size() == (words_[1] == "list" ? 5U : 3U)) {
      add_property(elements_.back());
    } else {
      fail(fmt::format("header line not understood: '{}'",
                       excerpt(fmt::format("{}", fmt::join(words_, " ")))));
    }
  }

  void add_element() {
    const std::optional<long> count = parse_integer(words_[2]);
    if (!count || *count < 0) {
      fail(fmt::format("element count '{}' is not a whole number", excerpt(words_[2])));
    }
    for (const Element& other : elements_) {
      if (other.name == words_[1]) {
        fail(fmt::format("element '{}' is declared twice", excerpt(words_[1])));
      }
    }
    elements_.push_back({std::string(words_[1]), *count, {}});
  }

  void add_property(Element& element) {
    Property property;
    property.name = words_.back();
    property.type = type(words_[words_.size() - 2]);
    if (words_[1] == "list") property.count = type(words_[2]);
    if (element.find(property.name, true) || element.find(property.name, false)) {
      fail(fmt::format("property '{}' is declared twice", excerpt(property.name)));
    }
    element.properties.push_back(std::move(property));
  }

  Type type(std::string_view name) const {
    const auto found = kTypes.find(name);
    if (found == kTypes.end()) fail(fmt::format("unknown property type '{}'", excerpt(name)));
    return found->second;
  }

  void check_header() const {
    if (!encoding_) fail("the header has no line 'format ascii 1.0' or the like");
    // The first byte of a binary body may look like the second of a line end.
    if (!ascii() && lines_.ends_with_carriage_return()) {
      fail("the header of a binary file must have line feeds at the ends of its lines");
    }
    for (const Element& element : elements_) {
      if (element.properties.empty() && element.count > 0) {
        fail(fmt::format("element '{}' has no properties", excerpt(element.name)));
      }
      for (const char* axis : {"x", "y", "z"}) {
        if (element.name == "vertex" && !element.find(axis, false)) {
          fail(fmt::format("element 'vertex' has no property '{}'", axis));
        }
      }
      if (has_corners(element) && !corner_list(element)) {
        fail(fmt::format("element '{}' has no list 'vertex_indices'", element.name));
      }
    }
  }

  struct EarlyItem {
    const Element* element;
    long item;
    std::vector<double> corners;
  };
  static constexpr std::array<std::string_view, 6> kVertexColumns = {"x",  "y",  "z",
                                                                     "nx", "ny", "nz"};

  static bool has_corners(const Element& element) {
    return element.name == "face" || element.name == "tristrips";
  }
  static std::optional<std::size_t> corner_list(const Element& element) {
    const auto found = element.find("vertex_indices", true);
    return found ? found : element.find("vertex_index", true);
  }

  void read_element(const Element& element) {
    element_ = &element;
    item_ = 0;
    if (element.name == "vertex") return read_vertices(element);
    const auto corners = has_corners(element) ? corner_list(element) : std::nullopt;
    for (; item_ < element.count; ++item_) {
      read_item(element, corners);
      if (!corners) continue;
      if (vertices_read_) {
        add_item();
      } else {
        early_items_.push_back({&element, item_, list_});
      }
    }
  }

  // Adds the face or the strips whose corners are in list_.
  void add_item() {
    if (element_->name == "tristrips") return add_strips();
    check_corners(0);
    corners_.assign(list_.begin(), list_.end());
    imported_.add_polygon(corners_, 0);
  }

  // Those that stand before the vertices.
  void add_early_items() {
    for (EarlyItem& early : early_items_) {
      element_ = early.element;
      item_ = early.item;
      list_ = std::move(early.corners);
      add_item();
    }
  }

  void note_left_out() {
    std::vector<std::string> left_out;
    for (const Element& element : elements_) {
      if (element.name != "vertex" && !has_corners(element)) {
        left_out.push_back(excerpt(element.name));
        continue;
      }
      for (const Property& property : element.properties) {
        const bool used = has_corners(element)
                              ? &property == &element.properties[*corner_list(element)]
                              : std::find(std::begin(kVertexColumns), std::end(kVertexColumns),
                                          property.name) != std::end(kVertexColumns);
        if (!used) left_out.push_back(fmt::format("{}.{}", element.name, excerpt(property.name)));
      }
    }
    if (left_out.empty()) return;
    imported_.mesh.notes.push_back(
        fmt::format("{}: left out: {}", file_.string(),
                    excerpt(fmt::format("{}", fmt::join(left_out, ", ")), 500)));
  }

  void read_vertices(const Element& element) {
    std::array<std::optional<std::size_t>, kVertexColumns.size()> columns;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      columns[i] = element.find(kVertexColumns[i], false);
    }
    const bool normals = columns[3] && columns[4] && columns[5];
    if (!normals) imported_.file_normals = FileNormals::missing;
    used_.assign(element.properties.size(), false);
    for (std::size_t i = 0; i < (normals ? 6U : 3U); ++i) used_[*columns[i]] = true;
    for (; item_ < element.count; ++item_) {
      read_item(element, std::nullopt);
      const auto value = [&](std::size_t i) { return values_[*columns[i]]; };
      imported_.add_vertex({value(0), value(1), value(2)},
                           normals ? Vec3(value(3), value(4), value(5)) : Vec3::Zero());
    }
    used_.clear();
    vertices_read_ = true;
  }

  // Fills list_ from the property `list`, and values_ with the properties that are used.
  void read_item(const Element& element, std::optional<std::size_t> list) {
    if (ascii()) next_item_line();
    values_.resize(element.properties.size());
    list_.clear();
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (property.count) {
        read_list(property, i == list);
      } else if (i < used_.size() && used_[i]) {
        values_[i] = read(property.type);
        // A normal may be NaN, as long as no face has it.
        if (property.name.front() != 'n' && !(std::abs(values_[i]) <= kMaxCoordinate)) {
          throw MeshFault(fmt::format("{} is {}, must be a number of at most {}", property.name,
                                      values_[i], kMaxCoordinate));
        }
      } else {
        skip(property.type);
      }
    }
    if (ascii() && next_word_ != words_.size())
      fail(fmt::format("{} has too many numbers", item()));
  }

  void read_list(const Property& property, bool wanted) {
    const double count = read(*property.count);
    constexpr double kMost = 1e9;
    if (!(count >= 0 && count <= kMost && count == std::floor(count))) {
      fail(fmt::format("{}: list length {} is not a whole number up to {}", item(), count, kMost));
    }
    const auto length = static_cast<std::uint64_t>(count);
    for (std::uint64_t i = 0; i < length; ++i) {
      if (wanted) {
        list_.push_back(read(property.type));
      } else {
        skip(property.type);
      }
    }
  }

  // Of a strip, -1 begins the next one.
  void check_corners(double least) const {
    const std::size_t vertices = imported_.mesh.positions.size();
    for (const double index : list_) {
      if (!(index >= least && index < static_cast<double>(vertices) &&
            index == std::floor(index))) {
        fail(fmt::format("{} refers to vertex {}, but the file has {} (counted from 0)", item(),
                         index, vertices));
      }
    }
  }

  void add_strips() {
    check_corners(-1);
    corners_.clear();
    for (const double index : list_) {
      if (index >= 0) {
        corners_.push_back(static_cast<std::uint32_t>(index));
        continue;
      }
      imported_.add_strip(corners_, 0);
      corners_.clear();
    }
    imported_.add_strip(corners_, 0);
  }

  void next_item_line() {
    std::string_view line;
    do {
      if (!lines_.next(line)) fail(fmt::format("the file ends before {}", item()));
      words(line, words_);
    } while (words_.empty());
    next_word_ = 0;
  }

  // A count that is too small would show half a mesh.
  void check_end() {
    const std::string_view rest = ascii() ? lines_.rest() : bytes_;
    if (rest.find_first_not_of(std::string_view("\0 \t\r\n", 5)) != std::string_view::npos) {
      throw InputError(file_, 0, "the file goes on behind what its header counts");
    }
  }

  std::string_view next_word() {
    if (next_word_ == words_.size()) fail(fmt::format("{} has too few numbers", item()));
    return words_[next_word_++];
  }

  double read(Type type) {
    if (!ascii()) return read_bytes(type);
    const std::string_view word = next_word();
    const std::optional<double> value = parse_any_number(word);
    if (!value) fail(fmt::format("{}: '{}' is not a number", item(), excerpt(word)));
    return *value;
  }

  void skip(Type type) {
    if (ascii()) {
      next_word();
    } else {
      read_bytes(type);
    }
  }

  double read_bytes(Type type) {
    switch (type) {
      case Type::i8:
        return read_as<std::int8_t>();
      case Type::u8:
        return read_as<std::uint8_t>();
      case Type::i16:
        return read_as<std::int16_t>();
      case Type::u16:
        return read_as<std::uint16_t>();
      case Type::i32:
        return read_as<std::int32_t>();
      case Type::u32:
        return read_as<std::uint32_t>();
      case Type::f32:
        return static_cast<double>(read_as<float>());
      case Type::f64:
        break;
    }
    return read_as<double>();
  }

  template <class Value>
  Value read_as() {
    std::array<char, sizeof(Value)> raw;
    if (bytes_.size() < raw.size()) {
      fail(fmt::format("the file ends before {} is complete", item()));
    }
    std::copy_n(bytes_.begin(), raw.size(), raw.begin());
    bytes_.remove_prefix(raw.size());
    if (*encoding_ == Encoding::big_endian) {  // every host of ours is little-endian
      std::reverse(raw.begin(), raw.end());
    }
    Value value;
    std::memcpy(&value, raw.data(), sizeof(Value));
    return value;
  }

  std::string item() const { return fmt::format("{} {}", excerpt(element_->name), item_); }

  [[noreturn]] void fail(const std::string& message) const {
    const bool has_line = element_ == nullptr || ascii();
    throw InputError(file_, has_line ? lines_.number() : 0, message);
  }

  const std::filesystem::path& file_;
  LineReader lines_;
  std::string_view bytes_;  // what is left of a binary body
  std::optional<Encoding> encoding_;
  std::vector<Element> elements_;
  const Element* element_ = nullptr;  // being read; null in the header
  long item_ = 0;                     // of the element
  std::vector<std::string_view> words_;
  std::size_t next_word_ = 0;
  std::vector<bool> used_;      // by property: whether its value is wanted
  std::vector<double> values_;  // by property
  std::vector<double> list_;
  std::vector<std::uint32_t> corners_;
  bool vertices_read_ = false;
  std::vector<EarlyItem> early_items_;
  ImportedMesh imported_;
};

}  // namespace

ImportedMesh read_ply(const MeshSource& source) {
  return PlyReader(source).run();
}

}  // namespace phongpipe
