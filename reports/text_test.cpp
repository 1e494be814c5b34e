#include "reports/text.h"

#include <gtest/gtest.h>

namespace photonproof::reports {
namespace {

TEST(Text, printable_keeps_valid_utf8_and_puts_it_on_one_line) {
  EXPECT_EQ(printable("Größe 光 🙂"), "Größe 光 🙂");
  EXPECT_EQ(printable("a\nb\tc\r\x1b[0m"), "a b c  [0m");
}

TEST(Text, printable_marks_malformed_bytes) {
  EXPECT_EQ(printable("a\xff\x62"), "a\uFFFD\x62");
  EXPECT_EQ(printable("\xc0\xaf"), "\uFFFD\uFFFD");                 // overlong '/'
  EXPECT_EQ(printable("\xed\xa0\x80"), "\uFFFD\uFFFD\uFFFD");       // surrogate U+D800
  EXPECT_EQ(printable("\xf5\x80\x80\x80").substr(0, 3), "\uFFFD");  // past U+10FFFF
  EXPECT_EQ(printable("\xe2\x82"), "\uFFFD\uFFFD");                 // cut short
}

TEST(Text, printable_marks_bidirectional_overrides) { EXPECT_EQ(printable("a\u202Eb"), "a\uFFFDb"); }

TEST(Text, markdown_text_escapes_what_would_be_markup) {
  EXPECT_EQ(markdown_text("a|b"), "a\\|b");
  EXPECT_EQ(markdown_text("<script>*_`[x](y)"), "\\<script\\>\\*\\_\\`\\[x\\](y)");
  EXPECT_EQ(markdown_text("one\ntwo"), "one two");
  EXPECT_EQ(markdown_text("a\\|b"), "a\\\\\\|b");
}

TEST(Text, url_path_encodes_everything_that_could_end_a_link) {
  EXPECT_EQ(url_path("cells/a b(1).png"), "cells/a%20b%281%29.png");
  EXPECT_EQ(url_path("ä|\n#?"), "%C3%A4%7C%0A%23%3F");
}

TEST(Text, base64_matches_the_vectors_of_rfc_4648) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xff\xfe"), "///+");  // 111111 111111 111111 111110
}

}  // namespace
}  // namespace photonproof::reports
