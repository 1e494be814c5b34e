#include "renderer/photon_mapping/indirect_choice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "renderer/lanes/path_sampler.h"
#include "renderer/light_sampling/scene_lights.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"
#include "renderer/scene/surface_detail.h"
#include "renderer/sensor/film.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream indirect_pilot_stream{15}, brightest_light_stream{16};

constexpr int samples_a_pixel = 4, pilot_pixels = pilot_camera_paths / samples_a_pixel;
/// A pixel's variance is relative to the mean of its block.
constexpr int pixels_a_block = 8;

/// Another method wins if it needs less than this factor of the maps' time, or has less than this factor of their
/// error.
constexpr double plainly = 0.9;
/// Limit of a light's brightness, in means of the image: a pilot meets less bright lights often enough.
constexpr double bright = 100;

// Measured on library scenes at 256x256 with 16 lanes, one thread.
constexpr double ray_by_brute_force = 35, ray_elsewhere = 90, gather_time = 70;  // ns
constexpr double photon_ray_in_rays = 1.4;
constexpr std::uint64_t priced_photons = 1024;  // of a map, traced only to measure the cost of a photon
constexpr double guided_start = 600;            // ns: the densities of all places that a photon may be sent to

constexpr double photons_in_disc_of_million = 700;

struct Sample {
  RgbD sum{0.0}, squares{0.0};  ///< sums over a pixel's samples
};

struct PilotImage {
  std::vector<Sample> pixels{};  ///< row by row
  double rays_a_sample = 0;
  std::vector<double> points_a_sample{};  ///< that it leaves, by surface
};

RgbD block_mean(const PilotImage& image, std::size_t pixel) {
  const std::size_t first = pixel / pixels_a_block * pixels_a_block;
  const std::size_t end = std::min(first + pixels_a_block, image.pixels.size());
  RgbD sum(0.0);
  for (std::size_t i = first; i < end; ++i) sum += image.pixels[i].sum;
  return sum / (static_cast<double>(end - first) * samples_a_pixel);
}

double mean_of(const RgbD& v) { return (v.x + v.y + v.z) / 3; }

/// Variance of a camera sample, relative to the whole image.
double variance_of(const PilotImage& image, const PilotImage& whole) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const Sample& s = image.pixels[i];
    const RgbD variance = (s.squares - s.sum * s.sum / double{samples_a_pixel}) / (samples_a_pixel - 1);
    sum += mean_of(variance * Film::relative_scale(block_mean(whole, i)));
  }
  return sum / static_cast<double>(image.pixels.size());
}

double mean_square_between(const PilotImage& part, const PilotImage& whole) {
  double sum = 0;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    const RgbD mean = block_mean(whole, i), missing = mean - block_mean(part, i);
    sum += mean_of(missing * missing * Film::relative_scale(mean));
  }
  return sum / static_cast<double>(whole.pixels.size());
}

double mean_of(const PilotImage& image) {
  double sum = 0;
  for (const Sample& s : image.pixels) sum += mean_of(s.sum);
  return sum / (static_cast<double>(image.pixels.size()) * samples_a_pixel);
}

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

/// Rays a photon, over the maps that are wanted; aimed and other photons count equally.
double rays_a_photon(const PhotonSource& source, const PhotonMaps& maps, RenderStats& stats) {
  const int max_edges = source.settings.limits.max_depth >= 0 ? source.settings.limits.max_depth - 1 : -1;
  RayTotals rays;
  double photons = 0;
  for (const MapState* map : {&maps.global, &maps.caustic}) {
    if (!map->wanted) continue;
    trace_photons(source.scene, {map->kind, pilot_stream, source.job.seed, 0, priced_photons, max_edges, map->aimed},
                  {source.job.kernels(), source.job.sampler}, source.threads, rays);
    photons += double{priced_photons};
  }
  rays.store(stats);
  return static_cast<double>(rays.counts().photon) / photons;
}

class PilotTracer {
 public:
  PilotTracer(const PhotonSource& source, const PathSettings& settings, const Tile& window)
      : source_(source),
        settings_(settings),
        window_(window),
        rows_(std::clamp((pilot_pixels + window.width() - 1) / window.width(), 1, window.height())),
        scratch_(source.job.kernels().path) {}

  /// Traces the pilot; the camera samples are the same for every policy at diffuse surfaces.
  PilotImage trace(PathPolicy policy) {
    const auto width = static_cast<std::size_t>(window_.width()), rows = static_cast<std::size_t>(rows_);
    PilotImage image;
    image.pixels.resize(width * rows);
    RayTotals totals;
    std::vector<std::vector<std::uint32_t>> left(rows);
    source_.threads.for_each(rows, [&](std::size_t row) {
      left[row] = trace_row(static_cast<int>(row), policy, &image.pixels[row * width], totals);
    });
    const RayCounts rays = totals.counts();
    const double each = 1 / static_cast<double>(image.pixels.size() * samples_a_pixel);
    image.rays_a_sample = static_cast<double>(rays.camera + rays.bounce + rays.shadow) * each;
    image.points_a_sample.resize(source_.scene.surfaces.size());
    for (const std::vector<std::uint32_t>& surfaces : left)
      for (const std::uint32_t surface : surfaces) image.points_a_sample[surface] += each;
    return image;
  }

