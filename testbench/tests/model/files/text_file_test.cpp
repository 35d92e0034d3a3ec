#include "model/files/text_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "testbench/tests/model/scene/scene_files.h"

namespace phongpipe {
namespace {

TEST(TextFile, OnlyFilesThatStayAsTheyAreAreRead) {
  const TempFolder folder;
  const auto refusal = [&](const std::filesystem::path& file) {
    return error_of(folder, [&] { read_whole_file(file, 1000); });
  };
  EXPECT_EQ(read_whole_file(folder.write("a", "text\n")), "text\n");
  EXPECT_EQ(refusal(folder.write("a", " \n")), "a: the file is empty");
  EXPECT_EQ(refusal(folder.write("a", std::string(1001, 'x'))),
            "a: has 1001 bytes, may have at most 1000");
  EXPECT_EQ(refusal(folder.path() / "none"), "none: no such file");
  EXPECT_EQ(refusal("/dev/zero"), "/dev/zero: is a device, not a file");
  EXPECT_EQ(refusal("/"), "/: is a directory, not a file");
  // A file whose size is not what it has.
  EXPECT_EQ(refusal("/proc/self/status"),
            "/proc/self/status: changed while it was read; try again");
}

TEST(TextFile, LinesEndInThreeWays) {
  LineReader reader("a\nb\r\nc\rd\r\re");
  std::string_view line;
  std::string lines;
  while (reader.next(line)) lines += std::string(line) + "|";
  EXPECT_EQ(lines, "a|b|c|d||e|");
  EXPECT_EQ(reader.number(), 6U);
}

TEST(TextFile, NumbersTakeTheWholeWord) {
  EXPECT_EQ(parse_number(".5"), 0.5);
  EXPECT_EQ(parse_number("+1.e3"), 1000);
  EXPECT_EQ(parse_number("1e-400"), 0) << "too near to zero for a double";
  for (const char* word : {"", "+", "+-1", "1x", "0x10", "1,5", "nan", "-inf", "1e400"}) {
    EXPECT_EQ(parse_number(word), std::nullopt) << word;
  }
  EXPECT_TRUE(parse_any_number("nan").has_value());
  EXPECT_EQ(parse_integer("+007"), 7);
  EXPECT_EQ(parse_integer("1.0"), std::nullopt);
}

TEST(TextFile, ExcerptsAreOneShortLine) {
  EXPECT_EQ(excerpt("short"), "short");
  EXPECT_EQ(excerpt(std::string(100, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(excerpt("aü", 2), "a...") << "not half a character";
  EXPECT_EQ(excerpt(std::string_view("a\0b", 3)), "a\\x00b");
}

}  // namespace
}  // namespace phongpipe
