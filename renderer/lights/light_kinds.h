// The lights that kernels sample in their lanes. Each is a struct of floats in light_<name>.h with these members.
//   `sample(p, u)`: a point of the light for the point p (next-event estimation), with its density per solid angle.
//   `pdf(p, at)`: that density for a ray from p that met the light's point by itself (for MIS).
//   `emit(u, v)`: a photon's start and flux.
//   `emit_pdfs(at, d)`: the densities of a start there in direction d.
//   `flux_towards(at, d)`: a photon's flux from there towards d, over the density of its position only; W sr^-1.
//   `leaving(at, d)`: radiance from a point in direction d; 0 from behind. For lights without surface it is the
//                     intensity, for directional ones the irradiance.
//   `flux()`: total emitted flux, W per channel.
//   `bounds()`: position and directions of a light that is not infinite (light_bounds.h).
//   `is_delta`: a ray cannot find it.
//   `is_infinite`: it has directions, but no points.
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

/// Value in LightWords::kind and SceneView::light_kinds for every kind that needs tables; kernels call scene_lights.h
/// for these.
inline constexpr std::uint32_t general_light_kind = LightKinds::count;

}  // namespace photonproof::inline renderer_lights
