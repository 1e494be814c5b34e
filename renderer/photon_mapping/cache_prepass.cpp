#include "renderer/photon_mapping/cache_prepass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

#include "renderer/core/large_array.h"
#include "renderer/lanes/sampler.h"
#include "renderer/passes/ray_totals.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"
#include "renderer/rays/surface_hit.h"
#include "renderer/sensor/camera.h"
#include "scenes/base/timer.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream cache_stream{12}, cache_global_stream{13}, cache_caustic_stream{14};
constexpr Stream check_stream{17}, check_global_stream{18}, check_caustic_stream{19};

constexpr double photons_of_cache = 250'000;  // where the budget gives no number
constexpr int coarsest_lattice = 32;          // pixels
constexpr std::size_t records_a_round = 64;
/// Least and greatest distance up to which a record is used, in pixels.
constexpr float least_reach = 1.5f, most_reach = 24;

/// Bound of a record's radius, in distances to the nearest surface that it sees. Times kappa this is less than 1, so
/// that a record beside a slot is not used inside the slot.
constexpr float most_of_nearest = 4;

/// Number of pixels where the cache is checked, and rays of a check for each ray of a record. Noise falls faster with
/// rays than with pixels. Both together take as long as 1800 records.
constexpr std::size_t checked_pixel_count = 225;
constexpr std::int64_t rays_a_check = 4;

struct CachePoint {
  Vec3f p, n;
  std::uint32_t number;  ///< number of its pixel
  int x = 0, y = 0;
};

class CacheMaker {
 public:
  CacheMaker(const RenderPlan& plan, const PhotonSource& source, const GatherAreas& areas, PhotonMaps& maps)
      : source_(source),
        areas_(areas),
        maps_(maps.wanted()),
        near_hit_(maps.global),
        grid_(hemisphere_grid(static_cast<std::size_t>(source.settings.gather_rays))),
        check_grid_(hemisphere_grid(static_cast<std::size_t>(rays_a_check * source.settings.gather_rays))),
        kappa_(static_cast<float>(source.settings.cache_error)),
        settings_(camera_path_settings(source.settings, plan)),
        scratch_(source.job.kernels().path) {}

  std::vector<CachePoint> candidates(const Tile& window);
  IrradianceCache make(const std::vector<CachePoint>& points);
  /// Pixels where the cache is checked.
  std::vector<CacheError::Pixel> checked_pixels(const IrradianceCache& cache, const Tile& window,
                                                const std::vector<CachePoint>& points) const;
  /// The values D of cache_error.h, by the maps' photons, for path number `half` of each of the pixels.
  std::vector<RgbD> differences(const IrradianceCache& cache, const std::vector<CacheError::Pixel>& pixels, int half);
  const RayTotals& rays() const { return rays_; }

 private:
  std::vector<CachePoint> of_tile(const Tile& tile, std::uint32_t first_number);
  GatherQueue ends_of(const CameraTask& camera);
  RgbD difference(const IrradianceCache& cache, const CacheError::Pixel& at, std::uint64_t number);
  IrradianceRecord record_at(const CachePoint& point);
  HemisphereRays gather(const HemisphereGrid& grid, const Vec3f& p, const Vec3f& n, std::uint32_t key);
  void add_photons(MapState& map, GatherQueue& queue, std::vector<float>& radiance) const;
  void run(PathTask& task) {
    scratch_.trace(task);
    rays_.add(task.counts);
  }
  float footprint(const Vec3f& p) const { return pixel_footprint(source_.scene.view().camera, p); }

  const PhotonSource& source_;
  const GatherAreas& areas_;
  const std::vector<MapState*> maps_;
  const MapState& near_hit_;  ///< the map whose gather radius limits near hits
  const HemisphereGrid grid_, check_grid_;
  const float kappa_;
  const PathSettings settings_;
  ScratchPool scratch_;
  RayTotals rays_;
};

/// Points where camera paths first meet a Lambertian surface.
GatherQueue CacheMaker::ends_of(const CameraTask& camera) {
  PathTask task{.scene = &source_.scene.view(), .camera = camera, .settings = settings_};
  task.settings.direct_light = DirectLight::hits_only;
  task.policy = PathPolicy::gather_pass;
  std::vector<float> radiance(3 * std::size_t{camera.paths()});
  GatherQueue queue(camera.paths());
  task.radiance = radiance.data();
  task.points = queue.view();
  run(task);
  queue.set_size(task.points.count);
  return queue;
}

