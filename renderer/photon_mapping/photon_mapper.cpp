// Photon mapping (Jensen 1996, 2001) with fixed-radius density estimation at the first diffuse hit of a camera path.
//   `L = Le + direct (next-event estimation) + rho/pi (sum of caustic fluxes / A_c + sum of global fluxes / A_g)`.
// A is the area of the part of the surface whose photons the gather counts (surface_side.h, gather_area.h). Before that
// hit, rough parts of BSDFs gather caustic photons by their directions (rough_gather.h).
//   `L += sum of f(direction) x flux / A_c`.
// The render is cut into passes, each with photons and camera samples of its own. The mean is the same and gathers are
// cheaper. The passes' spread gives an honest variance that includes the photons' noise, but not the bias of the
// radius. A view (view.h) shows a part of that light, or statistics of the render.

#include "renderer/photon_mapping/photon_mapper.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "renderer/irradiance/irradiance_cache.h"
#include "renderer/light_sampling/scene_lights.h"
#include "renderer/passes/aov.h"
#include "renderer/passes/render_loop.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photon_mapping/adaptive_sample_map.h"
#include "renderer/photon_mapping/cache_prepass.h"
#include "renderer/photon_mapping/camera_pass.h"
#include "renderer/photon_mapping/camera_pilot.h"
#include "renderer/photon_mapping/gather_area.h"
#include "renderer/photon_mapping/gather_bias.h"
#include "renderer/photon_mapping/indirect_choice.h"
#include "renderer/photon_mapping/photon_dots.h"
#include "renderer/photon_mapping/photon_maps.h"
#include "renderer/photon_mapping/radius_pilot.h"
#include "renderer/scene/projection_targets.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr std::int64_t longest_pass = 64;  ///< samples a pixel
constexpr const char* not_shown = "the view does not show it";

/// Decides on a map. `needed` is whether the scene needs it, if paths are long enough.
void plan_map(Planner& planner, Skip skip, const char* name, const std::string& photons, bool shown, int max_depth,
              bool needed, const char* why_not_needed, const char* why_needed) {
  // The shortest path through a map has two edges of the light path and one of the camera path.
  const bool deep_enough = max_depth < 0 || max_depth >= 3;
  const char* why = !shown                        ? not_shown
                    : !deep_enough                ? "paths of max_depth edges are too short for it"
                    : !needed                     ? why_not_needed
                    : planner.facts().lights == 0 ? "no light"
                                                  : nullptr;
  if (!planner.decide(skip, why != nullptr, why != nullptr ? why : "", why_needed)) planner.run(name, photons);
}

/// Throws InputError if the view of cache records has no cache.
void check_cache_is_there(const Planner& planner) {
  for (const RenderPlan::Decision& d : planner.plan().decisions)
    if (d.skip == Skip::global_map && d.skipped)
      throw InputError("--view", "there are no cache-records to show, since there is no global photon map: " + d.why);
}

/// Text on the number of a map's photons and their gather radius.
std::string photons_words(const PhotonSettings& settings, const RenderJob& job, std::int64_t by_scene, double radius) {
  const auto of = [](std::int64_t n) { return counted(static_cast<std::size_t>(n), "photon", "photons"); };
  const std::int64_t total = job.budget.photons.value_or(by_scene);
  std::string words = settings.textbook ? of(settings.textbook->photons_a_pass) + " in every pass"
                      : total > 0       ? of(total) + " emitted"
                                        : "a photon for four camera samples";
  if (job.view == Aov::photons) return words;
  char number[32];
  std::snprintf(number, sizeof number, "%g", radius);
  if (settings.textbook) {
    words +=
        radius > 0 ? std::string(", at first within ") + number : ", at first within the radius that a pilot chooses";
    std::snprintf(number, sizeof number, "%g", settings.textbook->alpha);
    return words + ", which shrinks with alpha " + number;
  }
  if (radius > 0) return words + ", looked up within " + number;
  return words + ", looked up within the radius whose bias and noise are least together, as earlier passes show them";
}

