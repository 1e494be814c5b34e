// Media for Mitsuba, whose colours are at most 1.
#include <algorithm>
#include <variant>

#include "reference/mitsuba/mitsuba_lowering.h"

namespace photonproof::inline reference_mitsuba {
namespace {

/// Moves a factor of the extinction into `scale`.
template <class Medium>
void normalise(MitsubaLowering& lowering, const MediumDescription& medium, RgbD& sigma_t, Medium& model) {
  const double most = std::max({sigma_t.x, sigma_t.y, sigma_t.z});
  if (most <= 1) return;
  sigma_t = sigma_t / most;
  model.scale *= most;
  lowering.explain("sigma_t of " + lowering.scene().where(medium.loc) +
                   ": divided by its largest part, which goes into scale");
}

}  // namespace

void lower_media(MitsubaLowering& lowering) {
  for (MediumDescription& medium : lowering.lowered().media) {
    if (!volumes_of(medium).empty()) lowering.refuse(medium.loc, "a grid of values: not written yet");
    if (auto* fog = std::get_if<HomogeneousDescription>(&medium.model)) {
      normalise(lowering, medium, fog->sigma_t, *fog);
      continue;
    }
    auto& cloud = std::get<HeterogeneousDescription>(medium.model);
    if (RgbD* constant = constant_of(cloud.sigma_t)) normalise(lowering, medium, *constant, cloud);
  }
}

}  // namespace photonproof::inline reference_mitsuba
