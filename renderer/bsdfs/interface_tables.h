// Numbers of dielectric interfaces that BSDF records carry ready-made: integrals over all directions of light.
#pragma once

#include <array>

#include "renderer/bsdfs/bsdf_roughplastic.h"

namespace photonproof::inline renderer_bsdfs {

/// Share of diffuse light that a smooth interface does not reflect: 1 less 2 times the integral of F(cos) cos
/// exp(-2 depth / cos) over cos in [0,1], the light crossing an absorbing layer on its way to the interface and back.
/// `eta` = ior of the far side / ior of the side the light is on.
double diffuse_fresnel_loss(double eta, double depth = 0);

struct RoughInterface {
  std::array<float, RoughPlasticBsdf<float>::coefficients> through;  ///< RoughPlasticBsdf::through
  float lost_inside;                                                 ///< RoughPlasticBsdf::lost_inside
};
/// `eta` = ior below / ior above. As Mitsuba 3 has them: only what microfacets let through at once reaches the base,
/// and the reflectance from inside is the mean over 64 evenly spaced cosines from 0 to 1, 1 to 5 % below its integral.
RoughInterface rough_interface(const Microfacets<float>& facets, double eta);

/// Share of the light from direction wo that facets of the interface reflect to wo's side.
double rough_reflectance(const Microfacets<float>& facets, double cos_wo, double eta);
/// Share of it that they refract to the other side. What a second facet stops is in neither.
double rough_transmittance(const Microfacets<float>& facets, double cos_wo, double eta);

}  // namespace photonproof::inline renderer_bsdfs
