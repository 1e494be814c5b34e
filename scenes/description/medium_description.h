// Media and phase functions as a scene file states them.
#pragma once

#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "scenes/description/texture_description.h"
#include "scenes/description/volume_description.h"

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

struct RayleighDescription {
  friend bool operator==(const RayleighDescription&, const RayleighDescription&) = default;
};

template <class P>
void describe(P& p, RayleighDescription&) {
  p.plugin("rayleigh", "Rayleigh 1871: molecules, 1 + the squared cosine");
}

using PhaseLobe = std::variant<IsotropicDescription, HenyeyGreensteinDescription, RayleighDescription>;

struct BlendPhaseDescription {
  VolumeNumber weight = 0.5;
  PhaseLobe first, second;
  friend bool operator==(const BlendPhaseDescription&, const BlendPhaseDescription&) = default;
};

template <class P>
void describe(P& p, BlendPhaseDescription& d) {
  p.plugin("blendphase", "a mixture of two");
  p.require("weight", "a number from 0 to 1 or a volume");
  p.volume_number("weight", d.weight, scene_xml::kShare, "share of the second");
  p.nested("phase", 2, "both, none a `blendphase`");
}

using PhaseDescription =
    std::variant<IsotropicDescription, HenyeyGreensteinDescription, RayleighDescription, BlendPhaseDescription>;

/// Extinction sigma_t x scale per scene unit; the share `albedo` of it is scattering.
struct HomogeneousDescription {
  RgbD sigma_t{1.0};
  VolumeColour albedo = RgbD(0.75);
  double scale = 1;
  PhaseDescription phase = {};
  friend bool operator==(const HomogeneousDescription&, const HomogeneousDescription&) = default;
};

template <class P>
void describe(P& p, HomogeneousDescription& d) {
  p.plugin("homogeneous", "the same extinction everywhere");
  p.colour("sigma_t", d.sigma_t, scene_xml::kNotNegative, "extinction per scene unit");
  p.volume("albedo", d.albedo, scene_xml::kShare, "share of it that scatters");
  p.also("sigma_a", scene_xml::ParamType::colour, "", "absorption per scene unit, with the next in place of these two");
  p.also("sigma_s", scene_xml::ParamType::colour, "", "scattering per scene unit");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of `sigma_t`, `sigma_a` and `sigma_s`");
  p.nested("phase", 1, "a phase function");
}

/// The same with values that vary. As in Mitsuba, the medium ends at the box of sigma_t, the unit cube of a constant.
struct HeterogeneousDescription {
  VolumeColour sigma_t = RgbD(1.0);
  VolumeColour albedo = RgbD(0.75);
  double scale = 1;
  PhaseDescription phase = {};
  friend bool operator==(const HeterogeneousDescription&, const HeterogeneousDescription&) = default;
};

template <class P>
void describe(P& p, HeterogeneousDescription& d) {
  p.plugin("heterogeneous", "varies; it ends at the box of `sigma_t`, the unit cube where that is a colour");
  p.volume("sigma_t", d.sigma_t, scene_xml::kNotNegative, "extinction per scene unit");
  p.volume("albedo", d.albedo, scene_xml::kShare, "share of it that scatters");
  p.number("scale", d.scale, scene_xml::kNotNegative, "factor of `sigma_t`");
  p.nested("phase", 1, "a phase function");
}

struct MediumDescription {
  SourceLoc loc;
  std::string id;
  std::variant<HomogeneousDescription, HeterogeneousDescription> model;

  /// Whether its extinction varies.
  bool varies() const { return std::holds_alternative<HeterogeneousDescription>(model); }
};

/// Extinction and scattering are at most these, per scene unit.
struct MediumBounds {
  RgbD extinction, scattering;
};
inline MediumBounds bounds_of(const MediumDescription& medium) {
  const auto bounds = [](const RgbD& sigma_t, const RgbD& albedo, double scale) {
    return MediumBounds{sigma_t * scale, sigma_t * scale * albedo};
  };
  if (const auto* fog = std::get_if<HomogeneousDescription>(&medium.model))
    return bounds(fog->sigma_t, most(fog->albedo), fog->scale);
  const auto& cloud = std::get<HeterogeneousDescription>(medium.model);
  return bounds(most(cloud.sigma_t), most(cloud.albedo), cloud.scale);
}

inline PhaseDescription& phase_of(MediumDescription& medium) {
  return std::visit([](auto& model) -> PhaseDescription& { return model.phase; }, medium.model);
}
inline const PhaseDescription& phase_of(const MediumDescription& medium) {
  return std::visit([](const auto& model) -> const PhaseDescription& { return model.phase; }, medium.model);
}

/// Calls `visit` with each value of a medium that a volume may give, a VolumeColour or a VolumeNumber.
template <class Medium, class Visit>
void visit_volume_values(Medium& medium, Visit&& visit) {
  if (auto* cloud = std::get_if<HeterogeneousDescription>(&medium.model)) visit(cloud->sigma_t);
  std::visit([&](auto& model) { visit(model.albedo); }, medium.model);
  if (auto* blend = std::get_if<BlendPhaseDescription>(&phase_of(medium))) visit(blend->weight);
}

/// The grids among a medium's values.
template <class Medium>
auto volumes_of(Medium& medium) {
  using Grid = std::conditional_t<std::is_const_v<Medium>, const GridVolumeDescription, GridVolumeDescription>;
  std::vector<Grid*> found;
  visit_volume_values(medium, [&](auto& value) {
    if (auto* grid = std::get_if<GridVolumeDescription>(&value)) found.push_back(grid);
  });
  return found;
}

}  // namespace photonproof::inline scenes_description
