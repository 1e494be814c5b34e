#include "reference/povray_options.h"

#include <string>

#include "scenes/input_error.h"

namespace photonproof {

PovrayPreset povray_preset(int quality) {
  switch (quality) {
    case 1:
      return {.grid = 3,
              .rectangle_spots = 5,
              .sphere_spots = 48,
              .photon_spots = 5,
              .radiosity_count = 96,
              .nearest_count = 6,
              .error_bound = 1,
              .maximum_reuse = 0.015,
              .pretrace_end = 0.02,
              .truncation = 1e-2,
              .photons = 100'000,
              .photon_radius = 0.03};
    case 2:
      return {.grid = 3,
              .rectangle_spots = 6,
              .sphere_spots = 128,
              .photon_spots = 6,
              .radiosity_count = 192,
              .nearest_count = 8,
              .error_bound = 0.7,
              .maximum_reuse = 0.015,
              .pretrace_end = 0.01,
              .truncation = 5e-3,
              .photons = 300'000,
              .photon_radius = 0.02};
    case 3:
      return {.grid = 4,
              .rectangle_spots = 8,
              .sphere_spots = 256,
              .photon_spots = 6,
              .radiosity_count = 384,
              .nearest_count = 10,
              .error_bound = 0.5,
              .maximum_reuse = 0.015,
              .pretrace_end = 0.01,
              .truncation = 1e-3,
              .photons = 1'000'000,
              .photon_radius = 0.015};
    default:
      throw InputError("--quality", std::to_string(quality) + " is not a preset, expected 1, 2 or 3");
  }
}

}  // namespace photonproof
