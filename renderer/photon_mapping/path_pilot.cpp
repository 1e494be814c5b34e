#include "renderer/photon_mapping/path_pilot.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "renderer/passes/ray_totals.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photons/query_order.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream path_pilot_stream{15};

constexpr int samples_a_pixel = PilotImage::samples_a_pixel, pixels_a_block = 8;
/// Paths that one thread traces at a time, at least: the kernel takes many at once.
constexpr int paths_a_chunk = 512;

/// Mean of the block of a pixel, or of its other pixels.
RgbD block_mean(const PilotImage& image, std::size_t pixel, bool others = false) {
  const std::size_t first = pixel / image.block * image.block;
  const bool leaves_out = others && image.block > 1;
  RgbD sum(0.0);
  for (std::size_t i = first; i < first + image.block; ++i)
    if (!leaves_out || i != pixel) sum += image.pixels[i].all();
  return sum / (static_cast<double>(image.block - (leaves_out ? 1 : 0)) * samples_a_pixel);
}

double mean_of(const RgbD& v) { return (v.x + v.y + v.z) / 3; }

/// Variance of a sample of a pixel.
RgbD variance_at(const PilotImage::Pixel& s, Samples samples) {
  constexpr double set = PilotImage::samples_a_set;
  const RgbD apart = s.sum[0] - s.sum[1];
  const RgbD within = (s.squares - (s.sum[0] * s.sum[0] + s.sum[1] * s.sum[1]) / set) / (2 * (set - 1));
  return samples == Samples::spread ? apart * apart / (2 * set) : within;
}

/// Number of equal values that would have the same sum and sum of squares.
struct Evenness {
  double sum = 0, squares = 0;
  void add(double value) {
    sum += value;
    squares += value * value;
  }
  double carriers() const { return squares > 0 ? sum * sum / squares : 0; }
};

bool counts(const PilotImage::Pixel& pixel, Where where) { return where == Where::all_pixels || !pixel.rough; }

/// Blocks across and down: near squares of the window.
int blocks_across_for(const Tile& window, double blocks) {
  const double shape = static_cast<double>(window.width()) / window.height();
  const int most = std::max(1, window.width() / pixels_a_block);
  return std::clamp(static_cast<int>(std::lround(std::sqrt(blocks * shape))), 1, most);
}

/// Sums over the points, by surface.
void count(const GatherPoints& points, PointsBySurface& by_surface, double each) {
  for (std::size_t i = 0; i < points.count; ++i) by_surface[surface_number(points.surface[i])] += each;
}

}  // namespace

double PilotImage::mean() const {
  double sum = 0;
  for (const Pixel& pixel : pixels) sum += mean_of(pixel.all());
  return sum / (static_cast<double>(pixels.size()) * samples_a_pixel);
}

double variance_of(const PilotImage& image, const PilotImage& whole, Samples samples) {
  double sum = 0;
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    sum += mean_of(variance_at(image.pixels[i], samples) * Film::relative_scale(block_mean(whole, i)));
  return sum / static_cast<double>(image.pixels.size());
}

Spread variance_within(const PilotImage& part, const PilotImage& whole) {
  Evenness sum;
  for (std::size_t first = 0; first < part.pixels.size(); first += part.block) {
    const RgbD scale = Film::relative_scale(block_mean(whole, first));
    double of_part = 0, of_whole = 0;
    for (std::size_t i = first; i < first + part.block; ++i) {
      of_part += mean_of(variance_at(part.pixels[i], Samples::by_themselves) * scale);
      of_whole += mean_of(variance_at(whole.pixels[i], Samples::by_themselves) * scale);
    }
    sum.add(std::min(of_part, of_whole));
  }
  return {sum.sum / static_cast<double>(part.pixels.size()), sum.carriers()};
}