/// Text on the length of camera paths.
std::string camera_paths_words(const PhotonSettings& settings, bool any_global_map) {
  if (settings.indirect == IndirectLight::gather && any_global_map)
    return "one bounce further than their first diffuse surface (final gather), or two where that bounce is shorter "
           "than a gather's radius. There photons of both maps are looked up; at the surfaces before, caustic ones";
  if (settings.indirect == IndirectLight::cache && any_global_map) {
    char number[32];
    std::snprintf(number, sizeof number, "%g", settings.cache_error);
    return "to their first diffuse surface, between points of an irradiance cache that is made beforehand (" +
           counted(static_cast<std::size_t>(settings.gather_rays), "ray", "rays") + " a point, error up to " + number +
           "). Its error does not fall with more samples";
  }
  if (settings.indirect == IndirectLight::path)
    return "on by path tracing; caustic photons are looked up at their first two diffuse surfaces";
  std::string words = "to their first diffuse surface, where photons are looked up";
  if (!settings.textbook) words += ", once for all samples of a pixel that end alike";
  if (settings.indirect == IndirectLight::automatic && any_global_map)
    words += "; or on by path tracing without a global map, if a pilot of up to " + std::to_string(pilot_camera_paths) +
             " of them expects the same error in less time";
  return words;
}

/// Whether the number of samples may differ between pixels.
bool steers_samples(const PhotonSettings& settings, const AovRow& view, const RenderJob& job) {
  return settings.steers_samples && !settings.textbook && view.made_from_all() && job.grid == 0;
}

void plan_camera_pilot(Planner& planner) {
  const SceneFacts& facts = planner.facts();
  const char* why = !facts.any_delta_bsdf                                ? "no mirror and no smooth glass"
                    : !facts.lights_can_be_hit && !facts.any_environment ? "rays meet no light"
                                                                         : nullptr;
  if (!planner.decide(Skip::camera_pilot, why != nullptr, why != nullptr ? why : "",
                      "mirrors or smooth glass may show lights"))
    planner.run(
        "camera pilot",
        "samples beforehand, of no image, find the pixels where a light is rarely met by mirrors or through glass");
}

void plan_camera_paths(Planner& planner, const PhotonSettings& settings, const AovRow& view) {
  planner.run("camera paths", camera_paths_words(settings, !planner.plan().skips(Skip::global_map)) + "; " +
                                  depth_words(settings.limits.max_depth));
  if (steers_samples(settings, view, planner.job())) {
    planner.run("more camera paths", "up to 64 times as many in pixels whose earlier passes disagree");
    plan_camera_pilot(planner);
  }
  if (planner.facts().any_rough && !planner.plan().skips(Skip::caustic_map))
    planner.run("on rough surfaces", "caustic photons are looked up by the directions they came from");
  if (planner.facts().any_environment && view.direct_light)
    planner.run("one more ray", "from where photons are looked up to the environment, which light samples find, too");
  planner.batches();
  const bool lit = view.direct_light || (view.global_map && settings.looks_further());
  if (lit || !planner.decide(Skip::direct_light, true, not_shown, "")) planner.direct_light(true);
}

PassPlan plan_passes(const PhotonSettings& settings, const PhotonMaps& maps) {
  return {.phase = "photon mapping",
          .longest = settings.textbook ? 1 : longest_pass,
          .parts = settings.parts_of_samples,
          .budget = maps.totals() + ", indirect light by " + word_of(settings.indirect)};  // all passes follow from it
}

/// The maps whose light is shown. Where camera paths continue, these include caustics that diffuse surfaces reflect.
/// The plan may also want other maps (--no-skip).
std::vector<MapState*> shown_by(const AovRow& view, IndirectLight indirect, std::vector<MapState*> maps) {
  const bool later_caustics = indirect == IndirectLight::gather || indirect == IndirectLight::path;
  std::erase_if(maps, [&](const MapState* map) {
    return map->kind == PhotonKind::caustic ? !view.caustic_map && !later_caustics : !view.global_map;
  });
  return maps;
}

void keep(RenderLoop& loop, PhotonMaps& maps) {
  for (MapState* map : {&maps.global, &maps.caustic}) {
    loop.keep_between_passes(map->counts);
    loop.keep_between_passes(map->radii);
    loop.keep(map->gathers);
    loop.keep(map->found);
  }
}

/// Whether the map's first radius is tried out: not where the scene or the textbook decides it. A final gather looks up
/// photons a bounce further than the pilot's points are.
bool tries_radii(const MapState& map, const PhotonSettings& settings) {
  const bool gathered = settings.indirect == IndirectLight::gather && map.kind == PhotonKind::global;
  return !map.fixed_radius && !settings.textbook && !gathered;
}

