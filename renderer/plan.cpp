#include "renderer/plan.h"

#include <algorithm>
#include <bit>

#include "renderer/aim_targets.h"
#include "renderer/direct_integrator.h"
#include "renderer/scene_facts.h"

namespace photonproof {
namespace {

std::string counted(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

std::string depth_words(int max_depth) {
  return max_depth < 0 ? "paths of any length" : "paths of at most " + counted(std::size_t(max_depth), "edge", "edges");
}

class Planner {
 public:
  Planner(const Scene& scene, const RenderJob& job, RenderPlan& plan) : scene_(scene), job_(job), plan_(plan) {}

  /// Notes a skip: `reason` where the scene allows it, else why it does not.
  bool decide(Skip skip, bool possible, const std::string& why, const std::string& why_not) {
    const bool skipped = possible && job_.skips.on(skip);
    const std::string note = possible && !skipped ? "switched off by --no-skip, though " + why
                             : possible           ? why
                                                  : why_not;
    plan_.decisions.push_back({skip, skipped, note});
    return skipped;
  }
  void run(const std::string& what, const std::string& how) { plan_.runs.push_back({what, how}); }

  void rays() {
    const std::string primitives = counted(scene_.primitive_count(), "primitive", "primitives");
    const bool few = scene_.primitive_count() <= small_scene_limit;
    const bool simple = scene_.has_simple_primitives();
    const bool skipped = decide(Skip::bvh, few && simple, primitives + ", tested one after the other",
                                !simple ? "not all shapes are parallelograms, triangles and spheres"
                                        : primitives + ", more than " + std::to_string(small_scene_limit));
    run("rays", skipped ? "packed kernel over all primitives" : "Embree, camera rays in packets, others one by one");
  }
  void direct_light(bool weighted_by_method) {
    const std::size_t count = scene_.lights.size();
    decide(Skip::light_choice, count <= 1, counted(count, "light", "lights"), counted(count, "light", "lights"));
    decide(Skip::shadow_rays, true, "where the light or the BSDF gives nothing, none is traced", "");
    if (!weighted_by_method) return;
    decide(Skip::mis, !scene_.view().lights_can_be_hit,
           count == 0 ? "there is no light" : "every light is a point, no ray can hit one",
           "rays can hit a light that next-event estimation samples too");
  }
  void groups() {
    const bool one_kind = std::has_single_bit(scene_.view().bsdf_kinds);
    decide(Skip::bsdf_groups, one_kind, "all BSDFs are of one kind",
           counted(std::size_t(std::popcount(scene_.view().bsdf_kinds)), "kind", "kinds") + " of BSDF");
    decide(Skip::surface_detail, !scene_.needs_detail(), "no textures, shading normals, tangents or nested BSDFs",
           "there are textures, shading normals, tangents or nested BSDFs");
  }

  void path(const PathDescription& method) {
    run("camera paths", depth_words(method.max_depth) + ", roulette from depth " + std::to_string(method.rr_depth));
    rays();
    groups();
    direct_light(true);
  }

  void direct(const DirectDescription& method) {
    const std::int64_t paths = paths_a_sample(method);
    run("camera paths", "of at most 2 edges, " + counted(std::size_t(paths), "path", "paths") + " a camera sample");
    run("direct light", method.bsdf_samples == 0      ? "samples of the lights alone"
                        : method.emitter_samples == 0 ? "rays that meet the lights alone"
                                                      : "samples of the lights, weighted against rays that meet them");
    rays();
    groups();
    direct_light(method.emitter_samples > 0 && method.bsdf_samples > 0);
  }

  void photon_mapper(const PhotonMapperDescription& method) {
    const SceneFacts facts = analyse(scene_);
    // The shortest path through a map has two edges of the light's and one of the camera's.
    const bool deep_enough = method.max_depth < 0 || method.max_depth >= 3;
    const auto map = [&](Skip skip, const char* name, std::int64_t photons, bool needed, const char* why_not_needed,
                         const char* why_needed) {
      const std::int64_t asked = job_.budget.photons.value_or(photons);
      const char* why = !deep_enough            ? "paths of max_depth edges are too short for it"
                        : !needed               ? why_not_needed
                        : scene_.lights.empty() ? "no light"
                        : asked <= 0            ? "no photons asked for"
                                                : nullptr;
      if (!decide(skip, why != nullptr, why != nullptr ? why : "", why_needed))
        run(name, counted(std::size_t(std::max<std::int64_t>(asked, 0)), "photon", "photons") + " emitted");
    };
    map(Skip::global_map, "global photon map", method.global_photons, facts.diffuse_interreflection,
        facts.any_diffuse ? "no two diffuse surfaces see each other" : "no diffuse surface reflects",
        "light goes from diffuse surface to diffuse surface");
    map(Skip::caustic_map, "caustic photon map", method.caustic_photons, facts.any_specular && facts.any_diffuse,
        facts.any_specular ? "no diffuse surface reflects" : "no specular surface",
        "specular surfaces throw light on diffuse ones");
    if (!plan_.skips(Skip::caustic_map)) {
      const std::size_t targets = scene_.view().aim_target_count;
      const std::string surfaces = counted(targets, "specular surface", "specular surfaces");
      decide(Skip::stray_photons, targets > 0 && targets <= most_aim_targets, surfaces + " to aim at",
             surfaces + ", at most " + std::to_string(most_aim_targets) + " can be aimed at");
    }

    run("camera paths", "to their first diffuse surface, where photons within a fixed radius are looked up; " +
                            depth_words(method.max_depth));
    rays();
    groups();
    direct_light(false);
  }

 private:
  const Scene& scene_;
  const RenderJob& job_;
  RenderPlan& plan_;
};

}  // namespace

bool RenderPlan::skips(Skip skip) const {
  return std::any_of(decisions.begin(), decisions.end(),
                     [&](const Decision& d) { return d.skip == skip && d.skipped; });
}

std::vector<std::string> RenderPlan::skipped() const {
  std::vector<std::string> lines;
  for (const Decision& d : decisions)
    if (d.skipped) lines.push_back(std::string(skip_row(d.skip).name) + ": " + d.why);
  return lines;
}

RenderPlan plan_render(const Scene& scene, const IntegratorDescription& method, const RenderJob& job) {
  const Kernels& kernels = job.kernels();
  RenderPlan plan;
  plan.integrator = integrator_name(method);
  plan.isa = kernels.isa;
  plan.lanes = kernels.lanes;
  Planner planner(scene, job, plan);
  if (const auto* path = std::get_if<PathDescription>(&method.method)) planner.path(*path);
  if (const auto* mapper = std::get_if<PhotonMapperDescription>(&method.method)) planner.photon_mapper(*mapper);
  if (const auto* direct = std::get_if<DirectDescription>(&method.method)) planner.direct(*direct);
  return plan;
}

std::string plan_text(const RenderPlan& plan) {
  const auto line = [](const std::string& name, const std::string& text) {
    return "  " + name + std::string(name.size() < 20 ? 20 - name.size() : 1, ' ') + text + "\n";
  };
  std::string text = plan.integrator + ", kernels " + plan.isa + " (" + counted(plan.lanes, "lane", "lanes") + ")\n";
  text += "runs\n";
  for (const PlanStep& step : plan.runs) text += line(step.what, step.how);
  for (const bool skipped : {true, false}) {
    const auto listed = [&](const RenderPlan::Decision& d) { return d.skipped == skipped; };
    if (std::none_of(plan.decisions.begin(), plan.decisions.end(), listed)) continue;
    text += skipped ? "skips\n" : "does not skip\n";
    for (const RenderPlan::Decision& d : plan.decisions)
      if (listed(d)) text += line(skip_row(d.skip).name, skip_row(d.skip).what + (": " + d.why));
  }
  return text;
}

}  // namespace photonproof
