// The lights of scene_lights.h in the scene of the scalar integrators.
#pragma once

#include "renderer/light_sampling/scene_lights.h"
#include "renderer/scalar/scene_interface.h"

namespace photonproof::inline renderer_scalar {

class ScalarLights {
 public:
  explicit ScalarLights(const SceneInterface& scene);

  const SceneLights* operator->() const { return &lights_; }

  /// A light's point, as the end of a segment.
  SegmentEnd end(std::uint32_t light, const LightPoint<float>& at) const;
  SegmentEnd end(const LightSeen& seen) const { return end(seen.light, seen.at); }
  SegmentEnd end(const LightStart& start) const { return end(start.light, start.at); }
  /// A light's point that a ray met.
  LightPoint<float> point(const Interaction& met) const;

 private:
  const SceneInterface& scene_interface_;
  const SceneLights& lights_;
  std::vector<std::uint32_t> surface_;  ///< of each light
};

}  // namespace photonproof::inline renderer_scalar
