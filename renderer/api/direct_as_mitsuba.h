// Departures of the `direct` of Mitsuba by its numbers of samples (docs/formats/scene.md, where Mitsuba departs).
#pragma once

#include <optional>

#include "scenes/description/description.h"

namespace photonproof::inline renderer_api {

/// The scene whose image by this renderer's `direct` is that of Mitsuba's. Empty where the scene is not rendered as
/// Mitsuba does, the integrator is another one, or both agree. Changes have notes.
std::optional<SceneDescription> direct_as_mitsuba(const SceneDescription& scene, const IntegratorDescription& method);

}  // namespace photonproof::inline renderer_api
