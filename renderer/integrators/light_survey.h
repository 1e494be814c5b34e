// A few thousand paths before the render measure whether the scene has light that an integrator cannot find. Facts
// alone cannot tell a mirror that is seen, or light that glass throws somewhere, from one that matters not.
#pragma once

#include <optional>

#include "renderer/passes/lost_light.h"
#include "renderer/planning/scene_facts.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_integrators {

/// Whether facts leave it open that the integrator of that name misses some light: only then a survey is worth its
/// time.
bool may_lose_light(const SceneFacts& facts, const std::string& integrator);

/// The light of the whole image that the integrator misses, if any; `limits` are its own. The same whatever seed,
/// budget and window of the render. A caustic outside of a narrow view, whose light arrives there after a further
/// bounce, is met by too few of the 4,096 paths: in a test's room .7 % of the light is lost unnoticed.
std::optional<LostLight> light_lost_by(const std::string& integrator, const Scene& scene, const PathLimits& limits);

}  // namespace photonproof::inline renderer_integrators
