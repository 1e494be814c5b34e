// A spot light (light_spot.h) that projects a texture through the square around its cut-off cone.
#pragma once

#include "renderer/lights/light_sample.h"
#include "renderer/lights/light_spot.h"
#include "renderer/textures/light_texture.h"

namespace photonproof::inline renderer_lights {

class TexturedSpotLight {
 public:
  static constexpr bool is_delta = true, is_infinite = false;

  /// The unit vectors `right` and `up` are the directions in which the texture's u and v grow. The cut-off is below a
  /// quarter turn.
  TexturedSpotLight(const SpotLight<float>& spot, const Vec3f& right, const Vec3f& up, LightTexture texture);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  float pdf(const Vec3f&, const LightPoint<float>&) const { return 0; }
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const {
    return spot_.emit_pdfs(at, direction);
  }
  Rgb flux_towards(const LightPoint<float>& at, const Vec3f& direction) const { return leaving(at, direction); }
  Rgb leaving(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux() const { return flux_; }
  LightBounds bounds() const { return spot_.bounds(); }

 private:
  Rgb texture_towards(const Vec3f& direction) const;

  SpotLight<float> spot_;
  Vec3f right_, up_;
  float half_width_;  ///< half width of the square, one unit ahead
  LightTexture texture_;
  Rgb flux_{0.0f};
};

}  // namespace photonproof::inline renderer_lights
