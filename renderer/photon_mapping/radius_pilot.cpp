#include "renderer/photon_mapping/radius_pilot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <numbers>
#include <utility>

#include "renderer/lanes/path_sampler.h"
#include "renderer/passes/scratch_pool.h"
#include "renderer/passes/tile_film.h"
#include "renderer/photons/query_order.h"
#include "renderer/sensor/film.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr Stream radius_pilot_stream{17};
/// The image is cut into this many cells, each with one pixel of the pilot.
constexpr int cells_across = 64, cells_down = 32;
/// Cells of a part, which one thread gathers at a time.
constexpr int cells_down_a_part = 2;
static_assert(cells_down % cells_down_a_part == 0);

constexpr std::size_t fewest_photons = 64;
/// Radii are tried in steps of this factor, so that the radius two steps before is the narrow one.
constexpr double step_factor = std::numbers::sqrt2;
constexpr std::size_t steps_to_narrow = 2;
static_assert(GatherBias::narrow_part == 0.5f);
/// Pixels whose mean an error is relative to.
constexpr std::size_t side_by_side = 8;
/// Trials end where the bias alone exceeds this factor of the least error, twice in a row.
constexpr double far_above = 1.5;
constexpr int twice = 2;
/// In standard errors: where D's square exceeds this, it is not by noise.
constexpr double plainly = 4;
/// The pilot's pixels in some rows of cells, one per cell, as their place in the window.
std::vector<std::uint32_t> scattered_pixels(const Tile& window, int first_down, int down, std::uint32_t seed) {
  const auto cell_begin = [](int size, int cell, int cells) { return size * cell / cells; };
  std::vector<std::uint32_t> pixels;
  for (int j = first_down; j < first_down + down; ++j)
    for (int i = 0; i < cells_across; ++i) {
      const int x0 = cell_begin(window.width(), i, cells_across), y0 = cell_begin(window.height(), j, cells_down);
      const int columns = cell_begin(window.width(), i + 1, cells_across) - x0;
      const int rows = cell_begin(window.height(), j + 1, cells_down) - y0;
      if (columns == 0 || rows == 0) continue;
      const auto cell = static_cast<std::uint32_t>(j * cells_across + i);
      const auto drawn = [&](std::uint32_t dimension, int count) {
        return static_cast<int>(draw_independent<float>(seed, cell, dimension) * static_cast<float>(count));
      };
      pixels.push_back(static_cast<std::uint32_t>((y0 + drawn(1, rows)) * window.width() + x0 + drawn(0, columns)));
    }
  return pixels;
}

double sum_of(const RgbD& v) { return v.x + v.y + v.z; }

/// First or second half of the photons.
Photons half_of(const Photons& photons, int half) {
  const std::size_t middle = photons.size() / 2;
  Photons some;
  for (std::size_t i = half == 0 ? 0 : middle; i < (half == 0 ? middle : photons.size()); ++i)
    some.push_back(photons[i]);
  return some;
}

}  // namespace

RadiusPilot::RadiusPilot(const PhotonSource& source, const PathSettings& settings, const GatherAreas& areas,
                         const Tile& window)
    : source_(source), areas_(areas), parts_(cells_down / cells_down_a_part) {
  ScratchPool scratch(source.job.kernels().path);
  const std::uint32_t seed = stream_seed(source.job.seed, radius_pilot_stream);
  source.threads.for_each(parts_.size(), [&](std::size_t number) {
    const std::vector<std::uint32_t> pixels =
        scattered_pixels(window, static_cast<int>(number) * cells_down_a_part, cells_down_a_part, seed);
    if (pixels.empty()) return;
    PathTask task{.scene = &source.scene.view(),
                  .camera = camera_task(source.job, window, 0, 1),
                  .settings = settings,
                  .policy = policy_of_maps(source.scene, settings)};
    task.camera.seed = seed;
    task.camera.grid = 0;
    task.camera.some_pixels = pixels.data();
    task.camera.some_count = static_cast<std::uint32_t>(pixels.size());
    Part& part = parts_[number];
    part.radiance.resize(3 * pixels.size());
    part.points.emplace(pixels.size());
    task.radiance = part.radiance.data();
    task.points = part.points->view();
    task.rough.by_photons = splits_rough_parts(source.scene, task.policy);
    scratch.trace(task);
    part.points->set_size(task.points.count);
  });
}

/// Both halves have the same areas.
void RadiusPilot::gather_part(std::size_t number, const Maps& maps, const std::vector<SheetTest>& tests, float radius,
                              Light& light) {
  Part& part = parts_[number];
  if (!part.points) return;
  const std::size_t count = part.points->size();
  const GatherPoints points = part.points->view();
  std::fill(points.radius, points.radius + count, radius);
  std::vector<float> areas(count);
  for (std::size_t h = 0; h < 2; ++h) {
    light.by[h].assign(part.radiance.size() / 3, RgbD(0.0));
    if (maps[h].empty() || count == 0) continue;
    const std::vector<std::uint32_t> order = cell_order(maps[h], *part.points);
    source_.job.kernels().gather.gather(
        {maps[h].view(), most_edges(source_.settings), points, order.data(), tests.data()});
    for (std::size_t i = 0; i < count; ++i) {
      light.found += points.found[i];
      light.gathers += 1;
      if (points.found[i] == 0) continue;
      const GatherPoint point = (*part.points)[i];
      if (areas[i] == 0) areas[i] = areas_.divisor(point, radius);
      if (!(areas[i] > 0)) continue;
      const Rgb flux{points.flux_red[i], points.flux_green[i], points.flux_blue[i]};
      // A photon carries its share of all light paths; a half has half of them.
      light.by[h][point.path] += RgbD(point.weight * flux) * (2 / double{areas[i]});
    }
  }
}

