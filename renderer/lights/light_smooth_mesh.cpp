#include "renderer/lights/light_smooth_mesh.h"

#include <algorithm>
#include <utility>

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {

SmoothMeshLight::SmoothMeshLight(MeshShape shape, std::vector<MeshShape::Triangle> triangles,
                                 std::vector<Vec3f> normals, bool inward, const Rgb& radiance)
    : shape_(std::move(shape)),
      triangles_(std::move(triangles)),
      normals_(std::move(normals)),
      side_(inward ? -1.0f : 1.0f),
      radiance_(radiance),
      area_(shape_.area()) {}

Vec3f SmoothMeshLight::normal_at(const LightPoint<float>& at) const {
  const MeshShape::Triangle& t = triangles_[std::min<std::size_t>(at.triangle, triangles_.size() - 1)];
  const Vec2<float> b = shape_.uv_at(at);  // without texture coordinates, those of the triangle
  const Vec3f n = normals_[t[0]] * (1 - b.x - b.y) + normals_[t[1]] * b.x + normals_[t[2]] * b.y;
  const float norm = length(n);
  return norm > 0 ? n * (side_ / norm) : at.normal;
}

LightSample<float> SmoothMeshLight::sample(const Vec3f& p, const Vec2<float>& u) const {
  const LightPoint<float> at = shape_.sample(u);
  const Vec3f offset = at.p - p;
  return {at, offset * (1 / length(offset)), radiance_, pdf(p, at)};
}

float SmoothMeshLight::pdf(const Vec3f& p, const LightPoint<float>& at) const {
  const Vec3f offset = at.p - p;
  const float distance = length(offset);
  const float cosine = -dot(offset, normal_at(at)) / distance;
  return distance > 0 && cosine > 0 ? distance * distance / (area_ * cosine) : 0;
}

Emission<float> SmoothMeshLight::emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  const LightPoint<float> at = shape_.sample(u_position);
  return {at, Frame<float>(normal_at(at)).to_world(square_to_cosine_hemisphere(u_direction)), flux()};
}

EmissionPdfs<float> SmoothMeshLight::emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const {
  return {1 / area_, cosine_hemisphere_pdf(dot(normal_at(at), direction))};
}

Rgb SmoothMeshLight::flux_towards(const LightPoint<float>& at, const Vec3f& direction) const {
  return radiance_ * (area_ * std::max(dot(normal_at(at), direction), 0.0f));
}

Rgb SmoothMeshLight::leaving(const LightPoint<float>& at, const Vec3f& direction) const {
  return dot(normal_at(at), direction) > 0 ? radiance_ : Rgb(0.0f);
}

}  // namespace photonproof::inline renderer_lights
