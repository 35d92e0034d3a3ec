#include "model/files/toml_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "model/files/spelling.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

unsigned line_of(const toml::node& node) {
  return node.source().begin.line;
}

// Keeps from the parser what would take too much of the stack (a key of many parts, on which it
// recurs) or of memory. Arrays within arrays it limits itself, to a depth of 256.
class SizeCheck {
 public:
  SizeCheck(std::string_view text, std::filesystem::path file)
      : text_(text), file_(std::move(file)) {}

  void run() {
    while (at_ < text_.size()) step();
  }

 private:
  static constexpr std::size_t kMaxKeyParts = 64;
  // Bytes that the parser needs for a number or a text in an array, an array, and a key with its
  // value or its table, as measured, and how many bytes there may be.
  static constexpr std::size_t kItemBytes = 80, kArrayBytes = 160, kKeyBytes = 320,
                               kMaxBytes = std::size_t{320} << 20;

  void step() {
    switch (text_[at_]) {
      case '#':
        at_ = std::min(text_.find('\n', at_), text_.size());
        return;
      case '"':
      case '\'':
        return skip_string(text_[at_]);
      case '.':
        if (++dots_ >= kMaxKeyParts) {
          fail(fmt::format("a key may have at most {} parts between dots", kMaxKeyParts));
        }
        break;
      case ',':
        count(kItemBytes);
        break;
      case '[':
        count(kArrayBytes);
        break;
      case '{':
        count(kKeyBytes);
        break;
      case '=':
      case '\n':  // [a.b.c] is a key as well
        count(kKeyBytes * (dots_ + (text_[at_] == '=' ? 1 : 0)));
        break;
      default:
        break;
    }
    ++at_;
  }

  // What is counted ends what a dot belongs to.
  void count(std::size_t bytes) {
    dots_ = 0;
    bytes_ += bytes;
    if (bytes_ > kMaxBytes) {
      fail(fmt::format("holds too much: more than {} MiB of keys and values", kMaxBytes >> 20U));
    }
  }

  void skip_string(char quote) {
    const std::string three(3, quote);
    const bool long_string = text_.substr(at_, 3) == three;
    at_ += long_string ? 3 : 1;
    for (; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        ++at_;
      } else if (long_string ? text_.substr(at_, 3) == three : text_[at_] == quote) {
        at_ += long_string ? 3 : 1;
        // Two quotes may stand before those that end a long string.
        for (int i = 0; long_string && i < 2 && at_ < text_.size() && text_[at_] == quote; ++i) {
          ++at_;
        }
        return;
      } else if (text_[at_] == '\n' && !long_string) {
        return;  // a mistake that the parser finds
      }
    }
  }

  [[noreturn]] void fail(const std::string& message) const {
    const auto lines =
        std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw InputError(file_, static_cast<unsigned>(lines) + 1, message);
  }

  const std::string_view text_;
  const std::filesystem::path file_;
  std::size_t at_ = 0, dots_ = 0, bytes_ = 0;
};

}  // namespace

struct TomlTable::State {
  std::filesystem::path file;
  std::shared_ptr<const toml::table> document;  // keeps `table` alive
  const toml::table* table = nullptr;
  std::string name;  // as messages show it; empty for the file itself
  std::set<std::string, std::less<>> known;

  const toml::node* find(std::string_view key) {
    known.emplace(key);
    return table->get(key);
  }
  const toml::node& require(std::string_view key);
  // An array of `kCount` numbers. `expected`: what the key must be; `fault_of` tells what is wrong
  // with a number, nothing where it is right.
  template <typename Number, std::size_t kCount, typename FaultOf>
  std::array<Number, kCount> numbers(std::string_view key, std::string_view expected,
                                     FaultOf fault_of);
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  // `shown` is how the message writes the key.
  [[noreturn]] void fail_missing(std::string_view key, const std::string& shown) const;
  unsigned line() const { return name.empty() ? 0 : line_of(*table); }
  unsigned line(std::string_view key) const;
  std::shared_ptr<State> inner(const toml::table& inner_table, std::string inner_name) const {
    return std::make_shared<State>(State{file, document, &inner_table, std::move(inner_name), {}});
  }
};

