// Checked reading of TOML: every mistake becomes an InputError that names file and line.
//
// Each getter registers its key, and finish() refuses keys that are not registered. So only the
// code that reads a table says which keys it may contain.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace phongpipe {

struct NumberRange {  // inclusive
  double min = std::numeric_limits<double>::lowest();
  double max = std::numeric_limits<double>::max();
};

// Larger files are refused. Also refused are keys of more than 64 parts, and texts whose keys and
// values would take more than 320 MiB.
constexpr std::size_t kMaxTomlBytes = std::size_t{32} << 20;

// A handle to one table of a parsed file; copies share the file and the registered keys.
class TomlTable {
 public:
  // `overrides`: path=value, each of which replaces or adds a key, such as
  // material.gold.shininess=20 or light.0.color=[1, 1, 1] (the first [[light]]). The value is TOML;
  // a bare word is a string.
  static TomlTable read_file(const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {});

  // The same of a text; `file` is what messages call it.
  static TomlTable read_text(const std::string& text, const std::filesystem::path& file,
                             const std::vector<std::string>& overrides = {});

  const std::filesystem::path& file() const;
  unsigned line() const;                      // of the table
  unsigned line(std::string_view key) const;  // of the key, or of the table when it is absent
  bool has(std::string_view key) const;       // registers the key

  // A getter without a fallback requires the key.
  double number(std::string_view key, NumberRange range) const;
  double number(std::string_view key, NumberRange range, double fallback) const;
  int integer(std::string_view key, int min, int max) const;
  int integer(std::string_view key, int min, int max, int fallback) const;
  bool boolean(std::string_view key) const;
  bool boolean(std::string_view key, bool fallback) const;
  std::string text(std::string_view key) const;
  std::string text(std::string_view key, std::string_view fallback) const;
  // [a, b, c]
  std::array<double, 3> triple(std::string_view key, NumberRange range) const;
  // [r, g, b], or one number for all three; 0 to 1.
  std::array<double, 3> color(std::string_view key) const;
  // [a, b], whole numbers
  std::array<int, 2> integer_pair(std::string_view key, int min, int max) const;

  // [[a, b, …], …]: rows of `columns` numbers.
  std::vector<std::vector<double>> rows(std::string_view key, std::size_t columns,
                                        NumberRange range) const;

  template <class Enum>
  using Choices = std::initializer_list<std::pair<std::string_view, Enum>>;
  template <class Enum>
  Enum choice(std::string_view key, Choices<Enum> choices) const {
    std::vector<std::string_view> names;
    for (const auto& [name, value] : choices) {
      names.push_back(name);
    }
    return (choices.begin() + choice_index(key, names))->second;
  }
  template <class Enum>
  Enum choice(std::string_view key, Choices<Enum> choices, Enum fallback) const {
    return has(key) ? choice(key, choices) : fallback;
  }

  // All keys that the table has, in its order. For tables whose keys are not known beforehand.
  std::vector<std::string> keys() const;
  // The text, number or flag, or those of an array, as text.
  std::vector<std::string> values(std::string_view key) const;

  TomlTable table(std::string_view key) const;  // [key]
  std::optional<TomlTable> optional_table(std::string_view key) const;
  // [[key]], at least one
  std::vector<TomlTable> tables(std::string_view key) const;
  // [key.NAME] in the order of the file; none when the key is absent
  std::vector<std::pair<std::string, TomlTable>> named_tables(std::string_view key) const;

  // Fails with the reason if the key is present. For keys that are known but do not belong here.
  void refuse(std::string_view key, const std::string& reason) const;
  // Fails if the table has unregistered keys. Call it after reading the whole table.
  void finish() const;
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;

 private:
  struct State;
  explicit TomlTable(std::shared_ptr<State> state) : state_(std::move(state)) {}
  std::ptrdiff_t choice_index(std::string_view key,
                              const std::vector<std::string_view>& names) const;

  std::shared_ptr<State> state_;
};

}  // namespace phongpipe
