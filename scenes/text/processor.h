// Which instruction sets this processor has: the one place that asks. What is compiled for several of them takes the
// best by it (renderer/kernels/isa.cpp, harness/pixels/pixel_loops_isa.cpp).
#pragma once

namespace photonproof {

#if defined(__x86_64__)
/// 4, 3 or 2, of x86-64-v4, v3 or v2, which is what everything is compiled for.
inline int x86_64_level() {
  __builtin_cpu_init();
  if (__builtin_cpu_supports("x86-64-v4") != 0) return 4;
  return __builtin_cpu_supports("x86-64-v3") != 0 ? 3 : 2;
}
#endif

}  // namespace photonproof