/// Limit of the photons that a pilot's gather finds. On rough surfaces every sample gathers, and values its BSDF for
/// every photon: in the longest pass that shall not take much more time than the sample's rays.
double most_found(const MapState& map, const Scene& scene, const PathSettings& paths) {
  constexpr double valued_in_a_sample = 32;
  if (map.kind != PhotonKind::caustic || !splits_rough_parts(scene, policy_of_maps(scene, paths)))
    return std::numeric_limits<double>::infinity();
  return valued_in_a_sample * static_cast<double>(pilot_photons) / (static_cast<double>(longest_pass) * map.a_sample);
}

/// Least exponent of the squared bias that trials may find. Light between diffuse surfaces is smooth where photons are
/// many. With its edges' exponent, errors on `corridor` and `keyhole` at 256 samples are 2 to 3 % larger.
double least_exponent(const MapState& map) { return map.kind == PhotonKind::caustic ? edge_exponent : smooth_exponent; }

/// Replaces guessed first radii by the best that a pilot finds.
void try_radii(const PhotonSource& source, const RenderPlan& plan, const GatherAreas& areas, const Tile& window,
               const std::vector<MapState*>& maps, RenderStats& stats) {
  const PhaseTimer phase(stats.phases["pilot"]);
  std::optional<RadiusPilot> pilot;
  PathSettings paths = camera_path_settings(source.settings, plan);
  paths.direct_light = DirectLight::weighted;  // also in views without it, whose radii are those of the whole
  for (MapState* map : maps) {
    if (!tries_radii(*map, source.settings) || map->tried) continue;
    map->tried = true;
    if (!pilot) pilot.emplace(source, paths, areas, window);
    const auto emitted = static_cast<double>(pilot_photons);
    map->trials = pilot->try_radii(map->pilot, emitted,
                                   {.least = guessed_radius(*map, emitted),
                                    .most = widest_useful(source.scene),
                                    .most_found = most_found(*map, source.scene, paths),
                                    .least_exponent = least_exponent(*map),
                                    .smooth = map->kind == PhotonKind::global});
    map->pilot = {};
    map->radii.radius = static_cast<float>(guessed_radius(*map, map->radii.first_photons));
  }
}

/// Areas and radii of gathers, made when a method needs them.
struct GatherTools {
  const PhotonSource& source;
  const RenderPlan& plan;
  const Tile window;
  RenderStats& stats;
  std::optional<GatherAreas> areas{};

  const GatherAreas& make_areas() {
    if (areas) return *areas;
    const PhaseTimer phase(stats.phases["build"]);
    return areas.emplace(source.scene, source.threads);
  }
  void try_radii_of(const std::vector<MapState*>& maps) { try_radii(source, plan, make_areas(), window, maps, stats); }
};

/// The choice between the maps and path tracing. Photons are traced, and then radii tried out, only where the maps may
/// win by what is known before: trials cost most where meshes are large.
IndirectChoice choose_indirect(PhotonMaps& maps, GatherTools& tools) {
  const PhotonSource& source = tools.source;
  if (emission_misses_planes(source.scene.surfaces, source.scene.lights))
    return {IndirectLight::path, true, std::string("indirect light by path tracing: ") + light_that_maps_miss};
  IndirectPilots pilots(source, maps, tools.plan, tools.window, tools.stats);
  if (std::optional<IndirectChoice> choice = pilots.choose_without_photons()) return *choice;
  maps.choose_first_radii(source, tools.stats);
  pilots.trace_beside_photons();
  const auto choose = [&] { return choose_indirect(pilots.measured(), source.job.budget, source.job.sample_count); };
  if (IndirectChoice choice = choose(); choice.indirect == IndirectLight::path) return choice;
  tools.try_radii_of(maps.wanted());
  return choose();
}

/// Chooses the method where the settings leave it open, and the first radii. Adds a warning where the chosen maps miss
/// light.
void choose_way(PhotonMaps& maps, GatherTools& tools, PhotonSettings& settings) {
  const bool automatic = settings.indirect == IndirectLight::automatic;
  if (automatic) settings.indirect = IndirectLight::map;
  const Scene& scene = tools.source.scene;
  if (automatic && maps.global.wanted) {
    const IndirectChoice choice = choose_indirect(maps, tools);
    settings.indirect = choice.indirect;
    // A pass takes as many samples as all before, so that passes end where Sobol points are even. Time to equal error
    // on `lens`: 7 % less.
    if (settings.indirect == IndirectLight::path) settings.parts_of_samples = 1;
    maps.caustic.wanted = maps.caustic.wanted && choice.caustic_map;
    settings.steers_samples = settings.indirect != IndirectLight::path || maps.caustic.wanted;
    tools.stats.choices.push_back(choice.why);
  }
  if (maps.global.wanted && settings.indirect != IndirectLight::path &&
      emission_misses_planes(scene.surfaces, scene.lights))
    tools.stats.losses.emplace_back(light_that_maps_miss);
  if (settings.indirect == IndirectLight::path) maps.global.wanted = false;
  maps.choose_first_radii(tools.source, tools.stats);
}