namespace {

// Why a node is not a number within the range; empty when it is.
std::string number_fault(const toml::node& node, NumberRange range) {
  const std::optional<double> value = node.is_number() ? node.value<double>() : std::nullopt;
  if (!value) {
    return "must be a number";
  }
  if (!std::isfinite(*value)) {
    return "must be finite";
  }
  if (*value < range.min || *value > range.max) {
    if (range.max == NumberRange{}.max) {
      return fmt::format("is {}, must be at least {}", *value, range.min);
    }
    return fmt::format("is {}, must be from {} to {}", *value, range.min, range.max);
  }
  return {};
}

std::string integer_fault(const toml::node& node, int min, int max) {
  if (!node.is_integer()) {
    return "must be a whole number";
  }
  const std::int64_t value = *node.value<std::int64_t>();
  return value < min || value > max ? fmt::format("is {}, must be from {} to {}", value, min, max)
                                    : std::string();
}

}  // namespace

unsigned TomlTable::State::line(std::string_view key) const {
  const toml::node* node = table->get(key);
  return node == nullptr ? line() : line_of(*node);
}

void TomlTable::State::fail(std::string_view key, const std::string& message) const {
  throw InputError(file, line(key), message);
}

void TomlTable::State::fail_missing(std::string_view key, const std::string& shown) const {
  // A misspelt key is the likeliest reason, and its line is the one to look at.
  std::vector<std::string> strangers;
  for (const auto& [written, node] : *table) {
    if (known.count(written.str()) == 0) {
      strangers.emplace_back(written.str());
    }
  }
  const std::string stranger = closest_word(key, strangers);
  if (!stranger.empty()) {
    fail(stranger, fmt::format("unknown key '{}', did you mean '{}'?", stranger, key));
  }
  if (name.empty()) {
    fail({}, fmt::format("missing {}", shown));
  }
  fail({}, fmt::format("{} needs {}", name, shown));
}

const toml::node& TomlTable::State::require(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) {
    fail_missing(key, fmt::format("'{}'", key));
  }
  return *node;
}

template <typename Number, std::size_t kCount, typename FaultOf>
std::array<Number, kCount> TomlTable::State::numbers(std::string_view key,
                                                     std::string_view expected, FaultOf fault_of) {
  const toml::array* array = require(key).as_array();
  if (array == nullptr || array->size() != kCount) {
    fail(key, fmt::format("{} must be {}", key, expected));
  }
  std::array<Number, kCount> result{};
  for (std::size_t i = 0; i < kCount; ++i) {
    const toml::node& number = (*array)[i];
    const std::string fault = fault_of(number);
    if (!fault.empty()) {
      throw InputError(file, line_of(number), fmt::format("{}[{}] {}", key, i, fault));
    }
    result[i] = *number.value<Number>();
  }
  return result;
}

namespace {

// The node at a key of a table, or at an index of an array; null if there is none.
toml::node* child_of(toml::node& node, std::string_view key) {
  if (toml::table* const table = node.as_table()) return table->get(key);
  const auto index = parse_integer(key);
  toml::array* const array = node.as_array();
  return array != nullptr && index && *index >= 0 ? array->get(static_cast<std::size_t>(*index))
                                                  : nullptr;
}

// A table whose only key is `value`.
toml::table parse_value(const std::string& text) {
  const std::string line = "value = " + text;
  SizeCheck(line, "the value").run();
  try {
    toml::table table = toml::parse(line);
    if (table.size() > 1) {
      throw InputError(fmt::format("{}: more than one value", excerpt(text)));
    }
    return table;
  } catch (const toml::parse_error&) {
    return toml::table{{"value", text}};
  }
}

void apply_override(toml::table& document, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw InputError(fmt::format("{}: write path=value", text));
  const std::string path = text.substr(0, equals);
  const std::vector<std::string_view> keys = split(path, '.');
  toml::node* node = &document;
  for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
    node = child_of(*node, keys[i]);
    if (node != nullptr) continue;
    throw InputError(
        fmt::format("{}: the scene has no {}", text,
                    fmt::join(keys.begin(), keys.begin() + static_cast<long>(i) + 1, ".")));
  }
  toml::table* const table = node->as_table();
  if (table == nullptr) throw InputError(fmt::format("{}: no such key", text));
  const toml::table value = parse_value(text.substr(equals + 1));
  value.get("value")->visit(
      [&](const auto& found) { table->insert_or_assign(std::string(keys.back()), found); });
}

}  // namespace

TomlTable TomlTable::read_file(const std::filesystem::path& file,
                               const std::vector<std::string>& overrides) {
  return read_text(read_whole_file(file, kMaxTomlBytes), file, overrides);
}

