#include "testbench/trace/wave_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtkwave/fstapi.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <unordered_map>

#include "model/files/fork.h"
#include "model/files/text_file.h"
#include "model/scene/input_error.h"
#include "model/scene/tool_error.h"
#include "testbench/system/output_file.h"
#include "testbench/system/process.h"
#include "testbench/system/terminal.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

// Calls begin and end for the scopes between two variables, so that scopes nest.
template <typename Begin, typename End>
void change_scope(const std::string& from, const std::string& to, const Begin& begin,
                  const End& end) {
  const std::vector<std::string_view> old_parts = split(from, '.'), new_parts = split(to, '.');
  std::size_t same = 0;
  while (same < old_parts.size() && same < new_parts.size() && old_parts[same] == new_parts[same] &&
         !from.empty()) {
    ++same;
  }
  if (!from.empty()) {
    for (std::size_t i = old_parts.size(); i > same; --i) end();
  }
  if (!to.empty()) {
    for (std::size_t i = same; i < new_parts.size(); ++i) begin(std::string(new_parts[i]));
  }
}

// The file under another name until it is complete.
class PartialFile {
 public:
  explicit PartialFile(const fs::path& file)
      : file_(file), partial_(file.string() + fmt::format(".partial-{}", getpid())) {
    check_writable(file);
  }
  ~PartialFile() {
    std::error_code ignored;
    fs::remove(partial_, ignored);
  }
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;

  const std::string& name() const { return partial_; }
  void complete() const {
    std::error_code error;
    fs::rename(partial_, file_, error);
    if (error) fail(error.message());
  }
  [[noreturn]] void fail(const std::string& reason) const {
    throw ToolError(fmt::format("{}: {}", printable(file_.string()), reason));
  }

 private:
  fs::path file_;
  std::string partial_;
};

class FstWriter : public WaveWriter {
 public:
  FstWriter(const fs::path& path, const std::vector<WaveVariable>& variables)
      : file_(path), fst_(fstWriterCreate(file_.name().c_str(), 1)) {
    if (fst_ == nullptr) file_.fail("cannot be written");
    fstWriterSetPackType(fst_, FST_WR_PT_LZ4);
    fstWriterSetTimescale(fst_, -12);
    fstWriterSetVersion(fst_, "phongpipe");
    const auto begin = [this](const std::string& name) {
      fstWriterSetScope(fst_, FST_ST_VCD_MODULE, name.c_str(), nullptr);
    };
    const auto end = [this] { fstWriterSetUpscope(fst_); };
    std::string scope;
    for (const WaveVariable& variable : variables) {
      change_scope(scope, variable.scope, begin, end);
      scope = variable.scope;
      const std::string range = variable.range();
      is_real_.push_back(variable.real);
      const std::string name = range.empty() ? variable.name : variable.name + " " + range;
      handles_.push_back(fstWriterCreateVar(
          fst_, variable.real ? FST_VT_VCD_REAL : FST_VT_VCD_WIRE, FST_VD_IMPLICIT,
          variable.real ? 8 : static_cast<std::uint32_t>(variable.width), name.c_str(), 0));
    }
    change_scope(scope, "", begin, end);
  }
  ~FstWriter() override {
    if (fst_ != nullptr) fstWriterClose(fst_);
  }
  FstWriter(const FstWriter&) = delete;
  FstWriter& operator=(const FstWriter&) = delete;

  void time(std::uint64_t ps) override { fstWriterEmitTimeChange(fst_, ps); }
  void change(std::size_t index, const std::string& text) override {
    if (is_real_[index]) {
      const double value = parse_number(text).value_or(0);
      fstWriterEmitValueChange(fst_, handles_[index], &value);
    } else {
      fstWriterEmitValueChange(fst_, handles_[index], text.c_str());
    }
  }
  void close() override {
    fstWriterClose(fst_);
    fst_ = nullptr;
    file_.complete();
  }

 private:
  PartialFile file_;
  void* fst_;
  std::vector<fstHandle> handles_;
  std::vector<bool> is_real_;
};

