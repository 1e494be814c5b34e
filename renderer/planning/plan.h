// The steps of a render and the work it skips, decided from plain facts before the scene is built: by the planner and
// the integrator's own plan_ function. Printed by `render --plan`, kept in the stats.
// ```
//   SceneParts parts(description, width, height);
//   const RenderPlan plan = plan_render(analyse(parts), method, job);   // integrators/integrator.h
//   const Scene scene(std::move(parts), plan.scene);
//   render(scene, plan, job, film, stats);
// ```
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
  SceneChoices scene;  ///< the choices for building the scene
  std::vector<PlanStep> runs;
  struct Decision {
    Skip skip;
    bool skipped;
    std::string why;  ///< why it is left out, or why it is not
  };
  std::vector<Decision> decisions;  ///< one for each skip that concerns the integrator

  bool may_lose_light = false;            ///< find_lost_light (integrators/integrator.h) decides whether it does
  std::optional<LostLight> lost_light{};  ///< set after that

  bool skips(Skip skip) const;
  /// "name: why" of the skipped steps.
  std::vector<std::string> skipped() const;
};

/// For people: a few lines each on steps that run, steps that are skipped and skips that are not made.
std::string plan_text(const RenderPlan& plan);

}  // namespace photonproof::inline renderer_planning
