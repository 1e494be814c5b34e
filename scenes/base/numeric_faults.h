// Faults of numbers that can be planted in the renderer: an epsilon that is a constant, a float where a double was, a
// clamp that is missing, an origin that is not recentred. Ordinary scenes do not show them; each breaks climbs of
// `photonproof stress` (harness/stress/numeric_faults_test.cpp). Planted as those of faults.h are.
#pragma once

#include "scenes/base/faults.h"

namespace photonproof::inline scenes_base {

enum class NumericFault {
  no_recentring,    ///< coordinates keep the file's origin
  no_rescaling,     ///< coordinates keep the file's unit of length
  float_faces,      ///< what is huge is met in single precision as all else
  float_sphere,     ///< rays meet spheres in single precision
  float_cylinder,   ///< rays meet cylinders so
  lost_height,      ///< a cylindrical light's height is the difference of two that keep no digits of it
  far_periods,      ///< textures do not leave out whole periods before they round
  fixed_step,       ///< rays leave surfaces by one length, whatever their coordinates
  unclamped_metal,  ///< indices of metals go to where their fourth powers leave single precision
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
