// What sampling a BSDF yields, a lane each.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_bsdfs {

/// What the path carries: radiance (camera paths) or importance (photons). Refraction scales radiance by the squared
/// ratio of indices, flux not at all (Veach 1997, section 5.2).
enum class TransportMode { radiance, importance };

template <class F>
struct BsdfSample {
  Vec3<F> wi_local;
  Vec3<F> weight;  ///< f cos / pdf
  F pdf;           ///< per solid angle; of a delta sample: the probability of the lobe
  F eta;           ///< ior of the side entered / ior of the side left; 1 unless refracted
  Mask<F> delta;   ///< the direction was drawn from a Dirac, which eval and pdf leave out
  Mask<F> valid;   ///< where false the path is absorbed and the rest is undefined
};

}  // namespace photonproof::inline renderer_bsdfs
