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

constexpr std::size_t fewest_photons = 64, pixels_a_group = 8;
/// Radii are tried in steps of this factor, so that the radius two steps before is the narrow one.
constexpr double step_factor = std::numbers::sqrt2;
constexpr std::size_t steps_to_narrow = 2;
static_assert(GatherBias::narrow_part == 0.5f);
/// Pixels around each one, as steps across and down. Lines of pixels are mostly level or upright: these miss them.
constexpr std::array<std::array<int, 2>, 4> steps_around{{{-2, -2}, {2, -2}, {-2, 2}, {2, 2}}};
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

/// Some pixels around each of the pixels, kept inside the window.
std::vector<std::uint32_t> pixels_around(const std::vector<std::uint32_t>& pixels, const Tile& window) {
  const int width = window.width(), height = window.height();
  std::vector<std::uint32_t> around;
  around.reserve(pixels.size() * steps_around.size());
  for (const std::uint32_t pixel : pixels)
    for (const auto& [across, down] : steps_around) {
      const int x = std::clamp(static_cast<int>(pixel) % width + across, 0, width - 1);
      const int y = std::clamp(static_cast<int>(pixel) / width + down, 0, height - 1);
      around.push_back(static_cast<std::uint32_t>(y * width + x));
    }
  return around;
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
  const auto trace = [&](const std::vector<std::uint32_t>& pixels, Paths& paths) {
    PathTask task{.scene = &source.scene.view(),
                  .camera = camera_task(source.job, window, 0, 1),
                  .settings = settings,
                  .policy = policy_of_maps(source.scene, settings)};
    task.camera.seed = seed;
    task.camera.grid = 0;
    task.camera.some_pixels = pixels.data();
    task.camera.some_count = static_cast<std::uint32_t>(pixels.size());
    paths.radiance.resize(3 * pixels.size());
    paths.points.emplace(pixels.size());
    task.radiance = paths.radiance.data();
    task.points = paths.points->view();
    task.rough.by_photons = splits_rough_parts(source.scene, task.policy);
    scratch.trace(task);
    paths.points->set_size(task.points.count);
  };
  source.threads.for_each(parts_.size(), [&](std::size_t number) {
    const std::vector<std::uint32_t> pixels =
        scattered_pixels(window, static_cast<int>(number) * cells_down_a_part, cells_down_a_part, seed);
    if (pixels.empty()) return;
    trace(pixels, parts_[number].at);
    trace(pixels_around(pixels, window), parts_[number].around);
  });
}

/// Both halves have the same areas.
void RadiusPilot::gather_at(Paths& paths, const Maps& maps, const std::vector<SheetTest>& tests, float radius,
                            Light& light) const {
  if (!paths.points) return;
  const std::size_t count = paths.points->size();
  const GatherPoints points = paths.points->view();
  std::fill(points.radius, points.radius + count, radius);
  std::vector<float> areas(count);
  for (std::size_t h = 0; h < 2; ++h) {
    light.by[h].assign(paths.radiance.size() / 3, RgbD(0.0));
    if (maps[h].empty() || count == 0) continue;
    const std::vector<std::uint32_t> order = cell_order(maps[h], *paths.points);
    source_.job.kernels().gather.gather(
        {maps[h].view(), most_edges(source_.settings), points, order.data(), tests.data()});
    for (std::size_t i = 0; i < count; ++i) {
      light.found += points.found[i];
      light.gathers += 1;
      if (points.found[i] == 0) continue;
      const GatherPoint point = (*paths.points)[i];
      if (areas[i] == 0) areas[i] = areas_.divisor(point, radius);
      if (!(areas[i] > 0)) continue;
      const Rgb flux{points.flux_red[i], points.flux_green[i], points.flux_blue[i]};
      // A photon carries its share of all light paths; a half has half of them.
      light.by[h][point.path] += RgbD(point.weight * flux) * (2 / double{areas[i]});
    }
  }
}

RadiusPilot::Maps RadiusPilot::maps_of(const Halves& photons, float radius) const {
  Maps maps;
  for (std::size_t h = 0; h < 2; ++h) {
    Photons copy;
    copy.append(photons[h]);
    maps[h].build(std::move(copy), radius, source_.threads);
  }
  return maps;
}

std::vector<RadiusPilot::Light> RadiusPilot::gather(const Halves& photons, float radius) {
  const Maps maps = maps_of(photons, radius);
  const std::vector<SheetTest> tests = areas_.tests(radius);
  std::vector<Light> light(parts_.size());
  source_.threads.for_each(parts_.size(),
                           [&](std::size_t part) { gather_at(parts_[part].at, maps, tests, radius, light[part]); });
  return light;
}

