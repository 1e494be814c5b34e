#include "scenes/base/input_error.h"

#include <gtest/gtest.h>

#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_base {
namespace {

TEST(input_error, shows_the_line_and_a_caret_below_the_column) {
  const InputError error("a.xml", 3, 4, "bad", "\tab\"x\"");
  EXPECT_STREQ(error.what(), "a.xml:3:4: error: bad\n  \tab\"x\"\n  \t  ^");
  EXPECT_EQ(error.summary(), "a.xml:3:4: error: bad");
}

TEST(input_error, without_a_line_is_its_summary) {
  EXPECT_STREQ(InputError("a.xml", 1, 1, "bad").what(), "a.xml:1:1: error: bad");
  EXPECT_STREQ(InputError("-D x", "bad").what(), "-D x: error: bad");
}

TEST(input_error, puts_the_caret_below_the_character_not_the_byte) {
  // "grün x": x is byte 7 (the u-umlaut has two), but the sixth character.
  EXPECT_STREQ(InputError("a", 1, 7, "bad", "gr\xC3\xBCn x").what(), "a:1:7: error: bad\n  gr\xC3\xBCn x\n       ^");
}

TEST(input_error, shows_only_a_part_of_a_long_line) {
  const InputError error("a", 1, 5001, "bad", std::string(10000, 'x'));
  const std::string what = error.what();
  EXPECT_LT(what.size(), 400u);
  // Both the excerpt and the caret's line start after two blanks; 3 dots and 100 bytes precede the column.
  EXPECT_NE(what.find("\n  ..." + std::string(160, 'x') + "...\n  " + std::string(103, ' ') + "^"), std::string::npos);
}

TEST(input_error, is_valid_utf8_whatever_the_line_holds) {
  const InputError error("a", 1, 2, "bad", std::string("\xFF\x01\0z", 4));
  EXPECT_STREQ(error.what(), "a:1:2: error: bad\n  ???z\n   ^");
  std::string umlauts;
  for (int i = 0; i < 500; ++i) umlauts += "\xC3\xBC";
  for (int column = 1; column < 1000; column += 7)
    EXPECT_EQ(find_invalid_utf8(InputError("a", 1, column, "bad", umlauts).what()), std::string_view::npos);
}

TEST(input_error, shows_no_control_characters_of_file_names) {
  const InputError error("scene\x1B]0;title\x07.xml", "no such\nfile");
  EXPECT_EQ(error.summary(), "scene?]0;title?.xml: error: no such?file");
  EXPECT_STREQ(error.what(), error.summary().c_str());
  EXPECT_EQ(InputError("a\x1B[2J.xml", 1, 2, "bad").summary(), "a?[2J.xml:1:2: error: bad");
}

}  // namespace
}  // namespace photonproof::inline scenes_base
