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
PHOTONPROOF_ENTRIES(kernels_v4)
PHOTONPROOF_ENTRIES(kernels_v3)
PHOTONPROOF_ENTRIES(kernels_v2)
PHOTONPROOF_ENTRIES(kernels_native)
PHOTONPROOF_ENTRIES(kernels_scalar)
#undef PHOTONPROOF_ENTRIES

namespace {

#define PHOTONPROOF_ADD(isa, level) \
  if (x86_64_level() >= level) list.push_back({#isa, kernels_##isa::path, kernels_##isa::photon, kernels_##isa::gather})

/// CMakeLists.txt defines PHOTONPROOF_HAS_x for each instruction set x that PHOTONPROOF_KERNELS chose.
std::vector<Kernels> kernels_of_this_processor() {
  std::vector<Kernels> list;
#ifdef PHOTONPROOF_HAS_v4
  PHOTONPROOF_ADD(v4, 4);
#endif
#ifdef PHOTONPROOF_HAS_v3
  PHOTONPROOF_ADD(v3, 3);
#endif
#ifdef PHOTONPROOF_HAS_v2
  PHOTONPROOF_ADD(v2, 0);
#endif
#ifdef PHOTONPROOF_HAS_native
  PHOTONPROOF_ADD(native, 0);
#endif
#ifdef PHOTONPROOF_HAS_scalar
  PHOTONPROOF_ADD(scalar, 0);
#endif
  if (list.empty())
    throw InputError(
        "this processor",
        "it lacks the instructions that this program was built for; build again with PHOTONPROOF_KERNELS=all");
  return list;
}
#undef PHOTONPROOF_ADD

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
  throw InputError("--isa", "this program and processor have no '" + isa + "', they have: " + names);
}

}  // namespace photonproof::inline renderer_kernels