std::vector<CachePoint> CacheMaker::of_tile(const Tile& tile, std::uint32_t first_number) {
  CameraTask camera = camera_task(source_.job, tile, 0, 1);
  camera.seed = stream_seed(source_.job.seed, cache_stream);
  const GatherQueue queue = ends_of(camera);
  std::vector<CachePoint> points;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const GatherPoint at = queue[i];
    points.push_back({at.p, facing_side_normal(at.surface_side), first_number + at.path});
  }
  return points;
}

/// Candidate points from coarse to fine lattices, each in a scrambled order, so that those of a round are far apart.
std::vector<CachePoint> CacheMaker::candidates(const Tile& window) {
  struct Ordered {
    int lattice;
    std::uint32_t scrambled;
    CachePoint point;
  };
  const Tiles tiles(window);
  std::vector<std::vector<CachePoint>> of_tiles(tiles.count());
  std::vector<std::uint32_t> first(tiles.count() + 1, 0);
  for (std::size_t i = 0; i < tiles.count(); ++i)
    first[i + 1] = first[i] + static_cast<std::uint32_t>(tiles.at(i).width() * tiles.at(i).height());
  source_.threads.for_each(tiles.count(), [&](std::size_t i) { of_tiles[i] = of_tile(tiles.at(i), first[i]); });
  std::vector<Ordered> ordered;
  for (std::size_t i = 0; i < tiles.count(); ++i)
    for (const CachePoint& point : of_tiles[i]) {
      const Tile tile = tiles.at(i);
      const int pixel = static_cast<int>(point.number - first[i]);
      const int x = tile.x0 + pixel % tile.width(), y = tile.y0 + pixel / tile.width();
      int lattice = coarsest_lattice;
      while (x % lattice != 0 || y % lattice != 0) lattice /= 2;
      ordered.push_back({lattice, mix_bits(point.number), {point.p, point.n, point.number, x, y}});
    }
  std::ranges::stable_sort(ordered, [](const Ordered& a, const Ordered& b) {
    return a.lattice != b.lattice ? a.lattice > b.lattice : a.scrambled < b.scrambled;
  });
  std::vector<CachePoint> points;
  points.reserve(ordered.size());
  for (const Ordered& o : ordered) points.push_back(o.point);
  return points;
}

/// Adds the light that the map's photons bring.
void CacheMaker::add_photons(MapState& map, GatherQueue& queue, std::vector<float>& radiance) const {
  if (map.map.empty() || queue.size() == 0) return;
  const GatherPoints points = queue.view();
  std::fill_n(points.radius, points.count, map.radii.radius);
  const GatherKernelEntry& kernels = source_.job.kernels().gather;
  radiance_estimate(map, source_.settings, areas_, kernels, queue);
  map.count_found(points);
  kernels.add(points, radiance.data());
}

/// Traces a ray through every cell of the hemisphere.
HemisphereRays CacheMaker::gather(const HemisphereGrid& grid, const Vec3f& p, const Vec3f& n, std::uint32_t key) {
  constexpr std::size_t slack = 16;  // elements, for a whole pack
  const std::size_t cells = grid.cells();
  const std::array<Vec3f, 2> axes = record_axes(n);
  std::array<std::vector<float>, 6> columns;
  for (std::vector<float>& column : columns) column.resize(cells + slack);
  std::vector<std::uint32_t> keys(cells + slack, key), indices(cells + slack);
  for (std::uint32_t cell = 0; cell < cells; ++cell) {
    const Vec2<float> u = draw2<float>(SamplerKind::independent, key, cell, 0u);
    const Vec3f local = grid.direction(cell, u.x, u.y);
    const Vec3f to = normalize(axes[0] * local.x + axes[1] * local.y + n * local.z);
    const Vec3f from = offset_from(p, n, to, source_.scene.view().coordinate_floor);
    const float row[] = {from.x, from.y, from.z, to.x, to.y, to.z};
    for (std::size_t c = 0; c < columns.size(); ++c) columns[c][cell] = row[c];
    indices[cell] = cell;
  }
  HemisphereRays rays{std::vector<Rgb>(cells), std::vector<float>(cells, std::numeric_limits<float>::infinity())};
  std::vector<float> radiance(3 * cells);
  GatherQueue queue(cells), caustic_queue(cells);
  PathTask task{.scene = &source_.scene.view(), .camera = {}, .settings = settings_};
  task.camera.sampler = source_.job.sampler;
  task.bounces = {static_cast<std::uint32_t>(cells),
                  columns[0].data(),
                  columns[1].data(),
                  columns[2].data(),
                  columns[3].data(),
                  columns[4].data(),
                  columns[5].data(),
                  keys.data(),
                  indices.data(),
                  rays.distance.data()};
  task.policy = PathPolicy::cache_rays;
  task.radiance = radiance.data();
  task.points = queue.view();
  task.caustic_points = caustic_queue.view();
  task.near_hit = near_hit_.radii.radius;
  run(task);
  queue.set_size(task.points.count);
  caustic_queue.set_size(task.caustic_points.count);
  for (MapState* map : maps_) {
    add_photons(*map, queue, radiance);
    if (map->kind == PhotonKind::caustic) add_photons(*map, caustic_queue, radiance);
  }
  for (std::size_t i = 0; i < cells; ++i)
    rays.radiance[i] = {radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]};
  return rays;
}

