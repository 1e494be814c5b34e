// Faults that can be planted in the renderer and in the harness to show that gates find them (`photonproof gate
// --self-test`). Each is one condition where such a mistake would be made. Only the program photonproof-faulty has
// them; elsewhere has_fault is a compile-time false and leaves no code.
#pragma once

#include <optional>
#include <string>

namespace photonproof::inline scenes_base {

enum class Fault {
  // The renderer's.
  dropped_cosine,     ///< Direct light is not multiplied by the cosine at the surface.
  missing_caustic,    ///< Light by way of mirrors or glass is lost after a diffuse surface.
  half_photons,       ///< Half the requested photons are traced.
  uniform_diffuse,    ///< A diffuse surface scatters evenly over the hemisphere, with a cosine's density and weight.
  part_of_light,      ///< Points are sampled on nine tenths of a rectangular light, with the density of all of it.
  unweighted_hits,    ///< Lights that are hit count in full, though sampled lights are weighted against hits.
  unpaid_roulette,    ///< Survivors of roulette do not carry the light of the paths that end.
  dim_caustic,        ///< Caustic photons carry 5 % too little.
  density_radius,     ///< Photons are divided by the area of a radius 10 % larger than the gather radius.
  same_photons,       ///< Photons ignore the seed.
  same_samples,       ///< Samples of paths from the camera ignore the seed.
  wide_filter,        ///< Samples spread 20 % wider than the reconstruction filter.
  flipped_v,          ///< Bitmaps are read upside down.
  raw_srgb,           ///< Bitmaps' values are taken as linear.
  thin_medium,        ///< Media have 10 % too little extinction.
  backward_phase,     ///< The phase function's g has the wrong sign.
  fov_axis,           ///< The field of view is across the height, for every fov_axis of the scene.
  spot_angle,         ///< A spot's half-angles are taken as whole angles.
  turned_sky,         ///< An environment is turned the other way.
  swapped_ior,        ///< Glass has the index of its outside, and the outside that of glass.
  single_reflection,  ///< A pane reflects only at its front.
  flat_normals,       ///< Normals of meshes are not interpolated.
  // The harness's.
  repeated_seed,   ///< All images of an engine use one seed.
  upside_down,     ///< Engines' images are read upside down.
  quarter_budget,  ///< Engines get a quarter of the budget.
  red_for_all,     ///< Red stands for engines' green and blue.
  certain_noise,   ///< The noise of a block's mean is divided by the number of images twice.
};

#ifdef PHOTONPROOF_FAULTS

inline constexpr bool can_have_faults = true;
inline namespace faulty {  // other symbols than those of sources without faults, which are in the same program

/// The fault that the environment variable PHOTONPROOF_FAULT names ("dropped-cosine"), or a PlantedFault.
bool has_fault(Fault fault);
/// The planted fault's name; empty without one.
std::string planted_fault();

/// While it lives this process has only this fault. Threads that read has_fault start later and end before.
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
