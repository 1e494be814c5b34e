// Numerical faults that can be planted in the renderer: a constant epsilon, a float in place of a double, a missing
// clamp, an origin that is not recentred. Ordinary scenes do not show them; each breaks climbs of `photonproof stress`
// (harness/stress/numeric_faults_test.cpp). They are planted as those of faults.h.
#pragma once

#include "scenes/base/faults.h"

namespace photonproof::inline scenes_base {

enum class NumericFault {
  no_recentring,    ///< Coordinates keep the file's origin.
  no_rescaling,     ///< Coordinates keep the file's unit of length.
  float_faces,      ///< Rays meet huge surfaces in single precision like all others.
  float_sphere,     ///< Rays meet spheres in single precision.
  float_cylinder,   ///< Rays meet cylinders in single precision.
  lost_height,      ///< A cylindrical light's height is a difference of two numbers that keep none of its digits.
  far_periods,      ///< Textures do not remove whole periods before they round.
  fixed_step,       ///< Rays leave surfaces by one length, for all coordinates.
  unclamped_metal,  ///< Indices of metals reach values whose fourth powers exceed single precision.
};

#ifdef PHOTONPROOF_FAULTS

inline namespace faulty {
bool has_fault(NumericFault fault);
}  // namespace faulty

#else

inline namespace sound {
constexpr bool has_fault(NumericFault) { return false; }
}  // namespace sound

#endif

}  // namespace photonproof::inline scenes_base
