#include "renderer/integrators/integrator.h"

#include "renderer/integrators/direct_integrator.h"
#include "renderer/integrators/path_integrator.h"
#include "renderer/integrators/photon_mapper.h"
#include "renderer/scalar/bdpt.h"
#include "renderer/scalar/particle_tracer.h"
#include "renderer/scalar/volpath.h"
#include "renderer/scalar/whitted.h"

namespace photonproof {

const std::vector<Integrator>& integrators() {
  static const std::vector<Integrator> table{
      {"path",
       "unbiased path tracing: next-event estimation, MIS, Russian roulette",
       plan_path,
       render_path,
       {.target_error = true}},
      {"photonmapper",
       "global and caustic photon maps of fixed radius, direct light by next-event estimation",
       plan_photon_mapper,
       render_photon_mapper,
       {.photons = true}},
      {"direct", "emission and light reflected once: next-event estimation and BSDF sampling, MIS", plan_direct,
       render_direct},
      {"bdpt",
       "unbiased bidirectional path tracing: every way of making a path, weighted against the others",
       plan_bdpt,
       render_bdpt,
       {.isa = false},
       Integrator::Media::absorbing,
       true},
      {"ptracer",
       "unbiased light tracing: paths from the lights, every vertex connected to the camera",
       plan_particle_tracer,
       render_particle_tracer,
       {.grid = false, .isa = false},
       Integrator::Media::absorbing,
       true},
      {"volpath",
       "unbiased path tracing through participating media and nested dielectrics",
       plan_volpath,
       render_volpath,
       {.isa = false, .target_error = true},
       Integrator::Media::all,
       true},
      {"whitted",
       "mirrors and glass followed exactly, direct light elsewhere, no interreflection",
       plan_whitted,
       render_whitted,
       {.isa = false, .target_error = true}},
  };
  return table;
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
  RenderPlan plan = planner.plan();
  plan.method = method;
  plan.integrator = name;
  const Kernels& kernels = job.kernels();
  plan.isa = kernels.isa;
  plan.lanes = kernels.path.lanes;
  return plan;
}

void render(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats) {
  stats.skipped = plan.skipped();
  find_integrator(plan.integrator)->render(scene, plan, job, film, stats);
}

}  // namespace photonproof
