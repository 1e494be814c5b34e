// Half floats for references that are committed: half the bytes, no bias, and a variance that knows of it.
//
// A half float has 11 significant bits, so the two next to a value are at most 2^-10 of it apart. Rounding to the
// nearer one would move all pixels of an even surface the same way, which a test of block means takes for a bias. Each
// value therefore goes to one of its two neighbours a < x < b at random, to b with probability (x - a)/(b - a): the
// expectation is x, pixels are independent, and the variance is (x - a)(b - x), at most (2^-11 x)^2.
//
// Variances stay floats, since that of a dark pixel is below the smallest half, but keep 11 significant bits only, so
// that the rest compresses to nothing.
#pragma once

#include "scenes/images/image.h"

namespace photonproof::inline reference_store {

inline constexpr float largest_half = 65504;
/// The largest variance that rounding a mean so can have: (2^-11 x)^2.
double most_rounding_variance(double x);

/// |x| must not be larger than the largest half.
float half_below(float x);  ///< the largest half float that is not above x
float half_above(float x);  ///< the smallest that is not below it

/// The mean in half floats, the variance with what that adds. The draws are a function of the position in the image.
/// Preconditions: there is a variance; values are finite, and means no half float can hold are not there.
Rendering rounded_to_halves(const Rendering& rendering);

/// Of such a mean: no pixel's variance less than rounding can have at most. One that is rounded up once in a thousand
/// says that it is certain, and is off by 2^-10 where it was.
void widen_to_half_rounding(Rendering& rounded);

}  // namespace photonproof::inline reference_store
