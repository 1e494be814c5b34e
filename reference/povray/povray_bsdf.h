// A surface's materials as far as POV-Ray can show them: wrappers undone, colours evaluated.
#pragma once

#include <optional>

#include "reference/optics/coat.h"
#include "scenes/description/description.h"

namespace photonproof::inline reference_povray {

/// A colour of a scene, or its texture's mean and greatest value.
struct ColourRange {
  RgbD mean{0.0};
  double greatest = 0;  ///< of any channel anywhere
};
ColourRange range_of(const SceneDescription& scene, const Colour& colour);

/// The two sides of a surface. A side is a leaf, or a blend of leaves.
struct PovSides {
  const BsdfDescription* front = nullptr;
  const BsdfDescription* back = nullptr;  ///< Null: black, or the same as the front for surfaces that transmit.
  double opacity = 1;                     ///< Share of the surface that is there.
  bool nothing = false;                   ///< No surface, at most a boundary of a medium.
};

/// Undoes `twosided`, `mask` and `null`. Throws Unrepresentable for every model that povray_materials.cpp cannot write.
PovSides resolve_bsdf(const SceneDescription& scene, BsdfIndex index);

/// Optics of a side: the albedo of its diffuse part, whether it mirrors, whether it transmits.
struct PovOptics {
  ColourRange diffuse;
  bool specular = false;
  bool refracts = false;
};
PovOptics optics_of(const SceneDescription& scene, const BsdfDescription& side);

/// The coat of a plastic, or of a lacquer over a diffuse base, both of constant colours.
std::optional<Coat> coat_on(const SceneDescription& scene, const BsdfDescription& side);

/// Whether any part of a side has a textured colour.
bool is_textured(const SceneDescription& scene, const BsdfDescription& side);

}  // namespace photonproof::inline reference_povray
