// What every tracer of one path at a time has at hand. How it makes its paths is its own.
#pragma once

#include "renderer/scalar/scalar_camera.h"
#include "renderer/scalar/scalar_lights.h"
#include "renderer/scalar/surroundings.h"

namespace photonproof::inline renderer_scalar {

class ScalarTracer {
 protected:
  /// `rays` as ScalarCamera has them.
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

  /// Whether paths may have so many edges.
  bool within(std::uint32_t edges) const {
    return limits_.max_depth < 0 || edges <= static_cast<std::uint32_t>(limits_.max_depth);
  }

  /// A light path's. It begins at what is ahead, unless a medium without end takes light on the way.
  Ray first_ray(const LightStart& start) const {
    const bool ahead = start.is_ahead > 0 && outer_ == no_index;
    return scene_interface_.leave(ahead ? SegmentEnd{start.ahead} : lights_.end(start), start.direction);
  }

  /// Whether what the camera's ray met is a light that is hidden from it.
  bool is_hidden(const Interaction& at) const { return limits_.hide_emitters && at.light != no_index; }
  /// As `travel`, from the camera: behind hidden lights the ray goes on, and it ends at the far plane.
  bool look(Ray& ray, Surroundings& around, float u_layer, Rgb& throughput, Interaction& at) const {
    while (travel(scene_interface_, ray, around, u_layer, TransportMode::radiance, throughput, at)) {
      if (!is_hidden(at)) return !camera_.beyond_far_plane(at.p);
      if (scene_interface_.has_media_or_bodies()) around.cross(scene_interface_, at, ray.direction);
      ray = scene_interface_.pass(ray, at, ray.direction);
    }
    return false;
  }
  /// What arrives at the camera: as `transmittance`, through lights that are hidden from it.
  Rgb arriving_at_camera(const SegmentEnd& from, const SegmentEnd& camera, const Surroundings& around,
                         const PathSampler& draws, std::uint32_t dimension) const {
    return transmittance(scene_interface_, from, camera, around, {.lights = limits_.hide_emitters}, draws, dimension);
  }

  SceneInterface scene_interface_;
  ScalarLights lights_;
  ScalarCamera camera_;
  PathLimits limits_;
  std::uint32_t outer_;         ///< outer_medium
  Surroundings around_camera_;  ///< nothing, where the scene has no media or bodies
};

}  // namespace photonproof::inline renderer_scalar
