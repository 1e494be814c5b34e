// How messages write a fraction.
#pragma once

#include <cstdio>
#include <string>

namespace photonproof::inline scenes_base {

/// Two significant digits: 0.0123 is "1.2 %".
inline std::string percent_text(double fraction) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g %%", 100 * fraction);
  return text;
}

}  // namespace photonproof::inline scenes_base
