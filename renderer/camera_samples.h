// Where in its pixel a camera sample lies.
#pragma once

#include <cstdint>

#include "renderer/sampler.h"
#include "renderer/scene.h"

namespace photonproof {

inline Ray camera_ray(const Scene& scene, int x, int y, std::int64_t sample, int grid, Sampler& sampler) {
  Vec2<float> in_pixel = sampler.next2();
  if (grid > 0) {
    const auto cell = static_cast<int>(sample % (std::int64_t{grid} * grid));
    const int row = cell / grid;
    in_pixel = {(static_cast<float>(cell - row * grid) + 0.5f) / static_cast<float>(grid),
                (static_cast<float>(row) + 0.5f) / static_cast<float>(grid)};
  }
  return scene.camera.ray(static_cast<float>(x) + in_pixel.x, static_cast<float>(y) + in_pixel.y);
}

inline std::uint64_t pixel_index(const Scene& scene, int x, int y) {
  return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(scene.width) + static_cast<std::uint64_t>(x);
}

}  // namespace photonproof
