#include "harness/verbs/render_json.h"

#include "renderer/core/version.h"
#include "renderer/passes/view.h"

namespace photonproof {

nlohmann::ordered_json plan_json(const RenderPlan& plan) {
  nlohmann::ordered_json runs, skips;
  for (const PlanStep& step : plan.runs) runs[step.what] = step.how;
  for (const RenderPlan::Decision& d : plan.decisions)
    skips[skip_row(d.skip).name] = {{"skipped", d.skipped}, {"why", d.why}};
  return {{"integrator", plan.integrator},
          {"view", view_row(plan.view).name},
          {"isa", plan.isa},
          {"lanes", plan.lanes},
          {"runs", runs},
          {"skips", skips}};
}

nlohmann::ordered_json stats_json(const RenderArguments& arguments, const RenderPlan& plan, const RenderStats& stats,
                                  int threads, int width, int height) {
  return {{"schema_version", 1},
          {"engine", "photonproof " + plan.integrator},
          {"version", version_line()},
          {"scene", arguments.scene.path},
          {"width", width},
          {"height", height},
          {"seed", arguments.seed},
          {"sampler", arguments.sampler},
          {"threads", threads},
          {"interrupted", stats.interrupted},
          {"phases", stats.phases},
          {"counts", stats.counts},
          {"skipped", stats.skipped},
          {"choices", stats.choices},
          {"losses", stats.losses},
          {"plan", plan_json(plan)}};
}

}  // namespace photonproof
