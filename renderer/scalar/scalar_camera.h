// The camera for the scalar integrators: rays through a place of the image, and the camera seen from points.
#pragma once

#include <optional>

#include "renderer/lanes/path_sampler.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_scalar {

/// The camera as seen from a point.
struct CameraSeen {
  SegmentEnd end;      ///< Start of the camera's ray to the point.
  Vec3f wi{0, 0, 0};   ///< Unit, from the point to it.
  float density = 0;   ///< Density of the points where camera rays end, per area across them, over the whole image.
  Vec2<float> raster;  ///< Pixels from the upper left corner.
};

class ScalarCamera {
 public:
  /// `rays` is the number of rendered pixels; densities are over one camera ray for each.
  ScalarCamera(const SceneInterface& scene, std::int64_t rays)
      : camera_(scene.view().camera), rays_(static_cast<float>(rays)) {}

  /// The ray of a camera sample of a pixel; empty where the camera has no image. `grid` as in RenderJob.
  std::optional<Ray> ray(int x, int y, const PathSampler& draws, int grid, std::uint32_t in_pixel,
                         const Vec2<float>& u_lens, FilterPart part = FilterPart::positive) const;
  /// Empty where the camera cannot see p, without regard to occlusion.
  std::optional<CameraSeen> connect(const Vec3f& p, const Vec2<float>& u_lens) const;
  /// The density of CameraSeen for a camera ray, from the same point of the lens, that ended at p.
  float density(const Vec3f& p, const Vec2<float>& u_lens) const;
  bool beyond_far_plane(const Vec3f& p) const;

 private:
  const CameraView& camera_;
  float rays_;
};

}  // namespace photonproof::inline renderer_scalar
