#include "harness/references/reference_estimator.h"

#include <algorithm>

#include "scenes/base/input_error.h"
#include "scenes/description/emitter_kinds.h"

namespace photonproof::inline harness_references {
namespace {

/// Or varies, which volpath alone renders.
bool scatters(const MediumDescription& medium) {
  return medium.varies() || max_component(bounds_of(medium).scattering) > 0;
}

}  // namespace

std::vector<std::string> estimators_for(const SceneDescription& scene) {
  if (std::any_of(scene.media.begin(), scene.media.end(), scatters)) return {"volpath"};
  // Following directions finds light that comes from all around. Photons from far away find it badly.
  const bool only_surrounded = std::any_of(scene.emitters.begin(), scene.emitters.end(), surrounds) &&
                               std::all_of(scene.emitters.begin(), scene.emitters.end(), surrounds) &&
                               std::none_of(scene.shapes.begin(), scene.shapes.end(),
                                            [](const auto& shape) { return shape.radiance.has_value(); });
  const bool caustics = !only_surrounded && std::any_of(scene.bsdfs.begin(), scene.bsdfs.end(),
                                                        [](const auto& bsdf) { return traits_of(bsdf).focuses; });
  if (caustics) return {"bdpt", "volpath", "path", "ptracer"};
  return {"path", "volpath", "bdpt", "ptracer"};
}

std::string choose_estimator(const SceneDescription& scene, const std::optional<Expect>& expect,
                             const std::function<std::string(const std::string&)>& refusal) {
  std::string reasons;
  for (const std::string& integrator : estimators_for(scene)) {
    std::string reason;
    if (expect && expect->unsupported.count(integrator) != 0)
      reason = expect->unsupported.at(integrator);
    else
      reason = refusal(integrator);
    if (reason.empty()) return integrator;
    reasons += (reasons.empty() ? "" : "; ") + integrator + ": " + reason;
  }
  throw InputError(scene.files.front(), "no unbiased integrator can render this scene (" + reasons + ")");
}

}  // namespace photonproof::inline harness_references
