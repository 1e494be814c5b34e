#include "renderer/kernels/isa.h"

#include "scenes/text/input_error.h"
#include "scenes/text/processor.h"

namespace photonproof {

extern const Kernels kernels_scalar;
#if defined(__x86_64__)
extern const Kernels kernels_v2, kernels_v3, kernels_v4;
#else
extern const Kernels kernels_native;
#endif

const std::vector<const Kernels*>& available_kernels() {
  static const std::vector<const Kernels*> available = [] {
    std::vector<const Kernels*> list;
#if defined(__x86_64__)
    if (x86_64_level() >= 4) list.push_back(&kernels_v4);
    if (x86_64_level() >= 3) list.push_back(&kernels_v3);
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
