// Whether a stored reference can convict an engine, or only notice that it changed. A reference that the engine's own
// estimator made shares whatever is wrong with it.
#pragma once

#include <optional>
#include <string>

#include "harness/suites/engines.h"
#include "reference/store/reference_store.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_gates {

/// The integrator of this program that an engine runs; empty when it runs another program.
std::optional<std::string> integrator_of(const Engine& engine);

/// The integrator whose code an integrator finds its paths by: its own name, or another's.
std::string sampling_of(const std::string& integrator);

/// Whether two integrators find their paths by the same code: the photon mapper's and `direct`'s camera paths are
/// `path`'s (`Integrator::sampling`). (Materials, lights and textures are shared by all; closed forms and published
/// values are for those.)
bool shares_sampling(const std::string& integrator, const std::string& other);

/// Why a gate on this engine can find nothing but changes: "the reference is by path, whose sampling is the engine's".
/// Empty where the reference is independent: by other sampling, or held to a closed form that the scene states, which
/// the reference's mean must keep within 4 standard errors.
std::string regression_only(const Engine& engine, const StoredReference& reference,
                            const std::optional<Expect>& expect);

}  // namespace photonproof::inline harness_gates
