// From points of the scene back to the camera: what light tracing and bidirectional estimators need.
//
// A pixel's value is the integral over the raster of filter(raster) x L(raster), averaged over the lens; the filter's
// integral is 1 and L is the radiance that arrives along the ray through that raster point and lens point. A light path
// that brings radiance L_o from its vertex y, whose density per area is p(y), to the camera therefore adds
//   filter(raster) x L_o cos_y x importance / p(y)
// to the pixels around `raster`, with importance = raster area (pixels) per area across the ray at y: 1/distance^2 is
// inside, and for the orthographic camera, which has none, it is not. For paths of photons L_o cos_y / p(y) is
// f x flux x cos_y. The lens point is drawn uniformly, which is the average over the lens.
#pragma once

#include "renderer/sensor/camera_view.h"

namespace photonproof::inline renderer_sensor {

struct CameraConnection {
  bool visible = false;  ///< p is before the camera, between the clipping planes and within reach of the film
  Vec2<float> raster;    ///< may lie outside of the image, by what the filter reaches
  Vec3f origin;          ///< of the camera's ray through p, on the near plane: where shadow segments end
  Vec3f direction;       ///< unit, of that ray, from the camera to p
  float distance = 0;    ///< from `origin` to p
  float importance = 0;  ///< pixels per area across the ray at p
};

/// `u_lens` draws the point of the lens; cameras without do not use it.
CameraConnection connect_to_camera(const CameraView& camera, const Vec3f& p, const Vec2<float>& u_lens);

}  // namespace photonproof::inline renderer_sensor
