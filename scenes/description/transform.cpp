#include "scenes/description/transform.h"

#include <numbers>

namespace photonproof::inline scenes_description {
namespace {

struct SinCos {
  double sin, cos;
};

/// Exact at multiples of 90 degrees, so that a quarter turn leaves no 6e-17 in a wall that should be axis-aligned.
SinCos sin_cos_degrees(double degrees) {
  const double turn = std::remainder(degrees, 360.0);
  if (turn == 0) return {0, 1};
  if (turn == 90) return {1, 0};
  if (turn == -90) return {-1, 0};
  if (std::abs(turn) == 180) return {0, -1};
  const double radians = turn * (std::numbers::pi / 180);
  return {std::sin(radians), std::cos(radians)};
}

Vec3d row(const Transform& t, std::size_t r) { return {t.m[4 * r], t.m[4 * r + 1], t.m[4 * r + 2]}; }

}  // namespace

Transform Transform::translate(const Vec3d& by) { return {{1, 0, 0, by.x, 0, 1, 0, by.y, 0, 0, 1, by.z, 0, 0, 0, 1}}; }

Transform Transform::scale(const Vec3d& by) { return {{by.x, 0, 0, 0, 0, by.y, 0, 0, 0, 0, by.z, 0, 0, 0, 0, 1}}; }

// Rodrigues: R = cos I + sin [a]x + (1 - cos) a a^T.
Transform Transform::rotate(const Vec3d& axis, double degrees) {
  const Vec3d a = normalize(axis / std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)}));
  const auto [s, c] = sin_cos_degrees(degrees);
  const double v = 1 - c;
  return {{c + v * a.x * a.x, v * a.x * a.y - s * a.z, v * a.x * a.z + s * a.y, 0,  //
           v * a.y * a.x + s * a.z, c + v * a.y * a.y, v * a.y * a.z - s * a.x, 0,  //
           v * a.z * a.x - s * a.y, v * a.z * a.y + s * a.x, c + v * a.z * a.z, 0,  //
           0, 0, 0, 1}};
}

Transform Transform::look_at(const Vec3d& origin, const Vec3d& target, const Vec3d& up) {
  const Vec3d forward = normalize(target - origin);
  const Vec3d left = normalize(cross(up, forward));
  const Vec3d true_up = cross(forward, left);
  return {{left.x, true_up.x, forward.x, origin.x,  //
           left.y, true_up.y, forward.y, origin.y,  //
           left.z, true_up.z, forward.z, origin.z,  //
           0, 0, 0, 1}};
}

Vec3d Transform::point(const Vec3d& p) const { return vector(p) + Vec3d(m[3], m[7], m[11]); }

Vec3d Transform::vector(const Vec3d& v) const {
  return {dot(row(*this, 0), v), dot(row(*this, 1), v), dot(row(*this, 2), v)};
}

double Transform::determinant() const { return dot(row(*this, 0), cross(row(*this, 1), row(*this, 2))); }

// Rows are scaled to unit length first, so that scenes of any size neither under- nor overflow. With D the diagonal of
// row lengths and A = D U, A^-1 = U^-1 D^-1. The value |det U| in [0,1] (Hadamard) measures how far A is from singular.
double Transform::similarity_scale() const { return std::cbrt(std::abs(determinant())); }

std::optional<Transform> Transform::inverse() const {
  constexpr double kSingular = 1e-14;  // a few hundred roundings of a unit determinant
  std::array<Vec3d, 3> unit;
  std::array<double, 3> norm{};
  for (std::size_t r = 0; r < 3; ++r) {
    const Vec3d a = row(*this, r);
    norm[r] = std::hypot(a.x, a.y, a.z);
    if (!(norm[r] > 0) || !std::isfinite(norm[r])) return std::nullopt;
    unit[r] = a / norm[r];
  }
  const double det = dot(unit[0], cross(unit[1], unit[2]));
  if (!(std::abs(det) > kSingular)) return std::nullopt;
  const Vec3d c0 = cross(unit[1], unit[2]) / det / norm[0];
  const Vec3d c1 = cross(unit[2], unit[0]) / det / norm[1];
  const Vec3d c2 = cross(unit[0], unit[1]) / det / norm[2];
  Transform inv{{c0.x, c1.x, c2.x, 0, c0.y, c1.y, c2.y, 0, c0.z, c1.z, c2.z, 0, 0, 0, 0, 1}};
  const Vec3d origin = -inv.vector({m[3], m[7], m[11]});
  inv.m[3] = origin.x;
  inv.m[7] = origin.y;
  inv.m[11] = origin.z;
  for (const double entry : inv.m)
    if (!std::isfinite(entry)) return std::nullopt;
  return inv;
}

Transform operator*(const Transform& a, const Transform& b) {
  Transform product;
  for (std::size_t r = 0; r < 4; ++r)
    for (std::size_t c = 0; c < 4; ++c) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += a.m[4 * r + k] * b.m[4 * k + c];
      product.m[4 * r + c] = sum;
    }
  return product;
}

}  // namespace photonproof::inline scenes_description
