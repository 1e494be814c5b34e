// What sampling a BSDF yields.
#pragma once

#include "scenes/vec.h"

namespace photonproof {

/// What the history carries: radiance (camera paths) or importance (photons). Refraction scales radiance by the squared
/// ratio of indices, flux not at all (Veach 1997, section 5.2).
enum class TransportMode { radiance, importance };

struct BsdfSample {
  Vec3f wi_local;
  Rgb weight;     ///< f cos / pdf
  float pdf = 0;  ///< per solid angle; of a delta sample: the probability of the lobe
  bool delta = false;
  float eta = 1;  ///< ior of the side entered / ior of the side left; 1 unless refracted
};

}  // namespace photonproof
