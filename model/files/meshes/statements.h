// The lines of OBJ and MTL files.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "model/files/text_file.h"

namespace phongpipe {

// A line without its comment; a backslash at the end of a line continues it.
struct Statement {
  unsigned line = 0;                     // of its end, from 1
  std::string_view keyword;              // the first word
  std::string_view rest;                 // what follows, without blanks around it
  std::vector<std::string_view> values;  // the words of `rest`
};

// Calls visit(const Statement&) for each line that is not empty.
template <class Visit>
void for_each_statement(std::string_view text, Visit visit) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.substr(0, kByteOrderMark.size()) == kByteOrderMark) {
    text.remove_prefix(kByteOrderMark.size());
  }
  LineReader reader(text);
  Statement statement;
  const auto take = [&](std::string_view line) {
    line = trimmed(line);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    statement.line = reader.number();
    statement.keyword = line.substr(0, end);
    // A name may contain the sign, as in "steel#2".
    const bool named = statement.keyword == "newmtl" || statement.keyword == "usemtl" ||
                       statement.keyword == "mtllib";
    std::size_t comment = line.find('#');
    while (named && comment != std::string_view::npos && line[comment - 1] != ' ' &&
           line[comment - 1] != '\t') {
      comment = line.find('#', comment + 1);
    }
    line = line.substr(0, comment);
    statement.keyword = line.substr(0, end);
    statement.rest = trimmed(line.substr(statement.keyword.size()));
    words(statement.rest, statement.values);
    if (!statement.keyword.empty()) visit(statement);
  };
  std::string joined;
  for (std::string_view line; reader.next(line);) {
    const bool goes_on = !line.empty() && line.back() == '\\';
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
