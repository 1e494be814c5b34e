#include "reports/view/text.h"

#include <gtest/gtest.h>

namespace photonproof::reports::inline reports_view {
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

TEST(Text, shortened_text_ends_between_characters) {
  EXPECT_EQ(shortened("abc", 3), "abc");
  EXPECT_EQ(shortened("abc", 2), "ab");
  EXPECT_EQ(shortened("aé", 2), "a");  // é has two bytes
  EXPECT_EQ(shortened("−", 2), "");    // and the minus three
}

TEST(Text, latex_has_no_command_but_ours) {
  EXPECT_EQ(latex_text("50 % of a_b & $x^2$ #1 ~ {\\}"),
            "50 \\% of a\\_b \\& \\$x\\textasciicircum{}2\\$ \\#1 \\textasciitilde{} \\{\\textbackslash{}\\}");
  EXPECT_EQ(latex_text("≤ 0.5 †"), "$\\leq$ 0.5 $\\dagger$");
  EXPECT_EQ(latex_text("Schrödinger ✗"), "Schr\\\"{o}dinger [U+2717]");
  EXPECT_EQ(latex_text("\U0001F600"), "[U+1F600]");
  EXPECT_EQ(latex_text("−1.5×10⁻³"), "$-$1.5$\\times$10$^{-3}$");
}

TEST(Text, a_cell_of_csv_is_one_cell_and_no_formula) {
  EXPECT_EQ(csv_cell("plain 1.5"), "plain 1.5");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(csv_cell("=1+1"), "'=1+1");
  EXPECT_EQ(csv_cell("two\nlines").find('\n'), std::string::npos);
}

TEST(Text, json_in_a_page_cannot_end_its_element) {
  EXPECT_EQ(json_in_html("[\"</script><!--\"]"), "[\"\\u003c/script>\\u003c!--\"]");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
