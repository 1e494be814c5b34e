// Arguments and results of lights' functions, one per lane; the host's lights use F = float.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lights {

/// A point of a light.
template <class F>
struct LightPoint {
  Vec3<F> p;              ///< Position; for an infinite light beyond the scene, where shadow segments end.
  Vec3<F> normal = {};    ///< Unit normal on the emitting side; zero for lights without surface.
  Vec2<F> uv = {};        ///< Texture coordinates, where the radiance is a texture.
  UInt<F> triangle = {};  ///< Triangle of a mesh.
};

/// A point of a chosen light for a shaded point.
template <class F>
struct LightSample {
  LightPoint<F> at;
  Vec3<F> wi;        ///< Unit direction from the shaded point to the light.
  Vec3<F> radiance;  ///< Radiance arriving along wi; for a delta light the irradiance at normal incidence.
  F pdf = {};        ///< Density per solid angle at the shaded point; 1 for a delta light. It is 0 without light there.
};

/// A point sampled for a shaded point.
struct SeenPoint {
  LightPoint<float> at;
  Vec3f offset;   ///< vector to the point
  float pdf = 0;  ///< per solid angle
};

/// A light path's start at a light that has been chosen.
template <class F>
struct Emission {
  LightPoint<F> at;    ///< Point; for an infinite light on the disc in front of the scene.
  Vec3<F> direction;   ///< Unit direction.
  Vec3<F> flux;        ///< Emitted flux, W, cosine inside, over the densities of position and direction.
  F crowding{1.0f};    ///< Density of the position over that of an even one.
  Vec3<F> ahead = {};  ///< Point up to which the path meets nothing, where `is_ahead` is not 0.
  F is_ahead{0.0f};
};

/// Densities of the two samples of an emission in their order, for a chosen light. Infinite lights begin with their
/// direction, so the measures are swapped.
///   Finite lights: first the point, per area, then the direction, per solid angle.
///   Infinite lights: first the direction, per solid angle, then the point of entry, per area across the direction.
/// A delta density is 1: the position without surface, or a directional light's direction.
template <class F>
struct EmissionPdfs {
  F first = {}, second = {};
};

using renderer_lanes::select;  // declarations here would hide it
template <class M, class F>
LightPoint<F> select(const M& m, const LightPoint<F>& a, const LightPoint<F>& b) {
  return {select(m, a.p, b.p),
          select(m, a.normal, b.normal),
          {select(m, a.uv.x, b.uv.x), select(m, a.uv.y, b.uv.y)},
          select(m, a.triangle, b.triangle)};
}
template <class M, class F>
LightSample<F> select(const M& m, const LightSample<F>& a, const LightSample<F>& b) {
  return {select(m, a.at, b.at), select(m, a.wi, b.wi), select(m, a.radiance, b.radiance), select(m, a.pdf, b.pdf)};
}

template <class M, class F>
Emission<F> select(const M& m, const Emission<F>& a, const Emission<F>& b) {
  return {select(m, a.at, b.at),       select(m, a.direction, b.direction),
          select(m, a.flux, b.flux),   select(m, a.crowding, b.crowding),
          select(m, a.ahead, b.ahead), select(m, a.is_ahead, b.is_ahead)};
}

/// Converts a density `pdf_area` at a point of a surface light to a density per solid angle at `p`; 0 for a point seen
/// edge-on or from behind.
template <class F>
F area_to_solid_angle(const F& pdf_area, const Vec3<F>& p, const LightPoint<F>& at) {
  const Vec3<F> d = p - at.p;
  const F distance2 = dot(d, d);
  const F cos_light = dot(at.normal, d) / lane_sqrt(distance2);
  return select(cos_light > 0, pdf_area * distance2 / cos_light, F(0.0f));
}

/// Length of a shadow segment from p to an infinite light. Beyond it nothing lies within the ball around the scene;
/// infinite planes hide light up to a thousandth of a radian from their horizon.
template <class F>
F reach_beyond(const Vec3<F>& center, const F& radius, const Vec3<F>& p) {
  return 1024 * (radius + length(Vec3<F>(p - center)));
}

}  // namespace photonproof::inline renderer_lights
