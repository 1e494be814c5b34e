#include "renderer/photon_mapping/photon_maps.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "renderer/photon_mapping/photon_radius.h"
#include "renderer/photons/query_order.h"
#include "scenes/base/faults.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr double photons_a_camera_path = 0.25;          // for each map: gathers and paths then take about equal time
constexpr std::int64_t fewest_photons_a_pass = 16'384;  // small images need enough for their mean, too
constexpr double guessed_for = 1e6;                     // emitted photons that MapState::photons_in_disc refers to

/// Photons in a disc of gathers one bounce further: many directions average their noise but not their bias. The passes'
/// evidence tells little about the best radius for them, since directions cause most of its noise.
constexpr double gathered_photons_in_disc = 100;

/// Minimum of passes in each half for sufficient evidence.
constexpr std::int64_t least_evidence = 2;
/// Limits of a radius's change from pass to pass.
constexpr double most_shrinking = 0.75, most_growing = 1.25;
/// Limits of a radius, as factors of the first guess.
constexpr double widest = 4, narrowest = 1.0 / 16;

/// With fewer photons in a disc, the observed spread may miss the few photons that carry the light.
constexpr double few_photons_in_disc = 10;
/// Threshold of stored and of emitted photons. A map with fewer, and with a small share of those emitted, carries
/// hardly any light. With fewer emitted, nothing is known.
constexpr std::uint64_t few_photons_in_map = 1000;
constexpr double small_share = 0.01;
/// Nearly empty maps get one photon in so many.
constexpr int photons_for_one_of_few = 16;
/// Radius that blurs all shades of light, as a share of the visible extent.
constexpr double wide_part = 0.25;

/// Cuts the number of photons of a map where the pilot stores none; not where the number is asked for.
void emit_few(MapState& map) {
  map.nearly_empty = true;
  map.a_sample /= photons_for_one_of_few;
  map.least /= photons_for_one_of_few;
}

void choose_first_radius(MapState& map, double asked, const PhotonSource& source, RayTotals& totals) {
  float& radius = map.radii.radius;
  if (radius > 0) return;  // chosen before
  radius = static_cast<float>(asked * source.scene.scale());
  map.fixed_radius = radius > 0;
  if (!map.wanted || map.fixed_radius) return;
  const PhotonRun pilot{map.kind, pilot_stream, source.job.seed, 0, pilot_photons, -1, map.aimed};
  RayTotals rays;
  map.pilot = trace_photons(source.scene, pilot, {source.job.kernels(), source.job.sampler}, source.threads, rays);
  map.rays_a_photon = static_cast<double>(rays.counts().photon) / static_cast<double>(pilot_photons);
  totals.add(rays.counts());
  if (map.pilot.size() == 0 && map.least > 1) emit_few(map);
  radius = guess_radius(source.scene, map.pilot, static_cast<double>(pilot_photons), guessed_for, map.photons_in_disc,
                        source.threads);
  // A pilot that stores nothing means a map small enough for any radius.
  if (radius <= 0) radius = 4 * std::max(median_pixel_footprint(source.scene), 1e-6f);
  map.radii.first_photons = std::max(map.a_sample, static_cast<double>(map.least));
  radius *= static_cast<float>(shrunk(map.radii.first_photons / guessed_for));
  map.radii.first_radius = static_cast<double>(radius);
}

/// Decides the number of photons of the passes.
void choose_photons(MapState& map, std::int64_t by_scene, const PhotonSource& source) {
  if (source.settings.textbook) {
    map.a_sample = static_cast<double>(source.settings.textbook->photons_a_pass);
    return;
  }
  const RenderBudget& budget = source.job.budget;
  const std::int64_t total = budget.photons.value_or(by_scene);
  if (total > 0) {
    map.a_sample = static_cast<double>(total) / static_cast<double>(budget.spp.value_or(source.job.sample_count));
    return;
  }
  const CameraView& camera = source.scene.view().camera;
  const double pixels = 1 / (static_cast<double>(camera.inverse_width) * static_cast<double>(camera.inverse_height));
  map.a_sample = photons_a_camera_path * pixels;
  map.least = fewest_photons_a_pass;
}

