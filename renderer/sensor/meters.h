// Sensors of one pixel that measure: what their rays start from, after Mitsuba 3's radiancemeter, distant and
// irradiancemeter.
#pragma once

#include "renderer/sensor/camera_view.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_sensor {

/// The scene as meters need it. Positions are those of rays.
struct MeterPlace {
  Vec3d moved;                                ///< Added to positions of the description.
  Vec3d centre;                               ///< Middle of the ball around all shapes.
  double radius = 0;                          ///< Radius of that ball.
  double coordinate_floor = 0;                ///< Rays leave surfaces by a part of it at least (offset_from).
  const ShapeDescription* surface = nullptr;  ///< The shape that measures, or null.
};

/// The shape with `measures` set; null without one.
const ShapeDescription* measuring_shape(const SceneDescription& description);

/// Turns a view into a meter's. Throws std::bad_variant_access where the sensor is none.
void set_meter(CameraView& view, const SensorDescription& sensor, const MeterPlace& place);

}  // namespace photonproof::inline renderer_sensor
