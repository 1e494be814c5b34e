// Images that prove nothing: the reference itself, and the same image for several seeds. Statistics take independent
// noise for granted; a copy has none, and looks more certain than any rendering.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// The pixels, for a comparison bit for bit; they live as long as the image.
std::string_view bytes_of(const Image& image);

/// Whether the reference says of any value that noise had a part in it: more than rounding to half floats, which adds
/// (2^-11 value)^2 at most. Without, equal images are what any right engine gives.
bool has_noise(const Rendering& reference);

/// Whether the image is the reference's mean, bit for bit, where chance does not explain that. A right engine that
/// writes half floats may hit a half float exactly; how often it would miss one is known: a reference value with
/// standard error s is another of the half floats, u apart, with probability s^2/u^2 at least (of a value that lies
/// s^2/u^2 of the way between two of them and is rounded at random), up to one half. That sum over values, the
/// expected number of misses, must be 30: of ten independent pixels with three equal channels all are hit with
/// probability e^-10. Precondition: equal sizes and a variance.
bool is_copy(const Rendering& reference, const Image& image);

struct Repeats {
  std::size_t images = 0;
  std::size_t different = 0;  ///< of them
  /// The fewest values in which two different ones of them that follow each other differ; where they are few, equal
  /// images may be chance. 0 when all are the same.
  std::size_t least_difference = 0;
};
/// Images are compared bit for bit.
Repeats count_repeats(std::span<const Image* const> images);

}  // namespace photonproof::inline harness_pixels
