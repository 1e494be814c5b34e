#include "renderer/photon_mapping/camera_pass.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "renderer/irradiance/cache_picture.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photon_mapping/photon_radius.h"
#include "renderer/photon_mapping/shared_gathers.h"
#include "renderer/sensor/camera.h"
#include "scenes/base/faults.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Irradiance that a gather found.
Rgb irradiance(const GatherPoints& points, std::size_t i) {
  if (!(points.area[i] > 0)) return Rgb(0.0f);
  return Rgb{points.flux_red[i], points.flux_green[i], points.flux_blue[i]} * (1 / points.area[i]);
}

/// Maximum of points that a path leaves for caustic photons alone.
constexpr std::size_t caustic_points_a_path = 2;

/// The map of this kind; null without one.
MapState* map_of(PhotonKind kind, const std::vector<MapState*>& maps) {
  const auto found = std::ranges::find(maps, kind, &MapState::kind);
  return found != maps.end() ? *found : nullptr;
}

/// The map that a final gather reads; null without one.
const MapState* map_to_gather(const PhotonSettings& settings, const std::vector<MapState*>& maps) {
  return settings.indirect == IndirectLight::gather ? map_of(PhotonKind::global, maps) : nullptr;
}

/// Factor of gather areas; a planted fault dims the map's light by it.
float fault_divisor(const MapState& map) {
  return has_fault(Fault::dim_caustic) && map.kind == PhotonKind::caustic ? 1 / 0.95f : 1.0f;
}

/// In views without direct light, paths that continue keep only the light that they find further on.
PathSettings settings_of_view(PathSettings settings, const AovRow& view, bool goes_on) {
  settings.indirect_only = goes_on && !view.direct_light;
  return settings;
}

}  // namespace

/// The paths of a tile in a pass.
struct CameraPass::TilePaths {
  Tile tile;
  std::int64_t pass;
  FilterPart part;
  std::int64_t first;                     ///< the pass's first sample
  std::int64_t samples;                   ///< samples that the pass takes of every pixel
  double weight;                          ///< of the pass
  std::vector<float> radiance{};          ///< 3 values a path
  std::vector<std::uint32_t> pixel_of{};  ///< pixel of each path; pixels of the tile row by row
  GatherQueue queue{0};
  GatherQueue caustic_queue{0};  ///< points of paths that continue
  /// Points at rough parts with their gathered photons, and the same points with a part of their radii.
  GatherQueue rough{0}, rough_narrow{0};
  std::vector<float> radius_of_path{};
  std::vector<std::uint32_t> count;  ///< paths of each pixel
  std::vector<Rgb> sum;              ///< sum of each pixel

  TilePaths(const Tile& of, std::int64_t number, const RenderLoop& loop, FilterPart of_filter)
      : tile(of),
        pass(number),
        part(of_filter),
        first(part == FilterPart::positive ? loop.first() : loop.first_negative()),
        samples(part == FilterPart::positive ? loop.samples() : loop.negative()),
        weight(static_cast<double>(loop.samples())),
        count(static_cast<std::size_t>(of.width()) * static_cast<std::size_t>(of.height())),
        sum(count.size(), Rgb(0.0f)) {}
  void make_room_on_rough(RoughGathers& gathers) {
    gathers.room = std::max<std::size_t>(1024, 2 * gathers.points.count);
    const auto grow = [&](GatherQueue& points_of, GatherPoints& points) {
      points_of.set_size(points.count);
      points_of.reserve(gathers.room);
      points = points_of.view();
    };
    grow(rough, gathers.points);
    grow(rough_narrow, gathers.narrow);
  }
  RgbD mean(std::size_t pixel) const { return RgbD(sum[pixel]) / static_cast<double>(count[pixel]); }
  int x(std::size_t pixel) const { return tile.x0 + static_cast<int>(pixel) % tile.width(); }
  int y(std::size_t pixel) const { return tile.y0 + static_cast<int>(pixel) / tile.width(); }
};

