// Instruction sets of this processor; no other code queries them. Code compiled for several sets runs the best one
// (renderer/kernels/isa.cpp, harness/pixels/pixel_loops_isa.cpp).
#pragma once

namespace photonproof::inline scenes_base {

/// 4, 3 or 2, for x86-64-v4, v3 or v2; everything is compiled for v2. 0 on other processors.
inline int x86_64_level() {
#if !defined(__x86_64__)
  return 0;
#else
  __builtin_cpu_init();
#if defined(__clang__)  // has features, not levels (it builds the fuzzers)
  const bool v3 = __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
                  __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
  const bool v4 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                  __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
                  __builtin_cpu_supports("avx512vl") != 0;
#else
  const bool v3 = __builtin_cpu_supports("x86-64-v3") != 0, v4 = __builtin_cpu_supports("x86-64-v4") != 0;
#endif
  return v3 && v4 ? 4 : v3 ? 3 : 2;
#endif
}

}  // namespace photonproof::inline scenes_base
