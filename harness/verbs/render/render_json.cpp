#include "harness/verbs/render/render_json.h"

#include <optional>
#include <string>
#include <vector>

#include "renderer/core/version.h"
#include "renderer/passes/aov.h"

namespace photonproof::inline harness_verbs_render {

namespace {

/// Empty where the integrator finds all light, or was not asked.
std::vector<std::string> texts_of(const std::optional<LostLight>& lost) {
  return lost ? std::vector{lost->text()} : std::vector<std::string>{};
}

/// Null where the image is not denoised.
nlohmann::ordered_json denoised_json(const std::optional<Denoised>& denoised) {
  if (!denoised) return nullptr;
  return {{"library", denoised->library},
          {"version", denoised->version},
          {"seconds", denoised->seconds},
          {"guides", {{"images", {"albedo", "normal"}}, {"samples_per_pixel", denoised->guide_samples}}},
          {"biased", true}};
}

}  // namespace

nlohmann::ordered_json plan_json(const RenderPlan& plan) {
  nlohmann::ordered_json runs, skips;
  for (const PlanStep& step : plan.runs) runs[step.what] = step.how;
  for (const RenderPlan::Decision& d : plan.decisions)
    skips[skip_row(d.skip).name] = {{"skipped", d.skipped}, {"why", d.why}};
  nlohmann::ordered_json json = {{"integrator", plan.integrator},
                                 {"view", aov_row(plan.view).name},
                                 {"isa", plan.isa},
                                 {"lanes", plan.lanes},
                                 {"runs", runs}};
  json["cannot_find"] = texts_of(plan.lost_light);
  json["skips"] = skips;
  return json;
}

nlohmann::ordered_json stats_json(const RenderArguments& arguments, const Rendered& rendered) {
  const RenderPlan& plan = rendered.plan;
  const RenderStats& stats = rendered.stats;
  return {{"schema_version", 1},
          {"engine", "photonproof " + plan.integrator},
          {"version", version_line()},
          {"scene", arguments.scene.path},
          {"width", rendered.image.mean.width},
          {"height", rendered.image.mean.height},
          {"seed", arguments.seed},
          {"sampler", arguments.sampler},
          {"threads", rendered.threads},
          {"interrupted", stats.interrupted},
          {"denoised", denoised_json(rendered.denoised)},
          {"phases", stats.phases},
          {"counts", stats.counts},
          {"skipped", stats.skipped},
          {"choices", stats.choices},
          {"losses", stats.losses},
          {"cannot_find", texts_of(plan.lost_light)},
          {"plan", plan_json(plan)}};
}

}  // namespace photonproof::inline harness_verbs_render
