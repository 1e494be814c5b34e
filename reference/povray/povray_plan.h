// POV-Ray passes that a scene needs, their depth, and the light they lose. The plan follows from the scene alone, so it
// can be read and tested without running anything.
#pragma once

#include <string>
#include <vector>

#include "reference/povray/povray_options.h"
#include "reference/povray/povray_scene.h"

namespace photonproof::inline reference_povray {

struct PovPlan {
  PovrayPreset preset{};
  double scale = 1;          ///< POV-Ray's lengths are the scene's times this (a power of two).
  double exposure = 1;       ///< POV-Ray's radiances are the scene's times this (a power of two).
  bool point_lights = true;  ///< False when max_depth ends paths before they reach a light by way of a surface.
  bool radiosity = false;
  int recursion_limit = 0;  ///< bounces radiosity adds
  /// POV-Ray assumes that a bounce halves a ray's weight times `brightness`, and widens its error bound for light rays.
  /// With 2 they keep their weight. Surfaces get diffuse 1/2 and lights twice the brightness, so nothing else changes.
  double brightness = 1;
  bool paths = false;  ///< radiosity without its cache
  bool photons = false;
  std::string stem;                  ///< Prefix of the images' names.
  bool shows_lights = true;          ///< Whether lights are visible; false where another image adds them.
  bool shows_sky = true;             ///< False where the image is added to one that has the sky.
  std::vector<std::string> skipped;  ///< Passes left out, with the reason.
  std::vector<std::string> losses;   ///< Light that the image lacks, with its size.
};

/// Throws Unrepresentable when POV-Ray cannot cut paths at max_depth.
PovPlan make_plan(const PovScene& scene, const PovrayOptions& options);

/// Whether light can go from the front of one surface to the front of another, or of the same, in a straight line.
/// Never false when it can.
bool may_see(const PovSurface& from, const PovSurface& to);

}  // namespace photonproof::inline reference_povray
