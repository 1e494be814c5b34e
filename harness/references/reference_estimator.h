// Chooses the unbiased integrator for a reference.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "scenes/description/description.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_references {

/// The unbiased integrators, best first. It is only `volpath` if media scatter. Else `bdpt` comes first if light from a
/// place may come off mirrors or through glass, else `path`. A fixed rule, not a trial: in a short trial the estimator
/// that rarely finds a caustic seems free of noise.
std::vector<std::string> estimators_for(const SceneDescription& scene);

/// The first integrator that can render the scene: neither the scene's expectations nor `refusal` reject it. `refusal`
/// is the renderer's own answer, empty when it can render the scene. Throws InputError with every reason when none can.
std::string choose_estimator(const SceneDescription& scene, const std::optional<Expect>& expect,
                             const std::function<std::string(const std::string& integrator)>& refusal);

}  // namespace photonproof::inline harness_references
