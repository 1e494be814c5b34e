// Affine 4x4 transforms with Mitsuba's meaning: column vectors, row-major storage, last row (0,0,0,1).
#pragma once

#include <array>
#include <optional>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_description {

struct Transform {
  std::array<double, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

  static Transform translate(const Vec3d& by);
  static Transform scale(const Vec3d& by);
  /// Right-handed rotation about `axis` (any length but zero) by `degrees`.
  static Transform rotate(const Vec3d& axis, double degrees);
  /// Camera-to-world: +z of the local frame points from `origin` to `target`, +y towards `up`, +x to the viewer's left.
  /// This is Mitsuba's convention: the local frame is right-handed, so x = up x direction.
  static Transform look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up);

  Vec3d point(const Vec3d& p) const;
  Vec3d vector(const Vec3d& v) const;
  double determinant() const;                ///< of the upper 3x3 block
  double similarity_scale() const;           ///< factor on lengths, of a similarity
  std::optional<Transform> inverse() const;  ///< empty when singular

  friend Transform operator*(const Transform& a, const Transform& b);  ///< applies b first
  friend bool operator==(const Transform&, const Transform&) = default;
};

}  // namespace photonproof::inline scenes_description
