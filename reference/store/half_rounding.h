// Half floats for committed references: half the bytes, no bias, and a variance that includes the rounding.
//
// A half float has 11 significant bits, so the two next to a value are at most 2^-10 of it apart. Rounding to the
// nearer one would move all pixels of an even surface the same way, and a test of block means would find a bias. So
// each value goes to one of its two neighbours a < x < b at random, to b with probability (x - a)/(b - a). The
// expectation is x, pixels are independent, and the variance is (x - a)(b - x), at most (2^-11 x)^2.
//
// Variances stay floats, since that of a dark pixel is below the smallest half. They keep only 11 significant bits, so
// that the zero bits compress away.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::inline reference_store {

inline constexpr float largest_half = 65504;
/// The largest variance that such rounding of a mean can have: (2^-11 x)^2.
double most_rounding_variance(double x);

/// |x| must not be larger than the largest half.
float half_below(float x);  ///< the largest half float that is not above x
float half_above(float x);  ///< the smallest that is not below it

/// The mean in half floats, the variance with the rounding's variance added. The random numbers are a function of the
/// position in the image. Preconditions: there is a variance, values are finite, half floats can hold all means.
Rendering rounded_to_halves(const Rendering& rendering);

/// Raises each pixel's variance to at least the largest that rounding can have. A value that rounds up once in a
/// thousand times has almost no computed variance, and is off by 2^-10 where it rounded up.
void widen_to_half_rounding(Rendering& rounded);

}  // namespace photonproof::inline reference_store
