// Photon mapping (Jensen 1996, 2001) with fixed-radius density estimation at the first diffuse hit of a camera path:
//   L = Le + direct (next-event estimation) + rho/pi (sum of caustic fluxes / A_c + sum of global fluxes / A_g)
// where A is the area of that part of the surface whose photons the look-up counts (photon_sheet.h, look_up_area.h).
// The render is cut into passes, each with photons and camera samples of its own: the mean is the same, look-ups are
// cheaper, and the passes' spread gives an honest variance that includes the photons' noise (not the bias of the
// radius).

#include "renderer/integrators/photon_mapper.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <optional>

#include "renderer/integrators/photon_maps.h"
#include "renderer/passes/look_up_area.h"
#include "renderer/passes/render_loop.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photons/query_order.h"
#include "renderer/scene/aim_targets.h"
#include "scenes/text/faults.h"

namespace photonproof {
namespace {

/// Decides on a map; `needed` by the scene, where paths are long enough for one.
void plan_map(Planner& planner, Skip skip, const char* name, std::int64_t photons, int max_depth, bool needed,
              const char* why_not_needed, const char* why_needed) {
  // The shortest path through a map has two edges of the light's and one of the camera's.
  const bool deep_enough = max_depth < 0 || max_depth >= 3;
  const std::int64_t asked = planner.job().budget.photons.value_or(photons);
  const char* why = !deep_enough                  ? "paths of max_depth edges are too short for it"
                    : !needed                     ? why_not_needed
                    : planner.facts().lights == 0 ? "no light"
                    : asked <= 0                  ? "no photons asked for"
                                                  : nullptr;
  if (!planner.decide(skip, why != nullptr, why != nullptr ? why : "", why_needed))
    planner.run(name, counted(std::size_t(std::max<std::int64_t>(asked, 0)), "photon", "photons") + " emitted");
}

/// Adds to the paths' radiance what one map's photons bring to their gather points. Returns how many were found.
std::uint64_t add_photons(const MapState& state, const LookUpAreas& areas, const Kernels& kernels, int max_depth,
                          GatherQueue& queue, std::vector<float>& radiance) {
  if (state.map.empty()) return 0;
  if (has_fault(Fault::missing_caustic) && state.kind == PhotonKind::caustic) return 0;
  const GatherPoints points = queue.view();
  std::fill_n(points.radius, points.count, state.radius);
  const std::vector<std::uint32_t> order = cell_order(state.map, queue);
  const int max_edges = max_depth >= 0 ? max_depth : std::numeric_limits<int>::max();
  kernels.gather.gather({state.map.view(), max_edges, points, order.data(), state.tests.data()});
  areas.fill(queue);
  if (has_fault(Fault::dim_caustic) && state.kind == PhotonKind::caustic)
    for (std::size_t i = 0; i < points.count; ++i) points.area[i] /= 0.95f;
  kernels.gather.add(points, radiance.data());
  return std::accumulate(points.found, points.found + points.count, std::uint64_t{0});
}

/// The camera paths of a pass, and what the maps bring to their ends.
class CameraPass {
 public:
  CameraPass(const Scene& scene, const RenderPlan& plan, const RenderJob& job, std::vector<MapState*> maps,
             const LookUpAreas* areas)
      : scene_(scene), job_(job), maps_(std::move(maps)), areas_(areas), scratch_(job.kernels().path.scratch) {
    const auto& method = std::get<PhotonMapperDescription>(plan.method.method);
    settings_ = {method.max_depth, method.rr_depth, method.hide_emitters,
                 plan.skips(Skip::mis) ? DirectLight::unweighted : DirectLight::weighted};
  }

  void render(const Tile& tile, RenderLoop& loop, Film& film) {
    const CameraTask camera = camera_task(job_, tile, loop.first(), loop.samples());
    std::vector<float> radiance(3 * std::size_t{camera.paths()});
    GatherQueue queue(camera.paths());
    PathTask task{.scene = &scene_.view(),
                  .camera = camera,
                  .settings = settings_,
                  .at_diffuse = AtDiffuse::leave_gather_point,
                  .radiance = radiance.data(),
                  .points = queue.view()};
    scratch_.lend([&](std::uint32_t* words) {
      task.scratch = words;
      job_.kernels().path.trace(task);
    });
    queue.set_size(task.points.count);
    look_ups_ += queue.size();
    for (MapState* map : maps_)
      map->found += add_photons(*map, *areas_, job_.kernels(), settings_.max_depth, queue, radiance);
    add_means(film, camera, radiance);
    loop.rays().add(task.counts);
  }

