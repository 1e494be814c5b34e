// Where a finite light is, where to it shines and how strongly: what choosing it by position needs to know (Conty
// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", section 4).
#pragma once

#include <optional>

#include "renderer/light.h"

namespace photonproof {

/// Light leaves in directions within `spread` + `emission` of the axis: normals are within `spread` of it, and light
/// within `emission` of a normal. Radians.
struct LightBounds {
  Vec3f low, high;
  Vec3f axis{0, 0, 1};
  float spread = 3.14159265f, emission = 1.57079633f;
  float power = 0;  ///< mean channel of the flux, W
};

/// Nothing for lights that shine on nothing or come from infinity.
std::optional<LightBounds> light_bounds(const Light& light);

/// Of both together.
LightBounds merge(const LightBounds& a, const LightBounds& b);

/// How much of its light arrives at p, up to a factor: power x cos / distance^2. 0 only where none can.
float importance(const LightBounds& bounds, const Vec3f& p);

}  // namespace photonproof
