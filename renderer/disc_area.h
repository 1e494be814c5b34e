// Area of the part of a surface that a photon look-up sees: the disc of the look-up radius, clipped to the surface.
// Dividing by it instead of the full disc removes most of the darkening along edges.
#pragma once

#include "renderer/surface.h"
#include "renderer/warp.h"

namespace photonproof {

/// `p` on the quad. Exact: the disc in the quad's plane intersected with the parallelogram.
float disc_area(const Quad& quad, const Vec3f& p, float radius);

/// `p` on the sphere; points of it within the chord length `radius` of p have area pi radius^2 (Archimedes).
float disc_area(const Sphere& sphere, const Vec3f& p, float radius);

/// The full disc: other shapes are taken to be flat and to go on around p.
template <class Shape>
float disc_area(const Shape&, const Vec3f&, float radius) {
  return pi * radius * radius;
}

}  // namespace photonproof