  /// Hands the pass's counts to the maps.
  void end_pass() {
    const std::uint64_t look_ups = look_ups_.exchange(0);
    for (MapState* map : maps_) {
      map->counts.look_ups += look_ups;
      map->counts.found += map->found.exchange(0);
    }
  }

 private:
  const Scene& scene_;
  const RenderJob& job_;
  const std::vector<MapState*> maps_;
  const LookUpAreas* const areas_;  ///< null without maps
  PathSettings settings_;
  ScratchPool scratch_;
  std::atomic<std::uint64_t> look_ups_{0};
};

}  // namespace

void plan_photon_mapper(const IntegratorDescription& description, Planner& planner) {
  const auto& method = std::get<PhotonMapperDescription>(description.method);
  const SceneFacts& facts = planner.facts();
  const bool any_specular = facts.specular_surfaces > 0;
  plan_map(planner, Skip::global_map, "global photon map", method.global_photons, method.max_depth,
           facts.diffuse_interreflection,
           facts.any_diffuse ? "no two diffuse surfaces see each other" : "no diffuse surface reflects",
           "light goes from diffuse surface to diffuse surface");
  plan_map(planner, Skip::caustic_map, "caustic photon map", method.caustic_photons, method.max_depth,
           any_specular && facts.any_diffuse, any_specular ? "no diffuse surface reflects" : "no specular surface",
           "specular surfaces throw light on diffuse ones");
  if (!planner.plan().skips(Skip::caustic_map)) {
    const std::string surfaces = counted(facts.specular_surfaces, "specular surface", "specular surfaces");
    planner.decide(Skip::stray_photons, any_specular && facts.specular_surfaces <= most_aim_targets,
                   surfaces + " to aim at",
                   surfaces + ", at most " + std::to_string(most_aim_targets) + " can be aimed at");
  }
  planner.run("camera paths", "to their first diffuse surface, where photons within a fixed radius are looked up; " +
                                  depth_words(method.max_depth));
  planner.batches();
  planner.direct_light(true);
  if (planner.plan().skips(Skip::global_map) && planner.plan().skips(Skip::caustic_map)) planner.no_light_paths();
}

void render_photon_mapper(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                          RenderStats& stats) {
  const auto& method = std::get<PhotonMapperDescription>(plan.method.method);
  const Threads threads(job.threads);
  const PhotonSource source{scene, method, job, threads};
  PhotonMaps maps(plan, source, stats);
  const std::vector<MapState*> wanted = maps.wanted();
  std::optional<LookUpAreas> areas;
  if (!wanted.empty()) {
    const PhaseTimer phase(stats.phases["build"]);
    areas.emplace(scene, threads);
    for (MapState* map : wanted) map->tests = areas->tests(map->radius);
  }

  const std::int64_t spp = job.budget.spp.value_or(job.sample_count);
  // Sixteen passes give a usable variance; with a time budget every pass is one sample, so that the image depends on
  // the number of passes alone.
  PassPlan passes{.phase = "photon mapping", .longest = job.budget.seconds ? 1 : std::max<std::int64_t>(1, spp / 16)};
  passes.budget = maps.totals();  // the radii and every pass's photons follow from them
  if (!job.budget.seconds) passes.budget += " over " + std::to_string(spp) + " samples a pixel";
  RenderLoop loop(job, threads, film, stats, passes);
  std::int64_t pass_count = 0;
  loop.keep_between_passes(pass_count);
  for (MapState* map : {&maps.global, &maps.caustic}) loop.keep_between_passes(map->counts);
  CameraPass camera(scene, plan, job, wanted, areas ? &*areas : nullptr);
  for (; loop.next(); ++pass_count) {
    for (MapState* map : wanted) refill(*map, source, loop.first(), loop.first() + loop.samples(), spp, stats);
    const PhaseTimer phase(stats.phases["render"]);
    loop.for_each_tile([&](const Tile& tile) { camera.render(tile, loop, film); });
    camera.end_pass();
    film.end_shared_pass(static_cast<double>(loop.samples()));
  }
  maps.store_counts(scene.scale(), pass_count, stats);
  stats.counts["passes"] = static_cast<double>(pass_count);
}

}  // namespace photonproof
