// Photon mapping (Jensen 1996, 2001) with fixed-radius density estimation at the first diffuse hit of a camera path:
//   L = Le + direct (next-event estimation) + rho/pi (sum of caustic fluxes / A_c + sum of global fluxes / A_g)
// where A is the area of that part of the surface whose photons the look-up counts (photon_sheet.h, look_up_area.h).
// The render is cut into passes, each with photons and camera samples of its own: the mean is the same, look-ups are
// cheaper, and the passes' spread gives an honest variance that includes the photons' noise (not the bias of the
// radius).

#include "renderer/integrators/photon_mapper.h"

#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "renderer/integrators/cache_prepass.h"
#include "renderer/integrators/camera_pass.h"
#include "renderer/integrators/photon_maps.h"
#include "renderer/passes/irradiance_cache.h"
#include "renderer/passes/look_up_area.h"
#include "renderer/passes/look_up_bias.h"
#include "renderer/passes/pixel_effort.h"
#include "renderer/passes/render_loop.h"
#include "renderer/scene/aim_targets.h"

namespace photonproof {
namespace {

/// A pass takes a quarter of the samples before it: few enough passes for samples of a pixel to share their look-ups,
/// enough for their spread to give a variance, and none that depends on where the render will end.
constexpr std::int64_t parts_of_samples = 4;

/// Decides on a map; `needed` by the scene, where paths are long enough for one.
void plan_map(Planner& planner, Skip skip, const char* name, const std::string& photons, int max_depth, bool needed,
              const char* why_not_needed, const char* why_needed) {
  // The shortest path through a map has two edges of the light's and one of the camera's.
  const bool deep_enough = max_depth < 0 || max_depth >= 3;
  const char* why = !deep_enough                  ? "paths of max_depth edges are too short for it"
                    : !needed                     ? why_not_needed
                    : planner.facts().lights == 0 ? "no light"
                                                  : nullptr;
  if (!planner.decide(skip, why != nullptr, why != nullptr ? why : "", why_needed)) planner.run(name, photons);
}

/// How many a map gets, and within which radius they are looked up.
std::string photons_words(const PhotonSettings& settings, const RenderBudget& budget, std::int64_t by_scene,
                          double radius) {
  const auto of = [](std::int64_t n) { return counted(static_cast<std::size_t>(n), "photon", "photons"); };
  const std::int64_t total = budget.photons.value_or(by_scene);
  std::string words = settings.textbook ? of(settings.textbook->photons_a_pass) + " in every pass"
                      : total > 0       ? of(total) + " emitted"
                                        : "a photon for four camera samples";
  char number[32];
  std::snprintf(number, sizeof number, "%g", radius);
  if (settings.textbook) {
    words += radius > 0 ? std::string(", at first within ") + number : ", at first within the radius that a pilot says";
    std::snprintf(number, sizeof number, "%g", settings.textbook->alpha);
    return words + ", which shrinks with alpha " + number;
  }
  if (radius > 0) return words + ", looked up within " + number;
  return words + ", looked up within the radius whose bias and noise are least together, as earlier passes show them";
}

/// How far they go.
std::string camera_paths_words(const PhotonSettings& settings, bool any_global_map) {
  if (settings.indirect == IndirectLight::gather && any_global_map)
    return "one bounce further than their first diffuse surface (final gather), or two where that ends nearer than "
           "photons are looked up; there photons of both maps are looked up, at the surfaces before caustic ones";
  if (settings.indirect == IndirectLight::cache && any_global_map) {
    char number[32];
    std::snprintf(number, sizeof number, "%g", settings.cache_error);
    return "to their first diffuse surface, between points of an irradiance cache that is made beforehand (" +
           counted(static_cast<std::size_t>(settings.gather_rays), "ray", "rays") + " a point, error up to " + number +
           "): what it has wrong does not fall with more samples";
  }
  return std::string("to their first diffuse surface, where photons are looked up") +
         (settings.textbook ? "" : ", once for all samples of a pixel that end alike");
}

}  // namespace

void plan_photon_mapper(const IntegratorDescription& description, Planner& planner) {
  const PhotonSettings settings(description);
  const RenderBudget& budget = planner.job().budget;
  const int max_depth = settings.limits.max_depth;
  const SceneFacts& facts = planner.facts();
  const bool any_specular = facts.specular_surfaces > 0;
  plan_map(planner, Skip::global_map, "global photon map",
           photons_words(settings, budget, settings.global_photons, settings.global_radius), max_depth,
           facts.diffuse_interreflection,
           facts.any_diffuse ? "no two diffuse surfaces see each other" : "no diffuse surface reflects",
           "light goes from diffuse surface to diffuse surface");
  plan_map(planner, Skip::caustic_map, "caustic photon map",
           photons_words(settings, budget, settings.caustic_photons, settings.caustic_radius), max_depth,
           any_specular && facts.any_diffuse, any_specular ? "no diffuse surface reflects" : "no specular surface",
           "specular surfaces throw light on diffuse ones");
  if (!planner.plan().skips(Skip::caustic_map)) {
    const std::string surfaces = counted(facts.specular_surfaces, "specular surface", "specular surfaces");
    planner.decide(Skip::stray_photons, any_specular && facts.specular_surfaces <= most_aim_targets,
                   surfaces + " to aim at",
                   surfaces + ", at most " + std::to_string(most_aim_targets) + " can be aimed at");
  }
  planner.run("camera paths",
              camera_paths_words(settings, !planner.plan().skips(Skip::global_map)) + "; " + depth_words(max_depth));
  if (!settings.textbook)
    planner.run("more camera paths", "up to 64 times as many in pixels whose earlier passes disagree");
  if (facts.any_environment)
    planner.run("one more ray", "from where photons are looked up to the environment, which light samples find, too");
  planner.batches();
  planner.direct_light(true);
  if (planner.plan().skips(Skip::global_map) && planner.plan().skips(Skip::caustic_map)) planner.no_light_paths();
}

void render_photon_mapper(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                          RenderStats& stats) {
  const PhotonSettings settings(plan.method);
  const Threads threads(job.threads);
  const PhotonSource source{scene, settings, job, threads};
  PhotonMaps maps(plan, source, stats);
  const bool caches = settings.indirect == IndirectLight::cache && maps.global.wanted;
  if (caches) maps.global.wanted = false;  // the cache has photons of its own
  const std::vector<MapState*> wanted = maps.wanted();
  std::optional<LookUpAreas> areas;
  if (!wanted.empty() || caches) {
    const PhaseTimer phase(stats.phases["build"]);
    areas.emplace(scene, threads);
  }

  LookUpBias bias(film.window());
  PixelEffort effort(film.window());
  PassHalves halves;
  const auto squared_bias = [&] { return bias.evidence(film, LookUpBias::all_maps, halves).squared_bias(); };
  RenderLoop loop(job, threads, film, stats,
                  {.phase = "photon mapping",
                   .longest = settings.textbook ? 1 : 64,
                   .parts = parts_of_samples,
                   .budget = maps.totals(),  // every pass's photons follow from them
                   .squared_bias = squared_bias});
  loop.keep_between_passes(halves);
  for (MapState* map : {&maps.global, &maps.caustic}) {
    loop.keep_between_passes(map->counts);
    loop.keep_between_passes(map->radii);
  }
  loop.keep(bias.pixels());
  loop.keep(bias.narrowings());
  loop.keep(effort.pixels());
  loop.keep(effort.decided());
  CameraPass camera(scene, settings, plan, job, wanted, areas ? &*areas : nullptr, bias, effort);
  std::optional<IrradianceCache> cache;
  if (caches) camera.use(cache.emplace(make_irradiance_cache(plan, source, *areas, film.window(), stats)));
  while (loop.next()) {
    for (MapState* map : wanted) {
      map->tests = areas->tests(map->radii.radius);
      map->pass_photons = static_cast<double>(refill(*map, source, loop.first(), loop.first() + loop.samples(), stats));
    }
    const PhaseTimer phase(stats.phases["render"]);
    loop.for_each_tile([&](const Tile& tile) { camera.render(tile, halves.pass_count(), loop, film); });
    camera.end_pass();
    const auto samples = static_cast<double>(loop.samples());
    film.end_shared_pass(samples);
    if (!settings.textbook) effort.choose();
    halves.add_pass(samples);
    bias.narrow(film, halves);
    const double after_next = halves.all_samples() * (1 + 1.0 / parts_of_samples);
    for (MapState* map : wanted) {
      map->radii.add_pass(samples, map->pass_photons);
      const LookUpBias::Evidence evidence = bias.evidence(film, static_cast<int>(map->kind), halves);
      choose_next_radius(*map, settings, evidence, halves, after_next);
    }
  }
  maps.store_counts(scene.scale(), halves.pass_count(), stats);
  stats.counts["passes"] = static_cast<double>(halves.pass_count());
}

}  // namespace photonproof