class VcdWriter : public WaveWriter {
 public:
  VcdWriter(const fs::path& path, const std::vector<WaveVariable>& variables)
      : file_(path), out_(file_.name()) {
    out_ << "$version phongpipe $end\n$timescale 1 ps $end\n";
    const auto begin = [this](const std::string& name) {
      out_ << fmt::format("$scope module {} $end\n", name);
    };
    const auto end = [this] { out_ << "$upscope $end\n"; };
    std::string scope;
    for (std::size_t i = 0; i < variables.size(); ++i) {
      const WaveVariable& variable = variables[i];
      change_scope(scope, variable.scope, begin, end);
      scope = variable.scope;
      codes_.push_back(code(i));
      is_real_.push_back(variable.real);
      is_bit_.push_back(!variable.real && variable.width == 1);
      const std::string range = variable.range();
      out_ << fmt::format("$var {} {} {} {}{}{} $end\n", variable.real ? "real" : "wire",
                          variable.real ? 64 : variable.width, codes_.back(), variable.name,
                          range.empty() ? "" : " ", range);
    }
    change_scope(scope, "", begin, end);
    out_ << "$enddefinitions $end\n";
  }

  void time(std::uint64_t ps) override { out_ << '#' << ps << '\n'; }
  void change(std::size_t index, const std::string& text) override {
    if (!is_bit_[index]) out_ << (is_real_[index] ? 'r' : 'b');
    out_ << text << (is_bit_[index] ? "" : " ") << codes_[index] << '\n';
  }
  void close() override {
    out_.close();
    if (!out_) file_.fail("not all of it could be written; is the disk full?");
    file_.complete();
  }

 private:
  // Printable characters, as short as they can be.
  static std::string code(std::size_t index) {
    constexpr std::size_t kFirst = '!', kDigits = '~' - '!' + 1;
    std::string text;
    for (++index; index > 0; index = (index - 1) / kDigits) {
      text += static_cast<char>(kFirst + (index - 1) % kDigits);
    }
    return text;
  }

  PartialFile file_;
  std::ofstream out_;
  std::vector<std::string> codes_;
  std::vector<bool> is_bit_, is_real_;
};

// Splits "v [9:-16]" and "v[9:-16]" into name and width; without a range the width is given.
WaveVariable variable_of(const std::string& scope, const std::string& declared, int width,
                         bool real) {
  WaveVariable variable;
  variable.scope = scope;
  variable.width = width;
  variable.real = real;
  std::string_view name = declared;
  // A range has a colon; an index such as channel[0] has none.
  const std::size_t bracket = name.rfind('[');
  if (bracket != std::string_view::npos && name.find(':', bracket) != std::string_view::npos) {
    name = name.substr(0, bracket);
  }
  variable.name = std::string(trimmed(name));
  return variable;
}

constexpr std::size_t kMaxScopes = 256;  // within each other

class VcdParser {
 public:
  VcdParser(const std::string& text, WaveReader& reader, const WaveReader::Declare& declare,
            const WaveReader::Visit& visit)
      : text_(text), reader_(reader), declare_(declare), visit_(visit) {}

  // False if it is no VCD file.
  bool read() {
    for (std::string_view word; next(word);) {
      if (word == "$enddefinitions") {
        if (defined_) return false;
        defined_ = skip_to_end();
        declare_(reader_.variables);
      } else if (word == "$scope") {
        std::string_view type, name;
        if (!next(type) || !next(name) || !skip_to_end()) return false;
        if (scopes_.size() == kMaxScopes) return false;
        scopes_.emplace_back(name);
      } else if (word == "$upscope") {
        if (scopes_.empty() || !skip_to_end()) return false;
        scopes_.pop_back();
      } else if (word == "$var") {
        if (defined_ || !read_variable()) return false;
      } else if (word == "$timescale") {
        if (!read_timescale()) return false;
      } else if (word == "$dumpvars" || word == "$dumpall" || word == "$dumpon" ||
                 word == "$dumpoff" || word == "$end") {
        // Changes follow as everywhere.
      } else if (word.front() == '$') {
        if (!skip_to_end()) return false;
      } else if (!defined_) {
        return false;
      } else if (!read_change(word)) {
        reader_.complete = false;
        return true;
      }
    }
    reader_.complete = reader_.complete && !text_.empty() && text_.back() == '\n';
    return defined_;
  }