void say_if_few_are_emitted(const MapState& map, RenderStats& stats) {
  if (!map.wanted || !map.nearly_empty) return;
  char text[160];
  std::snprintf(text, sizeof text, "one photon in %d for the %s map: of %llu light paths none leaves a photon",
                photons_for_one_of_few, map.name, static_cast<unsigned long long>(pilot_photons));
  stats.choices.emplace_back(text);
}

void store_counts_of(const MapState& state, double scale, std::int64_t passes, RenderStats& stats) {
  if (!state.wanted) return;
  const std::string name = state.name;
  stats.counts["photons_emitted_" + name] = static_cast<double>(state.counts.emitted);
  stats.counts["photons_stored_" + name] = static_cast<double>(state.counts.stored);
  stats.counts["rays_photon"] += static_cast<double>(state.counts.rays);
  if (state.radii.radius <= 0) return;  // there were no gathers
  stats.counts["radius_" + name] = static_cast<double>(state.radii.radius) / scale;
  stats.counts["photons_in_disc_" + name] = state.in_disc(passes);
}

/// Extent of the visible scene along the image's shorter side.
double extent_seen(const Scene& scene) {
  const CameraView& camera = scene.view().camera;
  return double{median_pixel_footprint(scene)} / double{std::min(camera.inverse_width, camera.inverse_height)};
}

/// Adds a warning where the scene fixes a radius so wide that both radii of the bias estimate miss the bias.
void say_if_wide(const MapState& map, const Scene& scene, RenderStats& stats) {
  const double across = extent_seen(scene), radius = double{map.radii.radius};
  if (map.gathers == 0 || !map.fixed_radius || !(radius > wide_part * across)) return;
  char text[200];
  std::snprintf(text, sizeof text,
                "%s photons are looked up within %.3g, and what the image shows is some %.3g across: all shades of "
                "their light are blurred",
                map.name, radius / scene.scale(), across / scene.scale());
  stats.losses.emplace_back(text);
}

/// Adds a warning for the map that holds the light of every surface. Caustics exist only in some places.
void say_if_few_arrive(const MapState& global, std::int64_t passes, RenderStats& stats) {
  const double in_disc = global.in_disc(passes);
  const bool few_emitted = global.counts.emitted < few_photons_in_map;
  const double share = static_cast<double>(global.counts.stored) / static_cast<double>(global.counts.emitted);
  const bool matters = global.counts.stored >= few_photons_in_map || share > small_share;
  const bool few_in_disc = global.gathers > 0 && matters && in_disc < few_photons_in_disc;
  if (!few_emitted && !few_in_disc) return;
  char text[160];
  std::snprintf(text, sizeof text,
                "%.2g of %.3g photon%s are in the disc of a gather: too few arrive where the camera looks", in_disc,
                static_cast<double>(global.counts.emitted), global.counts.emitted == 1 ? "" : "s");
  stats.losses.emplace_back(text);
}

/// Adds a warning where a given radius is too narrow, judged by the photons around photons: most gathers find no
/// caustic. A radius chosen here follows the photons' density.
void say_if_narrow(const MapState& caustic, const Scene& scene, RenderStats& stats) {
  if (!caustic.fixed_radius || caustic.gathers == 0 || caustic.counts.stored == 0 ||
      caustic.counts.around_one >= few_photons_in_disc)
    return;
  char text[200];
  std::snprintf(text, sizeof text,
                "%.2g of %.3g caustic photons are within %.3g of one of them: caustics are noise of unknown error",
                caustic.counts.around_one, static_cast<double>(caustic.counts.stored),
                double{caustic.radii.radius} / scene.scale());
  stats.losses.emplace_back(text);
}

/// Maximum of photons that a pass can emit on this machine. If each is stored twice on average, the two maps and the
/// sort of one take this much memory.
std::uint64_t most_photons_in_a_pass() {
  constexpr std::uint64_t bytes = 2 * (2 * 32 + 34);
  const auto memory =
      static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  return std::min<std::uint64_t>(memory / bytes, std::uint64_t{1} << 30);
}

/// Photons of a map for the pass that takes samples [first, last). Throws InputError when they would not fit in memory.
std::uint64_t photons_for_pass(const MapState& state, const RenderJob& job, std::int64_t first, std::int64_t last) {
  const auto until = [&](std::int64_t s) { return static_cast<std::int64_t>(state.a_sample * static_cast<double>(s)); };
  const auto count = static_cast<std::uint64_t>(std::max<std::int64_t>(state.least, until(last) - until(first)));
  if (count > most_photons_in_a_pass())
    throw InputError(job.budget.photons ? "--photons" : job.integrator_place,
                     (job.budget.photons ? std::string() : std::string(state.name) + "_photons: ") +
                         std::to_string(count) + " in one pass are more than " +
                         std::to_string(most_photons_in_a_pass()) +
                         ", what this machine's memory holds; more samples a pixel make more passes");
  return count;
}

}  // namespace

