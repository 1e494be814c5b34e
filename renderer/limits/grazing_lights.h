// Lights that graze the surfaces they light: from just above a surface, or along a face. The cosine there is a small
// difference of numbers that single precision rounds; its relative error is that of the light.
#pragma once

#include <cstddef>
#include <vector>

#include "renderer/scene/scene_parts.h"

namespace photonproof::inline renderer_limits {

/// A grazing light at the place where its cosine is least exact.
struct GrazingLight {
  std::size_t light = 0;       ///< Index into SceneParts::lights.
  bool from_one_side = false;  ///< A beam, or a light so far away that it is one.
  /// Height of a light above the surface, in the description's lengths; the sine of a beam's angle.
  double height = 0;
  double rounding = 0;  ///< Error of that, either way, by single precision.
  double loss() const { return rounding > 0 ? rounding / height : 0; }
};

/// Lights whose irradiance on some surface has a relative error above a thousandth. Small lights count if they are near
/// a surface that is not only a mirror. Beams count by their angle to half of all flat faces or more; instances of many
/// triangles are left out.
std::vector<GrazingLight> grazing_lights(const SceneParts& scene);

}  // namespace photonproof::inline renderer_limits
