// Smooth dielectrics: Fresnel's coefficients and panes. `ior` is the index beyond the surface over that before it;
// angles in radians from the normal. No units: parts of the incident flux.
#pragma once

namespace photonproof::inline reference_closed_forms {

/// Reflectance for the electric field perpendicular (s) and parallel (p) to the plane of incidence; 1 beyond the
/// critical angle. Source: Fresnel 1823; Born and Wolf, section 1.5.3.
struct FresnelPair {
  double s, p;
  double unpolarised() const { return (s + p) / 2; }
};
FresnelPair fresnel_reflectance(double angle, double ior);

/// Refraction angle by Snell's law; pi/2 at and beyond the critical angle.
double refraction_angle(double angle, double ior);

/// Transmittance of a plane-parallel slab, its internal reflections added without interference (Stokes 1862). It is
/// T = (1 - F)^2 a / (1 - F^2 a^2), and (1 - F)/(1 + F) without absorption. `F` is the reflectance of one interface for
/// one polarisation, `a` the absorber's transmittance along one crossing. A renderer without polarisation takes the
/// mean of both F at every interface, so its slab is that of the mean F. In nature it is the mean of both slabs.
double slab_transmittance(double F, double a = 1);

/// Reflectance of the slab: R = F + F (1 - F)^2 a^2 / (1 - F^2 a^2). Without absorption T + R = 1, so lossless glass in
/// uniform light is invisible.
double slab_reflectance(double F, double a = 1);

}  // namespace photonproof::inline reference_closed_forms
