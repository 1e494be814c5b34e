#include "scenes/base/utf8.h"

#include <gtest/gtest.h>

#include <string>

namespace photonproof::inline scenes_base {
namespace {

constexpr auto kNone = std::string_view::npos;

TEST(find_invalid_utf8, accepts_the_ends_of_every_range) {
  EXPECT_EQ(find_invalid_utf8(""), kNone);
  EXPECT_EQ(find_invalid_utf8(std::string("\0 \x7F", 3)), kNone);
  EXPECT_EQ(find_invalid_utf8("\xC2\x80 \xDF\xBF"), kNone);
  EXPECT_EQ(find_invalid_utf8("\xE0\xA0\x80 \xED\x9F\xBF \xEE\x80\x80 \xEF\xBF\xBF"), kNone);
  EXPECT_EQ(find_invalid_utf8("\xF0\x90\x80\x80 \xF4\x8F\xBF\xBF"), kNone);
}

TEST(find_invalid_utf8, points_at_the_first_bad_byte) {
  EXPECT_EQ(find_invalid_utf8("ab\x80"), 2u);            // a continuation alone
  EXPECT_EQ(find_invalid_utf8("a\xC0\x80"), 1u);         // overlong NUL
  EXPECT_EQ(find_invalid_utf8("\xE0\x9F\xBF"), 0u);      // overlong
  EXPECT_EQ(find_invalid_utf8("\xED\xA0\x80"), 0u);      // surrogate
  EXPECT_EQ(find_invalid_utf8("\xF0\x8F\xBF\xBF"), 0u);  // overlong
  EXPECT_EQ(find_invalid_utf8("\xF4\x90\x80\x80"), 0u);  // past U+10FFFF
  EXPECT_EQ(find_invalid_utf8("\xF5\x80\x80\x80"), 0u);
  EXPECT_EQ(find_invalid_utf8("ok \xC3"), 3u);  // cut short
  EXPECT_EQ(find_invalid_utf8("ok \xE2\x82"), 3u);
  EXPECT_EQ(find_invalid_utf8("gr\xFCn"), 2u);  // Latin-1
}

TEST(printable, replaces_only_what_breaks_a_line) {
  EXPECT_EQ(printable("a\tb gr\xC3\xBCn"), "a\tb gr\xC3\xBCn");
  EXPECT_EQ(printable(std::string("\0\n\x1B[31m\xFF\xC3", 9)), "???[31m??");
}

// A terminal treats U+009B (C2 9B) as ESC [; U+202E reverses the following text.
TEST(printable, shows_what_a_terminal_would_obey) {
  EXPECT_EQ(printable("\xC2\x9B"
                      "31m\x7F\xE2\x80\xA8"),
            "?31m??");
  EXPECT_EQ(printable("a\xE2\x80\xAEgpj.exr"), "a?gpj.exr");
  EXPECT_EQ(printable("\uFFFE\uFFFF\uFFFD"), "??\uFFFD");  // no XML may hold the first two
}

}  // namespace
}  // namespace photonproof::inline scenes_base
