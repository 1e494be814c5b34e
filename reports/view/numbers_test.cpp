#include "reports/view/numbers.h"

#include <gtest/gtest.h>

#include <limits>

namespace photonproof::reports::inline reports_view {
namespace {

TEST(Numbers, significant_shows_three_digits_whatever_the_scale) {
  EXPECT_EQ(significant(0.0012345), "0.00123");
  EXPECT_EQ(significant(1.2345), "1.23");
  EXPECT_EQ(significant(12.345), "12.3");
  EXPECT_EQ(significant(123.45), "123");
  EXPECT_EQ(significant(12345), "12345");
  EXPECT_EQ(significant(0), "0");
}

TEST(Numbers, significant_rounds_before_it_counts_digits) {
  EXPECT_EQ(significant(0.09996), "0.100");
  EXPECT_EQ(significant(999.6), "1000");
}

TEST(Numbers, significant_turns_to_powers_of_ten_at_the_ends) {
  EXPECT_EQ(significant(0.0000123), "1.23×10⁻⁵");
  EXPECT_EQ(significant(-2.5e7), "−2.50×10⁷");
}

TEST(Numbers, not_finite_is_said_and_never_a_number) {
  EXPECT_EQ(significant(std::numeric_limits<double>::infinity()), "∞");
  EXPECT_EQ(fixed_decimals(-std::numeric_limits<double>::infinity(), 2), "−∞");
  EXPECT_EQ(signed_percent(std::numeric_limits<double>::quiet_NaN()), "NaN");
}

TEST(Numbers, undefined_is_a_dash) {
  const auto format = [](double v) { return significant(v); };
  EXPECT_EQ(or_dash(std::optional<double>(), format), "–");
  EXPECT_EQ(or_dash(std::optional<double>(2), format), "2.00");
}

TEST(Numbers, percentages_carry_their_sign) {
  EXPECT_EQ(signed_percent(0.01234), "+1.23");
  EXPECT_EQ(signed_percent(-0.5), "−50.00");
}

TEST(Numbers, counts_are_exact_and_grouped_from_five_digits) {
  EXPECT_EQ(grouped(4096), "4096");
  EXPECT_EQ(grouped(20000), "20\u202F000");
  EXPECT_EQ(grouped(1234567), "1\u202F234\u202F567");
  EXPECT_EQ(grouped(-12345.5), "−12\u202F345.5");
  EXPECT_EQ(grouped(0.1), "0.1");
}

TEST(Numbers, bytes_are_megabytes_of_a_million) {
  EXPECT_EQ(megabytes(61'000'000), "61");
  EXPECT_EQ(megabytes(4'560'000), "4.6");
  EXPECT_EQ(gibibytes(std::uint64_t{8} << 30), "8.0");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
