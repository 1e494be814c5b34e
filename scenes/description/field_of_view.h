// The part of a plane that a perspective camera or a projector sees.
#pragma once

#include <cmath>
#include <numbers>

#include "scenes/description/view_description.h"

namespace photonproof::inline scenes_description {

/// Half-angle tangents along x and y for a full angle given along `axis` of an image of this size.
inline Vec2<double> half_tangents(double fov_degrees, FovAxis axis, double width, double height) {
  const double tangent = std::tan(fov_degrees * std::numbers::pi / 360);
  if (axis == FovAxis::smaller) axis = width < height ? FovAxis::x : FovAxis::y;
  if (axis == FovAxis::larger) axis = width < height ? FovAxis::y : FovAxis::x;
  switch (axis) {
    case FovAxis::y:
      return {tangent * width / height, tangent};
    case FovAxis::diagonal: {
      const double diagonal = std::hypot(width, height);
      return {tangent * width / diagonal, tangent * height / diagonal};
    }
    default:
      return {tangent, tangent * height / width};
  }
}

}  // namespace photonproof::inline scenes_description
