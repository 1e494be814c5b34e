// What a render will do and what it leaves out, decided from plain facts before the scene is built: by the
// planner and the integrator's own plan_ function. Printed by `render --plan`, kept in the stats.
//
//   SceneParts parts(description, width, height);
//   const RenderPlan plan = plan_render(analyse(parts), method, job);   // integrators/integrator.h
//   const Scene scene(std::move(parts), plan.scene);
//   render(scene, plan, job, film, stats);
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/core/skips.h"
#include "renderer/passes/aov.h"
#include "renderer/passes/lost_light.h"
#include "renderer/scene/scene_choices.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_planning {

struct PlanStep {
  std::string what, how;
};

struct RenderPlan {
  IntegratorDescription method;
  std::string integrator;
  Aov view = Aov::whole;
  std::string isa;
  unsigned lanes = 1;
  SceneChoices scene;  ///< of what the scene has to be built
  std::vector<PlanStep> runs;
  struct Decision {
    Skip skip;
    bool skipped;
    std::string why;  ///< why it is left out, or why it is not
  };
  std::vector<Decision> decisions;  ///< one for each skip that concerns the integrator

  bool may_lose_light = false;            ///< find_lost_light (integrators/integrator.h) says whether it does
  std::optional<LostLight> lost_light{};  ///< once that has been asked

  bool skips(Skip skip) const;
  /// "name: why" of what is left out.
  std::vector<std::string> skipped() const;
};

/// For people: a few lines each of what runs, what is skipped and what is not.
std::string plan_text(const RenderPlan& plan);

}  // namespace photonproof::inline renderer_planning
