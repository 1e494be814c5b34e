#include "reference/closed_forms/closed_forms_glass.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace photonproof::inline reference_closed_forms {
namespace {

using std::numbers::pi;

TEST(ClosedForms, fresnel_has_its_textbook_values) {
  // Normal incidence: ((n-1)/(n+1))^2, 0.04 for n = 1.5. Brewster's angle atan n: nothing of p is reflected, and of s
  // ((n^2-1)/(n^2+1))^2. Beyond asin(1/n) from inside everything.
  EXPECT_NEAR(fresnel_reflectance(0, 1.5).s, 0.04, 1e-15);
  EXPECT_NEAR(fresnel_reflectance(0, 1.5).p, 0.04, 1e-15);
  EXPECT_NEAR(fresnel_reflectance(std::atan(1.5), 1.5).p, 0, 1e-15);
  EXPECT_NEAR(fresnel_reflectance(std::atan(1.5), 1.5).s, std::pow(1.25 / 3.25, 2), 1e-15);
  EXPECT_EQ(fresnel_reflectance(std::asin(1 / 1.5) + 1e-6, 1 / 1.5).unpolarised(), 1);
  EXPECT_NEAR(fresnel_reflectance(pi / 2, 1.5).unpolarised(), 1, 1e-15) << "grazing";
}

TEST(ClosedForms, fresnel_is_the_same_from_both_sides) {
  const double inside = refraction_angle(0.9, 1.33);
  EXPECT_NEAR(std::sin(0.9), 1.33 * std::sin(inside), 1e-15) << "Snell";
  EXPECT_NEAR(fresnel_reflectance(0.9, 1.33).s, fresnel_reflectance(inside, 1 / 1.33).s, 1e-14);
  EXPECT_NEAR(fresnel_reflectance(0.9, 1.33).p, fresnel_reflectance(inside, 1 / 1.33).p, 1e-14);
}

TEST(ClosedForms, slab_is_the_sum_of_its_internal_reflections) {
  for (const double a : {1.0, 0.8}) {
    const double F = 0.3;
    double through = 0, back = F, inside = (1 - F) * a;
    for (int i = 0; i < 200; ++i) {  // at the far side, then at the near one
      through += inside * (1 - F);
      inside *= F * a;
      back += inside * (1 - F);
      inside *= F * a;
    }
    EXPECT_NEAR(slab_transmittance(F, a), through, 1e-15);
    EXPECT_NEAR(slab_reflectance(F, a), back, 1e-15);
  }
  EXPECT_NEAR(slab_transmittance(0.3), 0.7 / 1.3, 1e-15);
}

TEST(ClosedForms, lossless_slab_loses_nothing) {
  for (const double angle : {0.0, 0.5, 1.2, 1.5}) {
    const double F = fresnel_reflectance(angle, 1.5).unpolarised();
    EXPECT_NEAR(slab_transmittance(F) + slab_reflectance(F), 1, 1e-15) << angle;
  }
}

}  // namespace
}  // namespace photonproof::inline reference_closed_forms
