// A stored reference that differs from every engine: is it old, or damaged?
#pragma once

#include <string>

#include "harness/verify/engine_picture.h"

namespace photonproof::inline harness_verify {

struct ReferenceState {
  bool is_stale = false;  ///< light of another scene or renderer; else its pixels contradict its variance
  std::string sentence;
};

/// A reference is stale if it is off to one side while its noise matches its variance. Then pixels within a block of 8
/// x 8 differ by as much as both variances allow, after dividing by the block's own factor. Precondition: it differs
/// from `right`, which engines agree on.
ReferenceState state_of_reference(const EnginePicture& reference, const EnginePicture& right);

}  // namespace photonproof::inline harness_verify