CameraPass::CameraPass(const Scene& scene, const PhotonSettings& settings, const RenderPlan& plan, const RenderJob& job,
                       std::vector<MapState*> maps_shown, const GatherAreas* areas, GatherBias& bias,
                       AdaptiveSampleMap& effort)
    : scene_(scene),
      job_(job),
      view_(aov_row(plan.view)),
      shares_(!settings.textbook),
      maps_(std::move(maps_shown)),
      caustic_(map_of(PhotonKind::caustic, maps_)),
      gathered_(map_to_gather(settings, maps_)),
      traces_paths_(settings.indirect == IndirectLight::path),
      goes_on_(traces_paths_ || gathered_ != nullptr),
      areas_(areas),
      bias_(bias),
      effort_(effort),
      settings_(settings),
      path_settings_(settings_of_view(camera_path_settings(settings, plan), view_, goes_on_)),
      lobes_(negative_lobes(scene, job)),
      footprint_(std::max(median_pixel_footprint(scene), 1e-30f)),
      scratch_(job.kernels().path) {}

/// Sets the paths' policy beyond the first diffuse surface and the queues where they leave points.
void CameraPass::leave_points(PathTask& task, TilePaths& paths) const {
  const std::size_t count = paths.pixel_of.size();
  const auto room = [](GatherQueue& queue, std::size_t points) {
    queue.reserve(points);
    return queue.view();
  };
  task.policy = policy_of_maps(scene_, task.settings);
  if (gathered_ != nullptr) {
    task.policy =
        task.policy == PathPolicy::gather_pass_looks ? PathPolicy::final_gather_looks : PathPolicy::final_gather;
    task.near_hit = gathered_->radii.radius;
  }
  const bool caustics = caustic_ != nullptr;
  if (traces_paths_)
    task.policy = caustics || task.settings.indirect_only ? PathPolicy::beside_caustic_map : PathPolicy::path_tracing;
  if (caustics || !traces_paths_) task.points = room(paths.queue, count);
  if (!goes_on_ || !caustics) return;
  task.caustic_points = room(paths.caustic_queue, caustic_points_a_path * count);
  task.caustics_at_first = view_.caustic_map;
}

/// Prepares the gathers on rough parts, for the paths of the last batch.
void CameraPass::gather_on_rough(RoughGathers& rough, TilePaths& paths) const {
  if (caustic_ == nullptr || !view_.caustic_map || has_fault(Fault::missing_caustic)) return;
  rough.map = caustic_->map.view();
  rough.max_edges = most_edges(settings_);
  rough.tests = caustic_->tests.data();
  rough.radius = paths.radius_of_path.data();
  rough.narrow_part = GatherBias::narrow_part;
  rough.make_room = [](PathTask& task) { static_cast<TilePaths*>(task.rough.sink)->make_room_on_rough(task.rough); };
  rough.sink = &paths;
  rough.points = paths.rough.view();
  rough.narrow = paths.rough_narrow.view();
  rough.room = rough.points.count;
}

void CameraPass::trace(const CameraTask& camera, TilePaths& paths, RenderLoop& loop) {
  const std::size_t first = paths.pixel_of.size();
  for (std::uint32_t i = 0; i < camera.pixels(); ++i) {
    paths.pixel_of.insert(paths.pixel_of.end(), camera.samples, camera.pixel(i));
    paths.count[camera.pixel(i)] += camera.samples;
  }
  paths.radiance.resize(3 * paths.pixel_of.size());
  PathTask task{.scene = &scene_.view(),
                .camera = camera,
                .settings = path_settings_,
                .radiance = paths.radiance.data() + 3 * first};
  leave_points(task, paths);
  const std::size_t rough_points = paths.rough.size();
  task.rough.by_photons = splits_rough_parts(scene_, task.policy);
  if (task.rough.by_photons) {
    paths.radius_of_path.clear();
    if (caustic_ != nullptr)
      for (std::size_t path = first; path < paths.pixel_of.size(); ++path)
        paths.radius_of_path.push_back(radius_at(*caustic_, paths.pixel_of[path], paths));
    gather_on_rough(task.rough, paths);
  }
  scratch_.trace(task);
  const auto take = [&](const GatherPoints& points, std::size_t taken, GatherQueue& queue) {
    for (std::size_t i = taken; i < points.count; ++i) points.path[i] += static_cast<std::uint32_t>(first);
    queue.set_size(points.count);
  };
  take(task.points, paths.queue.size(), paths.queue);
  take(task.caustic_points, paths.caustic_queue.size(), paths.caustic_queue);
  take(task.rough.points, rough_points, paths.rough);
  take(task.rough.narrow, rough_points, paths.rough_narrow);
  loop.rays().add(task.counts);
}

