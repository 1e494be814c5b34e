#include "renderer/denoising/guides.h"

#include <algorithm>
#include <cmath>

#include "renderer/scalar/scalar_camera.h"

namespace photonproof::inline renderer_denoising {
namespace {

constexpr Stream guide_stream{28};
constexpr std::uint32_t most_surfaces = 32;  ///< that a ray passes; behind so many nothing is seen

namespace guide_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1, first_hit = 2, per_hit = 3;
}  // namespace guide_dimension

struct Seen {
  Rgb albedo{0.0f};
  Vec3f normal{0.0f};
};

class GuideTracer {
 public:
  GuideTracer(const Scene& scene, const RenderJob& job, bool hide_emitters)
      : scene_interface_(scene), camera_(scene_interface_, 1), grid_(job.grid), hide_emitters_(hide_emitters) {}

  Seen seen(int x, int y, const PathSampler& draws) const {
    const std::optional<Ray> first =
        camera_.ray(x, y, draws, grid_, guide_dimension::in_pixel, draws.two(guide_dimension::lens));
    if (!first) return {};
    Ray ray = *first;
    Rgb throughput(1.0f);
    for (std::uint32_t hit = 0; hit < most_surfaces; ++hit) {
      const std::uint32_t dimension = guide_dimension::first_hit + hit * guide_dimension::per_hit;
      Interaction at;
      if (!scene_interface_.intersect(ray, draws.one(dimension), TransportMode::radiance, at)) return {};
      if (camera_.beyond_far_plane(at.p)) return {};
      if (hide_emitters_ && at.light != no_index) {
        ray = scene_interface_.pass(ray, at, ray.direction);
        continue;
      }
      const Vec3f wo = -ray.direction;
      const Scattered next =
          scatter(at, wo, draws.one(dimension + 1), draws.two(dimension + 2), TransportMode::radiance);
      // Radiance is divided by the squared ratio of indices where it enters glass, albedo is not.
      if (next.valid) throughput = throughput * next.weight * (next.eta * next.eta);
      if (!next.valid || !next.delta) {
        const Vec3f& normal = at.scattering.frame.n;
        return {next.valid ? throughput : Rgb(0.0f), dot(normal, wo) < 0 ? -normal : normal};
      }
      ray = next.straight ? scene_interface_.pass(ray, at, ray.direction) : scene_interface_.leave(at, next.wi);
    }
    return {};
  }

 private:
  SceneInterface scene_interface_;
  ScalarCamera camera_;
  int grid_;
  bool hide_emitters_;
};

/// Sums of samples as a pixel's mean; what is not finite counts as 0.
void store(const RgbD& sum, int samples, double least, float* pixel) {
  const double values[3] = {sum.x, sum.y, sum.z};
  for (int c = 0; c < 3; ++c) {
    const double mean = values[c] / samples;
    pixel[c] = std::isfinite(mean) ? static_cast<float>(std::clamp(mean, least, 1.0)) : 0.0f;
  }
}

}  // namespace

std::optional<Guides> trace_guides(const Scene& scene, const RenderJob& job, bool hide_emitters, const Tile& window,
                                   int samples) {
  const GuideTracer tracer(scene, job, hide_emitters);
  const std::uint32_t seed = stream_seed(job.seed, guide_stream);
  Guides guides{Image(window.width(), window.height()), Image(window.width(), window.height())};
  const auto trace_pixel = [&](int x, int y) {
    const std::uint32_t key = pixel_key<float>(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
    RgbD albedo(0.0), normal(0.0);
    for (int s = 0; s < samples; ++s) {
      const Seen seen = tracer.seen(x, y, {job.sampler, key, static_cast<std::uint32_t>(s)});
      albedo += RgbD(seen.albedo);
      normal += RgbD(seen.normal);
    }
    store(albedo, samples, 0, guides.albedo.pixel(x - window.x0, y - window.y0));
    store(normal, samples, -1, guides.normal.pixel(x - window.x0, y - window.y0));
  };
  const Tiles tiles(window);
  const std::size_t done =
      Threads(job.threads)
          .for_each_in_order(
              0, tiles.count(), [&] { return job.interrupted(); },
              [&](std::size_t i) {
                const Tile tile = tiles.at(i);
                for (int y = tile.y0; y < tile.y1; ++y)
                  for (int x = tile.x0; x < tile.x1; ++x) trace_pixel(x, y);
              },
              [&](std::size_t i) {
                if (job.progress && i % 64 == 0)
                  job.progress(static_cast<double>(i) / static_cast<double>(tiles.count()), "guides");
              });
  if (done < tiles.count()) return std::nullopt;
  return guides;
}

}  // namespace photonproof::inline renderer_denoising
