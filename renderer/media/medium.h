// Participating media: the distance light travels in them and its direction after scattering. Also the interiors of
// glass that may overlap, with the scene file's order of precedence.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "renderer/lanes/warp.h"
#include "renderer/media/free_flight.h"
#include "renderer/media/phase.h"
#include "renderer/textures/volume.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_media {

class VaryingMedium;  // varying_medium.h

struct Medium {
  Rgb sigma_t;  ///< extinction per scene unit
  Rgb albedo;   ///< the part of it that scatters; 1 where albedo_map gives it
  PhaseFunction phase;
  bool scatters = false;
  std::shared_ptr<const VaryingMedium> varying;  ///< empty where the medium is homogeneous; else sigma_t is 0
  std::shared_ptr<const Volume> albedo_map;  ///< of a homogeneous medium; empty where its albedo is the same everywhere
  std::shared_ptr<const Volume>
      second_lobe_map;  ///< the weight of the phase function; empty where it is the same everywhere

  PhaseFunction phase_at(const Vec3f& p) const;

  /// By Beer and Lambert, where the medium is homogeneous.
  Rgb transmittance(float distance) const {
    const auto of = [&](float extinction) { return extinction > 0 ? std::exp(-extinction * distance) : 1.0f; };
    return {of(sigma_t.x), of(sigma_t.y), of(sigma_t.z)};  // the distance may be infinite
  }
};

/// In a homogeneous medium, up to `distance` along a ray from `origin`. Samples a distance for one channel, chosen in
/// proportion to its throughput, and weights it against the others' densities (one-sample balance heuristic, Veach
/// 1997, section 9.2.4). So the sum of the channels' throughputs never grows, however colours differ in extinction.
FreeFlight fly(const Medium& medium, const Rgb& throughput, const Vec3f& origin, const Vec3f& direction, float distance,
               float u_channel, float u_distance);

/// A dielectric's interior, as its priority defines it.
struct InteriorDescription {
  std::optional<int> priority;
  float int_ior = 1, ext_ior = 1;
};

struct SceneMedia {
  std::vector<Medium> media;                   ///< by the description's indices
  std::vector<InteriorDescription> interiors;  ///< of each BSDF
  std::uint32_t around_camera;                 ///< index of a medium, or no_index
  bool any_priority = false;
};
/// `frame`: of rays; the description is in its unit already.
SceneMedia compile_media(const SceneDescription& description, const VolumeFrame& frame);

}  // namespace photonproof::inline renderer_media
