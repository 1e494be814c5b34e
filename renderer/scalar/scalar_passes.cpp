#include "renderer/scalar/scalar_passes.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "renderer/passes/tile_film.h"

namespace photonproof::inline renderer_scalar {
namespace {

constexpr std::int64_t passes_wanted = 32;
constexpr std::int64_t most_paths = std::int64_t{1} << 21;  ///< of a pass, which takes a minute at most
constexpr int tile_size = 16;

PathSampler draws_of(std::uint32_t seed, SamplerKind kind, int x, int y, std::int64_t sample) {
  return {kind, pixel_key<float>(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed),
          static_cast<std::uint32_t>(sample)};
}

/// Seed of the samplers of a part's samples.
std::uint32_t seed_of(const RenderJob& job, Stream stream, FilterPart part) {
  return stream_seed(job.seed, stream, static_cast<std::uint64_t>(part));
}

std::string wider_filter_text(double radius) {
  char text[160];
  std::snprintf(
      text, sizeof text,
      "the filter is %.2g pixels in radius: light paths, of which next to none would meet it, are spread over %g",
      radius, narrowest_splat);
  return text;
}

template <class Visit>
void for_each_pixel(const Tile& tile, Visit&& visit) {
  for (int y = tile.y0; y < tile.y1; ++y)
    for (int x = tile.x0; x < tile.x1; ++x) visit(x, y);
}

std::int64_t longest_pass(const RenderJob& job, const Film& film) {
  const std::int64_t affordable = std::max<std::int64_t>(1, most_paths / (std::int64_t{film.width()} * film.height()));
  if (job.budget.seconds) return affordable;
  return std::clamp<std::int64_t>(job.budget.spp.value_or(job.sample_count) / passes_wanted, 1, affordable);
}

/// The tiles of a window, row by row.
class TileGrid {
 public:
  explicit TileGrid(const Tile& window)
      : window_(window),
        across_((window.width() + tile_size - 1) / tile_size),
        down_((window.height() + tile_size - 1) / tile_size) {}
  std::size_t count() const { return static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_); }
  Tile tile(std::size_t number) const {
    const int x0 = window_.x0 + static_cast<int>(number) % across_ * tile_size;
    const int y0 = window_.y0 + static_cast<int>(number) / across_ * tile_size;
    return {x0, y0, std::min(x0 + tile_size, window_.x1), std::min(y0 + tile_size, window_.y1)};
  }

 private:
  const Tile& window_;
  int across_, down_;
};

}  // namespace

void render_samples(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                    RenderStats& stats, const PixelEstimate& estimate) {
  const PhaseTimer timer(stats.phases["render"]);
  const Threads threads(job.threads);
  const NegativeLobes lobes = negative_lobes(scene, job);
  if (lobes.any()) film.separate(lobes);
  RenderLoop loop(job, threads, film, stats, {.phase = phase, .subtracted = lobes.subtracted()});
  while (loop.next()) {
    loop.for_each_tile([&](const Tile& tile) {
      ScalarWork work;
      const auto sample = [&](FilterPart part, std::int64_t first, std::int64_t samples, auto&& add) {
        const std::uint32_t seed = seed_of(job, stream, part);
        work.part = part;
        for_each_pixel(tile, [&](int x, int y) {
          RgbD sum(0.0), sum_of_squares(0.0);
          for (std::int64_t s = first; s < first + samples; ++s) {
            const RgbD value(estimate(x, y, draws_of(seed, job.sampler, x, y, s), work));
            sum += value;
            sum_of_squares += value * value;
          }
          add(x, y, sum, sum_of_squares);
        });
      };
      sample(FilterPart::positive, loop.first(), loop.samples(),
             [&](int x, int y, const RgbD& sum, const RgbD& squares) { film.add(x, y, sum, squares, loop.samples()); });
      if (loop.negative() > 0)
        sample(FilterPart::negative, loop.first_negative(), loop.negative(),
               [&](int x, int y, const RgbD& sum, const RgbD& squares) {
                 film.add_negative(x, y, sum, squares, loop.negative());
               });
      loop.rays().add(work.rays);
    });
  }
}

void render_splats(const Scene& scene, const RenderJob& job, Stream stream, const char* phase, Film& film,
                   RenderStats& stats, const std::function<PixelEstimate()>& make_estimate) {
  const PhaseTimer timer(stats.phases["render"]);
  const Threads threads(job.threads);
  const Tile& window = film.window();
  const TileGrid tiles(window);
  struct Slot {
    ScalarWork work;
    std::vector<RgbD> radiance;  ///< of the tile's pixels
  };
  const ReconstructionFilter filter = filter_of_splats(scene.filter);
  if (!(filter == scene.filter)) stats.losses.push_back(wider_filter_text(FilterKernel(scene.filter).radius()));
  SplatImage pass =
      scene.sample_border ? SplatImage(window, filter) : SplatImage(window, filter, scene.width, scene.height);
  film.set_pixels_a_splat(FilterKernel(filter).pixels_a_splat());
  const NegativeLobes lobes = negative_lobes(scene, job);
  RenderLoop loop(
      job, threads, film, stats,
      {.phase = phase, .longest = longest_pass(job, film), .subtracted = lobes.subtracted(), .combines_passes = true});
  loop.keep(pass.sums());
  std::vector<Slot> slots(loop.slots());
  while (loop.next()) {
    const auto work_on = [&](std::size_t unit, std::size_t number) {
      Slot& slot = slots[number];
      slot.work.rays = {};
      slot.work.splats.clear();
      slot.radiance.clear();
      const PixelEstimate estimate = make_estimate();
      const auto sum_of = [&](int x, int y, FilterPart part, std::int64_t first, std::int64_t samples) {
        const std::uint32_t seed = seed_of(job, stream, part);
        slot.work.part = part;
        RgbD sum(0.0);
        for (std::int64_t s = first; s < first + samples; ++s)
          sum += RgbD(estimate(x, y, draws_of(seed, job.sampler, x, y, s), slot.work));
        return sum;
      };
      for_each_pixel(tiles.tile(unit), [&](int x, int y) {
        slot.radiance.push_back(sum_of(x, y, FilterPart::positive, loop.first(), loop.samples()));
        if (loop.negative() == 0) return;
        const std::size_t splats = slot.work.splats.size();
        const RgbD negative = sum_of(x, y, FilterPart::negative, loop.first_negative(), loop.negative());
        slot.work.splats.resize(splats);
        const double scale = static_cast<double>(loop.samples()) / static_cast<double>(loop.negative());
        slot.radiance.back() = lobes.combined(x, y, slot.radiance.back(), negative * scale);
      });
      loop.rays().add(slot.work.rays);
    };
    const auto commit = [&](std::size_t unit, std::size_t number) {
      pass.add(slots[number].work.splats);
      auto radiance = slots[number].radiance.begin();
      for_each_pixel(tiles.tile(unit), [&](int x, int y) { pass.add(x, y, *radiance++); });
      if (unit + 1 < tiles.count()) return;
      const auto samples = static_cast<double>(loop.samples());
      for_each_pixel(window, [&](int x, int y) { film.add(x, y, pass.sum(x, y) / samples, samples); });
      film.end_shared_pass(samples);
      pass.clear();
    };
    loop.for_each_in_order(tiles.count(), work_on, commit);
  }
}

}  // namespace photonproof::inline renderer_scalar