VarianceBeside variance_beside(const PilotImage& part, const PilotImage& whole) {
  VarianceBeside sum;
  Evenness added;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    const RgbD all = variance_at(whole.pixels[i], Samples::spread), own = variance_at(part.pixels[i], Samples::spread);
    const RgbD common(std::min(all.x, own.x), std::min(all.y, own.y), std::min(all.z, own.z));
    sum.common += mean_of(common * Film::relative_scale(block_mean(whole, i)));
    added.add(mean_of((all - common) * Film::relative_scale(block_mean(whole, i, true))));
  }
  const auto pixels = static_cast<double>(whole.pixels.size());
  return {sum.common / pixels, {added.sum / pixels, added.carriers()}};
}

LightBetween light_between(const PilotImage& part, const PilotImage& whole, Where where) {
  Evenness sum;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    if (!counts(part.pixels[i], where)) continue;
    const RgbD missing = whole.pixels[i].without_photons - part.pixels[i].without_photons;
    sum.add(mean_of(missing * Film::relative_scale(block_mean(whole, i))));
  }
  return {sum.sum / (static_cast<double>(whole.pixels.size()) * samples_a_pixel), sum.carriers()};
}

CausticLight caustic_light(const PilotImage& image, const PilotImage& whole, Where where) {
  CausticLight sum;
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    if (!counts(image.pixels[i], where)) continue;
    const RgbD scale = Film::relative_scale(block_mean(whole, i));
    sum.all += mean_of(image.pixels[i].caustics * scale);
    sum.dimmed += mean_of(image.pixels[i].dimmed_caustics * scale);
  }
  const double samples = static_cast<double>(image.pixels.size()) * samples_a_pixel;
  return {sum.all / samples, sum.dimmed / samples};
}

double mean_square_between(const PilotImage& part, const PilotImage& whole) {
  double sum = 0;
  for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
    const RgbD mean = block_mean(whole, i), missing = mean - block_mean(part, i);
    sum += mean_of(missing * missing * Film::relative_scale(mean));
  }
  return sum / static_cast<double>(whole.pixels.size());
}

/// Points that a chunk's paths leave.
struct PathPilot::Left {
  std::vector<PilotImage::Pixel> pixels{};
  std::vector<std::uint32_t> caustic_surfaces{};
  GatherQueue points{0}, rough{0}, rough_narrow{0};
  RayCounts rays{};

  void make_room_on_rough(RoughGathers& gathers) {
    gathers.room = std::max<std::size_t>(1024, 2 * gathers.points.count);
    const auto grow = [&](GatherQueue& queue, GatherPoints& view) {
      queue.set_size(view.count);
      queue.reserve(gathers.room);
      view = queue.view();
    };
    grow(rough, gathers.points);
    grow(rough_narrow, gathers.narrow);
  }
};

PathPilot::PathPilot(const PhotonSource& source, const PathSettings& settings, const Tile& window, double paths)
    : source_(source),
      settings_(settings),
      tests_(source.scene.surfaces.size(), SheetTest::side),
      window_(window),
      block_width_(std::min(pixels_a_block, window.width())),
      blocks_across_(blocks_across_for(window, paths / (samples_a_pixel * pixels_a_block))),
      blocks_down_(
          std::clamp(static_cast<int>(std::lround(paths / (samples_a_pixel * pixels_a_block * double(blocks_across_)))),
                     1, window.height())),
      rows_a_chunk_(std::max(1, paths_a_chunk / (blocks_across_ * block_width_ * PilotImage::samples_a_set))),
      scratch_(source.job.kernels().path) {}

