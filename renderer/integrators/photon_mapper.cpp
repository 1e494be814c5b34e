// Photon mapping (Jensen 1996, 2001) with fixed-radius density estimation at the first diffuse hit of a camera path:
//   L = Le + direct (next-event estimation) + rho/pi (sum of caustic fluxes / A_c + sum of global fluxes / A_g)
// where A is the area of that part of the surface whose photons the look-up counts (photon_sheet.h, look_up_area.h).
// The render is cut into passes, each with photons and camera samples of its own: the mean is the same, look-ups are
// cheaper, and the passes' spread gives an honest variance that includes the photons' noise (not the bias of the
// radius).

#include "renderer/integrators/photon_mapper.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "renderer/passes/look_up_area.h"
#include "renderer/passes/photon_radius.h"
#include "renderer/passes/photon_tracing.h"
#include "renderer/passes/render_loop.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photons/photon_map.h"
#include "renderer/photons/query_order.h"
#include "renderer/scene/aim_targets.h"
#include "scenes/text/faults.h"

namespace photonproof {
namespace {

constexpr std::int64_t photons_per_sample = 50'000;  // with a time budget: emitted for each camera sample a pixel
constexpr std::uint64_t pilot_photons = 20'000;
constexpr std::uint64_t most_photons_in_a_pass = 10'000'000;  // a map of them takes about a gigabyte

/// What a pass leaves to the next one: its photons are gone by then.
struct PhotonCounts {
  std::uint64_t emitted = 0;
  std::uint64_t stored = 0;
  std::uint64_t rays = 0;
  std::uint64_t look_ups = 0;
  std::uint64_t found = 0;  ///< by all of them

