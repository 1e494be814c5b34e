#include "scenes/pbrt/octahedral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_pbrt {

Vec2<double> equal_area_square(const Vec3d& direction) {
  const double x = std::abs(direction.x), y = std::abs(direction.y), z = std::min(std::abs(direction.z), 1.0);
  // A cap about the pole of height 1 - z has this share of the hemisphere, and the diamond of radius r the same.
  const double r = std::sqrt(1 - z);
  double v = r * std::atan2(y, x) * (2 / std::numbers::pi), u = r - v;
  if (direction.z < 0) {
    const double folded = 1 - v;
    v = 1 - u;
    u = folded;
  }
  return {(std::copysign(u, direction.x) + 1) / 2, (std::copysign(v, direction.y) + 1) / 2};
}

Image latitude_longitude(const Image& square, const Transform& to_light) {
  constexpr int per_axis = 4;  // samples of a pixel
  const int height = std::clamp(square.height, 16, 4096), width = 2 * height;
  const auto texel = [&](double at) { return std::clamp(static_cast<int>(at * square.width), 0, square.width - 1); };
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Vec3d sum(0.0);
      double weights = 0;
      for (int i = 0; i < per_axis * per_axis; ++i) {
        const double across = (x + (i % per_axis + 0.5) / per_axis) / width;
        const double theta = (y + (i / per_axis + 0.5) / per_axis) / height * std::numbers::pi;
        // +z is the middle of an envmap, +x to the left of it.
        const double phi = (0.5 - across) * 2 * std::numbers::pi, sine = std::sin(theta);
        const Vec3d d = to_light.vector({sine * std::sin(phi), std::cos(theta), sine * std::cos(phi)});
        const Vec2<double> at = equal_area_square(normalize(d));
        const float* value = square.pixel(texel(at.x), texel(at.y));
        sum += sine * Vec3d(double{value[0]}, double{value[1]}, double{value[2]});
        weights += sine;
      }
      const Vec3d mean = sum * (1 / weights);
      float* out = image.pixel(x, y);
      out[0] = static_cast<float>(mean.x);
      out[1] = static_cast<float>(mean.y);
      out[2] = static_cast<float>(mean.z);
    }
  return image;
}

}  // namespace photonproof::inline scenes_pbrt
