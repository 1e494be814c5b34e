// SceneLights in the words of the scalar integrators: ends of segments that know their primitives, and densities in
// which the choice of the light is included.
#pragma once

#include "renderer/light_choice/scene_lights.h"
#include "renderer/scalar/world.h"

namespace photonproof {

/// A light as seen from a point.
struct LightSeen {
  SegmentEnd end;     ///< its point; for infinite lights one beyond the scene
  Vec3f wi{0, 0, 0};  ///< unit, from the shaded point
  Rgb radiance;       ///< arriving along wi; of a delta light: irradiance at normal incidence
  float pdf = 0;      ///< per solid angle at the shaded point; of a delta light the probability of its choice
  std::uint32_t light = no_index;
  std::uint32_t triangle = 0;  ///< of a mesh
  bool delta = false;          ///< no ray can find it
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
  Vec2<float> uv;
  std::uint32_t light = no_index;
  std::uint32_t triangle = 0;  ///< of a mesh
  bool delta = false, infinite = false;
};

class WorldLights {
 public:
  explicit WorldLights(const World& world);

  std::uint32_t count() const { return static_cast<std::uint32_t>(lights_.count()); }
  bool has_environment() const { return lights_.environment().has_value(); }

  /// One light, chosen, as seen from p. pdf is 0 where it shows nothing.
  LightSeen sample(const Vec3f& p, float u_choice, const Vec2<float>& u) const;
  /// That light, its choice not in the density.
  LightSeen sample_of(std::uint32_t light, const Vec3f& p, const Vec2<float>& u) const;
  /// Density of `sample` at p for a light that a ray met, per solid angle.
  float sample_pdf(const Vec3f& p, const Interaction& met) const {
    return lights_.pdf(p, met.light, met.p, met.ng, triangle_of(met));
  }
  /// The same for a light path's start; of a delta light, the probability of its choice.
  float sample_pdf(const Vec3f& p, const LightStart& start) const;
  /// The same for the environment, which a ray along `direction` met.
  float environment_pdf(const Vec3f& p, const Vec3f& direction) const { return lights_.environment_pdf(p, direction); }

  /// The start of a light path; its weight is 0 where there is none.
  LightStart emit(float u_choice, const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  /// Of `emit`, for a path that goes along `direction` through p, which is the light's point with its normal there, or
  /// any point of a path from an infinite light.
  EmissionPdf emit_pdf(std::uint32_t light, const Vec3f& p, const Vec3f& normal, std::uint32_t triangle,
                       const Vec3f& direction) const;
  /// Of a light that a ray met along -`direction`.
  EmissionPdf emit_pdf(const Interaction& met, const Vec3f& direction) const {
    return emit_pdf(met.light, met.p, met.ng, triangle_of(met), direction);
  }
  /// For paths from the environment that come to p against `towards_sky`.
  EmissionPdf environment_emit_pdf(const Vec3f& p, const Vec3f& towards_sky) const {
    return emit_pdf(*lights_.environment(), p, Vec3f(0.0f), 0, -towards_sky);
  }

  /// Radiance that leaves a surface that a ray met along `direction`.
  Rgb radiance(const Interaction& met, const Vec3f& direction) const;
  /// Radiance that leaves a light path's start along another direction.
  Rgb radiance(const LightStart& start, const Vec3f& direction) const;
  Rgb environment(const Vec3f& towards_sky) const { return lights_.environment_radiance(towards_sky); }

 private:
  LightSeen seen(const LightSample<float>& sample, std::uint32_t light, std::uint32_t triangle) const;
  std::uint32_t triangle_of(const Interaction& met) const;
  SegmentEnd end(std::uint32_t light, const Vec3f& p, const Vec3f& normal, std::uint32_t triangle) const;

  const World& world_;
  const SceneLights& lights_;
  std::vector<std::uint32_t> surface_;  ///< of each light
};

}  // namespace photonproof