void CameraPass::trace_extra(TilePaths& paths, RenderLoop& loop) {
  if (job_.grid > 0) return;
  std::vector<std::uint32_t> alike;
  std::uint32_t most = 0;
  for (std::size_t pixel = 0; pixel < paths.count.size(); ++pixel)
    most = std::max(most, effort_.extra(paths.x(pixel), paths.y(pixel)));
  for (std::uint32_t extra = 1; extra <= most; extra = 2 * extra + 1) {  // the numbers that AdaptiveSampleMap chooses
    alike.clear();
    for (std::size_t pixel = 0; pixel < paths.count.size(); ++pixel)
      if (effort_.extra(paths.x(pixel), paths.y(pixel)) == extra) alike.push_back(static_cast<std::uint32_t>(pixel));
    if (alike.empty()) continue;
    CameraTask camera =
        camera_task(job_, paths.tile, paths.first * AdaptiveSampleMap::most, paths.samples * extra, paths.part);
    camera.seed =
        stream_seed(job_.seed, paths.part == FilterPart::positive ? extra_sample_stream : negative_extra_sample_stream);
    camera.some_pixels = alike.data();
    camera.some_count = static_cast<std::uint32_t>(alike.size());
    trace(camera, paths, loop);
  }
}

/// Sums the paths of a part of the filter.
void CameraPass::follow(TilePaths& paths, RenderLoop& loop) {
  trace(camera_task(job_, paths.tile, paths.first, paths.samples, paths.part), paths, loop);
  trace_extra(paths, loop);
  const bool adds_radiance = view_.direct_light || goes_on_;
  for (std::size_t path = 0; adds_radiance && path < paths.pixel_of.size(); ++path) {
    const float* sample = &paths.radiance[3 * path];
    paths.sum[paths.pixel_of[path]] += Rgb(sample[0], sample[1], sample[2]);
  }
  if (!maps_.empty() || cache_ != nullptr) add_photons(paths);
}

void CameraPass::render(const Tile& tile, std::int64_t pass, RenderLoop& loop, Film& image, Film* numbers) {
  const Timer timer;
  TilePaths paths(tile, pass, loop, FilterPart::positive);
  follow(paths, loop);
  std::optional<TilePaths> negative;
  if (loop.negative() > 0) follow(negative.emplace(tile, pass, loop, FilterPart::negative), loop);
  for (std::size_t pixel = 0; pixel < paths.sum.size(); ++pixel) {
    const int x = paths.x(pixel), y = paths.y(pixel);
    const RgbD mean = negative ? lobes_.combined(x, y, paths.mean(pixel), negative->mean(pixel)) : paths.mean(pixel);
    image.add(x, y, mean, paths.weight);
    effort_.add(x, y, mean, static_cast<double>(paths.count[pixel]));
  }
  if (numbers != nullptr) add_numbers(paths, timer.seconds(), *numbers);
}

