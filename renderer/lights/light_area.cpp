#include "renderer/lights/light_area.h"

#include <cmath>
#include <utility>

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_tree.h"
#include "renderer/shapes/face_normal.h"

namespace photonproof::inline renderer_lights {
namespace {

/// Mean of a texture over a shape, from midpoints of a lattice of equal areas, in double.
Rgb mean_over(const LightShape& shape, const LightTexture& texture) {
  constexpr int cells = 64;
  RgbD sum(0.0);
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const Vec2<float> u{(static_cast<float>(column) + 0.5f) / cells, (static_cast<float>(row) + 0.5f) / cells};
      const LightPoint<float> point = std::visit([&](const auto& s) { return s.sample(u); }, shape);
      sum += RgbD(texture(point.uv));
    }
  return Rgb(sum / (cells * cells));
}

float area_of(const LightShape& shape) {
  return std::visit([](const auto& s) { return s.area(); }, shape);
}

template <class T>
Vec2<float> solution(const Vec3<T>& d, const Vec3<T>& u, const Vec3<T>& v) {
  const T uu = dot(u, u), vv = dot(v, v), uv = dot(u, v), du = dot(d, u), dv = dot(d, v);
  const T determinant = uu * vv - uv * uv;
  return {static_cast<float>((du * vv - dv * uv) / determinant), static_cast<float>((dv * uu - du * uv) / determinant)};
}

/// Least-squares solution (a, b) of a u + b v = d. Fourth powers of lengths below 1e-7 or above 1e7 need double.
Vec2<float> in_basis(const Vec3f& d, const Vec3f& u, const Vec3f& v) {
  const float scale = dot(u, u) * dot(v, v);
  if (scale > 1e-28f && scale < 1e28f) return solution(d, u, v);
  return solution(Vec3d(d), Vec3d(u), Vec3d(v));
}

}  // namespace

Vec2<float> QuadShape::uv_at(const LightPoint<float>& at) const { return in_basis(at.p - corner, edge_u, edge_v); }

Vec2<float> DiskShape::uv_at(const LightPoint<float>& at) const {
  const Vec2<float> d = in_basis(at.p - center, half_axis_u, half_axis_v);
  return {std::hypot(d.x, d.y), turn_of(d.x, d.y)};
}

Vec2<float> SphereShape::uv_at(const LightPoint<float>& at) const {
  const Vec3f d = normalize(at.p - center);
  return {turn_of(dot(d, start), dot(d, side)), angle_between(d, up) / pi};
}

Vec2<float> MeshShape::uv_at(const LightPoint<float>& at) const {
  const Triangle& t = triangles_[std::min<std::size_t>(at.triangle, triangles_.size() - 1)];
  const Vec3f& a = positions_[t[0]];
  const Vec2<float> w = in_basis(at.p - a, positions_[t[1]] - a, positions_[t[2]] - a);
  return uv_of(t, w.x, w.y);
}

Vec2<float> MeshShape::uv_of(const Triangle& t, float weight_b, float weight_c) const {
  if (uvs_.empty()) return {weight_b, weight_c};
  const float weight_a = 1 - weight_b - weight_c;
  const Vec2<float>&a = uvs_[t[0]], &b = uvs_[t[1]], &c = uvs_[t[2]];
  return {a.x * weight_a + b.x * weight_b + c.x * weight_c, a.y * weight_a + b.y * weight_b + c.y * weight_c};
}

LightPoint<float> DiskShape::sample(const Vec2<float>& u) const {
  const Vec2<float> d = square_to_disc(u);
  return {center + half_axis_u * d.x + half_axis_v * d.y, normal, {std::hypot(d.x, d.y), turn_of(d.x, d.y)}};
}
float DiskShape::area() const { return pi * length(cross(half_axis_u, half_axis_v)); }

LightPoint<float> SphereShape::sample(const Vec2<float>& u) const {
  const Vec3f d = square_to_sphere(u);  // z = 1 - 2 u.x, azimuth 2 pi u.y
  const Vec3f outward = start * d.x + side * d.y + up * d.z;
  return {center + outward * radius, outward * sign, {u.y, std::acos(std::clamp(d.z, -1.0f, 1.0f)) / pi}};
}
float SphereShape::area() const { return 4 * pi * radius * radius; }