TomlTable TomlTable::read_text(const std::string& text, const std::filesystem::path& file,
                               const std::vector<std::string>& overrides) {
  SizeCheck(text, file).run();
  try {
    toml::table parsed = toml::parse(text, file.string());
    for (const std::string& change : overrides) apply_override(parsed, change);
    auto document = std::make_shared<const toml::table>(std::move(parsed));
    return TomlTable(std::make_shared<State>(State{file, document, document.get(), {}, {}}));
  } catch (const toml::parse_error& error) {
    std::string message(error.description());
    std::replace(message.begin(), message.end(), '\n', ' ');
    throw InputError(file, error.source().begin.line, message);
  }
}

const std::filesystem::path& TomlTable::file() const {
  return state_->file;
}

unsigned TomlTable::line() const {
  return state_->line();
}

unsigned TomlTable::line(std::string_view key) const {
  return state_->line(key);
}

bool TomlTable::has(std::string_view key) const {
  return state_->find(key) != nullptr;
}

void TomlTable::fail(std::string_view key, const std::string& message) const {
  state_->fail(key, message);
}

double TomlTable::number(std::string_view key, NumberRange range) const {
  const toml::node& node = state_->require(key);
  const std::string fault = number_fault(node, range);
  if (!fault.empty()) {
    fail(key, fmt::format("{} {}", key, fault));
  }
  return *node.value<double>();
}

double TomlTable::number(std::string_view key, NumberRange range, double fallback) const {
  return has(key) ? number(key, range) : fallback;
}

int TomlTable::integer(std::string_view key, int min, int max) const {
  const toml::node& node = state_->require(key);
  const std::string fault = integer_fault(node, min, max);
  if (!fault.empty()) {
    fail(key, fmt::format("{} {}", key, fault));
  }
  return *node.value<int>();
}

int TomlTable::integer(std::string_view key, int min, int max, int fallback) const {
  return has(key) ? integer(key, min, max) : fallback;
}

bool TomlTable::boolean(std::string_view key) const {
  const toml::node& node = state_->require(key);
  if (!node.is_boolean()) {
    fail(key, fmt::format("{} must be true or false", key));
  }
  return *node.value<bool>();
}

bool TomlTable::boolean(std::string_view key, bool fallback) const {
  return has(key) ? boolean(key) : fallback;
}

std::string TomlTable::text(std::string_view key) const {
  const toml::node& node = state_->require(key);
  const std::optional<std::string> value = node.value_exact<std::string>();
  if (!value || value->empty()) {
    fail(key, fmt::format("{} must be a string in quotes, not empty", key));
  }
  return *value;
}

std::string TomlTable::text(std::string_view key, std::string_view fallback) const {
  return has(key) ? text(key) : std::string(fallback);
}

std::array<double, 3> TomlTable::triple(std::string_view key, NumberRange range) const {
  return state_->numbers<double, 3>(
      key, "three numbers, such as [0, 0, 1]",
      [&](const toml::node& node) { return number_fault(node, range); });
}

std::array<double, 3> TomlTable::color(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node != nullptr && node->is_number()) {
    const double grey = number(key, {0, 1});
    return {grey, grey, grey};
  }
  if (node != nullptr && !node->is_array()) {
    fail(key, fmt::format("{} must be [red, green, blue] or one number, from 0 to 1", key));
  }
  return triple(key, {0, 1});
}

std::array<int, 2> TomlTable::integer_pair(std::string_view key, int min, int max) const {
  return state_->numbers<int, 2>(
      key, "two whole numbers, such as [64, 32]",
      [&](const toml::node& node) { return integer_fault(node, min, max); });
}

std::vector<std::vector<double>> TomlTable::rows(std::string_view key, std::size_t columns,
                                                 NumberRange range) const {
  const toml::node& node = state_->require(key);
  const toml::array* const outer = node.as_array();
  if (outer == nullptr) fail(key, fmt::format("{} must be rows of {} numbers", key, columns));
  std::vector<std::vector<double>> rows;
  rows.reserve(outer->size());
  for (const toml::node& row : *outer) {
    const toml::array* const cells = row.as_array();
    if (cells == nullptr || cells->size() != columns) {
      fail(key, fmt::format("row {} of {} must be {} numbers", rows.size() + 1, key, columns));
    }
    std::vector<double>& values = rows.emplace_back();
    for (const toml::node& cell : *cells) {
      const std::string fault = number_fault(cell, range);
      if (!fault.empty()) {
        fail(key, fmt::format("a number in row {} of {} {}", rows.size(), key, fault));
      }
      values.push_back(*cell.value<double>());
    }
  }
  return rows;
}

