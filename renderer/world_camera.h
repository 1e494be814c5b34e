// The camera as one history at a time needs it: rays through a place of the image, and points seen from the camera.
#pragma once

#include <optional>

#include "renderer/draws.h"
#include "renderer/world.h"

namespace photonproof {

/// The camera as seen from a point.
struct CameraSeen {
  SegmentEnd end;      ///< where the camera's ray to the point starts
  Vec3f wi{0, 0, 0};   ///< unit, from the point to it
  float density = 0;   ///< of the points where camera rays end, per area across them, over the whole image
  Vec2<float> raster;  ///< pixels from the upper left corner
};

class WorldCamera {
 public:
  explicit WorldCamera(const World& world) : camera_(world.view().camera) {}

  /// The ray through a place of the image.
  Ray ray(const Vec2<float>& raster, const Vec2<float>& u_lens) const;
  /// Nothing where the camera cannot see p, whatever stands between.
  std::optional<CameraSeen> connect(const Vec3f& p, const Vec2<float>& u_lens) const;
  /// The density of CameraSeen for a camera ray that ended at p.
  float density(const Ray& ray, const Vec3f& p) const;
  bool beyond_far_plane(const Vec3f& p) const { return dot(p - camera_.origin, camera_.forward) > camera_.far; }

 private:
  const CameraView& camera_;
};

/// The place in its pixel of a history's sample: drawn, or on the k x k grid that was asked for.
Vec2<float> place_in_pixel(const Draws& draws, int grid, std::uint32_t dimension);

}  // namespace photonproof
