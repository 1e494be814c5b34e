// Formats numbers for readers: only the needed digits, a real minus sign, and a dash for none.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace photonproof::reports::inline reports_view {

inline constexpr const char* undefined_number = "–";

/// `digits` significant digits: 0.0123, 12.3, 123; past 1e6 or below 1e-4 as 1.23×10⁻⁵. Infinities are ∞.
std::string significant(double value, int digits = 3);
/// A fixed number of decimals, for quantities whose scale is known (SSIM, decibels).
std::string fixed_decimals(double value, int decimals);
/// A fraction as a signed percentage without the % sign: 0.0123 is "+1.23".
std::string signed_percent(double fraction);
/// An exact count with separated thousands: 2 000 000 (narrow no-break spaces).
std::string grouped(double value);
/// Bytes in MB (10^6): one decimal below 10, none above.
std::string megabytes(std::uint64_t bytes);
/// Bytes in GiB (2^30), one decimal.
std::string gibibytes(std::uint64_t bytes);

/// The formatted number, or the dash for none.
template <class T, class Format>
std::string or_dash(const std::optional<T>& value, Format format) {
  return value ? format(*value) : std::string(undefined_number);
}

}  // namespace photonproof::reports::inline reports_view
