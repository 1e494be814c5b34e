// The scene `many-lights`: blocks and balls among a chosen number of small lights, to measure how engines choose.
#pragma once

#include <string>

namespace photonproof::inline scenes_generators {

constexpr int kFewestLights = 1, kMostLights = 100'000;

/// scene.xml. The lights' total flux does not depend on their number. Deterministic to the byte.
/// Precondition: kFewestLights <= lights <= kMostLights.
std::string many_lights_scene(int lights);

/// expect.toml beside it.
std::string many_lights_expect(int lights);

}  // namespace photonproof::inline scenes_generators
