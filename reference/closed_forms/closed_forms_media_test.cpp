#include "reference/closed_forms/closed_forms_media.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photonproof::inline reference_closed_forms {
namespace {

/// dL/ds = j - sigma L, by the classical Runge-Kutta method: of order 4, here below 1e-12.
double by_integration(double background, double emission, double sigma, double distance) {
  constexpr int steps = 2000;
  const double h = distance / steps;
  const auto change = [&](double L) { return emission - sigma * L; };
  double L = background;
  for (int i = 0; i < steps; ++i) {
    const double k1 = change(L), k2 = change(L + h / 2 * k1), k3 = change(L + h / 2 * k2), k4 = change(L + h * k3);
    L += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  return L;
}

TEST(ClosedForms, media_solve_the_equation_of_transfer) {
  EXPECT_NEAR(transmittance(0.7, 3), by_integration(1, 0, 0.7, 3), 1e-12);
  EXPECT_NEAR(emitted_radiance(2, 0.7, 3), by_integration(0, 2, 0.7, 3), 1e-12);
  EXPECT_NEAR(radiance_through(5, 2, 0.7, 3), by_integration(5, 2, 0.7, 3), 1e-12);
  EXPECT_DOUBLE_EQ(emitted_radiance(2, 0, 3), 6) << "without absorption emission adds up";
  EXPECT_NEAR(emitted_radiance(2, 0.5, 1e3), 4, 1e-12) << "an optically thick body shines with j / sigma";
  EXPECT_NEAR(emitted_radiance(2, 1e-13, 3), 6, 1e-11) << "no cancellation";
}

}  // namespace
}  // namespace photonproof::inline reference_closed_forms
