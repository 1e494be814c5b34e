// All lights of a scene behind one door, one history at a time: points of them for next-event estimation, starts of
// light paths, and the densities of both, which weights need. Densities include the choice of the light.
#pragma once

#include "renderer/world.h"

namespace photonproof {

/// A light as seen from a point.
struct LightSeen {
  SegmentEnd end;     ///< its point; for infinite lights one beyond the scene
  Vec3f wi{0, 0, 0};  ///< unit, from the shaded point
  Rgb radiance;       ///< arriving along wi; of a delta light: irradiance at normal incidence
  float pdf = 0;      ///< per solid angle at the shaded point; of a delta light the probability of its choice
  std::uint32_t light = no_index;
  bool delta = false;  ///< no ray can find it
  bool infinite = false;
};

/// Densities with which light paths start at a point y0 of a light along a direction. At an infinite light the two
/// swap their measures: `position` is then the direction's, per solid angle, and `direction` that of the ray's place,
/// per area across it. `position` of a delta light is the probability of its choice.
struct EmissionPdf {
  float position = 0, direction = 0;
};

struct LightStart {
  SegmentEnd end;
  Vec3f direction{0, 0, 0};
  Rgb weight;  ///< emitted radiance x cosine / densities: the flux of a path
  EmissionPdf pdf;
  std::uint32_t light = no_index;
  bool delta = false, infinite = false;
};

class WorldLights {
 public:
  explicit WorldLights(const World& world);

  std::uint32_t count() const { return static_cast<std::uint32_t>(world_.scene().lights.size()); }

  /// One light, chosen, as seen from p. pdf is 0 where it shows nothing.
  LightSeen sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const;
  /// That light, its choice not in the density.
  LightSeen sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const;
  /// Density of `sample` at `p` for the point q of `light`, whose normal there is `normal`; per solid angle.
  float sample_pdf(const Vec3f& p, std::uint32_t light, const Vec3f& q, const Vec3f& normal) const;

  LightStart emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Of `emit`, for a path that leaves q, or the infinite light, along `direction`.
  EmissionPdf emit_pdf(std::uint32_t light, const Vec3f& normal, const Vec3f& direction) const;

  /// Radiance that leaves a point of a light along `direction`.
  Rgb radiance(std::uint32_t light, const Vec3f& normal, const Vec3f& direction) const;

 private:
  struct Choice {
    std::uint32_t light;
    float probability;
  };
  Choice choose(float u) const;
  float probability(std::uint32_t light) const;
  std::uint32_t primitive(std::uint32_t light) const;

  const World& world_;
  std::vector<std::uint32_t> surface_;  ///< of each light
};

}  // namespace photonproof
