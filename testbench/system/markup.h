// Text as part of HTML or XML.
#pragma once

#include <string>
#include <string_view>

namespace phongpipe {

// The text with the characters that mean something in markup replaced by entities, so that it can
// stand between tags and in attributes. Control characters, which XML does not have, are left out.
inline std::string markup_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        if (static_cast<unsigned char>(c) >= 0x20) result += c;
    }
  }
  return result;
}

}  // namespace phongpipe