  /// In the disc of a look-up, over the whole render: each pass has a part of the photons.
  double in_disc(std::int64_t passes) const {
    return static_cast<double>(found) / static_cast<double>(std::max<std::uint64_t>(1, look_ups)) *
           static_cast<double>(passes);
  }
};

/// One of the two maps, with what it takes to refill it every pass.
struct MapState {
  PhotonKind kind;
  Stream stream;
  const char* name;
  double photons_in_disc;  ///< the automatic radius aims at this many over the whole render
  bool wanted = false;
  bool aimed = false;      ///< emitted towards specular surfaces only
  std::int64_t total = 0;  ///< photons to emit over the whole render
  float radius = 0;
  std::vector<SheetTest> tests{};  ///< by surface
  PhotonCounts counts{};
  std::atomic<std::uint64_t> found{0};  ///< in this pass
  PhotonMap map{};
};

// Measured on cornell-spheres at 256^2, 1e6 photons, 32 samples a pixel: global discs of 50, 130, 350, 900 photons gave
// relmse .0029, .0021, .0017, .0016; caustic discs of 20 and 7 photons .0017 and .0014. Pixels average many look-ups,
// so smooth indirect light wants a wide disc and sharp caustics a small one.
struct Maps {
  MapState global{PhotonKind::global, Stream::global_photon, "global", 350};
  MapState caustic{PhotonKind::caustic, Stream::caustic_photon, "caustic", 8};
};

/// Fewer in a disc than this, and the spread that is seen may miss the few that carry the light.
constexpr double few_photons_in_disc = 10;
/// A map of fewer says that hardly any light goes that way, not that it goes elsewhere.
constexpr std::uint64_t few_photons_in_map = 1000;

/// Adds to the paths' radiance what one map's photons bring to their gather points. Returns how many were found.
std::uint64_t add_photons(const MapState& state, const LookUpAreas& areas, const Kernels& kernels, int max_depth,
                          const std::vector<GatherPoint>& points, std::vector<float>& radiance) {
  if (state.map.empty()) return 0;
  if (has_fault(Fault::missing_caustic) && state.kind == PhotonKind::caustic) return 0;
  const bool is_dim = has_fault(Fault::dim_caustic) && state.kind == PhotonKind::caustic;
  const std::vector<std::uint32_t> order = cell_order(state.map, points);
  std::vector<GatheredFlux> flux(points.size());
  const int max_edges = max_depth >= 0 ? max_depth : std::numeric_limits<int>::max();
  kernels.gather_photons({.map = state.map.view(),
                          .radius = state.radius,
                          .max_edges = max_edges,
                          .points = points.data(),
                          .order = order.data(),
                          .count = points.size(),
                          .flux = flux.data(),
                          .tests = state.tests.data()});
  std::uint64_t found = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (flux[i].count == 0) continue;
    found += static_cast<std::uint64_t>(flux[i].count);
    const GatherPoint& point = points[i];
    const float divisor = areas.divisor(point, has_fault(Fault::density_radius) ? 1.1f * state.radius : state.radius);
    if (!(divisor > 0)) continue;
    const Rgb added = point.weight * flux[i].flux / (is_dim ? divisor / 0.95f : divisor);
    float* out = &radiance[3 * std::size_t{point.path}];
    out[0] += added.x;
    out[1] += added.y;
    out[2] += added.z;
  }
  return found;
}

/// A map without a radius gets one from the pilot; a map whose pilot stores nothing is small enough for any radius.
void choose_radii(const Scene& scene, const PhotonMapperDescription& settings, const RenderJob& job, Maps& maps,
                  const Threads& threads, RayTotals& totals) {
  maps.global.radius = static_cast<float>(settings.global_radius * scene.scale());
  maps.caustic.radius = static_cast<float>(settings.caustic_radius * scene.scale());
  for (MapState* state : {&maps.global, &maps.caustic}) {
    if (!state->wanted || state->radius > 0) continue;
    const PhotonRun pilot{state->kind, Stream::pilot, job.seed, 0, pilot_photons, -1, state->aimed};
    state->radius = choose_radius(scene, pilot, static_cast<std::uint64_t>(state->total), state->photons_in_disc,
                                  {job.kernels(), job.sampler}, threads, totals);
    if (state->radius <= 0) state->radius = 4 * std::max(median_pixel_footprint(scene), 1e-6f);
  }
}

/// Replaces the map's photons by the `count` that follow those emitted before.
void refill(MapState& state, const Scene& scene, const PhotonMapperDescription& settings, const RenderJob& job,
            std::uint64_t count, const Threads& threads, RenderStats& stats) {
  Photons photons;
  {
    const PhaseTimer phase(stats.phases[std::string("photons_") + state.name]);
    const int max_edges = settings.max_depth >= 0 ? settings.max_depth - 1 : -1;
    const std::uint64_t traced = has_fault(Fault::half_photons) ? (count + 1) / 2 : count;
    const std::uint64_t seed = has_fault(Fault::same_photons) ? 1 : job.seed;
    RayTotals rays;
    photons =
        trace_photons(scene, {state.kind, state.stream, seed, state.counts.emitted, traced, max_edges, state.aimed},
                      {job.kernels(), job.sampler}, threads, rays);
    state.counts.rays += rays.counts().photon;
  }
  const PhaseTimer phase(stats.phases["build"]);
  state.map.build(std::move(photons), state.radius, threads);
  state.counts.emitted += count;
  state.counts.stored += state.map.size();
}

void store_counts(const MapState& state, const Scene& scene, std::int64_t passes, RenderStats& stats) {
  if (!state.wanted) return;
  const std::string name = state.name;
  stats.counts["photons_emitted_" + name] = static_cast<double>(state.counts.emitted);
  stats.counts["photons_stored_" + name] = static_cast<double>(state.counts.stored);
  stats.counts["radius_" + name] = state.radius / scene.scale();
  stats.counts["rays_photon"] += static_cast<double>(state.counts.rays);
  stats.counts["photons_in_disc_" + name] = state.counts.in_disc(passes);
}

/// Of the map that holds the light of every surface; caustics are nowhere but in places.
void say_if_few_arrive(const MapState& global, std::int64_t passes, RenderStats& stats) {
  const double in_disc = global.counts.in_disc(passes);
  if (!global.wanted || global.counts.look_ups == 0 || global.counts.stored < few_photons_in_map ||
      in_disc >= few_photons_in_disc)
    return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "of %.3g photons %.2g are in the disc of a look-up: too few arrive where the camera looks for the error "
      "to be known",
      static_cast<double>(global.counts.emitted), in_disc);
  stats.losses.emplace_back(text);
}

