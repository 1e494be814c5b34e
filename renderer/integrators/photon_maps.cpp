#include "renderer/integrators/photon_maps.h"

#include <cstdio>

#include "renderer/passes/photon_radius.h"
#include "scenes/text/faults.h"
#include "scenes/text/timer.h"

namespace photonproof {
namespace {

constexpr std::int64_t photons_per_sample = 50'000;  // with a time budget: emitted for each camera sample a pixel
constexpr std::uint64_t pilot_photons = 20'000;
constexpr std::uint64_t most_photons_in_a_pass = 10'000'000;  // a map of them takes about a gigabyte

/// Fewer in a disc than this, and the spread that is seen may miss the few that carry the light.
constexpr double few_photons_in_disc = 10;
/// A map of fewer says that hardly any light goes that way, not that it goes elsewhere.
constexpr std::uint64_t few_photons_in_map = 1000;

/// A map without a radius gets one from the pilot; a map whose pilot stores nothing is small enough for any radius.
void choose_radius_of(MapState& map, double asked, const PhotonSource& source, RayTotals& totals) {
  map.radius = static_cast<float>(asked * source.scene.scale());
  if (!map.wanted || map.radius > 0) return;
  const PhotonRun pilot{map.kind, pilot_stream, source.job.seed, 0, pilot_photons, -1, map.aimed};
  map.radius = choose_radius(source.scene, pilot, static_cast<std::uint64_t>(map.total), map.photons_in_disc,
                             {source.job.kernels(), source.job.sampler}, source.threads, totals);
  if (map.radius <= 0) map.radius = 4 * std::max(median_pixel_footprint(source.scene), 1e-6f);
}

void store_counts_of(const MapState& state, double scale, std::int64_t passes, RenderStats& stats) {
  if (!state.wanted) return;
  const std::string name = state.name;
  stats.counts["photons_emitted_" + name] = static_cast<double>(state.counts.emitted);
  stats.counts["photons_stored_" + name] = static_cast<double>(state.counts.stored);
  stats.counts["radius_" + name] = state.radius / scale;
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

/// Emits the photons that follow those emitted before.
Photons emit(MapState& map, const PhotonSource& source, std::uint64_t count, RenderStats& stats) {
  const PhaseTimer phase(stats.phases[std::string("photons_") + map.name]);
  const int max_edges = source.settings.max_depth >= 0 ? source.settings.max_depth - 1 : -1;
  const std::uint64_t traced = has_fault(Fault::half_photons) ? (count + 1) / 2 : count;
  const std::uint64_t seed = has_fault(Fault::same_photons) ? 1 : source.job.seed;
  RayTotals rays;
  Photons photons =
      trace_photons(source.scene, {map.kind, map.stream, seed, map.counts.emitted, traced, max_edges, map.aimed},
                    {source.job.kernels(), source.job.sampler}, source.threads, rays);
  map.counts.rays += rays.counts().photon;
  return photons;
}

}  // namespace

PhotonMaps::PhotonMaps(const RenderPlan& plan, const PhotonSource& source, RenderStats& stats) {
  const std::optional<std::int64_t>& asked = source.job.budget.photons;
  global.wanted = !plan.skips(Skip::global_map);
  global.total = asked.value_or(source.settings.global_photons);
  caustic.wanted = !plan.skips(Skip::caustic_map);
  caustic.aimed = plan.skips(Skip::stray_photons);
  caustic.total = asked.value_or(source.settings.caustic_photons);

  const PhaseTimer phase(stats.phases["pilot"]);
  RayTotals pilot_rays;
  choose_radius_of(global, source.settings.global_radius, source, pilot_rays);
  choose_radius_of(caustic, source.settings.caustic_radius, source, pilot_rays);
  pilot_rays.store(stats);
}

std::vector<MapState*> PhotonMaps::wanted() {
  std::vector<MapState*> maps;
  for (MapState* map : {&caustic, &global})
    if (map->wanted) maps.push_back(map);
  return maps;
}

std::string PhotonMaps::totals() const {
  return std::to_string(global.total) + " global and " + std::to_string(caustic.total) + " caustic photons";
}

void PhotonMaps::store_counts(double scale, std::int64_t passes, RenderStats& stats) const {
  store_counts_of(global, scale, passes, stats);
  store_counts_of(caustic, scale, passes, stats);
  say_if_few_arrive(global, passes, stats);
}

void refill(MapState& map, const PhotonSource& source, std::int64_t first, std::int64_t last, std::int64_t spp,
            RenderStats& stats) {
  const std::uint64_t count = source.job.budget.seconds
                                  ? static_cast<std::uint64_t>(photons_per_sample * (last - first))
                                  : photons_for_pass(map, source.job, first, last, spp);
  Photons photons = emit(map, source, count, stats);
  const PhaseTimer phase(stats.phases["build"]);
  map.map.build(std::move(photons), map.radius, source.threads);
  map.counts.emitted += count;
  map.counts.stored += map.map.size();
}

}  // namespace photonproof
