// Scenes of tests and benches, built as for a plan without an integrator.
#pragma once

#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"

namespace photonproof::test {

/// At most `small_limit` primitives make a small scene.
inline Scene compiled(const SceneDescription& description, int width, int height, const SkipSwitches& skips = {},
                      std::size_t small_limit = brute_force_limit) {
  SceneParts parts(description, width, height);
  RenderJob job;
  job.skips = skips;
  const SceneFacts facts = analyse(parts);
  const SceneChoices choices = Planner(facts, job, small_limit).plan().scene;
  return Scene(std::move(parts), choices);
}

}  // namespace photonproof::test
