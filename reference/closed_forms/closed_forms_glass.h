// Smooth dielectrics: Fresnel's coefficients and panes. `ior` is the index beyond the surface over that before it;
// angles in radians from the normal. No units: parts of the incident flux.
#pragma once

namespace photonproof::inline reference_closed_forms {

/// Reflectance for the electric field perpendicular (s) and parallel (p) to the plane of incidence (Fresnel 1823; Born
/// and Wolf, section 1.5.3); 1 beyond the critical angle.
struct FresnelPair {
  double s, p;
  double unpolarised() const { return (s + p) / 2; }
};
FresnelPair fresnel_reflectance(double angle, double ior);

/// The angle behind the surface by Snell's law; pi/2 at and beyond the critical angle.
double refraction_angle(double angle, double ior);

/// All light that comes through a plane-parallel slab, its internal reflections added without interference (Stokes
/// 1862): T = (1 - F)^2 a / (1 - F^2 a^2), without absorption (1 - F)/(1 + F). `F` is the reflectance of one interface
/// for one polarisation. A renderer without polarisation takes their mean at every interface, so its slab is that of
/// the mean F; nature's is the mean of the slabs. `a` is the absorber's transmittance along one crossing.
double slab_transmittance(double F, double a = 1);

/// What the slab sends back: R = F + F (1 - F)^2 a^2 / (1 - F^2 a^2); T + R = 1 without absorption, therefore lossless
/// glass in uniform light is invisible.
double slab_reflectance(double F, double a = 1);

}  // namespace photonproof::inline reference_closed_forms
