// Whether a stored reference can prove an engine wrong, or only show that it changed. A reference by the engine's own
// estimator shares all of its errors.
#pragma once

#include <optional>
#include <string>

#include "harness/suites/engines.h"
#include "reference/store/reference_store.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_gates {

/// The integrator of this program that an engine runs; empty when it runs another program.
std::optional<std::string> integrator_of(const Engine& engine);

/// The integrator whose code finds this integrator's paths: itself or another one.
std::string sampling_of(const std::string& integrator);

/// Whether two integrators find their paths by the same code: the photon mapper's and `direct`'s camera paths are
/// `path`'s (`Integrator::sampling`). (All share materials, lights and textures; closed forms and published values test
/// those.)
bool shares_sampling(const std::string& integrator, const std::string& other);

/// Why a gate on this engine can find only changes: "the reference is by path, whose sampling is the engine's". Empty
/// where the reference is independent. It is by other sampling, or its mean is within 4 standard errors of a closed
/// form that the scene states.
std::string regression_only(const Engine& engine, const StoredReference& reference,
                            const std::optional<Expect>& expect);

}  // namespace photonproof::inline harness_gates
