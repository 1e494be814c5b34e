// Which of POV-Ray's passes a scene needs, how deep they go, and what is lost by them: decided from the scene alone, so
// that it can be read and tested without running anything.
#pragma once

#include <string>
#include <vector>

#include "reference/povray/povray_options.h"
#include "reference/povray/povray_scene.h"

namespace photonproof::inline reference_povray {

struct PovPlan {
  PovrayPreset preset{};
  double scale = 1;          ///< POV-Ray's lengths are the scene's times this (a power of two)
  double exposure = 1;       ///< POV-Ray's radiances are the scene's times this (a power of two)
  bool point_lights = true;  ///< false when max_depth ends paths before they reach a light by way of a surface
  bool radiosity = false;
  int recursion_limit = 0;  ///< bounces radiosity adds
  /// POV-Ray takes a bounce to halve a ray's weight times `brightness`, and widens its error bound for light rays. With
  /// 2 they keep their weight; as surfaces are made diffuse 1/2 and lights twice as bright, nothing else changes.
  double brightness = 1;
  bool paths = false;  ///< radiosity without its cache
  bool photons = false;
  std::string stem;                  ///< of the images' names
  bool shows_lights = true;          ///< lights are seen; false where that is added from elsewhere
  bool shows_sky = true;             ///< false where what is rendered is added to a picture that has it
  std::vector<std::string> skipped;  ///< passes left out, with the reason
  std::vector<std::string> losses;   ///< what the image lacks, with its size
};

/// Throws Unrepresentable when max_depth asks for something POV-Ray cannot cut at.
PovPlan make_plan(const PovScene& scene, const PovrayOptions& options);

/// Whether light can go from the front of one surface to the front of another, or of the same, in a straight line.
/// Never false when it can.
bool may_see(const PovSurface& from, const PovSurface& to);

}  // namespace photonproof::inline reference_povray
