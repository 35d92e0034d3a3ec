#include "model/files/text_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <type_traits>

#include "model/scene/input_error.h"

namespace phongpipe {
namespace {

constexpr std::string_view kBlank = " \t\r";

template <class Number>
std::optional<Number> parse_whole(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') {
    word.remove_prefix(1);  // from_chars takes no plus sign
  }
  Number value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if constexpr (std::is_floating_point_v<Number>) {
    // Too near to zero for a double, or too far from it.
    if (error == std::errc::result_out_of_range && end == word.data() + word.size()) {
      return std::strtod(std::string(word).c_str(), nullptr);
    }
  }
  if (error != std::errc() || end != word.data() + word.size()) {
    return std::nullopt;
  }
  return value;
}

struct OpenFile {
  explicit OpenFile(int opened) : descriptor(opened) {}
  ~OpenFile() {
    if (descriptor >= 0) close(descriptor);
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  struct stat status() const {
    struct stat result {};
    fstat(descriptor, &result);
    return result;
  }

  const int descriptor;
};

const char* kind_of(mode_t mode) {
  return S_ISDIR(mode)                    ? "directory"
         : S_ISFIFO(mode)                 ? "pipe"
         : S_ISCHR(mode) || S_ISBLK(mode) ? "device"
                                          : "socket";
}

}  // namespace

std::string read_whole_file(const std::filesystem::path& file, std::size_t max_bytes) {
  // Without waiting for whoever writes to a pipe.
  const OpenFile opened(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
  if (opened.descriptor < 0) {
    throw InputError(file, 0,
                     errno == ENOENT  ? "no such file"
                     : errno == ENXIO ? "is a socket or a device, not a file"
                                      : fmt::format("cannot be read: {}", std::strerror(errno)));
  }
  const struct stat before = opened.status();
  if (!S_ISREG(before.st_mode)) {
    throw InputError(file, 0, fmt::format("is a {}, not a file", kind_of(before.st_mode)));
  }
  const auto size = static_cast<std::size_t>(before.st_size);
  if (size > max_bytes) {
    throw InputError(file, 0, fmt::format("has {} bytes, may have at most {}", size, max_bytes));
  }
  // One byte more shows whether the file has grown.
  std::string text(size + 1, '\0');
  std::size_t done = 0;
  for (ssize_t count = 1; count > 0 && done < text.size();) {
    count = read(opened.descriptor, text.data() + done, text.size() - done);
    if (count > 0) done += static_cast<std::size_t>(count);
    if (count < 0 && errno == EINTR) count = 1;
    if (count < 0) {
      throw InputError(file, 0, fmt::format("cannot be read: {}", std::strerror(errno)));
    }
  }
  const struct stat after = opened.status();
  if (done != size || after.st_size != before.st_size ||
      after.st_mtim.tv_sec != before.st_mtim.tv_sec ||
      after.st_mtim.tv_nsec != before.st_mtim.tv_nsec) {
    throw InputError(file, 0, "changed while it was read; try again");
  }
  text.resize(size);
  if (text.find_first_not_of(" \t\r\n") == std::string::npos) {
    throw InputError(file, 0, "the file is empty");
  }
  return text;
}

bool LineReader::next(std::string_view& line) {
  if (rest_.empty()) return false;
  const std::size_t end = std::min(rest_.find_first_of("\r\n"), rest_.size());
  line = rest_.substr(0, end);
  const bool pair = rest_.substr(end, 2) == "\r\n";
  ends_with_carriage_return_ = !pair && end < rest_.size() && rest_[end] == '\r';
  rest_.remove_prefix(std::min(end + (pair ? 2 : 1), rest_.size()));
  ++number_;
  return true;
}

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  if (text.substr(0, kMark.size()) == kMark) text.remove_prefix(kMark.size());
  return text;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) {
    return {};
  }
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> parts;
  for (std::size_t end = line.find(separator); end != std::string_view::npos;
       end = line.find(separator)) {
    parts.push_back(line.substr(0, end));
    line.remove_prefix(end + 1);
  }
  parts.push_back(line);
  return parts;
}

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> parts;
  words(line, parts);
  return parts;
}

void words(std::string_view line, std::vector<std::string_view>& parts) {
  parts.clear();
  for (std::size_t begin = line.find_first_not_of(kBlank); begin != std::string_view::npos;
       begin = line.find_first_not_of(kBlank)) {
    line.remove_prefix(begin);
    const std::size_t end = std::min(line.find_first_of(kBlank), line.size());
    parts.push_back(line.substr(0, end));
    line.remove_prefix(end);
  }
}

std::string excerpt(std::string_view text, std::size_t max_bytes) {
  std::size_t end = std::min(text.size(), max_bytes);
  while (end > 0 && end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) {
    --end;  // not within a character of UTF-8
  }
  std::string result;
  for (const char c : text.substr(0, end)) result += c == '\0' ? "\\x00" : std::string(1, c);
  return end < text.size() ? result + "..." : result;
}

std::optional<double> parse_any_number(std::string_view word) {
  return parse_whole<double>(word);
}

std::optional<double> parse_number(std::string_view word) {
  const std::optional<double> value = parse_any_number(word);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

std::optional<long> parse_integer(std::string_view word) {
  return parse_whole<long>(word);
}

}  // namespace phongpipe
