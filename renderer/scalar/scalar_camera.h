// The camera as the scalar integrators need it: rays through a place of the image, and points seen from the camera.
#pragma once

#include <optional>

#include "renderer/lanes/path_sampler.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_scalar {

/// The camera as seen from a point.
struct CameraSeen {
  SegmentEnd end;      ///< where the camera's ray to the point starts
  Vec3f wi{0, 0, 0};   ///< unit, from the point to it
  float density = 0;   ///< of the points where camera rays end, per area across them, over the whole image
  Vec2<float> raster;  ///< pixels from the upper left corner
};

class ScalarCamera {
 public:
  /// `rays`: pixels that are rendered, each with one of the camera rays over which densities are.
  ScalarCamera(const SceneInterface& world, std::int64_t rays)
      : camera_(world.view().camera), rays_(static_cast<float>(rays)) {}

  /// The ray of a camera sample of a pixel; nothing where the camera has no image. `grid` as in RenderJob.
  std::optional<Ray> ray(int x, int y, const PathSampler& draws, int grid, std::uint32_t in_pixel,
                         const Vec2<float>& u_lens) const;
  /// Nothing where the camera cannot see p, whatever stands between.
  std::optional<CameraSeen> connect(const Vec3f& p, const Vec2<float>& u_lens) const;
  /// The density of CameraSeen for a camera ray, from the same place of the lens, that ended at p.
  float density(const Vec3f& p, const Vec2<float>& u_lens) const;
  bool beyond_far_plane(const Vec3f& p) const;

 private:
  const CameraView& camera_;
  float rays_;
};

}  // namespace photonproof::inline renderer_scalar
