// Text files in lines, words and numbers.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace phongpipe {

constexpr std::size_t kMaxFileBytes = std::size_t{256} << 20;

// Throws InputError for what is missing, empty, unreadable, larger than `max_bytes` or not a file
// (a folder, a pipe, a device, links in a circle), and for a file that changes meanwhile.
std::string read_whole_file(const std::filesystem::path& file,
                            std::size_t max_bytes = kMaxFileBytes);

// Walks through a text line by line, without the line ends (\n, \r\n, or \r alone).
class LineReader {
 public:
  explicit LineReader(std::string_view text) : rest_(text) {}
  bool next(std::string_view& line);
  unsigned number() const { return number_; }      // of the line read last, from 1
  std::string_view rest() const { return rest_; }  // the text after that line
  bool ends_with_carriage_return() const { return ends_with_carriage_return_; }  // alone

 private:
  std::string_view rest_;
  unsigned number_ = 0;
  bool ends_with_carriage_return_ = false;
};

std::string_view without_byte_order_mark(std::string_view text);  // of UTF-8
std::string_view trimmed(std::string_view text);
inline bool starts_with(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}
std::vector<std::string_view> split(std::string_view line, char separator);
// The words between spaces and tabs; none is empty.
std::vector<std::string_view> words(std::string_view line);
void words(std::string_view line, std::vector<std::string_view>& parts);
// The beginning of a text, for a message: "..." stands for the rest, and \x00 for a zero byte.
std::string excerpt(std::string_view text, std::size_t max_bytes = 60);

// Empty unless the whole of `word` is a finite number.
std::optional<double> parse_number(std::string_view word);
std::optional<long> parse_integer(std::string_view word);
// The same for a number that may be infinite or NaN.
std::optional<double> parse_any_number(std::string_view word);

}  // namespace phongpipe
