// Emits photons and follows them (Jensen 2001, "Realistic Image Synthesis Using Photon Mapping", chapters 5 and 7.2).
#pragma once

#include <cstdint>

#include "renderer/core/parallel.h"
#include "renderer/kernels/tasks.h"
#include "renderer/lanes/sampler.h"
#include "renderer/passes/ray_totals.h"
#include "renderer/photons/photons.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_photon_mapping {

inline constexpr Stream global_photon_stream{2}, caustic_photon_stream{3}, pilot_stream{4};

struct PhotonRun {
  PhotonKind kind = PhotonKind::global;
  Stream stream = global_photon_stream;
  std::uint64_t seed = 0;
  std::uint64_t first = 0;  ///< Index of the first path of this run.
  std::uint64_t count = 0;  ///< Number of paths. Each carries 1/count of the lights' flux.
  int max_edges = -1;       ///< Maximum of edges of a light subpath; -1 is unlimited.
  bool aimed = false;       ///< Emission towards specular surfaces only, for caustics.
};

/// Kernels and sampler of photon paths: the same for every run of a render.
struct PhotonMethod {
  const Kernels& kernels;
  SamplerKind sampler = SamplerKind::sobol;
};

/// The stored photons in the order of their paths. The result does not depend on threads: paths are traced in chunks of
/// fixed size whose results are joined in order.
Photons trace_photons(const Scene& scene, const PhotonRun& run, const PhotonMethod& method, const Threads& threads,
                      RayTotals& totals);

}  // namespace photonproof::inline renderer_photon_mapping