PhotonSettings::PhotonSettings(const IntegratorDescription& description, const RenderJob& job)
    : limits(description.limits()) {
  if (const auto* photons = std::get_if<PhotonMapperDescription>(&description.method)) {
    global_photons = photons->global_photons;
    caustic_photons = photons->caustic_photons;
    global_radius = photons->global_radius;
    caustic_radius = photons->caustic_radius;
    const AovRow& view = aov_row(job.view);
    const bool asks_for_maps = job.budget.photons || global_photons > 0 || caustic_photons > 0 || global_radius > 0 ||
                               caustic_radius > 0 || !view.made_from_all();
    if (view.global_map && view.view != Aov::photons) indirect = photons->indirect;
    if (indirect == IndirectLight::automatic && asks_for_maps) indirect = IndirectLight::map;
    if (view.view == Aov::cache_records) indirect = IndirectLight::cache;
    cache_error = photons->cache_error;
    gather_rays = photons->gather_rays;
  } else {
    const auto& sppm = std::get<SppmDescription>(description.method);
    textbook = Textbook{sppm.photons, sppm.alpha};
    global_radius = caustic_radius = sppm.radius;
  }
}

std::optional<std::int64_t> known_samples(const RenderJob& job) {
  if (job.budget.target_error || job.budget.seconds) return std::nullopt;
  return job.budget.spp.value_or(job.sample_count);
}

double guessed_radius(const MapState& map, double photons) {
  return map.trials.empty() ? map.radii.first_radius * shrunk(photons / map.radii.first_photons)
                            : map.trials.best(photons);
}

void choose_next_radius(MapState& map, const PhotonSettings& settings, const GatherBias::Evidence& evidence,
                        const PassHalves& halves, double all_samples) {
  RadiusHistory& radii = map.radii;
  const double now = static_cast<double>(radii.radius);
  double next = now;
  if (settings.textbook) {
    const auto passes = static_cast<double>(halves.pass_count());
    next = now * std::sqrt((passes + settings.textbook->alpha) / (passes + 1));
  } else if (!map.fixed_radius) {
    const double photons = radii.worth() * all_samples / halves.all_samples();
    const double guess = guessed_radius(map, photons);
    next = guess;
    const bool gathered = settings.indirect == IndirectLight::gather && map.kind == PhotonKind::global;
    if (halves.passes[1] >= least_evidence && !gathered) {
      next = std::clamp(radii.best(evidence, all_samples, map.trials.exponent()), most_shrinking * now,
                        most_growing * now);
      next = std::clamp(next, narrowest * guess, widest * guess);
    }
  }
  radii.radius = static_cast<float>(next);
}

double widest_useful(const Scene& scene) { return wide_part * extent_seen(scene); }

double shrunk(double times) { return std::pow(times, -1.0 / 6); }

int most_edges(const PhotonSettings& settings) {
  return settings.limits.max_depth >= 0 ? settings.limits.max_depth : std::numeric_limits<int>::max();
}

void radiance_estimate(const MapState& map, const PhotonSettings& settings, const GatherAreas& areas,
                       const GatherKernelEntry& kernels, GatherQueue& queue) {
  const GatherPoints points = queue.view();
  const std::vector<std::uint32_t> order = cell_order(map.map, queue);
  kernels.gather({map.map.view(), most_edges(settings), points, order.data(), map.tests.data()});
  areas.fill(queue);
}

PathSettings camera_path_settings(const PhotonSettings& settings, const RenderPlan& plan) {
  const PathLimits& limits = settings.limits;
  return {limits.max_depth, limits.rr_depth, limits.hide_emitters,
          plan.skips(Skip::direct_light) ? DirectLight::hits_only
          : plan.skips(Skip::mis)        ? DirectLight::unweighted
                                         : DirectLight::weighted};
}

bool looks_at_environment(const Scene& scene, const PathSettings& settings) {
  return scene.view().environment != no_index && settings.direct_light != DirectLight::hits_only;
}

