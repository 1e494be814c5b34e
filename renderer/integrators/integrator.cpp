#include "renderer/integrators/integrator.h"

#include <algorithm>

#include "renderer/integrators/bdpt.h"
#include "renderer/integrators/direct_integrator.h"
#include "renderer/integrators/light_survey.h"
#include "renderer/integrators/particle_tracer.h"
#include "renderer/integrators/path_integrator.h"
#include "renderer/integrators/radiance_field.h"
#include "renderer/integrators/volpath.h"
#include "renderer/integrators/whitted.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photon_mapping/photon_mapper.h"

namespace photonproof::inline renderer_integrators {

namespace {

std::vector<Integrator> integrators_in_batches() {
  return {
      {.name = "path",
       .summary = "unbiased path tracing: next-event estimation, MIS, Russian roulette",
       .parts = {part::direct, part::weights, part::diffuse, part::specular},
       .plan = plan_path,
       .render = render_path,
       .heeds = {.target_error = true},
       .stream = camera_stream},
      {.name = "photonmapper",
       .summary =
           "global and caustic photon maps, their radii from bias and noise; direct light by next-event estimation",
       .parts = {part::direct, part::specular, "photon paths", "densities of photons"},
       .plan = plan_photon_mapper,
       .render = render_photon_mapper,
       .heeds = {.photons = true, .target_error = true, .view = true},
       .stream = camera_stream,
       .sampling = "path"},
      {.name = "sppm",
       .summary = "stochastic progressive photon mapping with its textbook settings",
       .parts = {part::direct, part::specular, "photon paths", "densities of photons"},
       .plan = plan_photon_mapper,
       .render = render_photon_mapper,
       .heeds = {.target_error = true, .view = true},
       .stream = camera_stream,
       .sampling = "path"},
      {.name = "direct",
       .summary = "emission and light reflected once: next-event estimation and BSDF sampling, MIS",
       .parts = {part::direct, part::weights},
       .plan = plan_direct,
       .render = render_direct,
       .stream = camera_stream,
       .sampling = "path"},
  };
}

std::vector<Integrator> integrators_of_one_path() {
  return {
      {.name = "bdpt",
       .summary = "unbiased bidirectional path tracing: every way of making a path, weighted against the others",
       .parts = {part::camera_paths, part::light_paths, "weights of bdpt"},
       .plan = plan_bdpt,
       .render = render_bdpt,
       .heeds = {.isa = false},
       .media = Integrator::Media::absorbing,
       .dielectric_priorities = true,
       .connects_to_camera = true,
       .stream = bdpt_stream},
      {.name = "ptracer",
       .summary = "unbiased light tracing: paths from the lights, every vertex connected to the camera",
       .parts = {part::light_paths, "splats"},
       .plan = plan_particle_tracer,
       .render = render_particle_tracer,
       .heeds = {.grid = false, .isa = false},
       .media = Integrator::Media::absorbing,
       .dielectric_priorities = true,
       .connects_to_camera = true,
       .stream = ptracer_stream},
      {.name = "volpath",
       .summary = "unbiased path tracing through participating media and nested dielectrics",
       .parts = {part::camera_paths, "media"},
       .plan = plan_volpath,
       .render = render_volpath,
       .heeds = {.isa = false, .target_error = true},
       .media = Integrator::Media::all,
       .dielectric_priorities = true,
       .stream = volpath_stream},
      {.name = "whitted",
       .summary = "mirrors and glass followed exactly, direct light elsewhere, no interreflection",
       .parts = {"rays of whitted"},
       .plan = plan_whitted,
       .render = render_whitted,
       .heeds = {.isa = false, .target_error = true},
       .stream = whitted_stream},
      {.name = "volprim_rf_basic",
       .summary = "a radiance field of ellipsoids: 3D Gaussians blended in the order in which rays enter them",
       .parts = {"ellipsoids"},
       .plan = plan_radiance_field,
       .render = render_radiance_field,
       .heeds = {.isa = false, .target_error = true},
       .stream = radiance_field_stream},
  };
}

}  // namespace

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> table = [] {
    std::vector<Integrator> all = integrators_in_batches();
    for (const Integrator& row : integrators_of_one_path()) all.push_back(row);
    return all;
  }();
  return table;
}

bool Integrator::can_do(const SceneMedia& scene) const {
  const bool scatters =
      std::ranges::any_of(scene.media, [](const Medium& medium) { return medium.scatters || medium.varying; });
  if (scatters && media != Media::all) return false;
  if (!scene.media.empty() && media == Media::none) return false;
  return dielectric_priorities || !scene.any_priority;
}

const Integrator* find_integrator(const std::string& name) {
  for (const Integrator& row : integrators())
    if (name == row.name) return &row;
  return nullptr;
}

RenderPlan plan_render(const SceneFacts& facts, const IntegratorDescription& method, const RenderJob& job) {
  const std::string name = integrator_name(method);
  const Integrator& row = *find_integrator(name);
  Planner planner(facts, job, row.small_limit());
  row.plan(method, planner);
  if (facts.subtracted_by_filter > 0 && job.grid == 0)
    planner.run("negative lobes",
                "the filter's, subtracted: " + std::to_string(negative_samples(facts.subtracted_by_filter, 100)) +
                    " more camera samples for every 100");
  RenderPlan plan = planner.plan();
  plan.method = method;
  plan.scene.hides_lights = method.limits().hide_emitters;
  plan.integrator = name;
  plan.view = job.view;
  plan.may_lose_light = job.view == Aov::whole && may_lose_light(facts, name);
  const Kernels& kernels = job.kernels();
  plan.isa = kernels.isa;
  plan.lanes = kernels.path.lanes;
  return plan;
}

void find_lost_light(const Scene& scene, RenderPlan& plan) {
  if (!plan.may_lose_light) return;
  plan.lost_light = light_lost_by(plan.integrator, scene, plan.method.limits());
  if (!plan.lost_light) return;
  std::erase_if(plan.lost_light->finders, [&](const std::string& name) {
    const Integrator* row = find_integrator(name);
    return row == nullptr || !row->can_do(scene.media);
  });
}

void render(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  stats.skipped = plan.skipped();
  find_integrator(plan.integrator)->render(scene, plan, job, film, stats);
}

}  // namespace photonproof::inline renderer_integrators
