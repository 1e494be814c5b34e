// Camera samples of a tile: path p of a task is sample p mod samples of the pixel number p / samples.
#pragma once

#include "renderer/kernels/tasks.h"
#include "renderer/sensor/camera_ray.h"

namespace photonproof::inline renderer_kernels {

/// Paths [first, first + lanes) of the task; lanes beyond the task's last path repeat it.
template <class F>
CameraRay<F> camera_rays(const SceneView& scene, const CameraTask& task, std::uint32_t first) {
  using U = UInt<F>;
  const U path = lane_index<F>() + first;
  // Exact for the at most 2^20 paths of a task: the quotient is at least half a sample away from an integer.
  const U nth = to_uint(F((to_float(path) + 0.5f) * (1.0f / static_cast<float>(task.samples))));
  U pixel = nth;
  if (task.some_pixels != nullptr) {
    const U last(task.some_count - 1);
    pixel = gather(task.some_pixels, select(as_mask<F>(nth < last), nth, last));
  }
  const U row = to_uint(F((to_float(pixel) + 0.5f) * (1.0f / static_cast<float>(task.tile_width()))));
  const U x = pixel - row * task.tile_width() + static_cast<std::uint32_t>(task.x0);
  const U y = row + static_cast<std::uint32_t>(task.y0);
  CameraRay<F> ray;
  ray.index = path - nth * task.samples + task.first_sample;
  ray.key = pixel_key<F>(x, y, task.seed);

  Vec2<F> in_pixel;
  if (task.grid > 0) {
    const auto grid = static_cast<std::uint32_t>(task.grid);
    const U turn = to_uint(F((to_float(ray.index) + 0.5f) * (1.0f / static_cast<float>(grid * grid))));
    const U cell = ray.index - turn * (grid * grid);
    const U down = to_uint(F((to_float(cell) + 0.5f) * (1.0f / static_cast<float>(grid))));
    in_pixel = {(to_float(U(cell - down * grid)) + 0.5f) * (1.0f / static_cast<float>(grid)),
                (to_float(down) + 0.5f) * (1.0f / static_cast<float>(grid))};
  } else {
    in_pixel = draw2<F>(task.sampler, ray.key, ray.index, U(0u));
    const FilterView& filter = scene.camera.filter;
    if (filter.has_lobes) {
      const Vec2<F> offsets = lobe_offsets<F>(scene.camera, x, y, task.part, in_pixel);
      in_pixel = {0.5f + offsets.x, 0.5f + offsets.y};
    } else if (!filter.is_box)
      in_pixel = {0.5f + filter_offset(filter, x, scene.camera.width, in_pixel.x),
                  0.5f + filter_offset(filter, y, scene.camera.height, in_pixel.y)};
  }
  const CameraView& camera = scene.camera;
  Vec2<F> u_lens{F(0.5f), F(0.5f)};
  if (takes_lens_point(camera.kind)) u_lens = draw2<F>(task.sampler, ray.key, ray.index, U(lens_dimension));
  set_ray(camera, Vec2<F>{to_float(x) + in_pixel.x, to_float(y) + in_pixel.y}, u_lens, ray);
  return ray;
}

}  // namespace photonproof::inline renderer_kernels
