#include "renderer/lights/light_textured_spot.h"

#include <cmath>
#include <utility>

namespace photonproof::inline renderer_lights {

TexturedSpotLight::TexturedSpotLight(const SpotLight<float>& spot, const Vec3f& right, const Vec3f& up,
                                     LightTexture texture)
    : spot_(spot), right_(right), up_(up), half_width_(std::tan(spot.cutoff)), texture_(std::move(texture)) {
  constexpr int cells = 64;  // midpoints of equal solid angles within the cone
  RgbD sum(0.0);
  for (int row = 0; row < cells; ++row)
    for (int column = 0; column < cells; ++column) {
      const Vec2<float> u{(static_cast<float>(column) + 0.5f) / cells, (static_cast<float>(row) + 0.5f) / cells};
      sum += RgbD(emit({}, u).flux);
    }
  flux_ = Rgb(sum / (cells * cells));
}

LightSample<float> TexturedSpotLight::sample(const Vec3f& p, const Vec2<float>& u) const {
  LightSample<float> s = spot_.sample(p, u);
  if (s.pdf > 0) s.radiance *= texture_towards(-s.wi);
  return s;
}

Emission<float> TexturedSpotLight::emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
  Emission<float> start = spot_.emit(u_position, u_direction);
  if (max_component(start.flux) > 0) start.flux *= texture_towards(start.direction);
  return start;
}

Rgb TexturedSpotLight::leaving(const LightPoint<float>& at, const Vec3f& direction) const {
  const Rgb intensity = spot_.leaving(at, direction);
  return max_component(intensity) > 0 ? intensity * texture_towards(direction) : Rgb(0.0f);
}

Rgb TexturedSpotLight::texture_towards(const Vec3f& direction) const {
  const float scale = 0.5f / (half_width_ * dot(direction, spot_.axis));
  return texture_({0.5f + scale * dot(direction, right_), 0.5f + scale * dot(direction, up_)});
}

}  // namespace photonproof::inline renderer_lights