/// Makes the record at a point. Its radius is at most the distance over which its light would change by 100 %. The
/// nearest visible surface also bounds the radius, and so does most_reach in pixels.
IrradianceRecord CacheMaker::record_at(const CachePoint& point) {
  const float pixel = footprint(point.p);
  const std::uint32_t key = stream_seed(source_.job.seed, cache_stream, point.number + 1);
  const HemisphereRays rays = gather(grid_, point.p, point.n, key);
  IrradianceRecord record = make_record(point.p, point.n, grid_, rays, pixel);
  record.radius = std::min(record.radius, most_of_nearest * *std::ranges::min_element(rays.distance));
  const Rgb& e = record.irradiance;
  const float change = length(record.moved[0] + record.moved[1] + record.moved[2]);
  const float sum = e.x + e.y + e.z;
  if (change * record.radius > sum) record.radius = sum / change;
  record.radius = std::min(record.radius, most_reach * pixel / kappa_);
  return record;
}

IrradianceCache CacheMaker::make(const std::vector<CachePoint>& points) {
  IrradianceCache cache(kappa_);
  for (std::size_t next = 0; next < points.size();) {
    std::vector<CachePoint> round;
    for (; next < points.size() && round.size() < records_a_round; ++next)
      if (!cache.covers(points[next].p, points[next].n)) round.push_back(points[next]);
    std::vector<IrradianceRecord> records(round.size());
    source_.threads.for_each(round.size(), [&](std::size_t i) { records[i] = record_at(round[i]); });
    for (const IrradianceRecord& record : records)
      if (!cache.covers(record.p, record.n)) cache.insert(record, least_reach * footprint(record.p) / kappa_);
  }
  return cache;
}

/// Half of the pixels are drawn evenly over the image, half by the cache's estimated error in them or beside them. Some
/// pixels, at edges of lights and in corners, have most of the error.
std::vector<CacheError::Pixel> CacheMaker::checked_pixels(const IrradianceCache& cache, const Tile& window,
                                                          const std::vector<CachePoint>& points) const {
  const auto width = static_cast<std::size_t>(window.width()),
             pixels = width * static_cast<std::size_t>(window.height());
  std::vector<double> density(pixels, 0.0);
  for (const CachePoint& at : points) {
    const double doubt = double{cache.doubt(at.p, at.n)};
    for (int y = std::max(at.y - 1, window.y0); y < std::min(at.y + 2, window.y1); ++y)
      for (int x = std::max(at.x - 1, window.x0); x < std::min(at.x + 2, window.x1); ++x) {
        double& there =
            density[static_cast<std::size_t>(y - window.y0) * width + static_cast<std::size_t>(x - window.x0)];
        there = std::max(there, doubt);
      }
  }
  const double all = std::accumulate(density.begin(), density.end(), 0.0);
  for (double& d : density)
    d = all > 0 ? 0.5 / static_cast<double>(pixels) + 0.5 * d / all : 1 / static_cast<double>(pixels);
  constexpr std::size_t checks = checked_pixel_count;
  const std::uint32_t key = stream_seed(source_.job.seed, check_stream);
  std::vector<CacheError::Pixel> drawn;
  double before = 0;
  for (std::size_t pixel = 0; pixel < pixels && drawn.size() < checks; before += density[pixel++])
    while (drawn.size() < checks) {
      const auto number = static_cast<std::uint32_t>(drawn.size());
      const double u =
          (number + double{draw2<float>(SamplerKind::independent, key, number, 0u).x}) / static_cast<double>(checks);
      if (u >= before + density[pixel] && pixel + 1 < pixels) break;
      drawn.push_back({window.x0 + static_cast<int>(pixel % width), window.y0 + static_cast<int>(pixel / width),
                       1 / (density[pixel] * static_cast<double>(pixels * checks))});
    }
  return drawn;
}

