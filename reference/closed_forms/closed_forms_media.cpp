#include "reference/closed_forms/closed_forms_media.h"

#include <cmath>

namespace photonproof::inline reference_closed_forms {

double transmittance(double sigma_t, double distance) { return std::exp(-sigma_t * distance); }

double emitted_radiance(double emission, double sigma_a, double distance) {
  if (sigma_a == 0) return emission * distance;
  return emission / sigma_a * -std::expm1(-sigma_a * distance);
}

double radiance_through(double background, double emission, double sigma_a, double distance) {
  return background * transmittance(sigma_a, distance) + emitted_radiance(emission, sigma_a, distance);
}

}  // namespace photonproof::inline reference_closed_forms
