#include "renderer/scalar/coverage.h"

#include <algorithm>

#include "renderer/passes/tile_film.h"
#include "renderer/scalar/scalar_camera.h"

namespace photonproof::inline renderer_scalar {
namespace {

constexpr Stream coverage_stream{22};
constexpr std::uint32_t most_surfaces = 256;  ///< passed by a ray; behind that many it counts as having met a shape

namespace coverage_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1, first_hit = 2, per_hit = 3;
}  // namespace coverage_dimension

class CoverageTracer {
 public:
  CoverageTracer(const Scene& scene, int grid, bool hide_emitters)
      : scene_interface_(scene), camera_(scene_interface_, 1), grid_(grid), hide_emitters_(hide_emitters) {}

  bool meets_a_shape(int x, int y, const PathSampler& draws, FilterPart part) const {
    const std::optional<Ray> first =
        camera_.ray(x, y, draws, grid_, coverage_dimension::in_pixel, draws.two(coverage_dimension::lens), part);
    if (!first) return false;
    Ray ray = *first;
    for (std::uint32_t hit = 0; hit < most_surfaces; ++hit) {
      const std::uint32_t dimension = coverage_dimension::first_hit + hit * coverage_dimension::per_hit;
      Interaction at;
      if (!scene_interface_.intersect(ray, draws.one(dimension), TransportMode::radiance, at)) return false;
      if (camera_.beyond_far_plane(at.p)) return false;
      if (!passes(at, ray, draws, dimension)) return true;
      ray = scene_interface_.pass(ray, at, ray.direction);
    }
    return true;
  }

 private:
  bool passes(const Interaction& at, const Ray& ray, const PathSampler& draws, std::uint32_t dimension) const {
    if (hide_emitters_ && at.light != no_index) return true;
    if (!scene_interface_.has_null_surfaces()) return false;
    const Scattered next =
        scatter(at, -ray.direction, draws.one(dimension + 1), draws.two(dimension + 2), TransportMode::radiance);
    return next.valid && next.straight;
  }

  SceneInterface scene_interface_;
  ScalarCamera camera_;
  int grid_;
  bool hide_emitters_;
};

}  // namespace

std::vector<float> coverage(const Scene& scene, const RenderJob& job, bool hide_emitters, const Tile& window,
                            std::int64_t samples) {
  const CoverageTracer tracer(scene, job.grid, hide_emitters);
  const auto count = static_cast<std::uint32_t>(std::clamp<std::int64_t>(samples, 1, most_coverage_samples));
  const NegativeLobes lobes = negative_lobes(scene, job);
  const auto width = static_cast<std::size_t>(window.width());
  std::vector<float> share(width * static_cast<std::size_t>(window.height()));
  Threads(job.threads).for_each(static_cast<std::size_t>(window.height()), [&](std::size_t row) {
    const int y = window.y0 + static_cast<int>(row);
    for (int x = window.x0; x < window.x1; ++x) {
      const auto share_of = [&](FilterPart part, std::uint32_t rays) {
        const std::uint32_t seed = stream_seed(job.seed, coverage_stream, static_cast<std::uint64_t>(part));
        const std::uint32_t key = pixel_key<float>(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
        std::uint32_t met = 0;
        for (std::uint32_t s = 0; s < rays; ++s)
          if (tracer.meets_a_shape(x, y, {job.sampler, key, s}, part)) ++met;
        return static_cast<float>(met) / static_cast<float>(rays);
      };
      float& of_pixel = share[row * width + static_cast<std::size_t>(x - window.x0)];
      of_pixel = share_of(FilterPart::positive, count);
      if (!lobes.any()) continue;
      const auto rays = static_cast<std::uint32_t>(negative_samples(lobes.subtracted(), count));
      of_pixel = static_cast<float>(
          lobes.combined(x, y, RgbD(double{of_pixel}), RgbD(double{share_of(FilterPart::negative, rays)})).x);
    }
  });
  return share;
}

}  // namespace photonproof::inline renderer_scalar
