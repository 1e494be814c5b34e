#include "renderer/kernels/isa.h"

#include "scenes/base/input_error.h"
#include "scenes/base/processor.h"

namespace photonproof::inline renderer_kernels {

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
#if !defined(PHOTONPROOF_NO_V4)
PHOTONPROOF_ENTRIES(kernels_v4)
#endif
#else
PHOTONPROOF_ENTRIES(kernels_native)
#endif
#undef PHOTONPROOF_ENTRIES

namespace {

std::vector<Kernels> kernels_of_this_processor() {
  std::vector<Kernels> list;
#if defined(__x86_64__)
#if !defined(PHOTONPROOF_NO_V4)
  if (x86_64_level() >= 4) list.push_back({"v4", kernels_v4::path, kernels_v4::photon, kernels_v4::gather});
#endif
  if (x86_64_level() >= 3) list.push_back({"v3", kernels_v3::path, kernels_v3::photon, kernels_v3::gather});
  list.push_back({"v2", kernels_v2::path, kernels_v2::photon, kernels_v2::gather});
#else
  list.push_back({"native", kernels_native::path, kernels_native::photon, kernels_native::gather});
#endif
  list.push_back({"scalar", kernels_scalar::path, kernels_scalar::photon, kernels_scalar::gather});
  return list;
}

}  // namespace

const std::vector<Kernels>& available_kernels() {
  static const std::vector<Kernels> kernels = kernels_of_this_processor();
  return kernels;
}

const Kernels& kernels_for(const std::string& isa) {
  if (isa.empty()) return available_kernels().front();
  std::string names;
  for (const Kernels& kernels : available_kernels()) {
    if (isa == kernels.isa) return kernels;
    names += (names.empty() ? "" : ", ") + std::string(kernels.isa);
  }
  throw InputError("--isa", "this processor has no '" + isa + "', it has: " + names);
}

}  // namespace photonproof::inline renderer_kernels
