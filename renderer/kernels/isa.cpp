#include "renderer/kernels/isa.h"

#include "scenes/text/input_error.h"

namespace photonproof {

extern const Kernels kernels_scalar;
#if defined(__x86_64__)
extern const Kernels kernels_v2, kernels_v3, kernels_v4;
#else
extern const Kernels kernels_native;
#endif

#if defined(__x86_64__)
namespace {

/// What x86-64-v3 and v4 have beyond v2 and v3, as far as compilers let one ask; the rest came with these.
bool processor_has_v3() {
  return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0 &&
         __builtin_cpu_supports("bmi") != 0 && __builtin_cpu_supports("bmi2") != 0;
}
bool processor_has_v4() {
  return processor_has_v3() && __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
         __builtin_cpu_supports("avx512cd") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
         __builtin_cpu_supports("avx512vl") != 0;
}

}  // namespace
#endif

const std::vector<const Kernels*>& available_kernels() {
  static const std::vector<const Kernels*> available = [] {
    std::vector<const Kernels*> list;
#if defined(__x86_64__)
    __builtin_cpu_init();
    if (processor_has_v4()) list.push_back(&kernels_v4);
    if (processor_has_v3()) list.push_back(&kernels_v3);
    list.push_back(&kernels_v2);
#else
    list.push_back(&kernels_native);
#endif
    list.push_back(&kernels_scalar);
    return list;
  }();
  return available;
}

const Kernels& kernels_for(const std::string& isa) {
  if (isa.empty()) return *available_kernels().front();
  std::string names;
  for (const Kernels* kernels : available_kernels()) {
    if (isa == kernels->isa) return *kernels;
    names += (names.empty() ? "" : ", ") + std::string(kernels->isa);
  }
  throw InputError("--isa", "this processor has no '" + isa + "', it has: " + names);
}

}  // namespace photonproof
