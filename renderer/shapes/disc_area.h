// Area of the part of a surface whose photons a look-up counts: those within the look-up radius that pass the sheet's
// test (photon_sheet.h). Dividing by it instead of the full disc removes most of the darkening along edges. Meshes are
// mesh_area.h's.
#pragma once

#include <span>

#include "renderer/lanes/warp.h"
#include "renderer/photons/photon_sheet.h"
#include "renderer/shapes/surface.h"

namespace photonproof {

/// What a polygon, in order around, has in the circle about the origin.
double polygon_in_circle(std::span<const Vec2<double>> polygon, double radius);

/// `p` on the quad. Exact: the disc in the quad's plane intersected with the parallelogram.
float disc_area(const Quad& quad, const Vec3f& p, float radius);

/// `p` on the disk, which may be an ellipse; exact up to what less than a 32nd of the way around it hides.
float disc_area(const Disk& disk, const Vec3f& p, float radius);

/// `p` on the sphere; points of it within the chord length `radius` of p have area pi radius^2 (Archimedes).
float disc_area(const Sphere& sphere, const Vec3f& p, float radius);

/// `p` on the cylinder. Accurate to 1e-6.
float disc_area(const Cylinder& cylinder, const Vec3f& p, float radius);

inline float disc_area(const Plane&, const Vec3f&, float radius) { return pi * radius * radius; }

}  // namespace photonproof
