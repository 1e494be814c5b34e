// Marks orderings for the thread sanitizer that uninstrumented libraries establish (oneTBB, Embree). Without these
// marks each of their loops looks like a race between its starter and its workers. Other builds compile this to
// nothing.
#pragma once

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#include <sanitizer/tsan_interface.h>
#define PHOTONPROOF_THREADS_WATCHED
#endif
#endif

/// Stands after the parameters of a lambda that such a library calls. The lambda reads its captures, written by the
/// thread that made it, before it can call `takes_over`.
#ifdef PHOTONPROOF_THREADS_WATCHED
#define PHOTONPROOF_CALLED_BY_LIBRARY __attribute__((no_sanitize("thread")))
#else
#define PHOTONPROOF_CALLED_BY_LIBRARY
#endif

namespace photonproof::inline scenes_base {

/// This thread's work so far comes before another's work after `takes_over` of the same address, which is only a name.
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
