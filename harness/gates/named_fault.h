// Names a failing gate's fault from its images alone, without the scene: turned, shifted, channels exchanged, encoded
// twice, darker by a factor, or light that is missing.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "scenes/images/image.h"

namespace photonproof::inline harness_gates {

struct SeenFault {
  std::string sentence;  ///< "the image is mirrored left to right"
  bool is_gain = false;  ///< a factor of the whole image, which some gates state themselves
};

/// Each change of the reference is tried; one that leaves less than 15 % of the squared difference beyond noise is the
/// fault. Where none does, and blocks are only darker, light is missing. `is_display_file`: the engine writes files of
/// encoded values, such as PNG. Preconditions: equal sizes, at least one image, a reference with variance.
std::optional<SeenFault> named_fault(const Rendering& reference, std::span<const Image* const> images,
                                     bool is_display_file);

}  // namespace photonproof::inline harness_gates
