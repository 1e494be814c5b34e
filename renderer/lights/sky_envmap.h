// A latitude-longitude image of the radiance from all directions, with Mitsuba's conventions. Local +y is up; u turns
// from local -z through +x. Texel columns are at half-integers of u x width. Rows reach from pole to pole: row 0 is at
// the zenith, the last at the nadir. Between texels radiance is bilinear.
#pragma once

#include <vector>

#include "renderer/core/discrete_distribution.h"
#include "scenes/base/vec.h"
#include "scenes/description/transform.h"
#include "scenes/images/image.h"

namespace photonproof::inline renderer_lights {

class EnvmapSky {
 public:
  /// The image has at least 1 x 2 finite texels, times `scale`. Only the rotation of `to_world` is used; it must be
  /// invertible.
  EnvmapSky(const Image& image, float scale, const Transform& to_world);

  Rgb radiance(const Vec3f& towards_sky) const;
  Vec3f sample(const Vec2<float>& u) const;
  float pdf(const Vec3f& towards_sky) const;
  Rgb irradiance() const { return irradiance_; }

 private:
  /// A point of the image: the texels around it are (column, row) and the next ones.
  struct Place {
    int column, row;
    float right, down;  ///< in [0,1]
  };
  Place place_of(const Vec3f& local) const;
  Rgb texel(int column, int row) const;
  double solid_angle(int row) const;  ///< of a cell between four texels
  int rows() const { return height_ - 1; }

  int width_, height_;
  std::vector<float> rgb_;
  Vec3f x_, y_, z_;  ///< local axes in the world, unit
  DiscreteDistribution by_row_;
  std::vector<DiscreteDistribution> in_row_;
  Rgb irradiance_;
};

}  // namespace photonproof::inline renderer_lights
