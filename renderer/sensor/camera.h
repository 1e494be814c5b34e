// Cameras with Mitsuba's conventions: local +z forward, +y up, +x to the left of the image.
#pragma once

#include <vector>

#include "renderer/sensor/camera_view.h"
#include "renderer/sensor/meters.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_sensor {

/// `width`, `height` in pixels: the size of the whole film, which fixes the aspect and so the fields of view. A crop is
/// a window of the same raster. `place.moved` is added to the camera's position in the world; meters need the rest. A
/// batch is without its parts.
CameraView compile_camera(const SensorDescription& sensor, int width, int height, const MeterPlace& place);

/// The cameras of a batch on a film of this size, from left to right; empty for other sensors.
std::vector<CameraView> compile_parts(const SensorDescription& sensor, int width, int height, const Vec3d& moved);

/// World height of a pixel at p_world.
float pixel_footprint(const CameraView& camera, const Vec3f& p_world);

}  // namespace photonproof::inline renderer_sensor
