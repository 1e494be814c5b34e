// The lights that kernels sample in their lanes: structs of floats, each in light_<name>.h, that offer
//   sample(p, u)             a point of the light seen from p (next-event estimation), density per solid angle at p
//   pdf(p, at)               that density for a ray from p that found the light's point by itself (for MIS)
//   emit(u, v)               a photon's start and what it carries
//   emit_pdfs(at, d)         the densities of a start there in direction d
//   flux_towards(at, d)      W sr^-1: what a photon that starts there carries towards d, over the density of its
//                            position only
//   leaving(at, d)           radiance from a point in direction d; 0 from behind. Of a light without surface the
//                            intensity, of a directional one the irradiance
//   flux()                   total emitted flux, W per channel
//   bounds()                 of a light that is not infinite: where it is and where to it shines (light_bounds.h)
//   is_delta                 a ray cannot find it
//   is_infinite              it has directions, but no points
#pragma once

#include "renderer/lanes/kind_list.h"
#include "renderer/lights/light_directional.h"
#include "renderer/lights/light_disk.h"
#include "renderer/lights/light_point.h"
#include "renderer/lights/light_quad.h"
#include "renderer/lights/light_sample.h"
#include "renderer/lights/light_sphere.h"
#include "renderer/lights/light_spot.h"

namespace photonproof::inline renderer_lights {

/// One row a light.
using LightKinds = KindList<QuadLight, SphereLight, PointLight, DiskLight, SpotLight, DirectionalLight>;

/// In LightWords::kind and SceneView::light_kinds: every kind that needs tables, which kernels ask scene_lights.h
/// about.
inline constexpr std::uint32_t general_light_kind = LightKinds::count;

}  // namespace photonproof::inline renderer_lights
