// A survey by a few thousand paths before the render: does the scene have light that an integrator cannot find? Facts
// alone do not show whether a visible mirror, or light refracted by glass, matters.
#pragma once

#include <optional>

#include "renderer/passes/lost_light.h"
#include "renderer/planning/scene_facts.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_integrators {

/// Whether the facts allow that this integrator misses some light. Only then is a survey worth its time.
bool may_lose_light(const SceneFacts& facts, const std::string& integrator);

/// The light of the whole image that the integrator misses, if any; `limits` are its own. It does not depend on seed,
/// budget or window of the render. Too few of the 4,096 paths meet a caustic outside a narrow view whose light enters
/// the view after a further bounce. In a test's room .7 % of the light is lost unnoticed.
std::optional<LostLight> light_lost_by(const std::string& integrator, const Scene& scene, const PathLimits& limits);

}  // namespace photonproof::inline renderer_integrators
