// Building blocks of notes.
#pragma once

#include <cstdio>
#include <string>
#include <utility>
#include <vector>

#include "renderer/limits/scene_notes.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline renderer_limits {

/// Step of a float near 1, and of a double.
inline constexpr double float_step = 0x1p-23, double_step = 0x1p-52;

inline std::string short_number(double x) {
  char text[24];
  std::snprintf(text, sizeof text, "%.2g", x);
  return text;
}

class Notes {
 public:
  explicit Notes(const SceneDescription& description) : description_(description) {}

  std::vector<SceneNote> made;

  void add(const SourceLoc& loc, const std::string& text) { made.push_back({description_.where(loc), text}); }

  /// Notes a number that is rendered as `rendered(number)`. Texture values get the same limits without a note.
  template <class Rendered>
  void limit(const SourceLoc& loc, const char* name, const Scalar& value, const Rendered& rendered) {
    const auto* asked = std::get_if<double>(&value);
    if (asked == nullptr) return;
    const auto number = static_cast<float>(*asked);
    if (rendered(number) == number) return;
    char text[16];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(rendered(number)));
    add(loc, std::string(name) + " " + format_number(*asked) + " is rendered as " + text);
  }

 private:
  const SceneDescription& description_;
};

}  // namespace photonproof::inline renderer_limits