MeshShape::MeshShape(std::vector<Vec3f> positions, std::vector<Triangle> triangles, std::vector<Vec2<float>> uvs,
                     bool flipped, LongFaces long_faces)
    : positions_(std::move(positions)),
      triangles_(std::move(triangles)),
      uvs_(std::move(uvs)),
      long_faces_(std::move(long_faces)) {
  std::vector<double> areas;
  std::vector<std::optional<LightBounds>> bounds;
  areas.reserve(triangles_.size());
  bounds.reserve(triangles_.size());
  planes_.reserve(triangles_.size());
  for (const Triangle& t : triangles_) {
    const Vec3f &a = positions_[t[0]], &b = positions_[t[1]], &c = positions_[t[2]];
    areas.push_back(0.5 * length(cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a))));
    const LongFace* face = long_face(static_cast<std::uint32_t>(planes_.size()));
    planes_.push_back(face != nullptr ? FacePlane{Vec3f(face->normal), static_cast<float>(face->offset)}
                                      : FacePlane{face_normal(b - a, c - a) * (flipped ? -1.0f : 1.0f)});
    bounds.push_back(triangle_bounds(a, b, c, planes_.back().normal, static_cast<float>(areas.back())));
  }
  by_area_ = DiscreteDistribution(areas);
  area_ = static_cast<float>(by_area_.total());
  if (!(area_ > 0)) return;
  const LightBounds all = round_bounds(positions_);
  center_ = (all.low + all.high) * 0.5f;
  half_extent2_ = length_squared(all.high - all.low) * 0.25f;
  by_importance_ = std::make_shared<const LightTree>(bounds);
}

LightPoint<float> MeshShape::sample(const Vec2<float>& u) const {
  const DiscreteDistribution::Drawn drawn = by_area_.sample(u.x);
  return point_on(static_cast<std::uint32_t>(drawn.index), {drawn.u, u.y});
}

AreaLight::AreaLight(LightShape shape, const Rgb& radiance)
    : shape_(std::move(shape)), area_(area_of(shape_)), radiance_(radiance), flux_(radiance * (pi * area_)) {}

AreaLight::AreaLight(LightShape shape, LightTexture texture)
    : shape_(std::move(shape)),
      area_(area_of(shape_)),
      texture_(std::move(texture)),
      flux_(mean_over(shape_, texture_) * (pi * area_)) {}

LightSample<float> AreaLight::sample(const Vec3f& p, const Vec2<float>& u) const {
  const SeenPoint seen = std::visit([&](const auto& shape) { return shape.sample_from(p, u); }, shape_);
  const Vec3f wi = seen.offset * (1 / length(seen.offset));
  return {seen.at, wi, radiance_at(seen.at.uv), seen.pdf};
}

float AreaLight::pdf(const Vec3f& p, const LightPoint<float>& at) const {
  return std::visit([&](const auto& shape) { return shape.pdf_from(p, at); }, shape_);
}

Emission<float> AreaLight::emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  const LightPoint<float> at = std::visit([&](const auto& shape) { return shape.sample(u_position); }, shape_);
  const Vec3f direction = Frame<float>(at.normal).to_world(square_to_cosine_hemisphere(u_direction));
  return {at, direction, radiance_at(at.uv) * (pi * area_)};
}

Vec2<float> AreaLight::uv_at(const LightPoint<float>& at) const {
  if (!texture_) return {};
  return std::visit([&](const auto& shape) { return shape.uv_at(at); }, shape_);
}

EmissionPdfs<float> AreaLight::emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const {
  return {1 / area_, cosine_hemisphere_pdf(dot(at.normal, direction))};
}

Rgb AreaLight::flux_towards(const LightPoint<float>& at, const Vec3f& direction) const {
  return radiance_at(at.uv) * (area_ * std::max(dot(at.normal, direction), 0.0f));
}

Rgb AreaLight::leaving(const LightPoint<float>& at, const Vec3f& direction) const {
  return dot(at.normal, direction) > 0 ? radiance_at(at.uv) : Rgb(0.0f);
}

}  // namespace photonproof::inline renderer_lights
