#include "renderer/lights/light_beam.h"

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {

BeamLight::BeamLight(const BeamPatch& patch, const Rgb& irradiance) : patch_(patch), irradiance_(irradiance) {
  const Vec3d u(patch.half_u), v(patch.half_v);
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  along_u_ = Vec3f((u * vv - v * uv) / determinant);
  along_v_ = Vec3f((v * uu - u * uv) / determinant);
  area_ = static_cast<float>((patch.is_round ? pi_d : 4.0) * length(cross(u, v)));
}

/// The foot of the perpendicular, where that is on the surface.
LightSample<float> BeamLight::sample(const Vec3f& p, const Vec2<float>&) const {
  const Vec3f d = p - patch_.middle;
  const float height = dot(d, patch_.normal);
  const Vec3f foot = d - patch_.normal * height;
  const float a = dot(foot, along_u_), b = dot(foot, along_v_);
  const bool inside = patch_.is_round ? a * a + b * b <= 1 : std::abs(a) <= 1 && std::abs(b) <= 1;
  if (!inside || !(height > 0)) return {};
  return {{patch_.middle + foot, patch_.normal}, -patch_.normal, irradiance_, 1};
}

Emission<float> BeamLight::emit(const Vec2<float>& u_position, const Vec2<float>&) const {
  const Vec2<float> place =
      patch_.is_round ? square_to_disc(u_position) : Vec2<float>{2 * u_position.x - 1, 2 * u_position.y - 1};
  const Vec3f p = patch_.middle + patch_.half_u * place.x + patch_.half_v * place.y;
  return {{p, patch_.normal}, patch_.normal, flux()};
}

}  // namespace photonproof::inline renderer_lights
