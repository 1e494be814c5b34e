// One scene: its engines' pictures, the pairs, and what follows from them.
#pragma once

#include <vector>

#include "harness/verify/engine_renderer.h"
#include "harness/verify/verify_engines.h"
#include "reports/verify/verify_record.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

/// What differs is looked at again with new samples before it is said. `probes` decide where nobody else can: of two
/// that differ, one whose probe of what the scene holds is wrong. Throws VerifyInterrupted.
VerifyScene verify_scene(const EngineRenderer& renderer, const RenderedScene& scene,
                         const SceneDescription& description, const std::vector<VerifyEngine>& engines,
                         const std::vector<VerifyProbe>& probes);

}  // namespace photonproof::inline harness_verify
