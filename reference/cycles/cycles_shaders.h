// Surfaces and media as Cycles' shaders: expressions of the Graph of blender_shaders.py.
#pragma once

#include <optional>
#include <string>

#include "reference/cycles/cycles_script.h"

namespace photonproof::inline reference_cycles {

/// Of a colour, or of a texture as it is looked up where the surface is met.
std::string colour_py(CyclesScript& script, const Colour& colour);

/// "lambda g: ..." of a medium.
std::string medium_py(const CyclesScript& script, MediumIndex index);

/// What a shape is made of.
struct CyclesMaterial {
  BsdfIndex bsdf;
  std::optional<Colour> radiance;
  std::optional<MediumIndex> interior;
  bool leaning = false;  ///< its shading normals are not the surface's own
  bool sampled = true;   ///< the light is aimed at, and not only found by chance; either is unbiased
  friend bool operator==(const CyclesMaterial&, const CyclesMaterial&) = default;
};

/// "material(...)" of the name. Throws NotRepresentable for every model that Blender 3.4 has no equal of.
std::string material_py(CyclesScript& script, const std::string& name, const CyclesMaterial& material);

/// Whether there is no surface at all, at most a border of a medium.
bool is_nothing(const SceneDescription& scene, BsdfIndex index);

/// Of a BSDF and what it nests.
struct CyclesTraits {
  bool pane = false;    ///< a thin dielectric, whose straight light Cycles does not count as part of a path
  bool clear = false;   ///< mirrors or refracts in one direction alone
  bool chance = false;  ///< Cycles draws a direction and cannot aim at lights
  bool wide = false;    ///< scatters into many
};
CyclesTraits traits_of(const SceneDescription& scene, BsdfIndex index);

}  // namespace photonproof::inline reference_cycles
