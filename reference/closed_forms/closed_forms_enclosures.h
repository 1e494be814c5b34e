// Diffuse surfaces that see only each other: furnace, integrating sphere, concentric spheres, parallel planes, cube.
// Radiosity (radiant exitance) and irradiance in W m^-2, radiance in W m^-2 sr^-1, flux in W; albedo rho in [0,1).
#pragma once

namespace photonproof::inline reference_closed_forms {

/// Radiance everywhere inside a closed diffuse surface of albedo rho that emits e: e / (1 - rho).
double furnace(double emission, double albedo);

/// The same radiance after `bounces` bounces: e (1 - rho^(bounces+1)) / (1 - rho).
double furnace(double emission, double albedo, int bounces);

/// Irradiance inside a diffuse sphere by light reflected at least once: flux rho / ((1 - rho) 4 pi R^2). It does not
/// depend on the source's place or distribution, since every point of a sphere sees every other with the same form
/// factor (Sumpner 1892; Jacquez and Kuppenheim 1955).
double integrating_sphere_indirect(double flux, double albedo, double radius);

/// The radiosities of two surfaces.
struct RadiosityPair {
  double first, second;
};

/// Form factors of concentric spheres. The inner sphere sees only the outer one, F12 = 1. The outer one sees the inner
/// with F21 = (r1/r2)^2 and itself with the rest (Howell, C-139; reciprocity A1 F12 = A2 F21).
struct ConcentricFactors {
  double inner_to_outer, outer_to_inner, outer_to_outer;
};
ConcentricFactors concentric_sphere_factors(double inner_radius, double outer_radius);

struct DiffuseEmitter {
  double exitance;  ///< emitted exitance, without reflected light
  double albedo;
};
/// B1 = E1 + rho1 B2,  B2 = E2 + rho2 (F21 B1 + F22 B2), inner sphere first.
RadiosityPair concentric_sphere_radiosity(const DiffuseEmitter& inner, const DiffuseEmitter& outer,
                                          const ConcentricFactors& factors);

/// Infinite planes that face each other: B1 = (E1 + rho1 E2) / (1 - rho1 rho2).
RadiosityPair parallel_plane_radiosity(const DiffuseEmitter& first, const DiffuseEmitter& second);

/// Form factor between equal rectangles a x b straight opposite at the distance c (Howell, C-11), X = a/c, Y = b/c.
double opposite_rectangles_factor(double a, double b, double c);

/// Form factors of a cube: 0.1998 to the opposite face and (1 - 0.1998)/4 = 0.2000 to each of the four others.
double cube_factor_opposite();
double cube_factor_adjacent();

}  // namespace photonproof::inline reference_closed_forms
