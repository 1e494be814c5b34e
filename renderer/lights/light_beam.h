// A beam: light that leaves a flat surface along its normal alone. Meaning as in Mitsuba 3's directionalarea, whose
// `radiance` is the irradiance across the beam. Like a directional light it has one direction, the entry of photons is
// sampled across it, and rays that meet its surface find no light.
#pragma once

#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

/// The parallelogram, or the ellipse in it, of these half axes; `normal` is the direction of the light, unit.
struct BeamPatch {
  Vec3f middle, half_u, half_v, normal;
  bool is_round;
};

class BeamLight {
 public:
  static constexpr bool is_delta = true, is_infinite = true;

  BeamLight(const BeamPatch& patch, const Rgb& irradiance);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  float pdf(const Vec3f&, const LightPoint<float>&) const { return 0; }
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>&, const Vec3f&) const { return {1, 1 / area_}; }
  Rgb flux_towards(const LightPoint<float>&, const Vec3f&) const { return Rgb(0.0f); }
  /// To rays, which find no light.
  Rgb leaving(const LightPoint<float>&, const Vec3f&) const { return Rgb(0.0f); }
  Rgb flux() const { return irradiance_ * area_; }

 private:
  BeamPatch patch_;
  Vec3f along_u_, along_v_;  ///< their products with a vector in the plane are its parts of the half axes
  Rgb irradiance_;
  float area_;
};

}  // namespace photonproof::inline renderer_lights
