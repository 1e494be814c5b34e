// What a surface is made of, as far as POV-Ray can show it: wrappers undone, colours known.
#pragma once

#include <optional>

#include "reference/optics/coat.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_povray {

/// A colour of a scene, or what its texture is on the whole.
struct ColourRange {
  RgbD mean{0.0};
  double greatest = 0;  ///< of any channel anywhere
};
ColourRange range_of(const SceneDescription& scene, const Colour& colour);

/// The two sides of a surface. A side is a leaf, or a blend of leaves.
struct PovSides {
  const BsdfDescription* front = nullptr;
  const BsdfDescription* back = nullptr;  ///< null: black, or for what transmits the same
  double opacity = 1;                     ///< share of the surface that is there
  bool nothing = false;                   ///< no surface, at most a border of a medium
};

/// Undoes `twosided`, `mask` and `null`. Throws Unrepresentable for every model that povray_materials.cpp cannot write.
PovSides resolve_bsdf(const SceneDescription& scene, BsdfIndex index);

/// Of a side: albedo of its diffuse part, whether it mirrors, whether light goes through.
struct PovOptics {
  ColourRange diffuse;
  bool specular = false;
  bool refracts = false;
};
PovOptics optics_of(const SceneDescription& scene, const BsdfDescription& side);

/// Of a plastic, or of a lacquer over a diffuse base, both of constant colours.
std::optional<Coat> coat_on(const SceneDescription& scene, const BsdfDescription& side);

/// Whether a texture's colours are looked up anywhere in a side.
bool is_textured(const SceneDescription& scene, const BsdfDescription& side);

}  // namespace photonproof::inline reference_povray
