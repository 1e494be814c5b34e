// The phase function of Henyey and Greenstein (1941), isotropic at g = 0.
// Let cos be between the directions of travel before and after: p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)).
#pragma once

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_media {

struct HenyeyGreenstein {
  float g = 0;  ///< mean cosine; > 0 scatters forward

  /// Per solid angle; also the density of `sample`.
  float eval(const Vec3f& travel, const Vec3f& wi) const;
  Vec3f sample(const Vec3f& travel, const Vec2<float>& u) const;
};

}  // namespace photonproof::inline renderer_media
