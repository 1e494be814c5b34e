// Lights with the tables that a scene keeps for them, test code only.
#pragma once

#include <utility>
#include <vector>

#include "renderer/light_sampling/light_table.h"
#include "renderer/light_sampling/scene_lights.h"

namespace photonproof::test {

struct Lights {
  std::vector<Light> lights;
  std::vector<LightWords> words;
  SceneLights scene;
  explicit Lights(std::vector<Light> all, const SceneBall& ball = {{0, 0, 0}, 2})
      : lights(std::move(all)), words(light_table(lights)), scene(lights, words, ball) {}
};

}  // namespace photonproof::test
