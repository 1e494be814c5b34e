// The interface of all integrators, and the table of them. An integrator is one file and one row.
#pragma once

#include <string>
#include <vector>

#include "renderer/lanes/sampler.h"
#include "renderer/passes/render_job.h"
#include "renderer/planning/integrator_name.h"
#include "renderer/planning/planner.h"
#include "renderer/scene/scene.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_integrators {

/// Parts of our code that integrators use besides the common code (CONTRIBUTING, "A batch's life" and "One path at a
/// time"). Diagnoses name these parts when the integrators that share one fail together.
namespace part {
constexpr const char *direct = "direct light", *weights = "weights of lights that bounces meet",
                     *diffuse = "diffuse bounces", *specular = "mirrors and glass",
                     *camera_paths = "camera paths of one path at a time",
                     *light_paths = "light paths of one path at a time";
}  // namespace part

struct Integrator {
  const char* name;
  const char* summary;
  std::vector<const char*> parts;  ///< parts from `part`, and its own
  /// Plans the render of a scene with these facts, including the parts that are left out.
  void (*plan)(const IntegratorDescription&, Planner&);
  /// Renders like `render` below. The plan is the integrator's own, and the scene is built by it.
  void (*render)(const Scene&, const RenderPlan&, const RenderJob&, Film&, RenderStats&);
  /// Parts of a job that it supports; others are refused rather than ignored (check_supported.h).
  struct Heeds {
    bool photons = false;  ///< the budget's number of photons
    bool grid = true;
    bool isa = true;
    bool target_error = false;  ///< its film estimates its error after every pass
    bool view = false;          ///< views other than all light
  } heeds{};
  /// Scene features that it supports.
  enum class Media { none, absorbing, all } media = Media::none;
  bool dielectric_priorities = false;
  bool connects_to_camera = false;  ///< points of the scene, for which the camera must have one place
  /// Whether it supports all of these, in use or not.
  bool can_do(const SceneMedia& scene) const;
  Stream stream;  ///< Stream of its random numbers, shared only with integrators that share code.
  /// Name of the integrator whose code samples its paths; null for its own code.
  const char* sampling = nullptr;

  /// Largest number of primitives for which it traces rays without Embree.
  std::size_t small_limit() const { return heeds.isa ? brute_force_limit : brute_force_limit_of_single_rays; }
};

const std::vector<Integrator>& integrators();
/// Null when no integrator has that name.
const Integrator* find_integrator(const std::string& name);

/// Throws InputError where the job cannot be done (for instance an instruction set that the processor lacks).
RenderPlan plan_render(const SceneFacts& facts, const IntegratorDescription& method, const RenderJob& job);

/// Surveys the scene, built by the plan, for light that the integrator cannot find, and enters it in the plan. Partial
/// views are not surveyed.
void find_lost_light(const Scene& scene, RenderPlan& plan);

/// Renders into the film until the budget or an interrupt ends it. Deterministic for a given number of samples and
/// photons: neither threads nor time enter the estimates. Passes use render_loop.h, which gives an integrator budget,
/// progress, Ctrl-C, checkpoints and --resume. The film may be a window of the image; pixels outside it are not
/// accessed.
void render(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