/// Photons of a map for the pass that takes samples [first, last) of `spp`; at least one, so that a pass has a map.
/// Throws InputError when they would not fit in memory.
std::uint64_t photons_for_pass(const MapState& state, const RenderJob& job, std::int64_t first, std::int64_t last,
                               std::int64_t spp) {
  const auto until = [&](std::int64_t s) {
    return static_cast<std::int64_t>(static_cast<double>(state.total) * static_cast<double>(s) /
                                     static_cast<double>(spp));
  };
  const auto count = static_cast<std::uint64_t>(std::max<std::int64_t>(1, until(last) - until(first)));
  if (count > most_photons_in_a_pass)
    throw InputError(job.budget.photons ? "--photons" : job.integrator_place,
                     (job.budget.photons ? std::string() : std::string(state.name) + "_photons: ") +
                         std::to_string(count) + " in one pass are more than " +
                         std::to_string(most_photons_in_a_pass) +
                         ", the most that are kept at once; more samples a pixel make more passes");
  return count;
}

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
  const auto settings = std::get<PhotonMapperDescription>(plan.method.method);
  const Threads threads(job.threads);
  Maps maps;
  maps.global.wanted = !plan.skips(Skip::global_map);
  maps.global.total = job.budget.photons.value_or(settings.global_photons);
  maps.caustic.wanted = !plan.skips(Skip::caustic_map);
  maps.caustic.aimed = plan.skips(Skip::stray_photons);
  maps.caustic.total = job.budget.photons.value_or(settings.caustic_photons);
  {
    const PhaseTimer phase(stats.phases["pilot"]);
    RayTotals pilot_rays;
    choose_radii(scene, settings, job, maps, threads, pilot_rays);
    pilot_rays.store(stats);
  }
  std::optional<LookUpAreas> areas;
  if (maps.global.wanted || maps.caustic.wanted) {
    const PhaseTimer phase(stats.phases["build"]);
    areas.emplace(scene, threads);
    for (MapState* state : {&maps.global, &maps.caustic}) state->tests = areas->tests(state->radius);
  }

  const std::int64_t spp = job.budget.spp.value_or(job.sample_count);
  // Sixteen passes give a usable variance; with a time budget every pass is one sample, so that the image depends on
  // the number of passes alone.
  PassPlan passes{.phase = "photon mapping", .longest = job.budget.seconds ? 1 : std::max<std::int64_t>(1, spp / 16)};
  // The radii and every pass's photons follow from the totals.
  passes.budget =
      std::to_string(maps.global.total) + " global and " + std::to_string(maps.caustic.total) + " caustic photons";
  if (!job.budget.seconds) passes.budget += " over " + std::to_string(spp) + " samples a pixel";
  RenderLoop loop(job, threads, film, stats, passes);
  ScratchPool scratch(job.kernels().path_scratch);
  std::int64_t pass_count = 0;
  loop.keep_between_passes(pass_count);
  for (MapState* state : {&maps.global, &maps.caustic}) loop.keep_between_passes(state->counts);
  for (; loop.next(); ++pass_count) {
    for (MapState* state : {&maps.global, &maps.caustic}) {
      if (!state->wanted) continue;
      const std::uint64_t count = job.budget.seconds
                                      ? static_cast<std::uint64_t>(photons_per_sample * loop.samples())
                                      : photons_for_pass(*state, job, loop.first(), loop.first() + loop.samples(), spp);
      refill(*state, scene, settings, job, count, threads, stats);
    }
    const PhaseTimer phase(stats.phases["render"]);
    std::atomic<std::uint64_t> look_ups{0};
    loop.for_each_tile([&](const Tile& tile) {
      const CameraTask camera = camera_task(job, tile, loop.first(), loop.samples());
      std::vector<float> radiance(3 * std::size_t{camera.paths()});
      std::vector<GatherPoint> points(camera.paths());
      PathTask task{.scene = &scene.view(),
                    .camera = camera,
                    .settings = {settings.max_depth, settings.rr_depth, settings.hide_emitters, !plan.skips(Skip::mis)},
                    .radiance = radiance.data(),
                    .gather_points = points.data()};
      scratch.lend([&](std::uint32_t* words) {
        task.scratch = words;
        job.kernels().trace_paths(task);
      });
      points.resize(task.gather_count);
      look_ups += points.size();
      for (MapState* state : {&maps.caustic, &maps.global})
        if (state->wanted)
          state->found += add_photons(*state, *areas, job.kernels(), settings.max_depth, points, radiance);
      add_means(film, camera, radiance);
      loop.rays().add(task.counts);
    });
    for (MapState* state : {&maps.global, &maps.caustic}) {
      state->counts.look_ups += look_ups;
      state->counts.found += state->found.exchange(0);
    }
    film.end_shared_pass(static_cast<double>(loop.samples()));
  }
  for (const MapState* state : {&maps.global, &maps.caustic}) store_counts(*state, scene, pass_count, stats);
  say_if_few_arrive(maps.global, pass_count, stats);
  stats.counts["passes"] = static_cast<double>(pass_count);
}

}  // namespace photonproof
