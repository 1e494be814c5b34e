// Homogeneous media along a ray of length d. Coefficients per scene unit, radiance in W m^-2 sr^-1.
// A medium of albedo 1 in uniform light needs no formula: as much scatters into a ray as out of it, so L is unchanged.
#pragma once

namespace photonproof::inline reference_closed_forms {

/// exp(-sigma d) (Bouguer 1729, Lambert 1760, Beer 1852).
double transmittance(double sigma_t, double distance);

/// Radiance that a medium of emission j (W m^-3 sr^-1) adds along the ray: (j/sigma_a) (1 - exp(-sigma_a d)). At
/// sigma_a = 0 it is the limit j d. Source: Chandrasekhar 1950, eq. I.61.
double emitted_radiance(double emission, double sigma_a, double distance);

/// Attenuated radiance of a uniform background behind the medium plus the medium's own emission.
double radiance_through(double background, double emission, double sigma_a, double distance);

}  // namespace photonproof::inline reference_closed_forms