PathPolicy policy_of_maps(const Scene& scene, const PathSettings& settings) {
  return looks_at_environment(scene, settings) ? PathPolicy::gather_pass_looks : PathPolicy::gather_pass;
}

bool splits_rough_parts(const Scene& scene, PathPolicy policy) {
  return policy != PathPolicy::path_tracing && (scene.view().bsdf_kinds & rough_kinds) != 0;
}

PhotonMaps::PhotonMaps(const RenderPlan& plan, const PhotonSource& source) {
  global.wanted = !plan.skips(Skip::global_map);
  if (source.settings.indirect == IndirectLight::gather || source.settings.indirect == IndirectLight::cache)
    global.photons_in_disc = gathered_photons_in_disc;
  choose_photons(global, source.settings.global_photons, source);
  caustic.wanted = !plan.skips(Skip::caustic_map);
  caustic.aimed = plan.skips(Skip::stray_photons);
  choose_photons(caustic, source.settings.caustic_photons, source);
}

void PhotonMaps::choose_first_radii(const PhotonSource& source, RenderStats& stats) {
  const PhaseTimer phase(stats.phases["pilot"]);
  RayTotals pilot_rays;
  choose_first_radius(global, source.settings.global_radius, source, pilot_rays);
  choose_first_radius(caustic, source.settings.caustic_radius, source, pilot_rays);
  pilot_rays.store(stats);
}

std::vector<MapState*> PhotonMaps::wanted() {
  std::vector<MapState*> maps;
  for (MapState* map : {&caustic, &global})
    if (map->wanted) maps.push_back(map);
  return maps;
}

std::string PhotonMaps::totals() const {
  char text[96];
  std::snprintf(text, sizeof text, "%.9g global and %.9g caustic photons a sample", global.a_sample, caustic.a_sample);
  return text;
}

void PhotonMaps::store_counts(const Scene& scene, std::int64_t passes, RenderStats& stats) const {
  stats.counts["passes"] = static_cast<double>(passes);
  store_counts_of(global, scene.scale(), passes, stats);
  store_counts_of(caustic, scene.scale(), passes, stats);
  for (const MapState* map : {&global, &caustic}) say_if_few_are_emitted(*map, stats);
  say_what_is_lost(scene, passes, stats);
}

void PhotonMaps::say_what_is_lost(const Scene& scene, std::int64_t passes, RenderStats& stats) const {
  for (const MapState* map : {&global, &caustic})
    if (map->wanted) say_if_wide(*map, scene, stats);
  if (global.wanted) say_if_few_arrive(global, passes, stats);
  if (caustic.wanted) say_if_narrow(caustic, scene, stats);
}

Photons emit_photons(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last,
                     RenderStats& stats) {
  const std::uint64_t count = photons_for_pass(map, source.job, first, last);
  const PhaseTimer phase(stats.phases[std::string("photons_") + map.name]);
  const int max_edges = source.settings.limits.max_depth >= 0 ? source.settings.limits.max_depth - 1 : -1;
  const std::uint64_t traced = has_fault(Fault::half_photons) ? (count + 1) / 2 : count;
  const std::uint64_t seed = has_fault(Fault::same_photons) ? 1 : source.job.seed;
  RayTotals rays;
  Photons photons =
      trace_photons(source.scene, {map.kind, map.stream, seed, map.counts.emitted, traced, max_edges, map.aimed},
                    {source.job.kernels(), source.job.sampler}, source.threads, rays);
  map.counts.rays += rays.counts().photon;
  map.counts.emitted += count;
  map.counts.stored += photons.size();
  return photons;
}

std::uint64_t refill(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last,
                     RenderStats& stats) {
  const std::uint64_t emitted_before = map.counts.emitted;
  Photons photons = emit_photons(map, source, first, last, stats);
  const PhaseTimer phase(stats.phases["build"]);
  const bool may_be_narrow = map.kind == PhotonKind::caustic && map.fixed_radius;
  if (may_be_narrow && map.counts.around_one < few_photons_in_disc)
    map.counts.around_one += photons_around_one(photons, map.radii.radius, source.threads);
  map.map.build(std::move(photons), map.radii.radius, source.threads);
  return map.counts.emitted - emitted_before;
}

}  // namespace photonproof::inline renderer_photon_mapping
