// Sampling of the shapes of light_area.h from a point.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_area.h"
#include "renderer/lights/light_tree.h"

namespace photonproof::inline renderer_lights {
namespace {

QuadLight<float> as_light(const QuadShape& s) {
  return {s.corner, s.edge_u, s.edge_v, s.normal, s.area(), Rgb(0.0f), s.offset};
}
DiskLight<float> as_light(const DiskShape& s) {
  return {s.center, s.half_axis_u, s.half_axis_v, s.normal, s.area(), Rgb(0.0f), s.offset};
}
SphereLight<float> as_light(const SphereShape& s) { return {s.center, s.radius, s.sign, Rgb(0.0f), s.offset}; }

template <class Shape>
SeenPoint sample_as_light(const Shape& shape, const Vec3f& p, const Vec2<float>& u) {
  const LightSample<float> s = as_light(shape).sample(p, u);
  return {{s.at.p, s.at.normal, shape.uv_at(s.at)}, s.wi, s.pdf};
}

}  // namespace

SeenPoint QuadShape::sample_from(const Vec3f& p, const Vec2<float>& u) const { return sample_as_light(*this, p, u); }
float QuadShape::pdf_from(const Vec3f& p, const LightPoint<float>& at) const { return as_light(*this).pdf(p, at); }
SeenPoint DiskShape::sample_from(const Vec3f& p, const Vec2<float>& u) const { return sample_as_light(*this, p, u); }
float DiskShape::pdf_from(const Vec3f& p, const LightPoint<float>& at) const { return as_light(*this).pdf(p, at); }
SeenPoint SphereShape::sample_from(const Vec3f& p, const Vec2<float>& u) const { return sample_as_light(*this, p, u); }
float SphereShape::pdf_from(const Vec3f& p, const LightPoint<float>& at) const { return as_light(*this).pdf(p, at); }

// --- meshes ----------------------------------------------------------------------------------------------------------

CloseTriangle::CloseTriangle(const Vec3f& p, float height, const std::array<Vec3d, 3>& corner) {
  // Chords are parallel to the edge that p is furthest outside of. Double precision is needed: where two large
  // triangles meet above p, rounding would leave a gap between them.
  double furthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d &from = corner[i], edge = corner[(i + 1) % 3] - from, other = corner[(i + 2) % 3] - from;
    const Vec3d along = normalize(edge), up = normalize(other - along * dot(other, along));
    const Vec3d foot = Vec3d(p) - from;
    const double y = dot(foot, up);
    if (-y <= furthest) continue;
    furthest = -y;
    frame = {Vec3f(along), Vec3f(up), height, static_cast<float>(dot(foot, along)), static_cast<float>(y)};
    length = static_cast<float>(dot(edge, along));
    apex = static_cast<float>(dot(other, along));
    y_low = static_cast<float>(-y);
    y_high = static_cast<float>(dot(other, up) - y);
  }
}

const LongFace* MeshShape::long_face(std::uint32_t triangle) const { return find_long_face(long_faces_, triangle); }

std::uint32_t MeshShape::triangle_at(const LightPoint<float>& at) const {
  // Single precision resolves the face's edges to this fraction of their length; neighbours lie in its plane up to
  // rounding.
  constexpr double unsure = 1e-6, same_plane = 0x1p-21;
  const LongFace* met = long_face(at.triangle);
  const Vec3d p(at.p);
  if (met == nullptr || holds(*met, p, 0) || !holds(*met, p, unsure)) return at.triangle;
  const double grain = same_plane * std::max(1.0, length(p));
  for (const LongFace& face : *long_faces_)
    if (std::abs(dot(face.normal, p) - face.offset) <= grain && dot(face.normal, met->normal) > 0 && holds(face, p, 0))
      return face.primitive;
  return at.triangle;
}

LightPoint<float> MeshShape::point_on(std::uint32_t triangle, const Vec2<float>& u) const {
  const Triangle& t = triangles_[triangle];
  const Vec3f &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
  // Uniform on the triangle (Turk 1990).
  const float root = std::sqrt(u.x);
  const float weight_b = root * (1 - u.y), weight_c = root * u.y;
  return {a + (b - a) * weight_b + (c - a) * weight_c, planes_[triangle].normal, uv_of(t, weight_b, weight_c),
          triangle};
}

std::optional<CloseTriangle> MeshShape::close_triangle(std::uint32_t triangle, const Vec3f& p) const {
  const Triangle& t = triangles_[triangle];
  const Vec3f &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
  const Vec3f middle = (a + b + c) * (1.0f / 3);
  const float reach2 = std::max({length_squared(a - middle), length_squared(b - middle), length_squared(c - middle)});
  if (!is_close<float>(p, middle, reach2)) return std::nullopt;
  const float height = height_above<float>(p, a, planes_[triangle].normal, planes_[triangle].offset);
  if (const LongFace* face = long_face(triangle))
    return CloseTriangle(p, height, {face->corner, face->corner + face->edge_u, face->corner + face->edge_v});
  return CloseTriangle(p, height, {Vec3d(a), Vec3d(b), Vec3d(c)});
}

float MeshShape::pdf_on(std::uint32_t triangle, const Vec3f& p, const Vec3f& offset) const {
  const Triangle& t = triangles_[triangle];
  if (const auto close = close_triangle(triangle, p)) return close_pdf<float>(*close, offset);
  const Vec3f &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
  return area_to_solid_angle<float>(2 / length(cross(b - a, c - a)), p, {p + offset, planes_[triangle].normal});
}

SeenPoint MeshShape::sample_from(const Vec3f& p, const Vec2<float>& u) const {
  if (!is_close<float>(p, center_, half_extent2_)) {
    const LightPoint<float> point = sample(u);
    return {point, point.p - p, area_to_solid_angle<float>(1 / area_, p, point)};
  }
  const std::optional<LightTree::Choice> chosen = by_importance_->choose(p, u.x);
  if (!chosen) return {sample(u), positions_[0] - p, 0};
  SeenPoint seen;
  if (const auto close = close_triangle(chosen->light, p)) {
    const Vec3f& n = planes_[chosen->light].normal;
    seen.offset = close_sample<float>(*close, n, {chosen->u, u.y}).offset;
    seen.at = {p + seen.offset, n, {}, chosen->light};
    seen.at.uv = uv_at(seen.at);
  } else {
    seen.at = point_on(chosen->light, {chosen->u, u.y});
    seen.offset = seen.at.p - p;
  }
  seen.pdf = chosen->probability * pdf_on(chosen->light, p, seen.offset);
  return seen;
}

float MeshShape::pdf_from(const Vec3f& p, const LightPoint<float>& at) const {
  if (!is_close<float>(p, center_, half_extent2_)) return area_to_solid_angle<float>(1 / area_, p, at);
  const std::uint32_t triangle = triangle_at(at);
  return by_importance_->probability(p, triangle) * pdf_on(triangle, p, at.p - p);
}

}  // namespace photonproof::inline renderer_lights
