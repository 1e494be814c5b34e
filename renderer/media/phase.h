// Phase functions: the distribution of directions after a scattering in a medium. Let cos be between the directions of
// travel before and after.
#pragma once

#include <variant>

#include "scenes/base/vec.h"

namespace photonproof::inline renderer_media {

/// Henyey and Greenstein (1941), isotropic at g = 0: p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)).
struct HenyeyGreenstein {
  float g = 0;  ///< mean cosine; > 0 scatters forward

  /// Per solid angle; also the density of `sample`.
  float eval(const Vec3f& travel, const Vec3f& wi) const;
  Vec3f sample(const Vec3f& travel, const Vec2<float>& u) const;
};

/// Rayleigh (1871): p = 3 (1 + cos^2) / (16 pi).
struct Rayleigh {
  /// Per solid angle; also the density of `sample`.
  float eval(const Vec3f& travel, const Vec3f& wi) const;
  Vec3f sample(const Vec3f& travel, const Vec2<float>& u) const;
};

/// A mixture of two.
struct PhaseFunction {
  using Lobe = std::variant<HenyeyGreenstein, Rayleigh>;
  Lobe first, second;
  float weight = 0;  ///< share of the second

  /// Per solid angle; also the density of `sample`.
  float eval(const Vec3f& travel, const Vec3f& wi) const;
  Vec3f sample(const Vec3f& travel, const Vec2<float>& u) const;
};

}  // namespace photonproof::inline renderer_media
