// Common parts of tracers of one path at a time. Each makes its paths in its own way.
#pragma once

#include "renderer/scalar/scalar_camera.h"
#include "renderer/scalar/scalar_lights.h"
#include "renderer/scalar/surroundings.h"

namespace photonproof::inline renderer_scalar {

class ScalarTracer {
 protected:
  /// `rays` as in ScalarCamera.
  ScalarTracer(const Scene& scene, const PathLimits& limits, std::int64_t rays)
      : scene_interface_(scene),
        lights_(scene_interface_),
        camera_(scene_interface_, rays),
        limits_(limits),
        outer_(outer_medium(scene_interface_)),
        around_camera_(surroundings_at(scene_interface_, scene.view().camera.origin, outer_)) {}
  ScalarTracer(const ScalarTracer&) = delete;
  ScalarTracer& operator=(const ScalarTracer&) = delete;
  ~ScalarTracer() = default;

  /// Whether paths may have this many edges.
  bool within(std::uint32_t edges) const {
    return limits_.max_depth < 0 || edges <= static_cast<std::uint32_t>(limits_.max_depth);
  }

  /// The first ray of a light path. It begins at the point ahead, unless an endless medium attenuates light on the way.
  Ray first_ray(const LightStart& start) const {
    const bool ahead = start.is_ahead > 0 && outer_ == no_index;
    return scene_interface_.leave(ahead ? SegmentEnd{start.ahead} : lights_.end(start), start.direction);
  }

  /// Whether the camera's ray met a light that is hidden from it.
  bool is_hidden(const Interaction& at) const { return limits_.hide_emitters && at.light != no_index; }
  /// As `travel`, from the camera: the ray continues behind hidden lights, and ends at the far plane.
  bool look(Ray& ray, Surroundings& around, float u_layer, Rgb& throughput, Interaction& at) const {
    while (travel(scene_interface_, ray, around, u_layer, TransportMode::radiance, throughput, at)) {
      if (!is_hidden(at)) return !camera_.beyond_far_plane(at.p);
      if (scene_interface_.has_media_or_interiors()) around.cross(scene_interface_, at, ray.direction);
      ray = scene_interface_.pass(ray, at, ray.direction);
    }
    return false;
  }
  /// Light that arrives at the camera: as `transmittance`, through lights that are hidden from it.
  Rgb arriving_at_camera(const SegmentEnd& from, const SegmentEnd& camera, const Surroundings& around,
                         const PathSampler& draws, std::uint32_t dimension) const {
    return transmittance(scene_interface_, from, camera, around, {.lights = limits_.hide_emitters}, draws, dimension);
  }

  SceneInterface scene_interface_;
  ScalarLights lights_;
  ScalarCamera camera_;
  PathLimits limits_;
  std::uint32_t outer_;         ///< outer_medium
  Surroundings around_camera_;  ///< empty where the scene has no media or interiors
};

}  // namespace photonproof::inline renderer_scalar
