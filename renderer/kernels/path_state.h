// The state of a camera path between two surfaces: one lane of a batch (lane_batch.h).
#pragma once

#include "renderer/kernels/lane_batch.h"
#include "renderer/lanes/always_inline.h"
#include "scenes/base/vec.h"

namespace photonproof::inline renderer_kernels {

template <class F>
struct PathState {
  Vec3<F> origin, direction;  ///< the next ray
  Vec3<F> throughput, radiance;
  F bsdf_pdf;  ///< Density of `direction`; 0 after a delta BSDF and from the camera: nothing else could find it.
               ///< Negative where the ray shows no environment (hides_environment).
  F refraction_scale;  ///< Undoes the squared index ratios in the throughput, for roulette.
  UInt<F> from;        ///< Primitive that the ray leaves.
  UInt<F> vertex;      ///< Edges before the next ray.
  UInt<F> key, index;  ///< The sampler's.
  UInt<F> path;
  UInt<F> gathering;  ///< final_gather's bits

  static constexpr std::size_t column_count = 20;
  template <class Self, class Visit>
  PHOTONPROOF_ALWAYS_INLINE static void columns(Self& s, Visit&& visit) {
    const auto visit3 = [&](auto& v) { visit(v.x), visit(v.y), visit(v.z); };
    visit3(s.origin), visit3(s.direction), visit3(s.throughput), visit3(s.radiance);
    visit(s.bsdf_pdf), visit(s.refraction_scale);
    visit(s.from), visit(s.vertex), visit(s.key), visit(s.index), visit(s.path);
    visit(s.gathering);
  }
};

}  // namespace photonproof::inline renderer_kernels
