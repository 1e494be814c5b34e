// What diagnose() knows of a scene: its features' light, its objects' places, and how it looks with common mistakes
// built in. All are rendered by our own engine as processes and kept in a cache folder.
#pragma once

#include <optional>
#include <string>

#include "harness/diagnosis/diagnosis.h"
#include "harness/variants/own_engine.h"
#include "scenes/description/description.h"

namespace photonproof::inline harness_diagnosis {

struct KnowledgeOptions {
  std::optional<float> white = 1;  ///< where pictures are clamped
  int spp = 64;                    ///< of each probe
  int longer_side = 128;           ///< pixels of what is rendered; probes are enlarged to the reference's size
  bool what_ifs = true;            ///< also the pictures with mistakes built in, which take most of the time
};

/// Nothing is rendered yet: what is asked of it is, and throws InputError where a render fails. The engine is copied.
SceneKnowledge knowledge_of(const SceneDescription& scene, const Rendering& reference, const OwnEngine& engine,
                            const KnowledgeOptions& options = {});

}  // namespace photonproof::inline harness_diagnosis
