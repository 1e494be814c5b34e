// Which unbiased integrator a reference is made with.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_references {

/// The unbiased integrators, best first: `bdpt` where light may come off mirrors or through glass from a light that has
/// a place, `volpath` where media scatter, else `path`. A rule and no trial: in a short trial the estimator that rarely
/// finds a caustic is the one that seems free of noise.
std::vector<std::string> estimators_for(const SceneDescription& scene);

/// The first of them that can render the scene: the scene's expectations do not call it unsupported, and `refusal` (the
/// renderer's own answer, empty when it has no objection) does not either. Throws InputError with every reason when
/// none can.
std::string choose_estimator(const SceneDescription& scene, const std::optional<Expect>& expect,
                             const std::function<std::string(const std::string& integrator)>& refusal);

}  // namespace photonproof::inline harness_references
