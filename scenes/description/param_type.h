// Types of a plugin's parameters.
#pragma once

#include <limits>

namespace photonproof::scene_xml {

/// `colour_map` and `number_map` may be textures, `texture` must be one. `volume` may be a volume.
enum class ParamType {
  boolean,
  integer,
  number,
  string,
  ior,
  colour,
  emission,
  colour_map,
  emission_map,
  number_map,
  texture,
  volume,
  point,
  transform
};

constexpr double kUnbounded = std::numeric_limits<double>::infinity();

/// Allowed numbers. Messages and the page call them `words`, or "from <low> to <high>" without.
struct Range {
  double low = -kUnbounded, high = kUnbounded;
  const char* words = nullptr;
  bool open = false;  ///< without `low` itself
  bool open_above = false;
  bool holds(double x) const { return (open ? x > low : x >= low) && (open_above ? x < high : x <= high); }
};
constexpr Range kAny{}, kNotNegative{0, kUnbounded}, kShare{0, 1}, kFilterRadius{0.5, 16, "0.5 to 16 pixels"};

/// A word that stands for a value.
template <class Value>
struct Word {
  const char* text;
  Value value;
};

}  // namespace photonproof::scene_xml