/// Scales by pixels of the image far apart.
void RadiusPilot::measure_scales_by_groups(const std::vector<Light>& light) {
  for (std::size_t number = 0; number < parts_.size(); ++number) {
    Part& part = parts_[number];
    part.scale.resize(part.at.radiance.size() / 3);
    for (std::size_t first = 0; first < part.scale.size(); first += pixels_a_group) {
      const std::size_t end = std::min(first + pixels_a_group, part.scale.size());
      RgbD mean(0.0);
      for (std::size_t i = first; i < end; ++i) {
        const float* sample = &part.at.radiance[3 * i];
        mean += RgbD(sample[0], sample[1], sample[2]) + (light[number].by[0][i] + light[number].by[1][i]) / 2.0;
      }
      mean = mean / static_cast<double>(end - first);
      for (std::size_t i = first; i < end; ++i) part.scale[i] = Film::relative_scale(mean);
    }
  }
}

/// Scales by the brightest of the pixels around. Light without photons is the mean of theirs, since one sample of it
/// has much noise.
void RadiusPilot::measure_scales_around(const Halves& photons, float radius) {
  constexpr std::size_t around = steps_around.size();
  const Maps maps = maps_of(photons, radius);
  const std::vector<SheetTest> tests = areas_.tests(radius);
  source_.threads.for_each(parts_.size(), [&](std::size_t number) {
    Part& part = parts_[number];
    Light light;
    gather_at(part.around, maps, tests, radius, light);
    part.scale_around.assign(part.at.radiance.size() / 3, RgbD(0.0));
    for (std::size_t i = 0; i < part.scale_around.size(); ++i) {
      RgbD direct(0.0), brightest(0.0);
      for (std::size_t j = around * i; j < around * (i + 1); ++j) {
        const float* sample = &part.around.radiance[3 * j];
        direct += RgbD(sample[0], sample[1], sample[2]) / double{around};
        const RgbD found = (light.by[0][j] + light.by[1][j]) / 2.0;
        brightest = {std::max(brightest.x, found.x), std::max(brightest.y, found.y), std::max(brightest.z, found.z)};
      }
      part.scale_around[i] = Film::relative_scale(direct + brightest);
    }
  });
}

/// Means over the pixels, by their scales.
GatherBias::Evidence RadiusPilot::compare(const std::vector<Light>& wide, const std::vector<Light>& narrow,
                                          std::vector<RgbD> Part::*scales) const {
  GatherBias::Evidence sum;
  double values = 0;
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const Light &w = wide[part], &n = narrow[part];
    const std::vector<RgbD>& scale = parts_[part].*scales;
    values += 3 * static_cast<double>(scale.size());
    for (std::size_t i = 0; i < scale.size(); ++i) {
      const RgbD first = w.by[0][i] - n.by[0][i], second = w.by[1][i] - n.by[1][i], apart = first - second;
      sum.difference += sum_of(first * second * scale[i]);
      sum.variance += sum_of(apart * apart * scale[i]) / 4;
    }
  }
  return values > 0 ? GatherBias::Evidence{sum.difference / values, sum.variance / values} : sum;
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
  if (limits.smooth) measure_scales_around(halves, static_cast<float>(limits.least));
  double proven = 0;  // a wider disc has no less bias
  int too_wide = 0;
  for (double radius = limits.least / step_factor / step_factor; too_wide < twice; radius *= step_factor) {
    if (!trials.empty() && radius > limits.most) break;
    light.push_back(gather(halves, static_cast<float>(radius)));
    if (light.size() <= steps_to_narrow) continue;
    const Light all = sums_of(light.back());
    if (!trials.empty() && all.found > limits.most_found * all.gathers / 2) break;  // half of the photons
    measure_scales_by_groups(light.back());
    const GatherBias::Evidence evidence = compare(light.back(), light.front(), &Part::scale);
    const GatherBias::Evidence local =
        limits.smooth ? compare(light.back(), light.front(), &Part::scale_around) : evidence;
    light.pop_front();
    // Discs that do not overlap, among those of the points.
    const double discs = std::clamp(static_cast<double>(photons.size()) / 2 * all.gathers / std::max(all.found, 1.0),
                                    1.0, std::max(1.0, all.gathers / 2));
    const double noise = evidence.variance * std::sqrt(2 / discs);
    if (evidence.difference > plainly * noise) proven = std::max(proven, evidence.difference);
    const auto bias_by = [](double difference) { return GatherBias::Evidence{difference, 0}.squared_bias(); };
    const double variance = evidence.variance / 3, bias = bias_by(std::max(evidence.difference + noise, proven));
    const double seen = bias_by(std::max(evidence.difference, proven));
    trials.add(radius, {variance, seen}, bias - seen, {local.variance / 3, bias_by(local.difference)});
    least_error = std::min(least_error, variance + bias);
    too_wide = bias > far_above * least_error ? too_wide + 1 : 0;
  }
  return trials;
}

}  // namespace photonproof::inline renderer_photon_mapping
