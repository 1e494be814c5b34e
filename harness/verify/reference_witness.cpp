#include "harness/verify/reference_witness.h"

#include <algorithm>

#include "harness/gates/independence.h"
#include "harness/references/reference_estimator.h"
#include "harness/verify/verify_engines.h"

namespace photonproof::inline harness_verify {

std::string witness_for(const SceneDescription& scene, const std::string& parent, const std::optional<Expect>& expect,
                        const std::function<std::string(const std::string&)>& refusal) {
  const std::vector<std::string> unbiased = estimators_for(scene);
  // Ordered by how little they share: paths from both ends, from the camera, from the lights.
  for (const std::string estimator : {"bdpt", "volpath", "path", "ptracer"}) {
    if (std::ranges::find(unbiased, estimator) == unbiased.end()) continue;
    if (shares_sampling(estimator, parent) || (expect && expect->unsupported.contains(estimator))) continue;
    if (what_is_not_shown(estimator, scene).empty() && refusal(estimator).empty()) return estimator;
  }
  return {};
}

PairTest test_witness(const Rendering& reference, double bias, const Rendering& witness) {
  constexpr double shared_mean = 0.002, shared_block = 0.02;
  EnginePicture first, second;
  first.rendering = reference;
  first.declared = {shared_mean + bias, shared_block + 2 * bias, ""};
  second.rendering = witness;
  return test_pair(first, second);
}

}  // namespace photonproof::inline harness_verify
