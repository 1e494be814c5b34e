// Options of a POV-Ray rendering, and the settings of its four quality presets.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace photonproof::inline reference_povray {

struct PovrayOptions {
  int width = 0;    ///< In pixels. 0: the scene's film.
  int height = 0;   ///< In pixels. 0: the scene's film.
  int margin = 0;   ///< Pixels rendered around the image.
  int grid = 0;     ///< Sub-pixels across a pixel, whose mean it is. Zero: POV-Ray refines where it sees an edge.
  int quality = 1;  ///< Presets: 1 seconds, 2 tens of seconds, 3 for comparisons that claim agreement, 4 paths.
  bool lights_apart = false;  ///< Renders visible lights that are thin in the image separately, and adds them.
  /// Seeds the places of light samples and the ends of paths; POV-Ray's own sample directions are fixed.
  std::uint64_t seed = 1;
  std::string stem = "scene";  ///< Prefix of the images that the text reads from its folder.
};

/// How lights become points: a rectangle n x n of them, a sphere `sphere` of them. A sky becomes n x n directions, as
/// does the sun's disc.
struct PovrayLightPoints {
  int rectangle;
  int sphere;
  int sky = 8;
  int sun = 2;
  bool fewer = false;  ///< one light stands for several where there are many area lights
};

/// Radiosity without its cache follows paths: noise in place of bias (povray_paths.h).
struct PovrayPaths {
  int count;          ///< Rays from a visible point; half as many from the next one, and so on down to five.
  double importance;  ///< Share of a point's rays that continue.
  int directions;     ///< Length of the sequence that rays take their directions from.
  int grid;           ///< Each pixel has grid x grid sub-pixels, each with its own rays.
  int photon_grid;    ///< The same in scenes with photons, which every ray's end gathers.
};

/// Settings of POV-Ray's radiosity (an irradiance cache) and photons, and how lights become points.
struct PovrayPreset {
  PovrayLightPoints image_points;      ///< For surfaces that the camera sees.
  PovrayLightPoints photon_points;     ///< The same in scenes with photons, which each point shoots.
  PovrayLightPoints radiosity_points;  ///< For surfaces that radiosity's rays see: with many rays few points suffice.
  int radiosity_count;                 ///< Rays per cache sample.
  int nearest_count;                   ///< Cache samples interpolated.
  double error_bound;                  ///< Reach of a cache sample, relative to the distance of other surfaces.
  double low_error_factor = 0.8;       ///< Factor of the error bound while the cache is filled in advance.
  double maximum_reuse;      ///< Cap on that distance, as a fraction of the radius of the scene's bounding sphere.
  double pretrace_end;       ///< Spacing of the finest pass that fills the cache in advance, per image width.
  double truncation;         ///< Bounces are added until about this fraction of the light is missing.
  std::int64_t photons;      ///< Number aimed at specular objects.
  double photon_radius;      ///< Radius of the gather disc, as a fraction of the radius of the scene's bounding sphere.
  double radiosity_bailout;  ///< Weight below which glass and mirrors end a ray of radiosity's.
  std::optional<PovrayPaths> paths{};  ///< Used instead of the cache.
};

/// Throws InputError unless `quality` is 1, 2, 3 or 4.
PovrayPreset povray_preset(int quality);

}  // namespace photonproof::inline reference_povray
