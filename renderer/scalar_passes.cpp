#include "renderer/scalar_passes.h"

#include <algorithm>

#include "renderer/parallel.h"
#include "renderer/pass_schedule.h"
#include "renderer/ray_totals.h"

namespace photonproof {
namespace {

constexpr std::int64_t passes_wanted = 32;
constexpr std::int64_t most_histories = std::int64_t{1} << 21;  ///< of a pass with splats, which wait in memory

Draws draws_of(std::uint32_t seed, SamplerKind kind, int x, int y, std::int64_t sample) {
  const auto pixel = static_cast<std::uint32_t>(y) << 16 | static_cast<std::uint32_t>(x);
  return {kind, mix_bits(mix_bits(pixel) + seed), static_cast<std::uint32_t>(sample)};
}

/// Calls pass(first sample, samples) until the budget ends; stops at an interrupt.
template <class Pass>
void run_passes(const RenderJob& job, std::int64_t longest, const char* phase, RenderStats& stats, const Pass& pass) {
  PassSchedule schedule(job.budget.spp.value_or(job.sample_count), job.budget.seconds, longest);
  for (std::int64_t samples = schedule.next(); samples > 0; samples = schedule.next()) {
    pass(schedule.samples_done() - samples, samples);
    if (job.progress) job.progress(schedule.fraction(), phase);
    if (job.interrupted()) {
      stats.interrupted = true;
      break;
    }
  }
  stats.counts["samples_per_pixel"] = static_cast<double>(schedule.samples_done());
}

}  // namespace

void render_samples(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                    RenderStats& stats, const PixelEstimate& estimate) {
  const PhaseTimer timer(stats.phases["render"]);
  const Threads threads(job.threads);
  const std::uint32_t seed = stream_seed(job.seed, stream);
  RayTotals totals;
  run_passes(job, 64, phase, stats, [&](std::int64_t first, std::int64_t samples) {
    for_each_tile(threads, scene.width, scene.height, [&](const Tile& tile) {
      if (first > 0 && job.interrupted()) return;
      ScalarWork work;
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          RgbD sum(0.0), sum_of_squares(0.0);
          for (std::int64_t s = first; s < first + samples; ++s) {
            const RgbD value(estimate(x, y, draws_of(seed, job.sampler, x, y, s), work));
            sum += value;
            sum_of_squares += value * value;
          }
          film.add(x, y, sum, sum_of_squares, static_cast<int>(samples));
        }
      }
      totals.add(work.rays);
    });
  });
  totals.store(stats);
}

void render_splats(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                   RenderStats& stats, const std::function<PixelEstimate()>& make_estimate) {
  const PhaseTimer timer(stats.phases["render"]);
  const Threads threads(job.threads);
  const std::uint32_t seed = stream_seed(job.seed, stream);
  const std::int64_t pixels = std::int64_t{scene.width} * scene.height;
  const std::int64_t affordable = std::max<std::int64_t>(1, most_histories / pixels);
  const std::int64_t longest =
      job.budget.seconds
          ? affordable
          : std::clamp<std::int64_t>(job.budget.spp.value_or(job.sample_count) / passes_wanted, 1, affordable);
  RayTotals totals;
  SplatImage splats(scene.width, scene.height);
  std::vector<RgbD> own(static_cast<std::size_t>(pixels));
  const auto across = static_cast<std::size_t>((scene.width + 15) / 16);
  std::vector<ScalarWork> work(across * static_cast<std::size_t>((scene.height + 15) / 16));
  run_passes(job, longest, phase, stats, [&](std::int64_t first, std::int64_t samples) {
    for_each_tile(threads, scene.width, scene.height, [&](const Tile& tile) {
      ScalarWork& mine = work[static_cast<std::size_t>(tile.y0 / 16) * across + static_cast<std::size_t>(tile.x0 / 16)];
      mine.rays = {};
      mine.splats.clear();
      const PixelEstimate estimate = make_estimate();
      for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
          RgbD sum(0.0);
          for (std::int64_t s = first; s < first + samples; ++s)
            sum += RgbD(estimate(x, y, draws_of(seed, job.sampler, x, y, s), mine));
          own[static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x)] = sum;
        }
      }
      totals.add(mine.rays);
    });
    splats.clear();
    for (const ScalarWork& w : work) splats.add(w.splats);
    // As many histories as camera samples: a pixel's share of the image is its share of the histories.
    for (int y = 0; y < scene.height; ++y)
      for (int x = 0; x < scene.width; ++x) {
        const RgbD& seen =
            own[static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x)];
        film.add(x, y, (seen + splats.sum(x, y)) / static_cast<double>(samples), static_cast<double>(samples));
      }
  });
  totals.store(stats);
}

}  // namespace photonproof
