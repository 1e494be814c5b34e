// The same radiance from all directions.
#pragma once

#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {

struct ConstantSky {
  Rgb value;

  Rgb radiance(const Vec3f&) const { return value; }
  Vec3f sample(const Vec2<float>& u) const { return square_to_sphere(u); }
  float pdf(const Vec3f&) const { return 1 / (4 * pi); }
  Rgb irradiance() const { return value * (4 * pi); }
};

}  // namespace photonproof::inline renderer_lights
