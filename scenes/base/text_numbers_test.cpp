#include "scenes/base/text_numbers.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>

#include "scenes/base/percent_text.h"

namespace photonproof::inline scenes_base {
namespace {

TEST(parse_number, reads_decimal_numbers_with_white_space_and_signs) {
  EXPECT_EQ(parse_number("1.5").value, 1.5);
  EXPECT_EQ(parse_number(" \t-2e-3\n").value, -0.002);
  EXPECT_EQ(parse_number("+7").value, 7);
  EXPECT_EQ(parse_number(".5").value, 0.5);
  EXPECT_EQ(parse_number("5.").value, 5);
  EXPECT_TRUE(std::signbit(*parse_number("-0").value));
  EXPECT_EQ(parse_number("1e-40").value, 1e-40);  // below float's normal range, still a number
}

TEST(parse_number, says_what_is_wrong) {
  for (const char* text :
       {"x", "1.0.0", "1 2", "1,2", "nan", "inf", "-inf", "0x10", "1e", "--1", "+-1", "+", "-", ".", "1f", "infinity"})
    EXPECT_EQ(parse_number(text).problem, std::string("is '") + text + "', which is not a finite decimal number");
  for (const char* text : {"", " ", "\n\t"}) EXPECT_EQ(parse_number(text).problem, "is empty, expected a number");
  for (const char* text : {"1e999", "-1e39", "3.5e38", "1e-999"})
    EXPECT_EQ(parse_number(text).problem,
              std::string("is '") + text + "', which is out of range, expected a magnitude of at most 3.4e38");
}

TEST(parse_integer, reads_64_bits_and_nothing_else) {
  EXPECT_EQ(parse_integer(" -9223372036854775808 ").value, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(parse_integer("+42").value, 42);
  EXPECT_EQ(parse_integer("9223372036854775808").problem, "is '9223372036854775808', which does not fit 64 bits");
  for (const char* text : {"1.0", "1e3", "0x1", "one", "1 2"})
    EXPECT_EQ(parse_integer(text).problem, std::string("is '") + text + "', which is not a decimal integer");
  EXPECT_EQ(parse_integer("").problem, "is empty, expected an integer");
}

TEST(format_number, is_short_and_reads_back_the_same_bits) {
  EXPECT_EQ(format_number(0.1), "0.1");
  EXPECT_EQ(format_number(-0.0), "-0");
  EXPECT_EQ(format_number(1e21), "1e+21");
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!(std::abs(value) < 3e38)) continue;
    const auto again = parse_number(format_number(value));
    if (!again.value) {
      EXPECT_LT(std::abs(value), 2.3e-308) << "only numbers below double's normal range may be refused";
      continue;
    }
    EXPECT_EQ(std::bit_cast<std::uint64_t>(*again.value), std::bit_cast<std::uint64_t>(value));
  }
}

TEST(split_list, cuts_at_commas_and_white_space) {
  EXPECT_EQ(split_list("1, 2,3 ,\n4"), (std::vector<std::string_view>{"1", "2", "3", "4"}));
  EXPECT_TRUE(split_list(" , ").empty());
}

TEST(in_quotes, is_short_and_printable) {
  EXPECT_EQ(in_quotes("a\nb"), "'a?b'");
  EXPECT_EQ(in_quotes(std::string(61, 'x')), "'" + std::string(60, 'x') + "...'");
  // 59 letters and a two-byte one: the cut at 60 bytes drops the half of it that would be left.
  EXPECT_EQ(in_quotes(std::string(59, 'x') + "\xC3\xBC and more"), "'" + std::string(59, 'x') + "...'");
  EXPECT_EQ(in_quotes(std::string(58, 'x') + "\xC3\xBC and more"), "'" + std::string(58, 'x') + "\xC3\xBC...'");
}

TEST(PercentText, has_two_digits_and_no_exponent_from_100_percent_on) {
  EXPECT_EQ(percent_text(0.0123), "1.2 %");
  EXPECT_EQ(percent_text(0.9949), "99 %");
  EXPECT_EQ(percent_text(0.996), "100 %");
  EXPECT_EQ(percent_text(1.349), "130 %");
  EXPECT_EQ(percent_text(137.2), "14000 %");
  EXPECT_EQ(percent_text(2e-7), "2e-05 %");
  EXPECT_EQ(percent_text(0), "0 %");
  EXPECT_EQ(signed_percent_text(-6.72), "-670 %");
  EXPECT_EQ(signed_percent_text(0.05), "+5 %");
}

}  // namespace
}  // namespace photonproof::inline scenes_base