/// The pixels of some rows of blocks, as their place in the window. Each block has a place of its own in its cell.
std::vector<std::uint32_t> PathPilot::pixels_of(std::size_t chunk) const {
  const std::uint32_t seed = stream_seed(source_.job.seed, path_pilot_stream);
  const auto cell_begin = [](int size, int cell, int cells) { return size * cell / cells; };
  const int first = static_cast<int>(chunk) * rows_a_chunk_, end = std::min(first + rows_a_chunk_, blocks_down_);
  std::vector<std::uint32_t> pixels;
  for (int j = first; j < end; ++j)
    for (int i = 0; i < blocks_across_; ++i) {
      const auto cell = static_cast<std::uint32_t>(j * blocks_across_ + i);
      const auto drawn = [&](std::uint32_t dimension, int begin, int places) {
        return begin + static_cast<int>(draw_independent<float>(seed, cell, dimension) * static_cast<float>(places));
      };
      const int x0 = cell_begin(window_.width(), i, blocks_across_), y0 = cell_begin(window_.height(), j, blocks_down_);
      const int x = drawn(0, x0, cell_begin(window_.width(), i + 1, blocks_across_) - x0 - block_width_ + 1);
      const int y = drawn(1, y0, cell_begin(window_.height(), j + 1, blocks_down_) - y0);
      for (int k = 0; k < block_width_; ++k) pixels.push_back(static_cast<std::uint32_t>(y * window_.width() + x + k));
    }
  return pixels;
}

/// Adds the caustic photons at the first point of each path to its pixel, and those at later points to the path's
/// radiance. Gathers count by whole discs, which is enough to know the noise and most of the light. A path that goes on
/// from a point carries at most pi times the point's weight.
void PathPilot::gather_caustics(GatherQueue& queue, const CausticMap& caustics, std::vector<float>& radiance,
                                std::vector<PilotImage::Pixel>& pixels) const {
  if (caustics.map.empty() || queue.size() == 0) return;
  const GatherPoints points = queue.view();
  std::fill(points.radius, points.radius + points.count, caustics.radius);
  const std::vector<std::uint32_t> order = cell_order(caustics.map, queue);
  source_.job.kernels().gather.gather(
      {caustics.map.view(), most_edges(source_.settings), points, order.data(), tests_.data()});
  std::vector<bool> seen(radiance.size() / 3);
  const double disc = std::numbers::pi * square(double{caustics.radius});
  for (std::size_t i = 0; i < points.count; ++i) {
    const GatherPoint point = queue[i];
    const RgbD light = RgbD(point.weight * Rgb{points.flux_red[i], points.flux_green[i], points.flux_blue[i]}) / disc;
    if (seen[point.path]) {
      float* sample = &radiance[3 * std::size_t{point.path}];
      for (const auto& [channel, value] : {std::pair{0, light.x}, {1, light.y}, {2, light.z}})
        sample[channel] += static_cast<float>(value);
    } else {
      PilotImage::Pixel& pixel = pixels[point.path / PilotImage::samples_a_set];
      pixel.caustics += light;
      pixel.dimmed_caustics += light * (std::numbers::pi * double{max_component(point.weight)});
    }
    seen[point.path] = true;
  }
}

