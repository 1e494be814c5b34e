// Sensors of one pixel that measure: what their rays start from, after Mitsuba 3's radiancemeter, distant and
// irradiancemeter.
#pragma once

#include "renderer/sensor/camera_view.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_sensor {

/// The scene as meters need it. Positions are those of rays.
struct MeterPlace {
  Vec3d moved;                                ///< added to positions of the description
  Vec3d centre;                               ///< of the ball around all shapes
  double radius = 0;                          ///< of that ball
  double coordinate_floor = 0;                ///< rays leave surfaces by a part of it at least (offset_from)
  const ShapeDescription* surface = nullptr;  ///< the one that measures; null where there is none
};

/// The shape with `measures` set; null without one.
const ShapeDescription* measuring_shape(const SceneDescription& description);

/// Turns a view into a meter's. Throws std::bad_variant_access where the sensor is none.
void set_meter(CameraView& view, const SensorDescription& sensor, const MeterPlace& place);

}  // namespace photonproof::inline renderer_sensor
