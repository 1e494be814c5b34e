// Curves of Mitsuba's curve files: text with a control point a line, as x y z radius. Blank lines separate curves.
// Files are untrusted: a set takes no more memory than a fixed multiple of its file.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_curves {

struct CurvePoint {
  Vec3f p;
  float radius = 0;
  friend bool operator==(const CurvePoint&, const CurvePoint&) = default;
};

struct CurveSet {
  std::vector<CurvePoint> points;    ///< of all curves in turn, finite; radii are at least 0
  std::vector<std::uint32_t> first;  ///< the first point of each curve, ascending; no curve is empty

  friend bool operator==(const CurveSet&, const CurveSet&) = default;
};

constexpr std::size_t kMaxCurveBytes = std::size_t{2} << 30;

/// Every curve has at least `least` points. Throws InputError with file:line:col; `file` stands for the file.
CurveSet parse_curves(std::string_view text, const std::string& file, std::size_t least);

}  // namespace photonproof::inline scenes_curves
