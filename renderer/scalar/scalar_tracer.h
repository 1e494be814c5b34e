// What every tracer of one history at a time has at hand. How it makes its paths is its own.
#pragma once

#include "renderer/scalar/surroundings.h"
#include "renderer/scalar/world_camera.h"
#include "renderer/scalar/world_lights.h"

namespace photonproof::inline renderer_scalar {

class ScalarTracer {
 protected:
  /// `rays` as WorldCamera has them.
  ScalarTracer(const Scene& scene, const PathLimits& limits, std::int64_t rays)
      : world_(scene),
        lights_(world_),
        camera_(world_, rays),
        limits_(limits),
        outer_(outer_medium(world_)),
        around_camera_(surroundings_at(world_, scene.view().camera.origin, outer_)) {}
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
    return world_.leave(ahead ? SegmentEnd{start.ahead} : lights_.end(start), start.direction);
  }

  /// Whether what the camera's ray met is a lamp that is hidden from it.
  bool is_hidden(const Interaction& at) const { return limits_.hide_emitters && at.light != no_index; }
  /// As `travel`, from the camera: behind hidden lamps the ray goes on, and it ends at the far plane.
  bool look(Ray& ray, Surroundings& around, float u_layer, Rgb& throughput, Interaction& at) const {
    while (travel(world_, ray, around, u_layer, TransportMode::radiance, throughput, at)) {
      if (!is_hidden(at)) return !camera_.beyond_far_plane(at.p);
      if (world_.has_media_or_bodies()) around.cross(world_, at, ray.direction);
      ray = world_.pass(ray, at, ray.direction);
    }
    return false;
  }
  /// What arrives at the camera: as `transmittance`, through lamps that are hidden from it.
  Rgb arriving_at_camera(const SegmentEnd& from, const SegmentEnd& camera, const Surroundings& around,
                         const Draws& draws, std::uint32_t dimension) const {
    return transmittance(world_, from, camera, around, {.lamps = limits_.hide_emitters}, draws, dimension);
  }

  World world_;
  WorldLights lights_;
  WorldCamera camera_;
  PathLimits limits_;
  std::uint32_t outer_;         ///< outer_medium
  Surroundings around_camera_;  ///< nothing, where the scene has no media or bodies
};

}  // namespace photonproof::inline renderer_scalar
