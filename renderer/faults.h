// Faults that can be planted in the renderer, to show that gates find them (`photonproof gate --self-test`). Only the
// program photonproof-faulty has them; elsewhere has_fault is false when it is compiled, and nothing is left of it.
#pragma once

namespace photonproof {

enum class Fault {
  dropped_cosine,   ///< direct light is not multiplied by the cosine at the surface
  missing_caustic,  ///< light that comes by mirrors or glass is lost after a diffuse surface
  half_photons,     ///< half the photons that were asked for are traced
};

#ifdef PHOTONPROOF_FAULTS
inline constexpr bool can_have_faults = true;
/// The one that the environment variable PHOTONPROOF_FAULT names: "dropped-cosine", "missing-caustic", "half-photons".
bool has_fault(Fault fault);
#else
inline constexpr bool can_have_faults = false;
constexpr bool has_fault(Fault) { return false; }
#endif

}  // namespace photonproof
