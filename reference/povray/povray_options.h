// What one chooses about a POV-Ray rendering, and what the three quality presets mean.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace photonproof::inline reference_povray {

struct PovrayOptions {
  int width = 0;    ///< pixels; 0: the scene's film
  int height = 0;   ///< pixels; 0: the scene's film
  int margin = 0;   ///< pixels around the picture that are rendered, too
  int grid = 0;     ///< k: each pixel is the mean of k x k sub-pixel centres; 0: POV-Ray refines where it sees an edge
  int quality = 1;  ///< 1 seconds, 2 tens of seconds, 3 for comparisons that claim agreement, 4 paths without a cache
  bool lights_apart = false;  ///< what is seen of lights that are thin in the picture is rendered besides, and added
  std::uint64_t seed =
      1;  ///< of the places of light samples and of where paths end; POV-Ray's own sample directions are fixed
  std::string stem = "scene";  ///< starts the names of images that the text reads from its folder
};

/// How lights become points: a rectangle n x n of them, a sphere `sphere` of them; a sky n x n directions, the sun's
/// disc, too.
struct PovrayLightPoints {
  int rectangle;
  int sphere;
  int sky = 8;
  int sun = 2;
  bool fewer = false;  ///< of many area lights every few are one
};

/// Radiosity without its cache follows paths: noise in place of bias (povray_paths.h).
struct PovrayPaths {
  int count;          ///< rays from what is seen; half as many from what they meet, and so on down to five
  double importance;  ///< share of a point's rays that go on
  int directions;     ///< in the sequence that rays take theirs from
  int grid;           ///< k: k x k sub-pixels, each with rays of its own
  int photon_grid;    ///< the same in scenes with photons, which every ray's end gathers
};

/// Settings of POV-Ray's radiosity (an irradiance cache) and photons, and how lights become points.
struct PovrayPreset {
  PovrayLightPoints image_points;      ///< for what the camera sees
  PovrayLightPoints photon_points;     ///< the same in scenes with photons, which each point shoots
  PovrayLightPoints radiosity_points;  ///< for what radiosity's rays see: many rays are averaged, so few points do
  int radiosity_count;                 ///< rays a cache sample
  int nearest_count;                   ///< cache samples interpolated
  double error_bound;                  ///< how far a cache sample is reused, relative to the distance of other surfaces
  double low_error_factor = 0.8;       ///< of the error bound while the cache is filled in advance
  double maximum_reuse;      ///< caps that distance, as a fraction of the radius of the scene's bounding sphere
  double pretrace_end;       ///< of the image's width: spacing of the finest pass that fills the cache in advance
  double truncation;         ///< bounces are added until about this fraction of the light is missing
  std::int64_t photons;      ///< aimed at specular objects
  double photon_radius;      ///< of the gather disc, as a fraction of the radius of the scene's bounding sphere
  double radiosity_bailout;  ///< weight below which glass and mirrors end what a ray of radiosity's meets
  std::optional<PovrayPaths> paths{};  ///< in place of the cache
};

/// Throws InputError unless `quality` is 1, 2, 3 or 4.
PovrayPreset povray_preset(int quality);

}  // namespace photonproof::inline reference_povray
