// A path that grows from the camera, vertex by vertex: what both integrators share.
#pragma once

#include <optional>

#include "renderer/roulette.h"
#include "renderer/scene.h"

namespace photonproof {

/// The ray that leaves `hit` in the local direction `wi_local`, moved off the surface.
inline Ray scattered_ray(const Scene& scene, const Hit& hit, const Frame& frame, const Vec3f& wi_local) {
  const Vec3f direction = normalize(frame.to_world(wi_local));
  return {scene.tracer().offset(hit.p_world, hit.normal, direction), direction};
}

struct CameraWalk {
  Ray ray;
  Rgb throughput{1.0f};
  float refraction_scale = 1;  ///< undoes the squared index ratios in the throughput, for roulette

  /// Samples the BSDF at `hit`, plays roulette where `mortal`, and turns `ray` into the next segment. Empty when the
  /// path ends here.
  std::optional<BsdfSample> scatter(const Scene& scene, const Hit& hit, const Frame& frame, const Vec3f& wo_local,
                                    bool mortal, Sampler& sampler) {
    const float u_lobe = sampler.next();
    const auto next = sample(scene.bsdf_of(hit), wo_local, u_lobe, sampler.next2(), TransportMode::radiance);
    if (!next) return std::nullopt;
    throughput *= next->weight;
    refraction_scale *= next->eta * next->eta;
    if (!(max_component(throughput) > 0)) return std::nullopt;
    if (mortal && !survives_roulette(throughput, refraction_scale, sampler)) return std::nullopt;
    ray = scattered_ray(scene, hit, frame, next->wi_local);
    return next;
  }
};

}  // namespace photonproof