 private:
  /// Returns the surfaces where paths leave points.
  std::vector<std::uint32_t> trace_row(int row, PathPolicy policy, Sample* pixels, RayTotals& totals) {
    const int y = window_.y0 + (2 * row + 1) * window_.height() / (2 * rows_);
    PathTask task{.scene = &source_.scene.view(),
                  .camera = camera_task(source_.job, {window_.x0, y, window_.x1, y + 1}, 0, samples_a_pixel),
                  .settings = settings_,
                  .policy = policy};
    task.camera.seed = stream_seed(source_.job.seed, indirect_pilot_stream);
    task.camera.grid = 0;
    std::vector<float> radiance(3 * std::size_t{task.camera.paths()});
    GatherQueue left(task.camera.paths());
    task.radiance = radiance.data();
    if (policy != PathPolicy::beside_caustic_map) task.points = left.view();
    task.rough.by_photons = splits_rough_parts(source_.scene, policy);
    scratch_.trace(task);
    totals.add(task.counts);
    for (std::size_t i = 0; i < task.camera.paths(); ++i) {
      const RgbD value(radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]);
      pixels[i / samples_a_pixel].sum += value;
      pixels[i / samples_a_pixel].squares += value * value;
    }
    left.set_size(task.points.count);
    std::vector<std::uint32_t> surfaces(left.size());
    for (std::size_t i = 0; i < left.size(); ++i) surfaces[i] = surface_number(left[i].surface);
    return surfaces;
  }

  const PhotonSource& source_;
  const PathSettings& settings_;
  const Tile window_;
  const int rows_;
  ScratchPool scratch_;
};

double relmse_of_maps(double samples, const IndirectPilot& pilot) {
  const double photons = samples * pilot.photons_a_sample, rays = pilot.maps.variance / samples;
  if (!pilot.trials.empty()) return rays + pilot.trials.error(photons);
  return rays + 1.5 * pilot.indirect_square / (photons_in_disc_of_million * std::pow(photons / 1e6, 2.0 / 3));
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
  const double map_time = pilot.maps.nanoseconds + pilot.areas;
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
  const bool alone = pilot.paths_alone && part(*pilot.paths_alone) < part(pilot.beside_caustics);
  const double least = alone ? part(*pilot.paths_alone) : part(pilot.beside_caustics);
  IndirectChoice choice;
  const char* way = alone || !pilot.caustics ? "path tracing alone" : "path tracing beside the caustic map";
  if (least < plainly) {
    choice.indirect = IndirectLight::path;
    choice.caustic_map = !alone;
  }
  char text[200];
  std::snprintf(text, sizeof text,
                "indirect light by %s: a pilot gives %s %.2g times the maps' time to a relmse of %.1g",
                least < plainly ? way : "photon maps", way, least, relmse);
  choice.why = text;
  return choice;
}

IndirectPilot pilot_indirect(const PhotonSource& source, const PhotonMaps& maps, const RenderPlan& plan,
                             const Tile& window, RenderStats& stats) {
  const PhaseTimer phase(stats.phases["pilot"]);
  const PathSettings settings = camera_path_settings(source.settings, plan);
  PilotTracer tracer(source, settings, window);
  const bool caustics = maps.caustic.wanted;
  const PilotImage direct = tracer.trace(policy_of_maps(source.scene, settings));
  const PilotImage beside = tracer.trace(caustics ? PathPolicy::beside_caustic_map : PathPolicy::path_tracing);
  std::optional<PilotImage> alone;
  if (caustics && brightest_light(source.scene, source.job.seed) < bright * mean_of(beside))
    alone = tracer.trace(PathPolicy::path_tracing);

  const double ray = plan.scene.small && !plan.scene.detailed ? ray_by_brute_force : ray_elsewhere;
  const CameraView& camera = source.scene.view().camera;
  const double photons_a_path = maps.global.a_sample * double{camera.inverse_width} * double{camera.inverse_height};
  const double a_photon = rays_a_photon(source, maps, stats) * photon_ray_in_rays * ray +
                          (source.scene.view().guided_emission ? guided_start : 0);
  const double map_time = gather_time + photons_a_path * a_photon;
  IndirectPilot pilot;
  pilot.maps = {variance_of(direct, beside), direct.rays_a_sample * ray + (caustics ? 2 : 1) * map_time};
  pilot.gathers_a_sample = direct.points_a_sample;
  pilot.beside_caustics = {variance_of(beside, beside),
                           beside.rays_a_sample * ray + (caustics ? map_time + gather_time : 0)};
  if (alone) pilot.paths_alone = {variance_of(*alone, *alone), alone->rays_a_sample * ray};
  pilot.indirect_square = mean_square_between(direct, beside);
  pilot.caustics = caustics;
  pilot.photons_a_sample = maps.global.a_sample;
  pilot.pixels = static_cast<double>(window.width()) * window.height();
  return pilot;
}

}  // namespace photonproof::inline renderer_photon_mapping
