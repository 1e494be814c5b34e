// Faults that can be planted in the renderer and in the harness, each one condition where such a mistake would be made,
// to show that gates find them (`photonproof gate --self-test`). Only the program photonproof-faulty has them;
// elsewhere has_fault is false when it is compiled, and nothing is left of it.
#pragma once

#include <optional>
#include <string>

namespace photonproof::inline scenes_base {

enum class Fault {
  // Of the renderer.
  dropped_cosine,     ///< direct light is not multiplied by the cosine at the surface
  missing_caustic,    ///< light that comes by mirrors or glass is lost after a diffuse surface
  half_photons,       ///< half the photons that were asked for are traced
  uniform_diffuse,    ///< a diffuse surface scatters evenly over the hemisphere, with a cosine's density and weight
  part_of_light,      ///< points are drawn on nine tenths of a rectangular light, with the density of all of it
  unweighted_hits,    ///< lights that are hit count in full, though sampled lights are weighted against that
  unpaid_roulette,    ///< what survives roulette does not carry the light of what does not
  dim_caustic,        ///< caustic photons carry 5 % too little
  density_radius,     ///< photons are divided by the area of a radius 10 % larger than they are looked for in
  same_photons,       ///< photons do not heed the seed
  same_samples,       ///< samples of paths from the camera do not heed the seed
  wide_filter,        ///< samples spread 20 % wider than the reconstruction filter says
  flipped_v,          ///< bitmaps are read upside down
  raw_srgb,           ///< bitmaps' values are taken for linear ones
  thin_medium,        ///< media take 10 % too little light
  backward_phase,     ///< the phase function's g has the wrong sign
  fov_axis,           ///< the field of view is across the height, whatever the scene says
  spot_angle,         ///< a spot's half-angles are taken for whole ones
  turned_sky,         ///< an environment is turned the other way
  swapped_ior,        ///< glass has the index of its outside, and the outside that of glass
  single_reflection,  ///< a pane reflects as its front alone
  flat_normals,       ///< normals of meshes are not interpolated
  // Of the harness.
  repeated_seed,   ///< all images of an engine are drawn with one seed
  upside_down,     ///< engines' images are read upside down
  quarter_budget,  ///< engines are told a quarter of the budget
  red_for_all,     ///< engines' green and blue are not looked at, red stands for them
  certain_noise,   ///< the noise of a block's mean is divided by the number of images twice
};

#ifdef PHOTONPROOF_FAULTS

inline constexpr bool can_have_faults = true;
inline namespace faulty {  // other symbols than those of sources without faults, which are in the same program

/// The one that the environment variable PHOTONPROOF_FAULT names ("dropped-cosine"), or a PlantedFault.
bool has_fault(Fault fault);
/// Its name; empty without one.
std::string planted_fault();

/// While it lives this process has the fault, and no other. Threads that read has_fault start later and end before.
class PlantedFault {
 public:
  /// Throws std::invalid_argument for an unknown name.
  explicit PlantedFault(const std::string& name);
  ~PlantedFault();
  PlantedFault(const PlantedFault&) = delete;
  PlantedFault& operator=(const PlantedFault&) = delete;

 private:
  std::optional<Fault> before_;
};

}  // namespace faulty

#else

inline constexpr bool can_have_faults = false;
inline namespace sound {

constexpr bool has_fault(Fault) { return false; }
inline std::string planted_fault() { return ""; }

}  // namespace sound

#endif

}  // namespace photonproof::inline scenes_base
