#include "renderer/photon_mapping/indirect_choice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "renderer/lanes/path_sampler.h"
#include "renderer/light_sampling/scene_lights.h"
#include "renderer/planning/area_price.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream brightest_light_stream{16};

/// Path tracing alone is taken up to this factor of the maps' time or error. Paths beside the caustic map must be far
/// better, since they are hardly ever better than both other methods.
constexpr double plainly = 0.95, far_better = 0.6;
/// Caustic photons of a pilot that tell how much light they carry.
constexpr std::size_t fewest_photons = 64;
/// Share of the caustic map's light that paths of a pilot must find.
constexpr double found_enough = 0.5;
/// Limit of a light's brightness, in means of the image: a pilot meets less bright lights often enough.
constexpr double bright = 100;

// Measured on library scenes at 256x256 with 16 lanes, one thread.
constexpr double ray_by_brute_force = 35, ray_elsewhere = 90, gather_time = 70;  // ns
/// Caustic gathers are narrower, so that fewer samples share one. After a bounce they lie apart.
constexpr double caustic_gather_time = 180, bounced_gather_time = 300;
constexpr double photon_ray_in_rays = 1.4, least_rays_a_photon = 1.5;
constexpr double guided_start = 600;  // ns: the densities of all places that a photon may be sent to

constexpr double valued_photon = 15;          // ns, by a BSDF
constexpr std::int64_t longest_of_pass = 64;  // samples a pixel
/// Time of a map's pilots that decide on its radius: of trials, and of rays.
constexpr double trials_of_map = 6e6, rays_of_pilot = 2 * photon_ray_in_rays * double{pilot_photons};  // ns, rays

constexpr double photons_in_disc_of_million = 700;

/// Radiance of the brightest light among sampled starts of light paths; infinite where no ray can hit the light.
double brightest_light(const Scene& scene, std::uint64_t seed) {
  constexpr std::uint64_t starts = 256;
  double most = 0;
  for (std::uint64_t i = 0; i < starts; ++i) {
    const PathSampler draws = sampler_of_path(SamplerKind::sobol, seed, brightest_light_stream, i);
    const LightStart start = scene.scene_lights().emit(draws.one(2), draws.two(0), draws.two(1));
    if (start.is_delta) return std::numeric_limits<double>::infinity();
    const double cosine = start.is_infinite ? 1 : double{dot(start.at.normal, start.direction)};
    if (!(cosine > 0)) continue;
    const double densities = double{start.pdfs.first} * double{start.pdfs.second};
    most = std::max(most, double{max_component(start.flux)} * densities / cosine);
  }
  return most;
}

double sum_of(const PointsBySurface& points) { return std::accumulate(points.begin(), points.end(), 0.0); }

/// Samples a pixel, infinite where an error or a time decides.
double samples_of(const RenderJob& job) {
  const std::optional<std::int64_t> known = known_samples(job);
  return known ? static_cast<double>(*known) : std::numeric_limits<double>::infinity();
}

/// Camera paths of the render, infinite where an error decides. Time is that of the tables, for one thread.
double paths_of(const RenderJob& job, const Tile& window, double nanoseconds) {
  if (job.budget.seconds) return *job.budget.seconds * 1e9 / nanoseconds;
  return samples_of(job) * window.width() * window.height();
}

double relmse_of_maps(double samples, const IndirectPilot& pilot) {
  const double photons = samples * pilot.photons_a_sample, rays = pilot.maps.variance / samples;
  const double by_table = 1.5 * pilot.indirect_square / (photons_in_disc_of_million * std::pow(photons / 1e6, 2.0 / 3));
  return rays + (pilot.trials.empty() ? by_table : std::max(by_table, pilot.trials.error(photons)));
}

/// Number of camera samples with which the maps reach that relmse.
double samples_to(double relmse, const IndirectPilot& pilot) {
  double low = 1e-6, high = 1e15;
  for (int i = 0; i < 100; ++i) {
    const double middle = std::sqrt(low * high);
    (relmse_of_maps(middle, pilot) > relmse ? low : high) = middle;
  }
  return high;
}

}  // namespace

