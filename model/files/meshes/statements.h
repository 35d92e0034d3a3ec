// The lines of OBJ and MTL files.
#pragma once

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
  std::string joined;
  Statement statement;
  for (std::string_view line; reader.next(line);) {
    if (!joined.empty() || (!line.empty() && line.back() == '\\')) {
      joined += line;
      if (joined.back() == '\\') {
        joined.back() = ' ';
        continue;
      }
      line = joined;
    }
    line = trimmed(line);
    const std::size_t end = std::min(line.find_first_of(" \t"), line.size());
    statement.line = reader.number();
    statement.keyword = line.substr(0, end);
    statement.rest = line.substr(end);
    // A name may contain the sign, as in "steel#2".
    const bool named = statement.keyword == "newmtl" || statement.keyword == "usemtl" ||
                       statement.keyword == "mtllib";
    for (std::size_t at = line.find('#'); at != std::string_view::npos;
         at = line.find('#', at + 1)) {
      if (named && line[at - 1] != ' ' && line[at - 1] != '\t') continue;
      statement.keyword = line.substr(0, std::min(at, end));
      statement.rest = line.substr(std::min(at, end), at - std::min(at, end));
      break;
    }
    statement.rest = trimmed(statement.rest);
    words(statement.rest, statement.values);
    if (!statement.keyword.empty()) visit(statement);
    joined.clear();
  }
}

}  // namespace phongpipe
