// A pinhole that projects an image, the reverse of a perspective camera. Meaning as in Mitsuba 3's projector.
#pragma once

#include "renderer/core/discrete_distribution.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_sample.h"
#include "renderer/textures/light_texture.h"

namespace photonproof::inline renderer_lights {

/// The rectangle that the image fills on the plane one unit ahead. The unit vectors are the directions in which the
/// image's u and v grow, and the axis.
struct ProjectorScreen {
  Vec3f position, right, down, axis;
  float half_width, half_height;
};

class ProjectorLight {
 public:
  static constexpr bool is_delta = true, is_infinite = false;

  /// On the screen, what faces the axis gets the irradiance `image`. Photons start by the means of cells, of which
  /// there are `cells` along each side; each mean is that of `steps` times `steps` points.
  ProjectorLight(const ProjectorScreen& screen, LightTexture image, int cells, int steps);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  float pdf(const Vec3f&, const LightPoint<float>&) const { return 0; }
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux_towards(const LightPoint<float>& at, const Vec3f& direction) const { return leaving(at, direction); }
  Rgb leaving(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux() const { return flux_; }
  LightBounds bounds() const;

 private:
  /// A direction's place in the image.
  struct Seen {
    Vec2<float> uv;
    float cosine;  ///< with the axis
    bool inside;
  };
  Seen seen(const Vec3f& direction) const;
  float cell_area() const;  ///< on the screen

  ProjectorScreen screen_;
  LightTexture image_;
  int cells_;
  DiscreteDistribution distribution_;  ///< of cells, row by row
  Rgb flux_{0.0f};
};

}  // namespace photonproof::inline renderer_lights
