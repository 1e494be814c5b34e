// What every integrator takes and gives back, and the table of them. An integrator is one file and one row.
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

/// The code of ours that integrators run beside what all of them share (CONTRIBUTING, "A batch's life" and "One path
/// at a time"), as sentences on those that fail together name it.
namespace part {
constexpr const char *direct = "direct light", *weights = "weights of lights that bounces meet",
                     *diffuse = "diffuse bounces", *specular = "mirrors and glass",
                     *camera_paths = "camera paths of one path at a time",
                     *light_paths = "light paths of one path at a time";
}  // namespace part

struct Integrator {
  const char* name;
  const char* summary;
  std::vector<const char*> parts;  ///< those of `part`, and its own
  /// What it will do with a scene of these facts, and what it leaves out.
  void (*plan)(const IntegratorDescription&, Planner&);
  /// Renders as `render` below says. The plan is its own, and the scene is built as it says.
  void (*render)(const Scene&, const RenderPlan&, const RenderJob&, Film&, RenderStats&);
  /// What of a job it heeds; the rest is refused rather than ignored (check_supported.h).
  struct Heeds {
    bool photons = false;  ///< the budget's
    bool grid = true;
    bool isa = true;
    bool target_error = false;  ///< its film tells its error after every pass
    bool view = false;          ///< shows other than all light
  } heeds{};
  /// What of a scene it can do.
  enum class Media { none, absorbing, all } media = Media::none;
  bool dielectric_priorities = false;
  /// Whether it can do all of these, in use or not.
  bool can_do(const SceneMedia& scene) const;
  Stream stream;  ///< of its draws; no other's but of those that share their code
  /// The integrator whose code finds its paths; null: its own.
  const char* sampling = nullptr;

  /// Up to how many primitives it traces rays without Embree.
  std::size_t small_limit() const { return heeds.isa ? brute_force_limit : brute_force_limit_of_single_rays; }
};

const std::vector<Integrator>& integrators();
/// Null when there is none of that name.
const Integrator* find_integrator(const std::string& name);

/// Throws InputError where the job cannot be done (an instruction set the processor has not).
RenderPlan plan_render(const SceneFacts& facts, const IntegratorDescription& method, const RenderJob& job);

/// Asks the scene, which was built as the plan says, for light that the integrator cannot find, and puts it into the
/// plan. Partial views are not asked about.
void find_lost_light(const Scene& scene, RenderPlan& plan);

/// Renders into the film until the budget or an interrupt ends it. Deterministic for a given number of samples and
/// photons: neither threads nor time enter the estimates. Passes go through render_loop.h, which gives an integrator
/// budget, progress, Ctrl-C, checkpoints and --resume. The film may be a window of the image: pixels outside of it are
/// not asked for.
void render(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film, RenderStats& stats);

}  // namespace photonproof::inline renderer_integrators
