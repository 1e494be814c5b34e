#include "reference/closed_forms/closed_forms_glass.h"

#include <cmath>
#include <numbers>

namespace photonproof::inline reference_closed_forms {

FresnelPair fresnel_reflectance(double angle, double ior) {
  const double sine = std::sin(angle) / ior;
  if (sine >= 1) return {1, 1};
  const double cos_i = std::cos(angle), cos_t = std::sqrt(1 - sine * sine);
  const double s = (cos_i - ior * cos_t) / (cos_i + ior * cos_t);
  const double p = (ior * cos_i - cos_t) / (ior * cos_i + cos_t);
  return {s * s, p * p};
}

double refraction_angle(double angle, double ior) {
  const double sine = std::sin(angle) / ior;
  return sine >= 1 ? std::numbers::pi / 2 : std::asin(sine);
}

double slab_transmittance(double F, double a) { return (1 - F) * (1 - F) * a / (1 - F * F * a * a); }

double slab_reflectance(double F, double a) { return F + F * (1 - F) * (1 - F) * a * a / (1 - F * F * a * a); }

}  // namespace photonproof::inline reference_closed_forms
