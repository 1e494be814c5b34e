// What a render will do and what it leaves out, decided from plain facts before it starts: the one place where skips
// are decided. Printed by `render --plan`, kept in the stats.
#pragma once

#include <string>
#include <vector>

#include "renderer/core/skips.h"
#include "renderer/passes/render_job.h"
#include "renderer/scene/scene.h"

namespace photonproof {

struct PlanStep {
  std::string what, how;
};

struct RenderPlan {
  std::string integrator;
  std::string isa;
  unsigned lanes = 1;
  std::vector<PlanStep> runs;
  struct Decision {
    Skip skip;
    bool skipped;
    std::string why;  ///< why it is left out, or why it is not
  };
  std::vector<Decision> decisions;  ///< one for each skip that concerns the integrator

  bool skips(Skip skip) const;
  /// "name: why" of what is left out.
  std::vector<std::string> skipped() const;
};

/// Throws InputError where the job cannot be done (an instruction set the processor has not).
RenderPlan plan_render(const Scene& scene, const IntegratorDescription& method, const RenderJob& job);

/// For people: a few lines each of what runs, what is skipped and what is not.
std::string plan_text(const RenderPlan& plan);

}  // namespace photonproof