std::vector<RadiusPilot::Light> RadiusPilot::gather(const Halves& photons, float radius) {
  Maps maps;
  for (std::size_t h = 0; h < 2; ++h) {
    Photons copy;
    copy.append(photons[h]);
    maps[h].build(std::move(copy), radius, source_.threads);
  }
  const std::vector<SheetTest> tests = areas_.tests(radius);
  std::vector<Light> light(parts_.size());
  source_.threads.for_each(parts_.size(),
                           [&](std::size_t part) { gather_part(part, maps, tests, radius, light[part]); });
  return light;
}

/// Means over the pixels. They are relative to the mean of some pixels side by side, since one has much noise.
GatherBias::Evidence RadiusPilot::compare(const std::vector<Light>& wide, const std::vector<Light>& narrow) const {
  GatherBias::Evidence sum;
  double values = 0;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const Light &w = wide[part], &n = narrow[part];
    const std::size_t pixels = w.by[0].size();
    values += 3 * static_cast<double>(pixels);
    RgbD scale(0.0);
    for (std::size_t i = 0; i < pixels; ++i) {
      if (i % side_by_side == 0) scale = Film::relative_scale(mean_image(parts_[part], w, i));
      const RgbD first = w.by[0][i] - n.by[0][i], second = w.by[1][i] - n.by[1][i], apart = first - second;
      sum.difference += sum_of(first * second * scale);
      sum.variance += sum_of(apart * apart * scale) / 4;
    }
  }
  return values > 0 ? GatherBias::Evidence{sum.difference / values, sum.variance / values} : sum;
}

/// Mean of the image over pixels side by side, from `first` on.
RgbD RadiusPilot::mean_image(const Part& part, const Light& light, std::size_t first) {
  const std::size_t end = std::min(first + side_by_side, light.by[0].size());
  RgbD sum(0.0);
  for (std::size_t i = first; i < end; ++i) {
    const float* direct = &part.radiance[3 * i];
    sum += RgbD(direct[0], direct[1], direct[2]) + (light.by[0][i] + light.by[1][i]) / 2.0;
  }
  return sum / static_cast<double>(end - first);
}

/// Numbers of photons and gathers of all parts.
RadiusPilot::Light RadiusPilot::sums_of(const std::vector<Light>& light) {
  Light sum;
  for (const Light& part : light) {
    sum.found += part.found;
    sum.gathers += part.gathers;
  }
  return sum;
}

RadiusTrials RadiusPilot::try_radii(const Photons& photons, double emitted, const Limits& limits) {
  RadiusTrials trials(emitted, limits.least_exponent);
  if (photons.size() < fewest_photons) return trials;
  const Halves halves{half_of(photons, 0), half_of(photons, 1)};
  std::deque<std::vector<Light>> light;  // of the last radii
  double least_error = std::numeric_limits<double>::infinity();
  double proven = 0;  // a wider disc has no less bias
  int too_wide = 0;
  for (double radius = limits.least / step_factor / step_factor; too_wide < twice; radius *= step_factor) {
    if (!trials.empty() && radius > limits.most) break;
    light.push_back(gather(halves, static_cast<float>(radius)));
    if (light.size() <= steps_to_narrow) continue;
    const Light all = sums_of(light.back());
    if (!trials.empty() && all.found > limits.most_found * all.gathers / 2) break;  // half of the photons
    const GatherBias::Evidence evidence = compare(light.back(), light.front());
    light.pop_front();
    // Discs that do not overlap, among those of the points.
    const double discs = std::clamp(static_cast<double>(photons.size()) / 2 * all.gathers / std::max(all.found, 1.0),
                                    1.0, std::max(1.0, all.gathers / 2));
    const double noise = evidence.variance * std::sqrt(2 / discs);
    if (evidence.difference > plainly * noise) proven = std::max(proven, evidence.difference);
    const auto bias_by = [](double difference) { return GatherBias::Evidence{difference, 0}.squared_bias(); };
    const double variance = evidence.variance / 3, bias = bias_by(std::max(evidence.difference + noise, proven));
    const double seen = bias_by(std::max(evidence.difference, proven));
    trials.add(radius, variance, seen, bias - seen);
    least_error = std::min(least_error, variance + bias);
    too_wide = bias > far_above * least_error ? too_wide + 1 : 0;
  }
  return trials;
}

}  // namespace photonproof::inline renderer_photon_mapping