 private:
  bool next(std::string_view& word) {
    constexpr std::string_view kSpace = " \t\r\n";
    const std::string_view all = text_;
    const std::size_t begin = all.find_first_not_of(kSpace, at_);
    if (begin == std::string_view::npos) return false;
    const std::size_t end = std::min(all.find_first_of(kSpace, begin), all.size());
    word = all.substr(begin, end - begin);
    at_ = end;
    return true;
  }
  bool skip_to_end() {
    std::string_view word;
    while (next(word)) {
      if (word == "$end") return true;
    }
    return false;
  }
  bool read_timescale() {
    std::string scale;
    std::string_view word;
    while (next(word) && word != "$end") scale += word;
    std::size_t digits = 0;
    while (digits < scale.size() && scale[digits] >= '0' && scale[digits] <= '9') ++digits;
    const auto number = parse_number(scale.substr(0, digits));
    const std::pair<const char*, double> units[] = {{"s", 1e12}, {"ms", 1e9}, {"us", 1e6},
                                                    {"ns", 1e3}, {"ps", 1},   {"fs", 1e-3}};
    for (const auto& [unit, ps] : units) {
      if (number && scale.substr(digits) == unit) {
        ps_ = *number * ps;
        return true;
      }
    }
    return false;
  }
  bool read_variable() {
    std::string_view type, width, code, word;
    std::string name;
    if (!next(type) || !next(width) || !next(code)) return false;
    while (next(word) && word != "$end") name += word;
    if (word != "$end" || name.empty()) return false;
    std::string scope;
    for (const std::string& part : scopes_) scope += scope.empty() ? part : "." + part;
    const auto bits = parse_integer(width);
    if (!bits || *bits < 1 || *bits > 1'000'000) return false;
    places_[std::string(code)].push_back(reader_.variables.size());
    reader_.variables.push_back(variable_of(scope, name, static_cast<int>(*bits), type == "real"));
    return true;
  }
  bool read_change(std::string_view word) {
    const char kind = word.front();
    std::string_view value = word.substr(1), code;
    if (kind == '#') {
      const auto time = parse_number(value);
      if (!time || *time < 0) return false;
      time_ = static_cast<std::uint64_t>(*time * ps_);
      return true;
    }
    if (kind == 'b' || kind == 'B' || kind == 'r' || kind == 'R') {
      if (!next(code)) return false;
    } else {
      value = word.substr(0, 1);
      code = word.substr(1);
    }
    const auto found = places_.find(std::string(code));
    if (found == places_.end()) return false;
    for (const std::size_t index : found->second) visit_(time_, index, std::string(value));
    return true;
  }

  const std::string& text_;
  WaveReader& reader_;
  const WaveReader::Declare& declare_;
  const WaveReader::Visit& visit_;
  std::size_t at_ = 0;
  bool defined_ = false;
  double ps_ = 1;  // in a unit of time
  std::uint64_t time_ = 0;
  std::vector<std::string> scopes_;
  std::unordered_map<std::string, std::vector<std::size_t>> places_;  // of variables, by code
};

// What the child sends of an FST file: variables, then changes, then that it has read it to the
// end.
constexpr char kVariable = 'v', kChange = 'c', kEnd = 'e';

template <typename Number>
void append_number(std::string& bytes, Number number) {
  const char* const at = reinterpret_cast<const char*>(&number);
  bytes.append(at, sizeof number);
}
template <typename Number>
Number take_number(std::string_view& bytes) {
  Number number{};
  if (bytes.size() < sizeof number) throw std::runtime_error("a message that was cut");
  std::memcpy(&number, bytes.data(), sizeof number);
  bytes.remove_prefix(sizeof number);
  return number;
}
void append_text(std::string& bytes, std::string_view text) {
  append_number(bytes, std::uint64_t{text.size()});
  bytes += text;
}
std::string take_text(std::string_view& bytes) {
  const auto size = take_number<std::uint64_t>(bytes);
  if (size > bytes.size()) throw std::runtime_error("a message that was cut");
  std::string text(bytes.substr(0, size));
  bytes.remove_prefix(size);
  return text;
}

// Collects changes, for a message each would take long.
class ChangeSender {
 public:
  explicit ChangeSender(const Worker::Send& send) : send_(send) {}

  void add(std::uint64_t ps, std::size_t index, std::string_view value) {
    append_number(batch_, ps);
    append_number(batch_, std::uint64_t{index});
    append_text(batch_, value);
    if (batch_.size() > kBatchBytes) flush();
  }
  void flush() {
    send_(kChange + batch_);
    batch_.clear();
  }

 private:
  static constexpr std::size_t kBatchBytes = 65536;
  const Worker::Send& send_;
  std::string batch_;
};