/// Adds the points and samples of a set.
void PathPilot::trace_set(const std::vector<std::uint32_t>& pixels, int set, PathPolicy policy,
                          const CausticMap* caustics, Left& left) {
  PathTask task{.scene = &source_.scene.view(),
                .camera = camera_task(source_.job, window_, 0, PilotImage::samples_a_set),
                .settings = settings_,
                .policy = policy};
  task.camera.seed = stream_seed(source_.job.seed, path_pilot_stream, static_cast<std::uint64_t>(set));
  task.camera.grid = 0;
  task.camera.some_pixels = pixels.data();
  task.camera.some_count = static_cast<std::uint32_t>(pixels.size());
  const std::size_t paths = task.camera.paths();
  const auto room = [](GatherQueue& queue, std::size_t points) {
    queue.reserve(queue.size() + points);
    return queue.view();
  };
  std::vector<float> radiance(3 * paths), radii;
  task.radiance = radiance.data();
  GatherQueue later(0);
  if (policy == PathPolicy::beside_caustic_map)
    task.caustic_points = room(later, 2 * paths);
  else
    task.points = room(left.points, paths);
  task.rough.by_photons = splits_rough_parts(source_.scene, policy);
  if (caustics != nullptr && task.rough.by_photons) {
    radii.assign(paths, caustics->radius);
    task.rough.map = caustics->map.view();
    task.rough.max_edges = most_edges(source_.settings);
    task.rough.tests = tests_.data();
    task.rough.radius = radii.data();
    task.rough.make_room = [](PathTask& of) { static_cast<Left*>(of.rough.sink)->make_room_on_rough(of.rough); };
    task.rough.sink = &left;
    task.rough.points = left.rough.view();
    task.rough.narrow = left.rough_narrow.view();
    task.rough.room = task.rough.points.count;
  }
  scratch_.trace(task);
  left.rays.camera += task.counts.camera;
  left.rays.bounce += task.counts.bounce;
  left.rays.shadow += task.counts.shadow;
  left.points.set_size(task.points.count);
  later.set_size(task.caustic_points.count);
  for (std::size_t i = 0; i < later.size(); ++i) left.caustic_surfaces.push_back(surface_number(later[i].surface));
  for (std::size_t i = 0; i < paths; ++i)
    left.pixels[i / PilotImage::samples_a_set].without_photons +=
        RgbD(radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]);
  if (caustics != nullptr) gather_caustics(later, *caustics, radiance, left.pixels);
  const std::size_t first_rough = left.rough.size();
  left.rough.set_size(task.rough.points.count);
  for (std::size_t i = first_rough; i < left.rough.size(); ++i)
    left.pixels[left.rough[i].path / PilotImage::samples_a_set].rough = true;
  left.rough_narrow.set_size(task.rough.narrow.count);
  for (std::size_t i = 0; i < paths; ++i) {
    const RgbD value(radiance[3 * i], radiance[3 * i + 1], radiance[3 * i + 2]);
    PilotImage::Pixel& pixel = left.pixels[i / PilotImage::samples_a_set];
    pixel.sum[static_cast<std::size_t>(set)] += value;
    pixel.squares += value * value;
  }
}

void PathPilot::trace_chunk(std::size_t chunk, PathPolicy policy, const CausticMap* caustics, Left& left) {
  const std::vector<std::uint32_t> pixels = pixels_of(chunk);
  left.pixels.resize(pixels.size());
  for (int set = 0; set < PilotImage::sets; ++set) trace_set(pixels, set, policy, caustics, left);
}

PilotImage PathPilot::trace(PathPolicy policy, const CausticMap* caustics) {
  std::vector<Left> chunks(static_cast<std::size_t>((blocks_down_ + rows_a_chunk_ - 1) / rows_a_chunk_));
  source_.threads.for_each(chunks.size(), [&](std::size_t i) { trace_chunk(i, policy, caustics, chunks[i]); });
  PilotImage image;
  image.block = static_cast<std::size_t>(block_width_);
  const std::size_t surfaces = source_.scene.surfaces.size();
  for (PointsBySurface* points : {&image.points_a_sample, &image.caustic_points_a_sample, &image.rough_points_a_sample})
    points->resize(surfaces);
  const double each = 1 / (static_cast<double>(block_width_) * blocks_across_ * blocks_down_ * samples_a_pixel);
  for (Left& left : chunks) {
    image.pixels.insert(image.pixels.end(), left.pixels.begin(), left.pixels.end());
    image.rays_a_sample += static_cast<double>(left.rays.camera + left.rays.bounce + left.rays.shadow) * each;
    count(left.points.view(), image.points_a_sample, each);
    for (const std::uint32_t surface : left.caustic_surfaces) image.caustic_points_a_sample[surface] += each;
    const GatherPoints gathered = left.rough.view();
    count(gathered, image.rough_points_a_sample, each);
    for (std::size_t i = 0; i < gathered.count; ++i) image.found_a_sample += gathered.found[i] * each;
  }
  return image;
}

}  // namespace photonproof::inline renderer_photon_mapping
