#include "reports/view/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>

namespace photonproof::reports::inline reports_view {
namespace {

constexpr const char* minus = "−";  // U+2212, as wide as a digit where digits are tabular

std::string with_minus(std::string text) {
  if (!text.empty() && text.front() == '-') text.replace(0, 1, minus);
  return text;
}

std::optional<std::string> not_finite(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "∞" : std::string(minus) + "∞";
  return std::nullopt;
}

std::string superscript(int exponent) {
  constexpr const char* digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char c : std::to_string(std::abs(exponent))) out += digits[c - '0'];
  return out;
}

}  // namespace

std::string significant(double value, int digits) {
  if (const auto special = not_finite(value)) return *special;
  if (value == 0) return "0";
  // The exponent after rounding: 0.09996 to three digits is 1.00e-1.
  const std::string scientific = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = scientific.find('e');
  const int exponent = std::atoi(scientific.c_str() + e + 1);
  if (exponent < -4 || exponent >= 6) return with_minus(scientific.substr(0, e)) + "×10" + superscript(exponent);
  return with_minus(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent)));
}

std::string fixed_decimals(double value, int decimals) {
  if (const auto special = not_finite(value)) return *special;
  return with_minus(fmt::format("{:.{}f}", value, decimals));
}

std::string signed_percent(double fraction) {
  if (const auto special = not_finite(fraction)) return *special;
  return with_minus(fmt::format("{:+.2f}", 100 * fraction));
}

std::string grouped(double value) {
  // 15 digits hold every integer a double holds exactly below 1e15, and 0.1 stays 0.1.
  const std::string plain = fmt::format("{:.15g}", value);
  const std::size_t first = plain.front() == '-' ? 1 : 0;
  const std::size_t whole = std::min(plain.find_first_not_of("0123456789", first), plain.size());
  if (whole - first < 5) return with_minus(plain);
  std::string out = plain.substr(0, first);
  for (std::size_t i = first; i < whole; ++i) {
    if (i > first && (whole - i) % 3 == 0) out += "\u202F";
    out += plain[i];
  }
  return with_minus(out + plain.substr(whole));
}

std::string megabytes(std::uint64_t bytes) {
  const double amount = static_cast<double>(bytes) / 1e6;
  return fixed_decimals(amount, amount < 10 ? 1 : 0);
}

std::string gibibytes(std::uint64_t bytes) { return fixed_decimals(static_cast<double>(bytes) / 0x1p30, 1); }

}  // namespace photonproof::reports::inline reports_view
