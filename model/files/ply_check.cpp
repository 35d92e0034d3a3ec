#include "model/files/ply_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cstdint>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>

#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/mesh.h"

namespace phongpipe {
namespace {

enum class Encoding { ascii, little_endian, big_endian };
enum class Type { i8, u8, i16, u16, i32, u32, f32, f64 };

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
};

class PlyChecker {
 public:
  explicit PlyChecker(const std::filesystem::path& file)
      : file_(file), text_(read_whole_file(file)), lines_(text_) {}

  void run() {
    read_header();
    bytes_ = lines_.rest();
    for (const Element& element : elements_) {
      if (element.properties.empty()) {
        fail(fmt::format("element '{}' has no properties", element.name));
      }
      for (long i = 0; i < element.count; ++i) {
        item_ = fmt::format("{} {}", element.name, i);
        check_item(element);
      }
    }
  }

 private:
  void read_header() {
    std::string_view line;
    if (!lines_.next(line) || trimmed(line) != "ply") {
      fail("not a PLY file, the first line must be 'ply'");
    }
    while (lines_.next(line)) {
      const std::vector<std::string_view> parts = words(line);
      if (parts.empty() || parts[0] == "comment" || parts[0] == "obj_info") {
        continue;
      }
      if (parts[0] == "end_header") {
        return;
      }
      read_header_line(parts);
    }
    fail("the header has no 'end_header'");
  }

  void read_header_line(const std::vector<std::string_view>& parts) {
    if (parts[0] == "format" && parts.size() >= 2) {
      encoding_ = parts[1] == "binary_little_endian" ? Encoding::little_endian
                  : parts[1] == "binary_big_endian"  ? Encoding::big_endian
                                                     : Encoding::ascii;
    } else if (parts[0] == "element" && parts.size() == 3) {
      const std::optional<long> count = parse_integer(parts[2]);
      if (!count || *count < 0) {
        fail(fmt::format("element count '{}' is not a whole number", parts[2]));
      }
      elements_.push_back({std::string(parts[1]), *count, {}});
      vertices_ = parts[1] == "vertex" ? *count : vertices_;
    } else if (parts[0] == "property" && !elements_.empty() &&
               parts.size() == (parts[1] == "list" ? 5U : 3U)) {
      Property property;
      property.name = parts.back();
      property.type = type(parts[parts.size() - 2]);
      if (parts[1] == "list") {
        property.count = type(parts[2]);
      }
      elements_.back().properties.push_back(property);
    } else {
      fail(fmt::format("header line not understood: '{}'", fmt::join(parts, " ")));
    }
  }

  Type type(std::string_view name) const {
    const auto found = kTypes.find(name);
    if (found == kTypes.end()) {
      fail(fmt::format("unknown property type '{}'", name));
    }
    return found->second;
  }

  void check_item(const Element& element) {
    if (encoding_ == Encoding::ascii) {
      next_item_line();
    }
    for (const Property& property : element.properties) {
      if (property.count) {
        const double count = read(*property.count);
        if (count < 0) {
          fail(fmt::format("{}: list length {} is negative", item_, count));
        }
        const bool indices = property.name == "vertex_indices" || property.name == "vertex_index";
        const auto length = static_cast<std::uint64_t>(count);
        for (std::uint64_t i = 0; i < length; ++i) {
          const double value = read(property.type);
          if (indices && (value < 0 || value >= static_cast<double>(vertices_))) {
            fail(fmt::format("{} refers to vertex {}, but the file has {} (counted from 0)", item_,
                             value, vertices_));
          }
        }
      } else {
        const double value = read(property.type);
        if (!std::isfinite(value) || std::abs(value) > kMaxCoordinate) {
          fail(fmt::format("{}: {} is {}, must be a number of at most {}", item_, property.name,
                           value, kMaxCoordinate));
        }
      }
    }
  }

  void next_item_line() {
    std::string_view line;
    do {
      if (!lines_.next(line)) {
        fail(fmt::format("the file ends before {}", item_));
      }
    } while (trimmed(line).empty());
    words_ = words(line);
    next_word_ = 0;
  }

  double read(Type type) { return encoding_ == Encoding::ascii ? read_word() : read_bytes(type); }

  double read_word() {
    if (next_word_ == words_.size()) {
      fail(fmt::format("{} has too few numbers", item_));
    }
    const std::string_view word = words_[next_word_++];
    const std::optional<double> value = parse_number(word);
    if (!value) {
      fail(fmt::format("{}: '{}' is not a finite number", item_, word));
    }
    return *value;
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
      fail(fmt::format("the file ends before {} is complete", item_));
    }
    std::copy_n(bytes_.begin(), raw.size(), raw.begin());
    bytes_.remove_prefix(raw.size());
    if (encoding_ == Encoding::big_endian) {  // every host of ours is little-endian
      std::reverse(raw.begin(), raw.end());
    }
    Value value;
    std::memcpy(&value, raw.data(), sizeof(Value));
    return value;
  }

  [[noreturn]] void fail(const std::string& message) const {
    const bool has_line = item_.empty() || encoding_ == Encoding::ascii;
    throw InputError(file_, has_line ? lines_.number() : 0, message);
  }

  const std::filesystem::path& file_;
  const std::string text_;
  LineReader lines_;
  std::string_view bytes_;  // what is left of a binary body
  Encoding encoding_ = Encoding::ascii;
  std::vector<Element> elements_;
  long vertices_ = 0;
  std::string item_;  // being checked, such as "face 3"; empty in the header
  std::vector<std::string_view> words_;
  std::size_t next_word_ = 0;
};

}  // namespace

void check_ply(const std::filesystem::path& file) {
  PlyChecker(file).run();
}

}  // namespace phongpipe
