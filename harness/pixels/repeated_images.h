// Images that prove nothing: the reference itself, and the same image for several seeds. Statistics assume independent
// noise. A copy has none and looks more certain than any rendering.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "scenes/images/image.h"

namespace photonproof::inline harness_pixels {

/// The pixels, for a comparison bit for bit; they live as long as the image.
std::string_view bytes_of(const Image& image);

/// Whether any reference value has noise beyond rounding to half floats, which adds (2^-11 value)^2 at most. Without
/// noise every right engine gives equal images.
bool has_noise(const Rendering& reference);

/// Whether the image is the reference's mean, bit for bit, and not by chance. A right engine that writes half floats
/// may hit a half float exactly. Where the reference value has standard error s and half floats are u apart, it misses
/// with probability s^2/u^2 at least, up to one half. That bound is for a value s^2/u^2 of the way between two half
/// floats, rounded at random. The expected number of misses, the sum over values, must be 30. Then ten independent
/// pixels with three equal channels all hit with probability e^-10. Precondition: equal sizes and a variance.
bool is_copy(const Rendering& reference, const Image& image);

struct Repeats {
  std::size_t images = 0;
  std::size_t different = 0;  ///< of them
  /// The least number of values in which two successive different images differ; if it is small, equal images may be
  /// chance. 0 when all are the same.
  std::size_t least_difference = 0;
};
/// Images are compared bit for bit.
Repeats count_repeats(std::span<const Image* const> images);

}  // namespace photonproof::inline harness_pixels
