// A stored reference that differs from every engine: is it old, or damaged?
#pragma once

#include <string>

#include "harness/verify/engine_picture.h"

namespace photonproof::inline harness_verify {

struct ReferenceState {
  bool is_stale = false;  ///< another scene's or renderer's light, else its pixels are not what its variance says
  std::string sentence;
};

/// Stale is a reference that is off to one side while its noise is what its variance says: pixels differ within a block
/// of 8 x 8 as much as both variances allow once the block's own factor is taken out. Precondition: it differs from
/// `right`, which engines agree on.
ReferenceState state_of_reference(const EnginePicture& reference, const EnginePicture& right);

}  // namespace photonproof::inline harness_verify