/// Whether an irradiance cache with its own photons replaces the global map. Clears `wanted` of that map if a cache or
/// path tracing replaces it.
bool takes_cache(const PhotonSettings& settings, PhotonMaps& maps) {
  const bool caches = settings.indirect == IndirectLight::cache && maps.global.wanted;
  if (caches || settings.indirect == IndirectLight::path) maps.global.wanted = false;
  return caches;
}

/// Statistics of the image, learned from pass to pass.
struct Lessons {
  const Film& image;
  const std::vector<MapState*> maps;  ///< maps that the gathers use
  GatherBias bias;
  AdaptiveSampleMap effort;
  PassHalves halves{};
  std::optional<CheckedCache> checked{};

  Lessons(const Film& of, const std::vector<MapState*>& looked_up)
      : image(of), maps(looked_up), bias(of.window()), effort(of.window()) {
    for (const MapState* map : maps) bias.set_exponent(static_cast<int>(map->kind), map->trials.exponent());
  }

  double bias_of_cache() const { return checked ? checked->error.squared_bias(image) : 0; }
  double squared_bias() const {
    if (maps.empty()) return bias_of_cache();
    return bias.evidence(image, GatherBias::all_maps, halves).squared_bias() + bias_of_cache();
  }
  /// Squared bias that more samples do not reduce.
  double lasting_bias(const PhotonSettings& settings) const { return bias_of_cache() + bias_of_fixed_radii(settings); }
  double bias_of_fixed_radii(const PhotonSettings& settings) const {
    double sum = 0;
    for (const MapState* map : maps)
      if (map->fixed_radius && !settings.textbook)
        sum += bias.evidence(image, static_cast<int>(map->kind), halves).squared_bias();
    return sum;
  }
  std::string lasting_bias_of(const PhotonSettings& settings) const {
    const std::string fixed = "the radii that the scene fixes have";
    if (!checked) return fixed;
    return bias_of_fixed_radii(settings) > 0 ? "the irradiance cache and " + fixed : "the irradiance cache has";
  }

  void keep(RenderLoop& loop) {
    loop.keep_between_passes(halves);
    loop.keep(bias.pixels());
    loop.keep(bias.narrowings());
    loop.keep(effort.pixels());
    loop.keep(effort.decided());
  }

  /// Decides the radii of the next pass after a pass of `samples`.
  void choose_radii(const PhotonSettings& settings, double samples) {
    halves.add_pass(samples);
    if (maps.empty()) return;
    bias.narrow(image, halves);
    const double after_next = halves.all_samples() * (1 + 1.0 / static_cast<double>(settings.parts_of_samples));
    for (MapState* map : maps) {
      map->radii.add_pass(samples, map->pass_photons);
      const GatherBias::Evidence evidence = bias.evidence(image, static_cast<int>(map->kind), halves);
      choose_next_radius(*map, settings, evidence, halves, after_next);
    }
  }
};

}  // namespace

