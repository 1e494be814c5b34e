// What one chooses about a POV-Ray rendering, and what the three quality presets mean.
#pragma once

#include <cstdint>

namespace photonproof {

struct PovrayOptions {
  int width = 0;           ///< pixels; 0: the scene's film
  int height = 0;          ///< pixels; 0: the scene's film
  int grid = 0;            ///< k: the mean of k x k sub-pixel centres; 0: the preset's
  int quality = 1;         ///< 1 seconds, 2 tens of seconds, 3 for comparisons that claim agreement
  std::uint64_t seed = 1;  ///< of the places of light samples; POV-Ray's own sample directions are fixed
};

/// Settings of POV-Ray's radiosity (an irradiance cache) and photons, and how lights become points.
struct PovrayPreset {
  int grid;
  int rectangle_spots;   ///< N: a rectangular light becomes N x N spots
  int sphere_spots;      ///< a spherical light becomes this many spots
  int photon_spots;      ///< N in scenes with photons, whose cost grows with the spots
  int radiosity_count;   ///< rays a cache sample
  int nearest_count;     ///< cache samples interpolated
  double error_bound;    ///< how far a cache sample is reused
  double maximum_reuse;  ///< the same in space: at most this fraction of the distance to the camera, times error_bound
  double pretrace_end;   ///< of the image's width: the finest pass that fills the cache in advance
  double truncation;     ///< bounces are added until at most this fraction of the light can be missing
  std::int64_t photons;  ///< aimed at specular objects
  double photon_radius;  ///< of the gather disc, as a fraction of the radius of the scene's bounding sphere
};

/// Throws InputError unless `quality` is 1, 2 or 3.
PovrayPreset povray_preset(int quality);

}  // namespace photonproof
