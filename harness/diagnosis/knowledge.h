// The knowledge of a scene for diagnose(): its features' light, its objects' places, and its pictures with common
// mistakes built in. Our own engine renders all of them as processes, and a cache folder keeps them.
#pragma once

#include <optional>
#include <string>

#include "harness/diagnosis/diagnosis.h"
#include "harness/variants/own_engine.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_diagnosis {

struct KnowledgeOptions {
  std::optional<float> white = 1;  ///< The value at which pictures are clamped.
  int spp = 64;                    ///< Samples a pixel of each probe.
  int longer_side = 128;           ///< Pixels of a render; probes are enlarged to the reference's size.
  bool what_ifs = true;            ///< Also the pictures with mistakes built in, which take most of the time.
};

/// Renders nothing yet: each value is rendered at its first use, which throws InputError on failure. Copies the engine.
SceneKnowledge knowledge_of(const SceneDescription& scene, const Rendering& reference, const OwnEngine& engine,
                            const KnowledgeOptions& options = {});

}  // namespace photonproof::inline harness_diagnosis