void plan_photon_mapper(const IntegratorDescription& description, Planner& planner) {
  const RenderJob& job = planner.job();
  const AovRow& view = aov_row(job.view);
  const PhotonSettings settings(description, job);
  const int max_depth = settings.limits.max_depth;
  const SceneFacts& facts = planner.facts();
  const bool any_specular = facts.specular_surfaces > 0;
  if (view.view != Aov::whole) planner.run("view", std::string(view.name) + ": " + view.shows);
  plan_map(planner, Skip::global_map, "global photon map",
           photons_words(settings, job, settings.global_photons, settings.global_radius), view.global_map, max_depth,
           facts.diffuse_interreflection && settings.indirect != IndirectLight::path,
           !facts.any_diffuse              ? "no diffuse surface reflects"
           : facts.diffuse_interreflection ? "path tracing finds its light, as asked for"
                                           : "no two diffuse surfaces see each other",
           "light goes from diffuse surface to diffuse surface");
  if (view.view == Aov::cache_records) check_cache_is_there(planner);
  const bool caustics_shown = view.caustic_map || (view.global_map && settings.looks_further());
  plan_map(planner, Skip::caustic_map, "caustic photon map",
           photons_words(settings, job, settings.caustic_photons, settings.caustic_radius), caustics_shown, max_depth,
           (any_specular && facts.any_diffuse) || (facts.any_sharp && facts.any_rough),
           any_specular ? "no diffuse or rough surface reflects" : "no specular surface",
           facts.any_diffuse ? "specular surfaces throw light on diffuse ones"
                             : "mirrors, glass or sharp highlights throw light on rough surfaces");
  if (!planner.plan().skips(Skip::caustic_map)) {
    const std::string surfaces = counted(facts.specular_surfaces, "specular surface", "specular surfaces");
    planner.decide(Skip::stray_photons, any_specular && facts.specular_surfaces <= most_projection_targets,
                   surfaces + " to aim at",
                   surfaces + ", at most " + std::to_string(most_projection_targets) + " can be aimed at");
  }
  if (view.view == Aov::photons) {
    planner.run("dots", "a shadow ray from every stored photon to the camera, no camera paths");
    planner.batches();
  } else {
    plan_camera_paths(planner, settings, view);
  }
  if (planner.plan().skips(Skip::global_map) && planner.plan().skips(Skip::caustic_map)) planner.no_light_paths();
}

void render_photon_mapper(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                          RenderStats& stats) {
  const AovRow& view = aov_row(plan.view);
  PhotonSettings settings(plan.method, job);
  const Threads threads(job.threads);
  const PhotonSource source{scene, settings, job, threads};
  PhotonMaps maps(plan, source);
  const bool no_areas = plan.view == Aov::photons;
  GatherTools tools{source, plan, film.window(), stats};
  if (!no_areas) choose_way(maps, tools, settings);
  PassPlan passes = plan_passes(settings, maps);
  if (no_areas) return render_photon_dots(source, maps, passes, film, stats);
  passes.subtracted = negative_lobes(scene, job).subtracted();
  passes.combines_passes = true;
  const bool caches = takes_cache(settings, maps);
  const std::vector<MapState*> wanted = maps.wanted();
  if (!wanted.empty() || caches) tools.make_areas();
  tools.try_radii_of(wanted);

  std::optional<Film> unseen;  // the image behind a view of numbers
  if (view.is_number()) unseen.emplace(film.window());
  Film& image = unseen ? *unseen : film;
  Lessons lessons(image, wanted);
  passes.squared_bias = [&] { return lessons.squared_bias(); };
  passes.lasting_bias = [&] { return lessons.lasting_bias(settings); };
  passes.lasting_bias_of = [&] { return lessons.lasting_bias_of(settings); };
  RenderLoop loop(job, threads, image, stats, passes);
  if (unseen) loop.keep(film);
  keep(loop, maps);
  lessons.keep(loop);
  CameraPass camera(scene, settings, plan, job, shown_by(view, settings.indirect, wanted),
                    tools.areas ? &*tools.areas : nullptr, lessons.bias, lessons.effort);
  if (steers_samples(settings, view, job) && !plan.skips(Skip::camera_pilot)) {
    run_camera_pilot(scene, camera_path_settings(settings, plan), job, threads, image.window(), lessons.effort, stats);
    lessons.effort.choose();
  }
  if (caches) {
    lessons.checked.emplace(make_irradiance_cache(plan, source, *tools.areas, film.window(), stats));
    camera.use(lessons.checked->cache);
  }
  while (loop.next()) {
    for (MapState* map : wanted) {
      map->tests = tools.areas->tests(map->radii.radius);
      map->pass_photons = static_cast<double>(refill(*map, source, loop.first(), loop.first() + loop.samples(), stats));
    }
    const PhaseTimer phase(stats.phases["render"]);
    loop.for_each_tile([&](const Tile& tile) {
      camera.render(tile, lessons.halves.pass_count(), loop, image, unseen ? &film : nullptr);
    });
    if (loop.broken_off()) continue;
    const auto samples = static_cast<double>(loop.samples());
    image.end_shared_pass(samples);
    if (unseen) film.end_shared_pass(samples);
    if (steers_samples(settings, view, job)) lessons.effort.choose();
    lessons.choose_radii(settings, samples);
  }
  maps.store_counts(scene, lessons.halves.pass_count(), stats);
  if (lessons.checked) stats.counts["relative_bias_cache"] = std::sqrt(lessons.bias_of_cache());
}

}  // namespace photonproof::inline renderer_photon_mapping
