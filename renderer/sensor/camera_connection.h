// Connects points of the scene to the camera, for light tracing and bidirectional estimators.
//
// A pixel's value is the integral over the raster of filter(raster) x L(raster), averaged over the lens. The filter's
// integral is 1 and L is the radiance that arrives along the ray through that raster point and lens point. Let a light
// path bring the radiance L_o from its vertex y, whose density per area is p(y), to the camera. It then adds
//   `filter(raster) x L_o cos_y x importance / p(y)`
// to the pixels around `raster`, with importance = raster area (pixels) per area across the ray at y. Importance
// includes 1/distance^2; for the orthographic camera there is no such factor. For paths of photons L_o cos_y / p(y) is
// f x flux x cos_y. The lens point is sampled uniformly, which averages over the lens.
#pragma once

#include "renderer/sensor/camera_view.h"

namespace photonproof::inline renderer_sensor {

struct CameraConnection {
  bool visible = false;  ///< If p is before the camera, between the clipping planes and within reach of the film.
  Vec2<float> raster;    ///< May lie outside the image, by the filter's reach.
  Vec3f origin;          ///< Start of the camera's ray through p, on the near plane: the end of shadow segments.
  Vec3f direction;       ///< Unit, of that ray, from the camera to p.
  float distance = 0;    ///< From `origin` to p.
  float importance = 0;  ///< Pixels per area across the ray at p.
};

/// `u_lens` samples the point of the lens; cameras without a lens do not use it.
CameraConnection connect_to_camera(const CameraView& camera, const Vec3f& p, const Vec2<float>& u_lens);

}  // namespace photonproof::inline renderer_sensor
