// A render's plan and stats as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "harness/verbs/render_run.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/plan.h"

namespace photonproof {

nlohmann::ordered_json plan_json(const RenderPlan& plan);

/// `threads`: how many there were. `width`, `height`: of the part that was rendered.
nlohmann::ordered_json stats_json(const RenderArguments& arguments, const RenderPlan& plan, const RenderStats& stats,
                                  int threads, int width, int height);

}  // namespace photonproof
