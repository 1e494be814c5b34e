// Properties of kinds of emitters.
#pragma once

#include <variant>

#include "scenes/description/light_description.h"

namespace photonproof::inline scenes_description {

inline EmitterTraits traits_of(const EmitterDescription& emitter) {
  return std::visit([]<class Light>(const Light&) { return Light::traits; }, emitter.light);
}

/// Whether it has one point or one direction, so that rays never meet it.
inline bool is_without_size(const EmitterDescription& emitter) { return traits_of(emitter).without_size; }

/// Whether its light comes from all around and is given by direction.
inline bool surrounds(const EmitterDescription& emitter) { return traits_of(emitter).surrounds; }

/// Whether its light comes from beyond the scene.
inline bool is_infinitely_far(const EmitterDescription& emitter) { return traits_of(emitter).infinitely_far; }

}  // namespace photonproof::inline scenes_description
