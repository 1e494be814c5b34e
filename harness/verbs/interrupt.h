// Ctrl-C as a flag that long work looks at, so that it can keep what it has and say so.
#pragma once

#include <atomic>

namespace photonproof::inline harness_verbs {

/// Becomes true on SIGINT or SIGTERM. The first call installs the handlers; before it, the signals do what they did.
/// A second signal of the same kind ends the program at once.
const std::atomic<bool>& interrupt_flag();

}  // namespace photonproof::inline harness_verbs