IndirectChoice choose_indirect(const IndirectPilot& pilot, const RenderBudget& budget, std::int64_t samples) {
  const double map_time = pilot.maps.nanoseconds;
  double relmse = 0, time = 0;  // of the maps
  if (budget.target_error) {
    relmse = *budget.target_error * *budget.target_error;
    time = samples_to(relmse, pilot) * map_time;
  } else {
    // Times are those of the tables, for one thread: the image must not depend on the machine.
    time = budget.seconds ? *budget.seconds * 1e9 / pilot.pixels
                          : static_cast<double>(budget.spp.value_or(samples)) * map_time;
    relmse = relmse_of_maps(time / map_time, pilot);
  }
  if (!(relmse * time > 0)) return {IndirectLight::map, true, "indirect light by photon maps: a pilot meets no noise"};
  const auto part = [&](const WayOfLight& way) { return way.variance * way.nanoseconds / (relmse * time); };
  const WayOfLight* paths_alone = pilot.paths_alone ? &*pilot.paths_alone
                                  : !pilot.caustics ? &pilot.beside_caustics
                                                    : nullptr;
  const double beside = part(pilot.beside_caustics);
  const bool alone = paths_alone != nullptr && (part(*paths_alone) < beside || paths_alone == &pilot.beside_caustics);
  const double least = alone ? part(*paths_alone) : beside;
  const bool wins = least < (alone ? plainly : far_better);
  IndirectChoice choice;
  const char* way = alone ? "path tracing alone" : "path tracing beside the caustic map";
  if (wins) {
    choice.indirect = IndirectLight::path;
    choice.caustic_map = !alone;
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "indirect light by %s: a pilot gives %s %.2g times the maps' time to a relmse of %.1g",
                wins ? way : "photon maps", way, least, relmse);
  choice.why = text;
  return choice;
}

IndirectPilots::IndirectPilots(const PhotonSource& source, const PhotonMaps& maps, const RenderPlan& plan,
                               const Tile& window, RenderStats& stats)
    : source_(source),
      maps_(maps),
      window_(window),
      stats_(stats),
      settings_(camera_path_settings(source.settings, plan)),
      ray_(plan.scene.small ? ray_by_brute_force : ray_elsewhere),
      caustics_(maps.caustic.wanted),
      tracer_(source_, settings_, window_, pilot_camera_paths) {
  const PhaseTimer phase(stats.phases["pilot"]);
  if (caustics_) brightest_ = brightest_light(source.scene, source.job.seed);
  direct_ = tracer_.trace(policy_of_maps(source_.scene, settings_));
  if (!caustics_) beside_ = tracer_.trace(PathPolicy::path_tracing);
}

/// A few bright samples may be all that a pilot knows of the variance that a method adds. Then that has a standard
/// error more, except for a part that margins bear.
WayOfLight IndirectPilots::way_of(const PilotImage& image, double nanoseconds) const {
  constexpr double borne = 1.25;
  const VarianceBeside beside = variance_beside(direct_, image);
  const double doubt = beside.added.carriers > 0 ? 1 / std::sqrt(beside.added.carriers) : 0;
  return {beside.common + beside.added.variance * std::max(1.0, (1 + doubt) / borne), nanoseconds};
}

/// Share of the caustic photons' light that path tracing alone has found, with one standard error less. Paths find
/// light on rough surfaces by light samples: these may hide what they do not find. So other pixels must tell, if they
/// have some of the light.
double IndirectPilots::share_found() const {
  constexpr double some = 0.1;
  const double all = caustic_light(beside_, *alone_, Where::all_pixels).all;
  const double told = caustic_light(beside_, *alone_, Where::without_rough).all;
  const LightBetween found = light_between(beside_, *alone_, Where::without_rough);
  if (!(all > 0)) return 1;
  if (!(told > some * all && found.carriers > 1)) return 0;
  return found.relative * (1 - 1 / std::sqrt(found.carriers)) / told;
}

/// Caustics add the squares of rare hits. A hit's value is at most that of the brightest light, times what surfaces let
/// through. So light that the caustic map has and these paths have not found bounds the squares that they have not
/// found.
std::optional<WayOfLight> IndirectPilots::alone() const {
  if (!alone_) return std::nullopt;
  const bool seldom = !(brightest_ < bright * beside_.mean());
  if (seldom && caustic_photons_ < fewest_photons) return std::nullopt;
  WayOfLight paths = way_of(*alone_, alone_->rays_a_sample * ray_);
  const double missing = std::max(0.0, 1 - share_found() / (seldom ? 1 : found_enough));
  if (missing > 0) paths.variance += missing * caustic_light(beside_, *alone_, Where::all_pixels).dimmed * brightest_;
  return paths;
}

/// Variance of the maps' samples. Rare bright samples of directly seen light are left out, as far as chance may have
/// brought them: passes of the maps take more samples where they are.
double IndirectPilots::maps_variance() const {
  const Spread spread = variance_within(direct_, beside_);
  return spread.carriers > 1 ? spread.variance * (1 - 1 / spread.carriers) : 0;
}