void CameraPass::add_numbers(TilePaths& paths, double seconds, Film& numbers) const {
  std::vector<Rgb> radii, dots;
  if (view_.view == Aov::radius) radii = radii_in_pixels(paths);
  if (view_.view == Aov::cache_records && cache_ != nullptr)
    dots = cache_picture(*cache_, scene_.view().camera, {paths.queue, paths.pixel_of, paths.count, paths.sum});
  for (std::size_t pixel = 0; pixel < paths.count.size(); ++pixel) {
    RgbD number(1e6 * seconds / (static_cast<double>(paths.count.size()) * paths.weight));
    if (view_.view == Aov::radius) number = RgbD(radii[pixel]) / static_cast<double>(paths.count[pixel]);
    if (view_.view == Aov::cache_records) number = RgbD(dots[pixel]);
    if (view_.view == Aov::samples) number = RgbD(static_cast<double>(paths.count[pixel]) / paths.weight);
    numbers.add(paths.x(pixel), paths.y(pixel), number, paths.weight);
  }
}

/// Radii in pixels, summed over the points where a pixel's samples end: red for the caustic map, green for the global
/// map.
std::vector<Rgb> CameraPass::radii_in_pixels(TilePaths& paths) const {
  std::vector<Rgb> sums(paths.count.size(), Rgb(0.0f));
  for (std::size_t i = 0; i < paths.queue.size(); ++i) {
    const GatherPoint point = paths.queue[i];
    const std::uint32_t pixel = paths.pixel_of[point.path];
    const float footprint = pixel_footprint(scene_.view().camera, point.p);
    for (const MapState* map : maps_)
      if (!map->map.empty())
        (map->kind == PhotonKind::caustic ? sums[pixel].x : sums[pixel].y) += radius_at(*map, pixel, paths) / footprint;
  }
  return sums;
}

void CameraPass::add_photons(TilePaths& paths) {
  const std::uint32_t key =
      stream_seed(job_.seed, paths.part == FilterPart::positive ? shared_gather_stream : negative_shared_gather_stream,
                  static_cast<std::uint64_t>(paths.pass));
  float most_apart = std::numeric_limits<float>::max();
  for (const MapState* map : maps_) most_apart = std::min(most_apart, map->radii.radius);
  const auto add_shared = [&](MapState& map, const std::vector<PixelPoint>& points) {
    add_photons_of(map, points, shares_ ? block_grid(pixels_a_radius(map), key) : BlockGrid{}, key, paths);
  };
  const std::vector<PixelPoint> points =
      points_of_pixels(goes_on_ ? paths.caustic_queue : paths.queue, paths.pixel_of, shares_ ? most_apart : 0.0f, key);
  if (cache_ != nullptr)
    for (const PixelPoint& at : points)
      paths.sum[at.pixel] +=
          at.point.weight * cache_->interpolate(at.point.p, facing_side_normal(at.point.surface_side));
  std::vector<PixelPoint> further;
  if (goes_on_) further = points_by_themselves(paths.queue, paths.pixel_of);
  for (MapState* map : maps_) {
    if (map->map.empty()) continue;
    if (has_fault(Fault::missing_caustic) && map->kind == PhotonKind::caustic) continue;
    if (map != gathered_) add_shared(*map, points);
    if (goes_on_) add_photons_of(*map, further, BlockGrid{}, key, paths);
  }
  if (paths.rough.size() > 0) add_photons_on_rough(paths);
}

/// Adds the photons that the kernel has gathered.
void CameraPass::add_photons_on_rough(TilePaths& paths) {
  areas_->fill(paths.rough);
  const GatherPoints wide = paths.rough.view(), narrow = paths.rough_narrow.view();
  const auto looks_twice = [&](std::uint32_t pixel) { return bias_.looks_twice(paths.x(pixel), paths.y(pixel)); };
  for (std::size_t i = 0; i < narrow.count; ++i)
    if (!looks_twice(paths.pixel_of[narrow.path[i]])) narrow.found[i] = 0;  // its area is of no use
  areas_->fill(paths.rough_narrow);  // neighbours share areas: each by itself took half of the time on `door-ajar`
  for (std::size_t i = 0; i < wide.count; ++i) {
    const GatherPoint point = paths.rough[i];
    const std::uint32_t pixel = paths.pixel_of[point.path];
    wide.area[i] *= fault_divisor(*caustic_);
    paths.sum[pixel] += point.weight * irradiance(wide, i);
    if (wide.found[i] == 0 || !looks_twice(pixel)) continue;
    narrow.area[i] *= fault_divisor(*caustic_);
    add_lost(*caustic_, pixel, point.weight * (irradiance(wide, i) - irradiance(narrow, i)), paths);
  }
  caustic_->count_found(wide);
}