// In a child.
void send_fst(const fs::path& file, const Worker::Send& send) {
  // The library tells of a fault there, and ends the process.
  if (std::freopen("/dev/null", "w", stderr) == nullptr) return;
  const std::unique_ptr<void, void (*)(void*)> reading(fstReaderOpen(file.c_str()), fstReaderClose);
  void* const fst = reading.get();
  if (fst == nullptr) return;
  std::vector<std::string> scopes;
  std::unordered_map<fstHandle, std::vector<std::size_t>> places;
  std::size_t count = 0;
  while (const fstHier* const item = fstReaderIterateHier(fst)) {
    if (item->htyp == FST_HT_SCOPE) {
      if (scopes.size() == kMaxScopes) return;
      scopes.emplace_back(item->u.scope.name, item->u.scope.name_length);
    } else if (item->htyp == FST_HT_UPSCOPE) {
      if (scopes.empty()) return;
      scopes.pop_back();
    } else if (item->htyp == FST_HT_VAR) {
      places[item->u.var.handle].push_back(count++);
      std::string message(1, kVariable);
      append_number(message, std::uint64_t{item->u.var.length});
      message += item->u.var.typ == FST_VT_VCD_REAL ? '\1' : '\0';
      append_text(message, fmt::format("{}", fmt::join(scopes, ".")));
      append_text(message, std::string_view(item->u.var.name, item->u.var.name_length));
      send(message);
    }
  }
  struct Context {
    const std::unordered_map<fstHandle, std::vector<std::size_t>>& places;
    ChangeSender changes;
    double ps;
  };
  // A power of ten of seconds.
  const auto exponent = static_cast<double>(fstReaderGetTimescale(fst));
  Context context{places, ChangeSender(send), std::pow(10, exponent + 12)};
  context.changes.flush();  // also of a file without any
  fstReaderSetFacProcessMaskAll(fst);
  fstReaderIterBlocks(
      fst,
      [](void* user, std::uint64_t time, fstHandle handle, const unsigned char* value) {
        Context& c = *static_cast<Context*>(user);
        const auto found = c.places.find(handle);
        if (found == c.places.end()) return;
        for (const std::size_t index : found->second) {
          c.changes.add(static_cast<std::uint64_t>(static_cast<double>(time) * c.ps), index,
                        reinterpret_cast<const char*>(value));
        }
      },
      &context, nullptr);
  context.changes.flush();
  send(std::string(1, kEnd));
}

// False if it is no FST file. The library trusts what it reads, so that it reads in a child, with
// limits.
bool read_fst(const fs::path& file, WaveReader& reader, const WaveReader::Declare& declare,
              const WaveReader::Visit& visit) {
  constexpr std::size_t kMemoryBytes = std::size_t{384} << 20;
  const auto seconds = static_cast<unsigned>(1 + (fs::file_size(file) >> 18U));
  Worker child([&](const Worker::Send& send) {
    limit_memory(kMemoryBytes);
    limit_processor_time(seconds);
    send_fst(file, send);
  });
  bool declared = false, complete = false;
  const auto take = [&](std::string_view message) {
    const char kind = take_number<char>(message);
    if (kind == kVariable) {
      const auto width = take_number<std::uint64_t>(message);
      const bool real = take_number<char>(message) != 0;
      const std::string scope = take_text(message);
      reader.variables.push_back(
          variable_of(scope, take_text(message), static_cast<int>(width), real));
      return;
    }
    if (!declared) declare(reader.variables);
    declared = true;
    complete = complete || kind == kEnd;
    while (!message.empty()) {
      const auto ps = take_number<std::uint64_t>(message);
      const auto index = take_number<std::uint64_t>(message);
      const std::string value = take_text(message);
      if (index >= reader.variables.size()) throw std::runtime_error("an unknown variable");
      visit(ps, index, value);
    }
  };
  while (!child.ended()) {
    for (const std::string& message : child.receive()) take(message);
  }
  return complete && child.failure().empty();
}

}  // namespace

std::string WaveVariable::range() const {
  if (real || width == 1) return {};
  return fmt::format("[{}:{}]", width - 1 - fraction_bits, -fraction_bits);
}

std::unique_ptr<WaveWriter> WaveWriter::open(const fs::path& file,
                                             const std::vector<WaveVariable>& variables) {
  if (file.extension() == ".fst") return std::make_unique<FstWriter>(file, variables);
  if (file.extension() == ".vcd") return std::make_unique<VcdWriter>(file, variables);
  throw InputError(
      fmt::format("{}: waveforms are written as .fst or .vcd", printable(file.string())));
}

WaveReader WaveReader::read(const fs::path& file, const Declare& declare, const Visit& visit) {
  WaveReader reader;
  const std::string text = read_whole_file(file);
  if (!text.empty() && text.front() == '\0') {
    if (read_fst(file, reader, declare, visit)) return reader;
    throw InputError(fmt::format(
        "{}: an FST file that is damaged or was cut; of VCD files, also the beginning can be read",
        printable(file.string())));
  }
  if (!VcdParser(text, reader, declare, visit).read()) {
    throw InputError(fmt::format("{}: no VCD or FST file", printable(file.string())));
  }
  return reader;
}

}  // namespace phongpipe
