#include "renderer/kernels/isa.h"

#include "scenes/text/input_error.h"

namespace photonproof {

#define PHOTONPROOF_ENTRIES(name)        \
  namespace name {                       \
  extern const PathKernelEntry path;     \
  extern const PhotonKernelEntry photon; \
  extern const GatherKernelEntry gather; \
  }
PHOTONPROOF_ENTRIES(kernels_scalar)
#if defined(__x86_64__)
PHOTONPROOF_ENTRIES(kernels_v2)
PHOTONPROOF_ENTRIES(kernels_v3)
PHOTONPROOF_ENTRIES(kernels_v4)
#else
PHOTONPROOF_ENTRIES(kernels_native)
#endif
#undef PHOTONPROOF_ENTRIES

namespace {

#if defined(__x86_64__)

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

#endif

std::vector<Kernels> kernels_of_this_processor() {
  std::vector<Kernels> list;
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (processor_has_v4()) list.push_back({"v4", kernels_v4::path, kernels_v4::photon, kernels_v4::gather});
  if (processor_has_v3()) list.push_back({"v3", kernels_v3::path, kernels_v3::photon, kernels_v3::gather});
  list.push_back({"v2", kernels_v2::path, kernels_v2::photon, kernels_v2::gather});
#else
  list.push_back({"native", kernels_native::path, kernels_native::photon, kernels_native::gather});
#endif
  list.push_back({"scalar", kernels_scalar::path, kernels_scalar::photon, kernels_scalar::gather});
  return list;
}

}  // namespace

const std::vector<const Kernels*>& available_kernels() {
  static const std::vector<Kernels> kernels = kernels_of_this_processor();
  static const std::vector<const Kernels*> available = [] {
    std::vector<const Kernels*> list;
    for (const Kernels& of_one_set : kernels) list.push_back(&of_one_set);
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
