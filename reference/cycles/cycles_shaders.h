// Surfaces and media as Cycles' shaders: expressions of the Graph of blender_shaders.py.
#pragma once

#include <optional>
#include <string>

#include "reference/cycles/cycles_script.h"

namespace photonproof::inline reference_cycles {

/// Expression of a colour, or of a texture evaluated at the hit point.
std::string colour_py(CyclesScript& script, const Colour& colour);

/// "lambda g: ..." expression of a medium.
std::string medium_py(const CyclesScript& script, MediumIndex index);

/// A shape's material.
struct CyclesMaterial {
  BsdfIndex bsdf;
  std::optional<Colour> radiance;
  std::optional<MediumIndex> interior;
  bool leaning = false;  ///< shading normals differ from the surface's own
  bool sampled = true;   ///< the light is sampled directly, not only hit by chance; both are unbiased
  friend bool operator==(const CyclesMaterial&, const CyclesMaterial&) = default;
};

/// "material(...)" of the name. Throws NotRepresentable for every model that Blender 3.4 has no equivalent of.
std::string material_py(CyclesScript& script, const std::string& name, const CyclesMaterial& material);

/// Whether there is no surface, at most a boundary of a medium.
bool is_nothing(const SceneDescription& scene, BsdfIndex index);

/// Properties of a BSDF and its nested BSDFs.
struct CyclesTraits {
  bool pane = false;    ///< A thin dielectric; Cycles does not count its straight light as part of a path.
  bool clear = false;   ///< Mirrors or refracts in one direction only.
  bool chance = false;  ///< Cycles samples a direction and cannot sample lights.
  bool wide = false;    ///< Scatters into many directions.
};
CyclesTraits traits_of(const SceneDescription& scene, BsdfIndex index);

}  // namespace photonproof::inline reference_cycles
