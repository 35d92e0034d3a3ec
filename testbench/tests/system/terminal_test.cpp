// Text from outside, made fit for a terminal and for JSON.
#include "testbench/system/terminal.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace phongpipe {
namespace {

TEST(Printable, KeepsUtf8) {
  for (const char* text :
       {"", "pawn.toml", "Bäume/Straße €.toml", "𝄞", "a\\nb \"$;", "\xf4\x8f\xbf\xbf"}) {
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ShowsControlCharacters) {
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable("\x1b[31mred"), "\\x1b[31mred");
  EXPECT_EQ(printable(std::string_view("\0\x7f", 2)), "\\x00\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m");  // U+009B opens an escape code, too
  EXPECT_EQ(printable("\xc2\xa0"), "\xc2\xa0");
}

TEST(Printable, ShowsBytesThatAreNotUtf8) {
  EXPECT_EQ(printable("caf\xe9.toml"), "caf\\xe9.toml");
  EXPECT_EQ(printable("\xc3"), "\\xc3");  // cut short
  EXPECT_EQ(printable("\xe2\x82"), "\\xe2\\x82");
  EXPECT_EQ(printable("\xc0\x80"), "\\xc0\\x80");                    // longer than need be
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // a surrogate
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // above U+10FFFF
}

TEST(Printable, IsFitForJsonWhateverTheBytes) {
  for (unsigned first = 0; first < 256; ++first) {
    for (unsigned second = 0; second < 256; ++second) {
      for (const char* end : {"", "\x80", "\x80\x80", "\xbf\xbf"}) {
        const std::string text = {static_cast<char>(first), static_cast<char>(second)};
        const nlohmann::json json = printable(text + end);
        ASSERT_NO_THROW(json.dump()) << first << ' ' << second;
      }
    }
  }
}

}  // namespace
}  // namespace phongpipe
