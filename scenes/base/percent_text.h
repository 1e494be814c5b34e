// How messages write a fraction.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

namespace photonproof::inline scenes_base {

/// Two significant digits, without an exponent from 100 % on: 0.0123 is "1.2 %", 6.72 is "670 %".
inline std::string percent_text(double fraction) {
  const double percent = 100 * fraction;
  char text[320];  // holds the digits of any double
  if (std::abs(percent) >= 99.5 && std::isfinite(percent)) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(percent))) - 1);
    std::snprintf(text, sizeof text, "%.0f %%", std::round(percent / unit) * unit);
  } else {
    std::snprintf(text, sizeof text, "%.2g %%", percent);
  }
  return text;
}

/// The same with its sign: "+1.2 %".
inline std::string signed_percent_text(double fraction) {
  return (std::signbit(fraction) ? "-" : "+") + percent_text(std::abs(fraction));
}

}  // namespace photonproof::inline scenes_base
