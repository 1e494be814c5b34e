#include "renderer/faults.h"

#include <cstdlib>
#include <string_view>

namespace photonproof {
namespace {

std::string_view planted() {
  const char* name = std::getenv("PHOTONPROOF_FAULT");
  return name == nullptr ? "" : name;
}

}  // namespace

bool has_fault(Fault fault) {
  static const std::string_view name = planted();
  switch (fault) {
    case Fault::dropped_cosine:
      return name == "dropped-cosine";
    case Fault::missing_caustic:
      return name == "missing-caustic";
    case Fault::half_photons:
      return name == "half-photons";
  }
  return false;
}

}  // namespace photonproof
