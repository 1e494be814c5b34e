// Unoccluded irradiance of simple lights on a surface element. Lengths are in scene units. Each colour channel has
// irradiance in W m^-2, radiance in W m^-2 sr^-1 and intensity in W sr^-1.
#pragma once

#include <span>

#include "scenes/base/vec.h"

namespace photonproof::inline reference_closed_forms {

/// A point on a surface with its unit normal; light from behind adds nothing.
struct SurfacePoint {
  Vec3d position;
  Vec3d normal;
};

/// E = I cos(angle) / d^2 of an isotropic point light.
double irradiance_of_point(double intensity, const Vec3d& light, const SurfacePoint& at);

/// Lambert's formula for a flat polygon of uniform radiance (Lambert 1760; Arvo 1994, eq. 2.5).
///   E = L/2 sum_i angle(v_i, v_i+1) dot(n, normalize(v_i x v_i+1)).
/// The vectors v_i go from the point to the vertices, after clipping the polygon at the point's horizon. The polygon is
/// flat and convex and shines on the side that sees its vertices counter-clockwise; on the other side E is 0.
double irradiance_of_polygon(double radiance, std::span<const Vec3d> vertices, const SurfacePoint& at);

/// Irradiance of a rectangle a x b that faces the point at the distance h, one corner straight above it. With A = a/h,
/// B = b/h: E = L/2 [A/sqrt(1+A^2) atan(B/sqrt(1+A^2)) + B/sqrt(1+B^2) atan(A/sqrt(1+B^2))].
/// Source: Siegel and Howell, configuration C-4.
double irradiance_of_rectangle_corner(double radiance, double a, double b, double h);

/// E = pi L (R/d)^2 cos(angle) of a ball of uniform radiance. Precondition: all of it is above the point's horizon,
/// d cos(angle) >= R.
double irradiance_of_sphere(double radiance, const Vec3d& center, double radius, const SurfacePoint& at);

/// Irradiance of the outside of a tube of uniform radiance from p0 to p1, open at its ends: E = L int cos cos' / d^2
/// dA. Gauss's two points integrate each of 4 x 16 cells of the side that faces the point. The relative error is 2e-6
/// at a distance of one tube length. Precondition: all of it is above the point's horizon.
double irradiance_of_cylinder(double radiance, const Vec3d& p0, const Vec3d& p1, double radius, const SurfacePoint& at);

/// A spot light's cone: full intensity within `beam` of its unit `axis`, falling linearly with the angle to 0 at
/// `cutoff` (Mitsuba's falloff). Half angles in radians, beam < cutoff.
struct SpotCone {
  double beam, cutoff;
};
double irradiance_of_spot(double intensity, const Vec3d& light, const Vec3d& axis, const SpotCone& cone,
                          const SurfacePoint& at);

/// E = E_0 cos(angle) of a collimated beam that travels along the unit `direction`.
double irradiance_of_beam(double irradiance, const Vec3d& direction, const Vec3d& normal);

/// E = pi L under a hemisphere of uniform radiance.
double irradiance_of_uniform_sky(double radiance);

/// E of a disc that faces the point, parallel to its surface, `height` above it, its axis `offset` aside. Let H = h/a,
/// R = r/a, Z = 1 + H^2 + R^2. Then E = pi L / 2 [1 - (1 + H^2 - R^2) / sqrt(Z^2 - 4 R^2)]. On the axis
/// E = pi L r^2 / (r^2 + h^2). Source: Howell, Catalog of Radiation Heat Transfer Configuration Factors, B-13.
double irradiance_of_parallel_disc(double radiance, double radius, double height, double offset);

}  // namespace photonproof::inline reference_closed_forms
