#include "renderer/passes/tile_film.h"

#include "scenes/base/faults.h"

namespace photonproof::inline renderer_passes {
namespace {

template <class Body>
void for_each_pixel(const CameraTask& task, const std::vector<float>& radiance, Body&& body) {
  const float* samples = radiance.data();
  for (int y = task.y0; y < task.y1; ++y)
    for (int x = task.x0; x < task.x1; ++x, samples += 3 * std::size_t{task.samples}) body(x, y, samples);
}

}  // namespace

NegativeLobes negative_lobes(const SceneParts& scene, const RenderJob& job) {
  if (job.grid > 0) return {};  // in place of the filter
  return {scene.filter, scene.sample_border, scene.width, scene.height};
}

CameraTask camera_task(const RenderJob& job, const Tile& tile, std::int64_t first, std::int64_t samples,
                       FilterPart part) {
  const Stream stream = part == FilterPart::positive ? camera_stream : negative_camera_stream;
  return {tile.x0,
          tile.y0,
          tile.x1,
          tile.y1,
          static_cast<std::uint32_t>(first),
          static_cast<std::uint32_t>(samples),
          stream_seed(has_fault(Fault::same_samples) ? 1 : job.seed, stream),
          job.sampler,
          job.grid,
          nullptr,
          0,
          part};
}

void add_samples(Film& film, const CameraTask& task, const std::vector<float>& radiance) {
  for_each_pixel(task, radiance, [&](int x, int y, const float* samples) {
    RgbD sum(0.0), sum_of_squares(0.0);
    for (std::size_t s = 0; s < task.samples; ++s) {
      const RgbD value(Vec3f(samples[3 * s], samples[3 * s + 1], samples[3 * s + 2]));
      sum += value;
      sum_of_squares += value * value;
    }
    if (task.part == FilterPart::positive)
      film.add(x, y, sum, sum_of_squares, static_cast<int>(task.samples));
    else
      film.add_negative(x, y, sum, sum_of_squares, static_cast<int>(task.samples));
  });
}

void add_means(Film& film, const CameraTask& task, const std::vector<float>& radiance) {
  for_each_pixel(task, radiance, [&](int x, int y, const float* samples) {
    RgbD sum(0.0);
    for (std::size_t s = 0; s < task.samples; ++s)
      sum += RgbD(Vec3f(samples[3 * s], samples[3 * s + 1], samples[3 * s + 2]));
    film.add(x, y, sum / task.samples, task.samples);
  });
}

}  // namespace photonproof::inline renderer_passes
