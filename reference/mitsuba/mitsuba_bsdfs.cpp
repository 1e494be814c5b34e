// BSDFs for Mitsuba.
#include <algorithm>
#include <string>
#include <variant>

#include "reference/mitsuba/mitsuba_lowering.h"

namespace photonproof::inline reference_mitsuba {
namespace {

/// Whether the BSDF or one that it nests turns some light into a single direction.
bool is_clear(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& bsdf = scene.bsdfs[index.value];
  const std::vector<BsdfIndex> nested = nested_bsdfs(bsdf);
  return traits_of(bsdf).specular ||
         std::any_of(nested.begin(), nested.end(), [&](BsdfIndex inner) { return is_clear(scene, inner); });
}

/// Whether all light that leaves it does so in single directions.
bool is_only_clear(const SceneDescription& scene, BsdfIndex index) {
  const BsdfDescription& bsdf = scene.bsdfs[index.value];
  return std::holds_alternative<ConductorDescription>(bsdf.model) ||
         std::holds_alternative<DielectricDescription>(bsdf.model) ||
         std::holds_alternative<ThinDielectricDescription>(bsdf.model) ||
         std::holds_alternative<NullDescription>(bsdf.model);
}

struct LoweredBsdf {
  MitsubaLowering& lowering;
  const BsdfDescription& bsdf;

  void operator()(DielectricDescription& d) const {
    if (d.priority) lowering.refuse(bsdf.loc, "a priority of bodies that overlap: Mitsuba has none");
  }
  void operator()(const BlendDescription& d) const {
    const SceneDescription& scene = lowering.scene();
    if (!is_clear(scene, d.first) && !is_clear(scene, d.second)) return;
    if (is_only_clear(scene, d.first) && is_only_clear(scene, d.second)) return;
    lowering.need("mixture");
    lowering.explain("blendbsdf of " + scene.where(bsdf.loc) +
                     ": our plugin, as Mitsuba's weighs a mirror's sample against the other part's density");
  }
  void operator()(const PhongDescription&) const {
    lowering.need("phong");
    lowering.explain("phong of " + lowering.scene().where(bsdf.loc) + ": our plugin, as Mitsuba 3 has none");
  }
  void operator()(const LayeredDescription&) const {
    lowering.refuse(bsdf.loc, "a lacquer over another BSDF: Mitsuba 3 has none; its model is this program's own");
  }
  void operator()(const DiffuseTransmitterDescription&) const {
    lowering.refuse(bsdf.loc, "a diffuse transmitter: Mitsuba 3 has none");
  }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

void lower_bsdfs(MitsubaLowering& lowering) {
  for (std::size_t i = 0; i < lowering.scene().bsdfs.size(); ++i)
    std::visit(LoweredBsdf{lowering, lowering.scene().bsdfs[i]}, lowering.lowered().bsdfs[i].model);
}

}  // namespace photonproof::inline reference_mitsuba
