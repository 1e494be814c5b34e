// The tool with which integrators make their plans: facts, switches, and decisions common to several integrators.
#pragma once

#include <string>
#include <vector>

#include "renderer/passes/render_job.h"
#include "renderer/planning/plan.h"
#include "renderer/planning/plan_words.h"
#include "renderer/planning/scene_facts.h"

namespace photonproof::inline renderer_planning {

/// Up to this many primitives are tested one after the other instead of through Embree. Measured among random
/// parallelograms (rays_bench.cpp, "threshold"): at 128 the packed kernel is 1.8, 1.4 and 0.9 times as fast with 16, 8
/// and 4 lanes. Where primitives do not overlap, Embree does better than that.
inline constexpr std::size_t brute_force_limit = 128;
/// The same for integrators that trace one ray at a time: bdpt on `cornell` (12 parallelograms) is 1.4 times as fast
/// through Embree, on `cornell-spheres` (8 primitives) as fast.
inline constexpr std::size_t brute_force_limit_of_single_rays = 8;

class Planner {
 public:
  /// Decides how the scene is built; at most `small_limit` primitives make a small scene.
  Planner(const SceneFacts& facts, const RenderJob& job, std::size_t small_limit);

  const SceneFacts& facts() const { return facts_; }
  const RenderJob& job() const { return job_; }

  /// Adds a step that runs.
  void run(const std::string& what, const std::string& how) { plan_.runs.push_back({what, how}); }
  /// Decides on a step that is left out where it is `possible` and not switched off. `why` it is possible, or why not.
  bool decide(Skip skip, bool possible, const std::string& why, const std::string& why_not);

  // --- steps common to several integrators ---

  /// Rays of the kernels, and their shading.
  void batches();
  /// Rays of integrators that follow one path at a time.
  void rays_one_by_one();
  /// Next-event estimation by the kernels, weighted against rays that meet lights where the method has both.
  void direct_light(bool weighted_by_method);
  /// No path starts at a light.
  void no_light_paths() { plan_.scene.light_paths = false; }

  const RenderPlan& plan() const { return plan_; }

 private:
  using Decision = RenderPlan::Decision;
  Decision decided(Skip skip, bool possible, const std::string& why, const std::string& why_not) const;
  void list(const Decision& decision) { plan_.decisions.push_back(decision); }

  const SceneFacts& facts_;
  const RenderJob& job_;
  RenderPlan plan_;
  const Decision bvh_, bsdf_groups_, surface_detail_, light_sampling_, far_lights_, shadow_rays_;  ///< of plan_.scene
};

}  // namespace photonproof::inline renderer_planning
