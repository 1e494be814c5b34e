#include "harness/python/stats.h"

#include <nanobind/stl/map.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "renderer/core/version.h"
#include "renderer/passes/aov.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

nb::list cannot_find(const RenderPlan& plan) {
  nb::list texts;
  if (plan.lost_light) texts.append(plan.lost_light->text());
  return texts;
}

nb::dict plan_of(const RenderPlan& plan) {
  nb::dict runs, skips, result;
  for (const PlanStep& step : plan.runs) runs[step.what.c_str()] = step.how;
  for (const RenderPlan::Decision& decision : plan.decisions) {
    nb::dict skip;
    skip["skipped"] = decision.skipped;
    skip["why"] = decision.why;
    skips[skip_row(decision.skip).name] = skip;
  }
  result["integrator"] = plan.integrator;
  result["view"] = aov_row(plan.view).name;
  result["isa"] = plan.isa;
  result["lanes"] = plan.lanes;
  result["runs"] = runs;
  result["cannot_find"] = cannot_find(plan);
  result["skips"] = skips;
  return result;
}

nb::object denoised_of(const Rendered& rendered) {
  if (!rendered.denoised) return nb::none();
  nb::dict denoised;
  denoised["library"] = rendered.denoised->library;
  denoised["version"] = rendered.denoised->version;
  denoised["seconds"] = rendered.denoised->seconds;
  return denoised;
}

}  // namespace

nb::dict stats_of(const Rendered& rendered, std::uint64_t seed, const std::string& sampler) {
  const RenderStats& stats = rendered.stats;
  nb::dict result;
  result["engine"] = "photonproof " + rendered.plan.integrator;
  result["version"] = version_line();
  result["width"] = rendered.image.mean.width;
  result["height"] = rendered.image.mean.height;
  result["seed"] = seed;
  result["sampler"] = sampler;
  result["threads"] = rendered.threads;
  result["interrupted"] = stats.interrupted;
  result["denoised"] = denoised_of(rendered);
  result["not_denoised"] = rendered.not_denoised;
  result["unsampled_pixels"] = rendered.unsampled_pixels;
  result["non_finite_values"] = rendered.non_finite_values;
  result["phases"] = stats.phases;
  result["counts"] = stats.counts;
  result["skipped"] = stats.skipped;
  result["choices"] = stats.choices;
  result["losses"] = stats.losses;
  result["cannot_find"] = cannot_find(rendered.plan);
  result["plan"] = plan_of(rendered.plan);
  return result;
}

}  // namespace photonproof::inline harness_python
