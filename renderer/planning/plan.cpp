#include "renderer/planning/plan.h"

#include <algorithm>
#include <bit>

#include "renderer/light_choice/scene_lights.h"
#include "renderer/planning/direct_paths.h"
#include "renderer/planning/integrator_name.h"
#include "renderer/planning/scene_facts.h"
#include "renderer/scene/aim_targets.h"

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
    if (count > 1)
      decide(Skip::far_lights, scene_.view().general_lights->has_tree(),
             counted(count, "light", "lights") + ", chosen by a tree over where they are and shine to",
             counted(count, "light", "lights") + ", chosen by their flux");
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
    for (const std::string& what : unreachable(false)) run("cannot see", what);
  }

  void bdpt(const BdptDescription& method) {
    run("camera paths", depth_words(method.max_depth) + ", one at a time, each vertex joined to a light");
    run("light paths", "one a camera sample, each vertex joined to the lens and to those of the camera path");
    rays_one_by_one();
    for (const std::string& what : unreachable(true)) run("cannot see", what);
  }

  void particle_tracer(const ParticleTracerDescription& method) {
    run("light paths", depth_words(method.max_depth) + ", one a camera sample, each vertex joined to the lens");
    rays_one_by_one();
    if (surfaces_with([](const Bsdf& bsdf) { return !has_smooth(bsdf); }))
      run("cannot see", "what mirrors and smooth glass show: no light path meets the lens by itself");
    if (scene_.view().environment != no_index) run("cannot see", "the environment itself, only what it lights");
  }

  void volpath(const VolPathDescription& method) {
    run("camera paths",
        depth_words(method.max_depth) + ", one at a time, roulette from depth " + std::to_string(method.rr_depth));
    run("media", scene_.media.media.empty() ? "none" : counted(scene_.media.media.size(), "medium", "media"));
    rays_one_by_one();
    for (const std::string& what : unreachable(false)) run("cannot see", what);
  }

  void whitted(const WhittedDescription& method) {
    run("camera paths", "through mirrors and both ways at smooth dielectrics, " + depth_words(method.max_depth));
    run("direct light", "one point of every light at every other surface; no light between those");
    rays_one_by_one();
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
  void rays_one_by_one() {
    run("rays", scene_.view().small ? "one by one against all primitives" : "one by one through Embree");
  }
  template <class Test>
  bool surfaces_with(const Test& test) const {
    bool found = false;
    for (const Surface& surface : scene_.surfaces)
      scene_.for_each_leaf(surface.bsdf, [&](const Bsdf& bsdf, bool) { found = found || test(bsdf); });
    return found;
  }
  /// Light that no path of the integrator can bring: lights that no ray meets have to be sampled, and what mirrors or
  /// smooth glass make of a light is in a single direction, which samples cannot hit. Light paths see the first, if the
  /// vertex after the glass scatters and the camera sees that directly.
  std::vector<std::string> unreachable(bool with_light_paths) const {
    const bool delta_light =
        std::any_of(scene_.lights.begin(), scene_.lights.end(), [](const Light& light) { return is_delta(light); });
    if (!delta_light || !surfaces_with([](const Bsdf& bsdf) { return !has_smooth(bsdf); })) return {};
    if (with_light_paths) return {"caustics of lights of no size, where they are seen in mirrors or through glass"};
    return {"caustics of lights of no size: no ray meets such a light behind a mirror or glass"};
  }

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
  if (const auto* bdpt = std::get_if<BdptDescription>(&method.method)) planner.bdpt(*bdpt);
  if (const auto* tracer = std::get_if<ParticleTracerDescription>(&method.method)) planner.particle_tracer(*tracer);
  if (const auto* volpath = std::get_if<VolPathDescription>(&method.method)) planner.volpath(*volpath);
  if (const auto* whitted = std::get_if<WhittedDescription>(&method.method)) planner.whitted(*whitted);
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
