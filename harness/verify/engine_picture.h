// What one engine makes of a scene, with what is known of its error: noise as a variance of every pixel, and what a
// biased engine declares to be off besides.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_verify {

/// Relative errors that are known and no defect: of the mean over the whole image, and of a block of 8 x 8 pixels
/// (relative to its mean, or to the channel's where it is darker).
struct DeclaredError {
  double whole = 0, block = 0;
  std::string reason;
  bool is_exact() const { return whole == 0 && block == 0; }
};

struct EnginePicture {
  std::string engine;
  Rendering rendering;  ///< the variance is always there; 0 of an engine that makes one estimate without noise
  /// The pictures whose mean it is, where only their differences show its noise. Empty: the variance is known, or one
  /// picture is all that the engine makes.
  std::vector<Image> images{};
  DeclaredError declared;
  std::uint64_t samples = 0;             ///< a pixel, where its budget counts them
  double seconds = 0;                    ///< wall time of its processes
  std::vector<std::string> losses;       ///< known errors, in the engine's words
  std::vector<std::string> cannot_find;  ///< those of them that are light which no number of its samples finds
};

}  // namespace photonproof::inline harness_verify
