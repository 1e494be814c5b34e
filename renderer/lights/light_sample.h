// What lights are asked about and what they answer, a lane each; the host's lights answer with F = float.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_lights {

/// A point of a light.
template <class F>
struct LightPoint {
  Vec3<F> p;              ///< of an infinite light: beyond the scene, where shadow segments end
  Vec3<F> normal = {};    ///< unit, on the side that emits; zero for lights of no surface
  Vec2<F> uv = {};        ///< where the radiance is a texture
  UInt<F> triangle = {};  ///< of a mesh
};

/// A point of a light that has been chosen, as seen from another.
template <class F>
struct LightSample {
  LightPoint<F> at;
  Vec3<F> wi;        ///< unit, from the shaded point to the light
  Vec3<F> radiance;  ///< arriving along wi; for a delta light: irradiance at normal incidence
  F pdf = {};        ///< per solid angle at the shaded point; 1 for a delta light; 0 when it gives nothing there
};

/// A point drawn as seen from another.
struct SeenPoint {
  LightPoint<float> at;
  Vec3f offset;   ///< to it
  float pdf = 0;  ///< per solid angle
};

/// A light path's start at a light that has been chosen.
template <class F>
struct Emission {
  LightPoint<F> at;    ///< of an infinite light: on the disc before the scene
  Vec3<F> direction;   ///< unit
  Vec3<F> flux;        ///< W: what leaves the light, cosine inside, over the densities of position and direction
  F crowding{1.0f};    ///< density of the position over that of an even one
  Vec3<F> ahead = {};  ///< where `is_ahead` is not 0: a point on its way up to which it meets nothing
  F is_ahead{0.0f};
};

/// Densities of an emission's two draws in their order, of a light that has been chosen. Infinite lights begin with
/// their direction, so the measures are swapped:
///             first                                   second
///   finite    the point, per area                     the direction, per solid angle
///   infinite  the direction, per solid angle          the place where it enters, per area across the direction
/// A delta density, a position of no surface or a directional light's direction, is 1.
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

/// Density per solid angle at `p` of a density `pdf_area` per area at a point of a surface light; 0 when that is seen
/// edge-on or from behind.
template <class F>
F area_to_solid_angle(const F& pdf_area, const Vec3<F>& p, const LightPoint<F>& at) {
  const Vec3<F> d = p - at.p;
  const F distance2 = dot(d, d);
  const F cos_light = dot(at.normal, d) / lane_sqrt(distance2);
  return select(cos_light > 0, pdf_area * distance2 / cos_light, F(0.0f));
}

/// How far from p a shadow segment to an infinite light goes. Within the ball around the scene nothing is beyond it;
/// infinite planes hide light up to a thousandth of a radian from their horizon.
template <class F>
F reach_beyond(const Vec3<F>& center, const F& radius, const Vec3<F>& p) {
  return 1024 * (radius + length(Vec3<F>(p - center)));
}

}  // namespace photonproof::inline renderer_lights
