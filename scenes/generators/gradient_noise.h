// Gradient noise (Perlin 2002, "Improving noise") and sums of it over octaves: the shapes of procedural scenes. It uses
// only additions, multiplications and exact roundings of doubles, so the same point has the same bits on every machine.
#pragma once

#include <cstdint>

#include "scenes/base/vec.h"

namespace photonproof::inline scenes_generators {

/// 32 well-mixed bits of four integers.
std::uint32_t hash_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

/// A multiple of 2^-32 in [0,1).
double unit_hash(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);

/// Smooth, about -1 to 1, 0 at whole coordinates; one feature per unit length.
double gradient_noise(const Vec3d& p, std::uint32_t seed);

/// Fractal sum: each octave has twice the frequency and half the amplitude of the one before, the first amplitude 1.
double fractal_noise(const Vec3d& p, int octaves, std::uint32_t seed);

/// The same sum of squared ridges, (1 - |noise|)^2, each weighted by the one before: from 0 to 2, sharp along crests
/// (Musgrave 1994).
double ridged_noise(const Vec3d& p, int octaves, std::uint32_t seed);

}  // namespace photonproof::inline scenes_generators