/// The value D for one path; `number` is unique to the path.
RgbD CacheMaker::difference(const IrradianceCache& cache, const CacheError::Pixel& at, std::uint64_t number) {
  CameraTask camera = camera_task(source_.job, {at.x, at.y, at.x + 1, at.y + 1}, 0, 1);
  camera.seed = stream_seed(source_.job.seed, check_stream, 2 * number + 1);
  const GatherQueue ends = ends_of(camera);
  if (ends.size() == 0) return RgbD(0.0);
  const Vec3f p = ends[0].p, n = facing_side_normal(ends[0].surface_side);
  const HemisphereRays rays = gather(check_grid_, p, n, stream_seed(source_.job.seed, check_stream, 2 * number + 2));
  const Rgb gathered = make_record(p, n, check_grid_, rays, footprint(p)).irradiance;
  return RgbD(ends[0].weight * (cache.interpolate(p, n) - gathered));
}

std::vector<RgbD> CacheMaker::differences(const IrradianceCache& cache, const std::vector<CacheError::Pixel>& pixels,
                                          int half) {
  std::vector<RgbD> found(pixels.size());
  source_.threads.for_each(pixels.size(), [&](std::size_t i) {
    found[i] = difference(cache, pixels[i], 2 * i + static_cast<std::uint64_t>(half));
  });
  return found;
}

/// Fills a map with the cache's own photons.
void fill_for_cache(MapState& map, Stream stream, std::int64_t by_scene, const PhotonSource& source,
                    const GatherAreas& areas, RenderStats& stats) {
  const std::int64_t asked = source.job.budget.photons.value_or(by_scene);
  const double count = asked > 0 ? static_cast<double>(asked) : photons_of_cache;
  map.stream = stream;
  if (!map.fixed_radius) map.radii.radius *= static_cast<float>(shrunk(count / map.radii.first_photons));
  map.a_sample = count;
  map.least = 1;
  map.tests = areas.tests(map.radii.radius);
  refill(map, source, 0, 1, stats);
}

/// Refills the map with photons that the cache did not use and halves its radius. The change is an error of the cache,
/// too.
void refill_to_check(MapState& map, Stream stream, int half, const PhotonSource& source, const GatherAreas& areas,
                     RenderStats& stats) {
  if (!map.wanted) return;
  map.stream = stream;
  if (half == 0) map.radii.radius *= 0.5f;
  map.tests = areas.tests(map.radii.radius);
  refill(map, source, half, half + 1, stats);
}

CacheError check(const IrradianceCache& cache, CacheMaker& maker, PhotonMaps& maps, const PhotonSource& source,
                 const GatherAreas& areas, std::vector<CacheError::Pixel> pixels, RenderStats& stats) {
  std::array<std::vector<RgbD>, 2> found;
  for (int half = 0; half < 2; ++half) {
    refill_to_check(maps.global, check_global_stream, half, source, areas, stats);
    refill_to_check(maps.caustic, check_caustic_stream, half, source, areas, stats);
    const PhaseTimer phase(stats.phases["cache_check"]);
    found[static_cast<std::size_t>(half)] = maker.differences(cache, pixels, half);
  }
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].product = found[0][i] * found[1][i];
  return CacheError(std::move(pixels));
}

}  // namespace

CheckedCache make_irradiance_cache(const RenderPlan& plan, const PhotonSource& source, const GatherAreas& areas,
                                   const Tile& window, RenderStats& stats) {
  PhotonMaps maps(plan, source);
  maps.choose_first_radii(source, stats);
  fill_for_cache(maps.global, cache_global_stream, source.settings.global_photons, source, areas, stats);
  if (maps.caustic.wanted)
    fill_for_cache(maps.caustic, cache_caustic_stream, source.settings.caustic_photons, source, areas, stats);
  CacheMaker maker(plan, source, areas, maps);
  std::vector<CacheError::Pixel> checked;
  const auto make = [&] {
    const PhaseTimer phase(stats.phases["cache"]);
    const std::vector<CachePoint> points = maker.candidates(window);
    IrradianceCache cache = maker.make(points);
    checked = maker.checked_pixels(cache, window, points);
    return cache;
  };
  IrradianceCache cache = make();
  maps.say_what_is_lost(source.scene, 1, stats);
  CacheError error = check(cache, maker, maps, source, areas, std::move(checked), stats);
  maker.rays().store(stats);
  stats.counts["rays_photon"] += static_cast<double>(maps.global.counts.rays + maps.caustic.counts.rays);
  stats.counts["cache_records"] = static_cast<double>(cache.records().size());
  return {std::move(cache), std::move(error)};
}

}  // namespace photonproof::inline renderer_photon_mapping
