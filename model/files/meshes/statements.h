// The lines of OBJ and MTL files.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include "model/files/text_file.h"

namespace phongpipe {

// A line without its comment. A backslash at its end continues it, unless it ends a comment or a
// name, such as that of a folder.
struct Statement {
  unsigned line = 0;                     // of its end, from 1
  std::string_view keyword;              // the first word
  std::string_view rest;                 // what follows, without blanks around it
  std::vector<std::string_view> values;  // the words of `rest`
};

// Whether a name follows the keyword. It may contain blanks and signs, as in "Material #25".
inline bool takes_name(std::string_view keyword) {
  constexpr std::string_view kKeywords[] = {"g",      "o",      "newmtl",     "usemtl",   "mtllib",
                                            "maplib", "usemap", "bump",       "disp",     "decal",
                                            "refl",   "norm",   "shadow_obj", "trace_obj"};
  return keyword.substr(0, 4) == "map_" ||
         std::find(std::begin(kKeywords), std::end(kKeywords), keyword) != std::end(kKeywords);
}

// Where the comment of a line begins. Within a name only a sign between blanks begins one.
inline std::size_t comment_of(std::string_view line, bool in_name) {
  const auto is_blank = [&](std::size_t at) {
    return at >= line.size() || line[at] == ' ' || line[at] == '\t';
  };
  std::size_t at = line.find('#');
  while (in_name && at != std::string_view::npos && at > 0 &&
         !(is_blank(at - 1) && is_blank(at + 1))) {
    at = line.find('#', at + 1);
  }
  return std::min(at, line.size());
}

// Calls visit(const Statement&) for each line that is not empty.
template <class Visit>
void for_each_statement(std::string_view text, Visit visit) {
  LineReader reader(without_byte_order_mark(text));
  Statement statement;
  const auto keyword_of = [](std::string_view line) {
    return line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
  };
  const auto take = [&](std::string_view line) {
    line = trimmed(line);
    line = line.substr(0, comment_of(line, takes_name(keyword_of(line))));
    statement.line = reader.number();
    statement.keyword = keyword_of(line);
    statement.rest = trimmed(line.substr(statement.keyword.size()));
    words(statement.rest, statement.values);
    if (!statement.keyword.empty()) visit(statement);
  };
  std::string joined;
  for (std::string_view line; reader.next(line);) {
    const bool goes_on = !line.empty() && line.back() == '\\' &&
                         line.find('#') == std::string_view::npos &&
                         !takes_name(keyword_of(trimmed(joined.empty() ? line : joined)));
    if (goes_on) line.remove_suffix(1);
    if (!goes_on && joined.empty()) {
      take(line);
      continue;
    }
    joined.append(line).push_back(' ');
    if (goes_on) continue;
    take(joined);
    joined.clear();
  }
  take(joined);  // where the last line goes on
}

}  // namespace phongpipe
