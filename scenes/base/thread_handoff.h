// Tells the thread sanitizer what libraries order that are not built with it (oneTBB, Embree): without it, each loop of
// theirs would look like a race between who begins it and who works in it. In other builds none of this is anything.
#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#include <sanitizer/tsan_interface.h>
#define PHOTONPROOF_THREADS_WATCHED
#endif
#endif

/// After the parameters of a lambda that such a library calls: its captures, of the thread that made it, are read
/// before it can say `takes_over`.
#ifdef PHOTONPROOF_THREADS_WATCHED
#define PHOTONPROOF_CALLED_BY_LIBRARY __attribute__((no_sanitize("thread")))
#else
#define PHOTONPROOF_CALLED_BY_LIBRARY
#endif

namespace photonproof::inline scenes_base {

/// What this thread has done comes before what another does after `takes_over` of the same address, which is a name
/// only.
inline void hands_over([[maybe_unused]] const void* name) {
#ifdef PHOTONPROOF_THREADS_WATCHED
  __tsan_release(const_cast<void*>(name));
#endif
}

inline void takes_over([[maybe_unused]] const void* name) {
#ifdef PHOTONPROOF_THREADS_WATCHED
  __tsan_acquire(const_cast<void*>(name));
#endif
}

}  // namespace photonproof::inline scenes_base
