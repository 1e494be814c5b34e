// The closed set of lights. Each lives in light_<name>.h as a struct of floats (or packs) that offers
//   sample(p, u)      a point of the light seen from p (next-event estimation), density per solid angle at p
//   pdf(p, q, n)      that density for a ray from p that found the light's point q by itself (for MIS)
//   emit(u, v)        a photon's start
//   emit_pdf(c)       density per solid angle of emit's direction, whose cosine to the normal is c
//   flux()            total emitted flux, W per channel
//   emitted_radiance  from a point whose normal makes `cos_emit` with the direction of travel; 0 from behind
#pragma once

#include "renderer/kind_list.h"
#include "renderer/light_point.h"
#include "renderer/light_quad.h"
#include "renderer/light_sample.h"
#include "renderer/light_sphere.h"

namespace photonproof {

/// One row a light.
using LightKinds = KindList<QuadLight, SphereLight, PointLight>;

/// A light of the scene, as the host sees it.
using Light = LightKinds::Variant;

/// A delta light cannot be found by a ray.
inline bool is_delta(const Light& light) {
  return std::visit([](const auto& l) { return l.is_delta; }, light);
}
inline Rgb flux(const Light& light) {
  return std::visit([](const auto& l) { return l.flux(); }, light);
}

}  // namespace photonproof
