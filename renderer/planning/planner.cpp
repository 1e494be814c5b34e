#include "renderer/planning/planner.h"

namespace photonproof::inline renderer_planning {
namespace {

std::string primitives(const SceneFacts& facts) { return counted(facts.primitives, "primitive", "primitives"); }
std::string lights(const SceneFacts& facts) { return counted(facts.lights, "light", "lights"); }

}  // namespace

Planner::Planner(const SceneFacts& facts, const RenderJob& job, std::size_t small_limit)
    : facts_(facts),
      job_(job),
      bvh_(decided(Skip::bvh, facts.primitives <= small_limit && facts.simple_primitives,
                   primitives(facts) + ", tested one after the other",
                   !facts.simple_primitives
                       ? "not all shapes are parallelograms, triangles and spheres of moderate size"
                       : primitives(facts) + ", more than " + std::to_string(small_limit))),
      bsdf_groups_(decided(Skip::bsdf_groups, facts.bsdf_kinds == 1, "all BSDFs are of one kind",
                           counted(facts.bsdf_kinds, "kind", "kinds") + " of BSDF")),
      surface_detail_(decided(Skip::surface_detail, facts.all_plain,
                              "no textures, shading normals, tangents or nested BSDFs",
                              "there are textures, shading normals, tangents or nested BSDFs")),
      light_sampling_(decided(Skip::light_sampling, facts.lights <= 1, lights(facts), lights(facts))),
      far_lights_(decided(Skip::far_lights, facts.many_lights,
                          lights(facts) + ", chosen by a tree over where they are and shine to",
                          lights(facts) + ", chosen by their flux")),
      shadow_rays_(decided(Skip::shadow_rays, true, "where the light or the BSDF gives nothing, none is traced", "")) {
  plan_.scene.small = bvh_.skipped;
  plan_.scene.one_bsdf_kind = bsdf_groups_.skipped;
  plan_.scene.detailed = !surface_detail_.skipped;
  plan_.scene.one_light = light_sampling_.skipped;
  plan_.scene.lights_by_position = far_lights_.skipped;
  plan_.scene.dark_shadow_rays = !shadow_rays_.skipped;
}

RenderPlan::Decision Planner::decided(Skip skip, bool possible, const std::string& why,
                                      const std::string& why_not) const {
  if (possible && !job_.skips.on(skip)) return {skip, false, "switched off by --no-skip, though " + why};
  return {skip, possible, possible ? why : why_not};
}

bool Planner::decide(Skip skip, bool possible, const std::string& why, const std::string& why_not) {
  list(decided(skip, possible, why, why_not));
  return plan_.decisions.back().skipped;
}

void Planner::batches() {
  list(bvh_);
  run("rays", bvh_.skipped ? "packed kernel over all primitives"
                           : "Embree, in packets from the camera and among flat faces, others one by one");
  list(bsdf_groups_);
  list(surface_detail_);
}

void Planner::rays_one_by_one() {
  run("rays", bvh_.skipped ? "one by one against all primitives" : "one by one through Embree");
}

void Planner::direct_light(bool weighted_by_method) {
  list(light_sampling_);
  if (facts_.lights > 1) list(far_lights_);
  list(shadow_rays_);
  if (weighted_by_method)
    decide(Skip::mis, !facts_.lights_can_be_hit,
           facts_.lights == 0 ? "there is no light" : "every light is a point, no ray can hit one",
           "rays can hit a light that next-event estimation samples too");
}

}  // namespace photonproof::inline renderer_planning
