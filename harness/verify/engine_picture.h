// One engine's picture of a scene with its known errors: noise as a variance of every pixel, and the error that a
// biased engine declares.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_verify {

/// Known relative errors that are no defect: of the mean over the whole image, and of a block of 8 x 8 pixels. A
/// block's error is relative to its mean, or to the channel's mean if the block is darker.
struct DeclaredError {
  double whole = 0, block = 0;
  std::string reason;
  bool is_exact() const { return whole == 0 && block == 0; }
};

struct EnginePicture {
  std::string engine;
  Rendering rendering;  ///< always has a variance; 0 if an engine makes one estimate without noise
  /// The pictures that were averaged, if only their differences show the noise. Empty if the variance is known, or if
  /// the engine makes only one picture.
  std::vector<Image> images{};
  DeclaredError declared;
  std::uint64_t samples = 0;             ///< per pixel, if its budget counts them
  double seconds = 0;                    ///< wall time of its processes
  std::vector<std::string> losses;       ///< known errors, in the engine's words
  std::vector<std::string> cannot_find;  ///< the losses that are light which no number of its samples finds
};

}  // namespace photonproof::inline harness_verify