std::ptrdiff_t TomlTable::choice_index(std::string_view key,
                                       const std::vector<std::string_view>& names) const {
  const std::string value = text(key);
  const auto found = std::find(names.begin(), names.end(), value);
  if (found == names.end()) {
    fail(key, fmt::format("{} is '{}', must be one of: {}", key, value, fmt::join(names, ", ")));
  }
  return found - names.begin();
}

TomlTable TomlTable::table(std::string_view key) const {
  const std::optional<TomlTable> found = optional_table(key);
  if (!found) {
    state_->fail_missing(key, fmt::format("table [{}]", key));
  }
  return *found;
}

std::optional<TomlTable> TomlTable::optional_table(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) {
    return std::nullopt;
  }
  if (!node->is_table()) {
    fail(key, fmt::format("'{}' must be a table, written [{}]", key, key));
  }
  return TomlTable(state_->inner(*node->as_table(), fmt::format("[{}]", key)));
}

std::vector<TomlTable> TomlTable::tables(std::string_view key) const {
  const toml::node* node = state_->find(key);
  if (node == nullptr) {
    state_->fail_missing(key, fmt::format("table [[{}]]", key));
  }
  const toml::array* array = node->as_array();
  if (array == nullptr || array->empty() || !array->is_homogeneous<toml::table>()) {
    fail(key, fmt::format("'{}' must be tables, written [[{}]]", key, key));
  }
  std::vector<TomlTable> result;
  for (const toml::node& entry : *array) {
    result.push_back(TomlTable(state_->inner(*entry.as_table(), fmt::format("[[{}]]", key))));
  }
  return result;
}

std::vector<std::string> TomlTable::keys() const {
  std::vector<std::string> result;
  for (const auto& [key, node] : *state_->table) result.emplace_back(key.str());
  // toml++ sorts by name; the file's order is what a reader expects.
  std::stable_sort(result.begin(), result.end(),
                   [&](const std::string& a, const std::string& b) { return line(a) < line(b); });
  return result;
}

std::vector<std::string> TomlTable::values(std::string_view key) const {
  std::vector<std::string> result;
  const auto add = [&](const toml::node& node) {
    if (const auto* text = node.as_string()) {
      result.push_back(text->get());
    } else if (const auto* whole = node.as_integer()) {
      result.push_back(fmt::format("{}", whole->get()));
    } else if (const auto* number = node.as_floating_point()) {
      result.push_back(fmt::format("{}", number->get()));
    } else if (const auto* flag = node.as_boolean()) {
      result.emplace_back(flag->get() ? "true" : "false");
    } else {
      fail(key, fmt::format("'{}' must be a text, a number, or an array of these", key));
    }
  };
  const toml::node& node = state_->require(key);
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& item : *array) add(item);
    if (array->empty()) fail(key, fmt::format("'{}' is empty", key));
  } else {
    add(node);
  }
  return result;
}

std::vector<std::pair<std::string, TomlTable>> TomlTable::named_tables(std::string_view key) const {
  std::vector<std::pair<std::string, TomlTable>> result;
  const std::optional<TomlTable> parent = optional_table(key);
  if (!parent) {
    return result;
  }
  for (const auto& [name, node] : *parent->state_->table) {
    if (!node.is_table()) {
      parent->fail(name.str(), fmt::format("'{}' must be a table, written [{}.{}]", name.str(), key,
                                           name.str()));
    }
    result.emplace_back(
        std::string(name.str()),
        TomlTable(state_->inner(*node.as_table(), fmt::format("[{}.{}]", key, name.str()))));
  }
  // toml++ sorts by name; the file's order is what a reader expects.
  std::stable_sort(result.begin(), result.end(),
                   [](const auto& a, const auto& b) { return a.second.line() < b.second.line(); });
  return result;
}

void TomlTable::refuse(std::string_view key, const std::string& reason) const {
  if (has(key)) {
    fail(key, fmt::format("'{}' does not belong here: {}", key, reason));
  }
}

void TomlTable::finish() const {
  const std::vector<std::string> known(state_->known.begin(), state_->known.end());
  for (const auto& [name, node] : *state_->table) {
    if (state_->known.count(name.str()) != 0) {
      continue;
    }
    const std::string where = state_->name.empty() ? "" : " in " + state_->name;
    const std::string meant = closest_word(name.str(), known);
    throw InputError(file(), name.source().begin.line,
                     meant.empty() ? fmt::format("unknown key '{}'{}, known are: {}", name.str(),
                                                 where, fmt::join(known, ", "))
                                   : fmt::format("unknown key '{}'{}, did you mean '{}'?",
                                                 name.str(), where, meant));
  }
}

}  // namespace phongpipe
