#include "renderer/photon_mapping/camera_pilot.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "renderer/kernels/gather_points.h"
#include "renderer/lanes/sampler.h"
#include "renderer/lights/light.h"
#include "renderer/passes/ray_totals.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream look_around_stream{20}, pilot_sample_stream{21};

/// The pilot first samples one of this many rows.
constexpr int rows_apart = 4;
/// Samples of a pixel that sees something by mirrors or through glass, and of one that came near a light. The samples
/// of all these pixels are limited to part_of_pixels times the number of pixels.
constexpr double few_samples = 16, many_samples = 128;
constexpr double part_of_pixels = 0.5;
/// Distance that counts as near, in radii of a light: in pixels with few and with many samples.
constexpr float near_of_few = 16, near_of_many = 4;
/// Maximum of a path's edges: after more, even equally chosen lobes seldom meet a light.
constexpr int longest = 8;
/// Each ray is tested against all lights.
constexpr std::size_t most_lights = 16;

/// Balls around the lights; empty for more than most_lights.
std::vector<LightBall> light_balls(const Scene& scene) {
  std::vector<LightBall> balls;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::optional<LightBounds> bounds = light_bounds(scene.lights[i]);
    if (!bounds || is_delta(scene.lights[i])) continue;
    const float radius = 0.5f * length(bounds->high - bounds->low);
    if (!(radius > 0)) continue;
    balls.push_back({(bounds->low + bounds->high) * 0.5f, radius, bounds->power / (pi * pi * radius * radius)});
  }
  if (balls.size() > most_lights) balls.clear();
  return balls;
}

/// A value for every pixel of a window, row by row.
template <class T>
class Plane {
 public:
  explicit Plane(const Tile& window)
      : window_(window),
        values_(static_cast<std::size_t>(window.width()) * static_cast<std::size_t>(window.height())) {}
  const Tile& window() const { return window_; }
  T& at(int x, int y) {
    return values_[static_cast<std::size_t>(y - window_.y0) * static_cast<std::size_t>(window_.width()) +
                   static_cast<std::size_t>(x - window_.x0)];
  }
  std::size_t size() const { return values_.size(); }
  std::size_t marked() const {
    return values_.size() - static_cast<std::size_t>(std::count(values_.begin(), values_.end(), T{}));
  }
  /// Calls visit(x, y) within so many pixels of (x, y), across and down.
  template <class Visit>
  void around(int x, int y, int across, int down, Visit&& visit) const {
    for (int v = std::max(y - down, window_.y0); v < std::min(y + down + 1, window_.y1); ++v)
      for (int u = std::max(x - across, window_.x0); u < std::min(x + across + 1, window_.x1); ++u) visit(u, v);
  }
  void mark_around(int x, int y, int across, int down) {
    around(x, y, across, down, [&](int u, int v) { at(u, v) = T{1}; });
  }

 private:
  Tile window_;
  std::vector<T> values_;
};
using Marks = Plane<std::uint8_t>;

/// Statistics of a pixel's samples.
struct Found {
  std::uint32_t samples = 0;
  double sum = 0, squares = 0;  ///< of the light that was met
  float nearest = 0;            ///< greatest contribution of a light that a sample came near

  void add(const float* sample) {
    const double met = 0.5 * (double{sample[0]} + double{sample[1]});
    samples += 1, sum += met, squares += met * met;
    nearest = std::max(nearest, sample[2]);
  }
  double met_variance() const { return samples > 0 ? std::max(0.0, squares - sum * sum / samples) / samples : 0; }
  double near_variance() const { return samples > 0 ? double{nearest} * double{nearest} / samples : 0; }
};

class Pilot {
 public:
  Pilot(const Scene& scene, const PathSettings& settings, const RenderJob& job, const Threads& threads,
        const Tile& window)
      : scene_(scene),
        job_(job),
        threads_(threads),
        settings_(settings),
        lights_(light_balls(scene)),
        scratch_(job.kernels().path),
        found_(window) {
    settings_.direct_light = DirectLight::rare_hits_only;
    if (settings_.max_depth < 0 || settings_.max_depth > longest) settings_.max_depth = longest;
  }

  /// Marks pixels near those that see something by mirrors or through glass.
  Marks look_around();
  /// Takes so many samples of each of the pixels, fewer if the pixels are too many. Numbers begin at `first`.
  void sample(Marks& pixels, std::int64_t first, double samples, float within);
  /// The pixels that came nearest to lights, and their neighbours.
  Marks nearest_to_lights();
  void tell(AdaptiveSampleMap& effort, Marks& by_many);
  const RayTotals& rays() const { return rays_; }

 private:
  struct Traced {
    std::vector<float> radiance;
    GatherQueue points{0};
  };
  void trace(CameraTask camera, Stream stream, float within, Traced& traced);

