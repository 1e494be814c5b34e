// Media and phase functions as a scene file states them.
#pragma once

#include <string>
#include <variant>

#include "scenes/description/texture_description.h"

namespace photonproof::inline scenes_description {

/// Henyey and Greenstein 1941; g = 0 is isotropic. g > 0 scatters forward.
struct HenyeyGreensteinDescription {
  double g = 0.8;
  friend bool operator==(const HenyeyGreensteinDescription&, const HenyeyGreensteinDescription&) = default;
};

template <class P>
void describe(P& p, HenyeyGreensteinDescription& d) {
  p.plugin("hg", "Henyey and Greenstein 1941");
  p.number("g", d.g, {-1, 1, "more than -1 and less than 1", true, true}, "mean cosine, above 0 forward");
}

struct IsotropicDescription {
  friend bool operator==(const IsotropicDescription&, const IsotropicDescription&) = default;
};

template <class P>
void describe(P& p, IsotropicDescription&) {
  p.plugin("isotropic", "the same in all directions; when none is named");
}

/// Extinction sigma_t x scale per scene unit; the share `albedo` of it is scattering.
struct HomogeneousDescription {
  RgbD sigma_t{1.0};
  RgbD albedo{0.75};
  double scale = 1;
  std::variant<IsotropicDescription, HenyeyGreensteinDescription> phase = {};
  friend bool operator==(const HomogeneousDescription&, const HomogeneousDescription&) = default;
};

template <class P>
void describe(P& p, HomogeneousDescription& d) {
  p.plugin("homogeneous", "the same everywhere");
  p.colour("sigma_t", d.sigma_t, scene_xml::kNotNegative, "extinction per scene unit");
  p.colour("albedo", d.albedo, scene_xml::kShare, "share of it that scatters");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of `sigma_t`");
  p.nested("phase", 1, "a phase function");
}

struct MediumDescription {
  SourceLoc loc;
  std::string id;
  std::variant<HomogeneousDescription> model;
};

}  // namespace photonproof::inline scenes_description
