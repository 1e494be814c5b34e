#include "reference/closed_forms/closed_forms_enclosures.h"

#include <cmath>
#include <numbers>

namespace photonproof::inline reference_closed_forms {

double furnace(double emission, double albedo) { return emission / (1 - albedo); }

double furnace(double emission, double albedo, int bounces) {
  double sum = 0;
  for (int k = bounces; k >= 0; --k) sum = sum * albedo + 1;
  return emission * sum;
}

double integrating_sphere_indirect(double flux, double albedo, double radius) {
  return flux * albedo / ((1 - albedo) * 4 * std::numbers::pi * radius * radius);
}

ConcentricFactors concentric_sphere_factors(double inner_radius, double outer_radius) {
  const double ratio = inner_radius / outer_radius;
  return {1, ratio * ratio, 1 - ratio * ratio};
}

RadiosityPair concentric_sphere_radiosity(const DiffuseEmitter& inner, const DiffuseEmitter& outer,
                                          const ConcentricFactors& factors) {
  // B1 = E1 + rho1 B2 in the second equation.
  const double seen = factors.outer_to_inner * inner.albedo + factors.outer_to_outer;
  const double b2 =
      (outer.exitance + outer.albedo * factors.outer_to_inner * inner.exitance) / (1 - outer.albedo * seen);
  return {inner.exitance + inner.albedo * factors.inner_to_outer * b2, b2};
}

RadiosityPair parallel_plane_radiosity(const DiffuseEmitter& first, const DiffuseEmitter& second) {
  const double lost = 1 - first.albedo * second.albedo;
  return {(first.exitance + first.albedo * second.exitance) / lost,
          (second.exitance + second.albedo * first.exitance) / lost};
}

double opposite_rectangles_factor(double a, double b, double c) {
  const double x = a / c, y = b / c, x1 = 1 + x * x, y1 = 1 + y * y;
  const double sum = 0.5 * std::log(x1 * y1 / (x1 + y * y)) + x * std::sqrt(y1) * std::atan(x / std::sqrt(y1)) +
                     y * std::sqrt(x1) * std::atan(y / std::sqrt(x1)) - x * std::atan(x) - y * std::atan(y);
  return 2 * sum / (std::numbers::pi * x * y);
}

double cube_factor_opposite() { return opposite_rectangles_factor(1, 1, 1); }

double cube_factor_adjacent() { return (1 - cube_factor_opposite()) / 4; }

}  // namespace photonproof::inline reference_closed_forms