  const Scene& scene_;
  const RenderJob& job_;
  const Threads& threads_;
  PathSettings settings_;
  const std::vector<LightBall> lights_;
  ScratchPool scratch_;
  RayTotals rays_;
  Plane<Found> found_;
};

void Pilot::trace(CameraTask camera, Stream stream, float within, Traced& traced) {
  camera.seed = stream_seed(job_.seed, stream);
  const std::size_t paths = camera.paths();
  traced.radiance.assign(3 * paths, 0.0f);
  traced.points.reserve(paths);
  traced.points.set_size(0);
  PathTask task{.scene = &scene_.view(),
                .camera = camera,
                .settings = settings_,
                .policy = PathPolicy::pilot_pass,
                .search = {lights_.data(), lights_.size(), within},
                .radiance = traced.radiance.data(),
                .points = traced.points.view()};
  scratch_.trace(task);
  traced.points.set_size(task.points.count);
  rays_.add(task.counts);
}

Marks Pilot::look_around() {
  const Tile& window = found_.window();
  Marks seen(window), near(window);
  const auto rows = static_cast<std::size_t>((window.height() + rows_apart - 1) / rows_apart);
  threads_.for_each(rows, [&](std::size_t i) {
    const int y = std::min(window.y0 + static_cast<int>(i) * rows_apart + rows_apart / 2, window.y1 - 1);
    Traced row;
    trace(camera_task(job_, {window.x0, y, window.x1, y + 1}, 0, 1), look_around_stream, 1, row);
    for (std::size_t p = 0; p < row.points.size(); ++p)
      if (row.points[p].edges > 1) seen.at(window.x0 + static_cast<int>(row.points[p].path), y) = 1;
  });
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x)
      if (seen.at(x, y) != 0) near.mark_around(x, y, 1, rows_apart - 1);
  return near;
}

void Pilot::sample(Marks& pixels, std::int64_t first, double samples, float within) {
  const auto marked = static_cast<double>(pixels.marked());
  if (marked == 0) return;
  const double affordable = part_of_pixels * static_cast<double>(pixels.size()) / marked;
  const std::uint32_t count = std::bit_floor(static_cast<std::uint32_t>(std::clamp(affordable, 1.0, samples)));
  const Tile& window = pixels.window();
  threads_.for_each(static_cast<std::size_t>(window.height()), [&](std::size_t row) {
    const int y = window.y0 + static_cast<int>(row);
    Traced traced;
    for (int x = window.x0, end = x; x < window.x1; x = end) {
      const std::uint8_t mark = pixels.at(x, y);
      for (end = x + 1; end < window.x1 && pixels.at(end, y) == mark; ++end) {
      }
      if (mark == 0) continue;
      trace(camera_task(job_, {x, y, end, y + 1}, first, count), pilot_sample_stream, within, traced);
      const float* sample = traced.radiance.data();
      for (int u = x; u < end; ++u) {
        Found& found = found_.at(u, y);
        found.nearest = 0;
        for (std::uint32_t s = 0; s < count; ++s, sample += 3) found.add(sample);
      }
    }
  });
}

Marks Pilot::nearest_to_lights() {
  const Tile& window = found_.window();
  Marks marks(window);
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) {
      const float nearest = found_.at(x, y).nearest;
      bool most = nearest > 0;
      found_.around(x, y, 1, 1, [&](int u, int v) { most = most && found_.at(u, v).nearest <= nearest; });
      if (most) marks.mark_around(x, y, 1, 1);
    }
  return marks;
}

void Pilot::tell(AdaptiveSampleMap& effort, Marks& by_many) {
  const Tile& window = found_.window();
  for (int y = window.y0; y < window.y1; ++y)
    for (int x = window.x0; x < window.x1; ++x) {
      const Found& found = found_.at(x, y);
      const double variance =
          by_many.at(x, y) != 0 ? std::max(found.met_variance(), found.near_variance()) : found.met_variance();
      effort.set_pilot(x, y, variance);
    }
}

}  // namespace

void run_camera_pilot(const Scene& scene, const PathSettings& settings, const RenderJob& job, const Threads& threads,
                      const Tile& window, AdaptiveSampleMap& effort, RenderStats& stats) {
  const PhaseTimer phase(stats.phases["pilot"]);
  Pilot pilot(scene, settings, job, threads, window);
  Marks by_specular = pilot.look_around();
  pilot.sample(by_specular, 0, few_samples, near_of_few);
  Marks nearest = pilot.nearest_to_lights();
  pilot.sample(nearest, static_cast<std::int64_t>(few_samples), many_samples, near_of_many);
  pilot.tell(effort, nearest);
  pilot.rays().store(stats);
  stats.counts["pilot_camera_samples"] += static_cast<double>(pilot.rays().counts().camera);
}

}  // namespace photonproof::inline renderer_photon_mapping
