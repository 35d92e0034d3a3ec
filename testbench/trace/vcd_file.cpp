#include "testbench/trace/vcd_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <unordered_map>

#include "testbench/trace/wave_format.h"

namespace phongpipe {
namespace fs = std::filesystem;
namespace {

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

}  // namespace

std::unique_ptr<WaveWriter> open_vcd(const fs::path& file,
                                     const std::vector<WaveVariable>& variables) {
  return std::make_unique<VcdWriter>(file, variables);
}

bool read_vcd(const std::string& text, WaveReader& reader, const WaveReader::Declare& declare,
              const WaveReader::Visit& visit) {
  return VcdParser(text, reader, declare, visit).read();
}

}  // namespace phongpipe
