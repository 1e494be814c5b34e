// Precomputed values of dielectric interfaces in BSDF records: integrals over all directions of light.
#pragma once

#include <array>

#include "renderer/bsdfs/bsdf_roughplastic.h"

namespace photonproof::inline renderer_bsdfs {

/// Share of diffuse light that a smooth interface does not reflect, with an absorbing layer crossed on the way to the
/// interface and back. It is 1 less 2 times the integral of F(cos) cos exp(-2 depth / cos) over cos in [0,1]. `eta` =
/// ior of the far side / ior of the side the light is on.
double diffuse_fresnel_loss(double eta, double depth = 0);

/// 1 - diffuse_fresnel_loss(eta) as Mitsuba's plastic has it: by the fits of Egan and Hilgeman (1973) for eta < 1 and
/// of d'Eon and Irving (2011) otherwise.
double fitted_diffuse_reflectance(double eta);

struct RoughInterface {
  std::array<float, RoughPlasticBsdf<float>::coefficients> through;  ///< RoughPlasticBsdf::through
  float lost_inside;                                                 ///< RoughPlasticBsdf::lost_inside
};
/// As in Mitsuba 3, only light that crosses the microfacets at once reaches the base. The reflectance from inside is
/// the mean over 64 evenly spaced cosines from 0 to 1, 1 to 5 % below its integral. `eta` = ior below / ior above.
RoughInterface rough_interface(const Microfacets<float>& facets, double eta);

/// Share of the light from direction wo that facets of the interface reflect to wo's side.
double rough_reflectance(const Microfacets<float>& facets, double cos_wo, double eta);
/// Share of that light that the facets refract to the other side. Light stopped by a second facet is in neither share.
double rough_transmittance(const Microfacets<float>& facets, double cos_wo, double eta);

}  // namespace photonproof::inline renderer_bsdfs