void CameraPass::add_photons_of(MapState& map, const std::vector<PixelPoint>& points, const BlockGrid& blocks,
                                std::uint32_t key, TilePaths& paths) {
  SharedGathers shared(points, radii_of(map, points, paths), paths.tile, blocks, key);
  gather_in(map, shared.queue);
  const GatherPoints looked_up = shared.queue.view();
  for (std::size_t i = 0; i < points.size(); ++i)
    paths.sum[points[i].pixel] += points[i].point.weight * irradiance(looked_up, shared.gather_of[i]);
  map.count_found(looked_up);
  look_twice(map, points, shared, paths);
}

/// Radii of the points' gathers.
std::vector<float> CameraPass::radii_of(const MapState& map, const std::vector<PixelPoint>& points,
                                        const TilePaths& paths) const {
  std::vector<float> radii;
  radii.reserve(points.size());
  for (const PixelPoint& p : points) radii.push_back(radius_at(map, p.pixel, paths));
  return radii;
}

float CameraPass::radius_at(const MapState& map, std::size_t pixel, const TilePaths& paths) const {
  if (!narrows(map)) return map.radii.radius;
  return map.radii.radius * bias_.narrowing(paths.x(pixel), paths.y(pixel), static_cast<int>(map.kind));
}

void CameraPass::gather_in(const MapState& map, GatherQueue& queue) const {
  radiance_estimate(map, settings_, *areas_, job_.kernels().gather, queue);
  const GatherPoints points = queue.view();
  for (std::size_t i = 0; i < points.count && fault_divisor(map) != 1; ++i) points.area[i] *= fault_divisor(map);
}

/// Repeats the gathers of the bias's lattice pixels with the narrow radius, and adds their loss.
void CameraPass::look_twice(const MapState& map, const std::vector<PixelPoint>& points, SharedGathers& shared,
                            TilePaths& paths) {
  constexpr std::uint32_t none = 0xFFFFFFFF;
  std::vector<std::uint32_t> again_of(shared.queue.size(), none);
  GatherQueue again(points.size());
  const GatherPoints wide = shared.queue.view(), narrow = again.view();
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::uint32_t& number = again_of[shared.gather_of[i]];
    if (number != none || !bias_.looks_twice(paths.x(points[i].pixel), paths.y(points[i].pixel))) continue;
    number = static_cast<std::uint32_t>(again.size());
    again.push_back(shared.queue[shared.gather_of[i]]);
    narrow.radius[number] = wide.radius[shared.gather_of[i]] * GatherBias::narrow_part;
  }
  gather_in(map, again);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::uint32_t pixel = points[i].pixel, radiance_estimate = shared.gather_of[i];
    if (!bias_.looks_twice(paths.x(pixel), paths.y(pixel))) continue;
    add_lost(map, pixel,
             points[i].point.weight *
                 (irradiance(wide, radiance_estimate) - irradiance(narrow, again_of[radiance_estimate])),
             paths);
  }
}

/// Adds the light that one path of the pixel loses by the map's radius.
void CameraPass::add_lost(const MapState& map, std::uint32_t pixel, const Rgb& lost, const TilePaths& paths) {
  RgbD of_pixel = RgbD(lost) / static_cast<double>(paths.count[pixel]);
  const int x = paths.x(pixel), y = paths.y(pixel);
  if (lobes_.any()) {
    const double m = lobes_.subtracted(x, y);
    of_pixel = of_pixel * (paths.part == FilterPart::positive ? 1 + m : -m);
  }
  bias_.add(x, y, static_cast<int>(map.kind), paths.pass, of_pixel, paths.weight);
}

}  // namespace photonproof::inline renderer_photon_mapping
