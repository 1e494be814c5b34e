// Verdict on one scene: its engines' pictures, the pairs, and the conclusions from them.
#pragma once

#include <vector>

#include "harness/verify/engine_renderer.h"
#include "harness/verify/verify_engines.h"
#include "reports/verify/verify_record.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_verify {

/// A difference is reported only after a second test with new samples. `probes` decide where pictures cannot: of two
/// that differ, the one with a wrong probe of the scene's contents is wrong. Throws VerifyInterrupted.
VerifyScene verify_scene(const EngineRenderer& renderer, const RenderedScene& scene,
                         const SceneDescription& description, const std::vector<VerifyEngine>& engines,
                         const std::vector<VerifyProbe>& probes);

}  // namespace photonproof::inline harness_verify
