// What every tracer of one history at a time has at hand. How it makes its paths is its own.
#pragma once

#include "renderer/scalar/surroundings.h"
#include "renderer/scalar/world_camera.h"
#include "renderer/scalar/world_lights.h"

namespace photonproof {

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

  World world_;
  WorldLights lights_;
  WorldCamera camera_;
  PathLimits limits_;
  std::uint32_t outer_;         ///< outer_medium
  Surroundings around_camera_;  ///< nothing, where the scene has no media or bodies
};

}  // namespace photonproof