std::optional<IndirectChoice> IndirectPilots::choose_without_photons() const {
  if (caustics_) return std::nullopt;
  const WayOfLight paths = way_of(beside_, beside_.rays_a_sample * ray_);
  double time = direct_.rays_a_sample * ray_;
  for (const MapState* map : {&maps_.global, &maps_.caustic}) {
    if (!map->wanted) continue;
    time += sum_of(direct_.points_a_sample) * (map->kind == PhotonKind::caustic ? caustic_gather_time : gather_time) +
            time_of_photons(*map, least_rays_a_photon) +
            (trials_of_map + rays_of_pilot * ray_) / paths_of(source_.job, window_, paths.nanoseconds);
  }
  const double least = maps_variance() * time;
  const double part = paths.variance * paths.nanoseconds / least;
  if (!(part < plainly)) return std::nullopt;
  char text[200];
  std::snprintf(text, sizeof text,
                "indirect light by path tracing alone: a pilot gives it %.2g times the time of photon maps of no error",
                part);
  return IndirectChoice{IndirectLight::path, false, text};
}

void IndirectPilots::trace_beside_photons() {
  if (!caustics_) return;
  const PhaseTimer phase(stats_.phases["pilot"]);
  PhotonMap map;
  Photons copy;
  copy.append(maps_.caustic.pilot);
  caustic_photons_ = copy.size();
  rough_radius_ = maps_.caustic.radii.radius;
  map.build(std::move(copy), rough_radius_, source_.threads);
  const PathPilot::CausticMap caustics{map, rough_radius_};
  beside_ = tracer_.trace(PathPolicy::beside_caustic_map, &caustics);
  if (std::isfinite(brightest_)) alone_ = tracer_.trace(PathPolicy::path_tracing);
}

double IndirectPilots::time_of_photons(const MapState& map, double rays_a_photon) const {
  const CameraView& camera = source_.scene.view().camera;
  // Passes are longer in longer renders, and each has some photons at least: in small images these are the most.
  const double samples_a_pass = std::clamp(samples_of(source_.job) / 3, 1.0, double{longest_of_pass});
  const double photons = std::max(map.a_sample, static_cast<double>(map.least) / samples_a_pass);
  const double a_path = photons * double{camera.inverse_width} * double{camera.inverse_height};
  return a_path *
         (rays_a_photon * photon_ray_in_rays * ray_ + (source_.scene.view().guided_emission ? guided_start : 0));
}

double IndirectPilots::time_of_gathers(const MapState& map, const PointsBySurface& points, double each) const {
  return sum_of(points) * each + AreaPrices(source_.scene, map.radii.radius).time_of(points);
}

double IndirectPilots::gathers_on_rough() const { return sum_of(beside_.rough_points_a_sample); }

/// Every sample gathers by itself on rough parts. The wide and the narrow gather have areas of their own.
double IndirectPilots::time_on_rough() const {
  if (!caustics_) return 0;
  const MapState& map = maps_.caustic;
  const double wider = square(double{map.radii.radius} / double{rough_radius_});
  const double photons = std::min(static_cast<double>(longest_of_pass), samples_of(source_.job) / 3) * map.a_sample;
  const double found = beside_.found_a_sample * wider * photons / static_cast<double>(pilot_photons);
  return time_of_gathers(map, beside_.rough_points_a_sample, caustic_gather_time) +
         AreaPrices(source_.scene, map.radii.radius * GatherBias::narrow_part).time_of(beside_.rough_points_a_sample) +
         found * valued_photon;
}

IndirectPilot IndirectPilots::measured() const {
  IndirectPilot pilot;
  const double rough = time_on_rough();
  const double caustic_photons = caustics_ ? time_of_photons(maps_.caustic, maps_.caustic.rays_a_photon) : 0;
  pilot.maps = {maps_variance(),
                direct_.rays_a_sample * ray_ + time_of_photons(maps_.global, maps_.global.rays_a_photon) +
                    caustic_photons + rough + time_of_gathers(maps_.global, direct_.points_a_sample, gather_time) +
                    (caustics_ ? time_of_gathers(maps_.caustic, direct_.points_a_sample, caustic_gather_time) : 0)};
  pilot.beside_caustics = way_of(
      beside_,
      beside_.rays_a_sample * ray_ + caustic_photons + rough +
          (caustics_ ? time_of_gathers(maps_.caustic, beside_.caustic_points_a_sample, bounced_gather_time) : 0));
  pilot.paths_alone = alone();
  pilot.indirect_square = mean_square_between(direct_, beside_);
  pilot.caustics = caustics_;
  pilot.trials = maps_.global.trials;
  pilot.photons_a_sample = maps_.global.a_sample;
  pilot.pixels = static_cast<double>(window_.width()) * window_.height();
  return pilot;
}

}  // namespace photonproof::inline renderer_photon_mapping
