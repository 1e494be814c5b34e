// Perspective camera with Mitsuba's conventions: local +z forward, +y up, +x to the left of the image.
#pragma once

#include "renderer/ray.h"
#include "scenes/description.h"

namespace photonproof {

class Camera {
 public:
  /// `width`, `height` in pixels: the size rendered, which fixes the aspect and so the fields of view.
  Camera(const SensorDescription& sensor, int width, int height);

  /// `x`, `y` in pixels from the image's top left corner. Throughput is 1: the film averages radiance.
  Ray ray(float x, float y) const;
  /// World height of a pixel at the depth of `p_world`.
  float footprint_at(const Vec3f& p_world) const { return 2 * tan_y_ / height_ * dot(p_world - origin_, forward_); }

 private:
  Vec3f origin_, right_, up_, forward_;
  float tan_x_, tan_y_;
  float width_, height_;
  float near_, far_;
};

}  // namespace photonproof
