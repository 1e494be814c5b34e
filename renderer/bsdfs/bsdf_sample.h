// A BSDF sample, one per lane.
#pragma once

#include "renderer/lanes/lane.h"

namespace photonproof::inline renderer_bsdfs {

/// Transported quantity of a path: radiance (camera paths) or importance (photons). Refraction scales radiance by the
/// squared ratio of indices, flux not at all (Veach 1997, section 5.2).
enum class TransportMode { radiance, importance };

template <class F>
struct BsdfSample {
  Vec3<F> wi_local;
  Vec3<F> weight;  ///< Value of f cos / pdf.
  F pdf;           ///< Density per solid angle; the lobe's probability for a delta sample.
  F eta;           ///< Ior of the side entered / ior of the side left; 1 unless refracted.
  Mask<F> delta;   ///< True for a direction from a Dirac lobe, which eval and pdf leave out.
  Mask<F> valid;   ///< False where the path is absorbed; the other members are then undefined.
};

}  // namespace photonproof::inline renderer_bsdfs
