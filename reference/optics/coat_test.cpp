#include "reference/optics/coat.h"

#include <gtest/gtest.h>

#include <cmath>

namespace photonproof::inline reference_optics {
namespace {

PlasticDescription plastic_of(double index) {
  PlasticDescription d;
  d.int_ior = index;
  d.ext_ior = 1;
  return d;
}

TEST(coat, lets_diffuse_light_in_as_published) {
  // External diffuse Fresnel reflectance of an index of 1.5: 0.0918 (d'Eon and Irving 2011); of 1.3: 0.0612.
  EXPECT_NEAR(coat_of(plastic_of(1.5), RgbD(0.5), RgbD(1.0)).mean_crossing().x, 1 - 0.0918, 1e-4);
  EXPECT_NEAR(coat_of(plastic_of(1.3), RgbD(0.5), RgbD(1.0)).mean_crossing().x, 1 - 0.0612, 2e-4);
  EXPECT_NEAR(coat_of(plastic_of(1.5), RgbD(0.5), RgbD(1.0)).mirror(1).x, 0.04, 1e-12);
}

TEST(coat, of_a_white_base_reflects_all_of_diffuse_light) {
  for (const double index : {1.1, 1.33, 1.5, 2.0}) {
    const Coat plastic = coat_of(plastic_of(index), RgbD(1.0), RgbD(1.0));
    EXPECT_NEAR(plastic.diffuse_albedo().x + 1 - plastic.mean_crossing().x, 1, 2e-4) << index;
    LayeredDescription lacquer;
    lacquer.int_ior = index;
    lacquer.ext_ior = 1;
    EXPECT_NEAR(coat_of(lacquer, RgbD(1.0), RgbD(1.0)).base.x, plastic.base.x, 1e-9 * plastic.base.x) << index;
  }
}

TEST(coat, that_is_nonlinear_or_tinted_shifts_colours) {
  PlasticDescription d = plastic_of(1.5);
  // R = 1 - (1 - 0.09178) / 2.25 = 0.59635; base = rho / (2.25 (1 - R)) and with rho R.
  EXPECT_NEAR(coat_of(d, RgbD(0.5), RgbD(1.0)).base.x, 0.5 / (2.25 * (1 - 0.59635)), 2e-4);
  d.nonlinear = true;
  EXPECT_NEAR(coat_of(d, RgbD(0.5), RgbD(1.0)).base.x, 0.5 / (2.25 * (1 - 0.5 * 0.59635)), 2e-4);
  LayeredDescription lacquer;
  lacquer.int_ior = 1.5;
  lacquer.ext_ior = 1;
  lacquer.sigma_a = {0, 0.5, 2};
  lacquer.thickness = 0.4;
  const Coat tinted = coat_of(lacquer, RgbD(0.5), RgbD(1.0));
  EXPECT_NEAR(tinted.crossing(1).x, 0.96, 1e-12);
  EXPECT_NEAR(tinted.crossing(1).y, 0.96 * std::exp(-0.2), 1e-12);
  // At 60 degrees outside the cosine inside is sqrt(1 - 0.75 / 2.25) = 0.8165; Fresnel's reflectance there is 0.0892.
  EXPECT_NEAR(tinted.crossing(0.5).z, (1 - 0.0892) * std::exp(-0.8 / 0.8165), 1e-4);
}

TEST(coat, is_a_sum_of_powers_within_a_third_of_a_percent) {
  for (const double index : {1.3, 1.5, 1.9}) {
    const Coat coat = coat_of(plastic_of(index), RgbD(0.5), RgbD(1.0));
    const auto powers = crossing_by_powers(coat);
    double mean = 0;
    for (std::size_t k = 0; k < powers.size(); ++k) mean += powers[k].x * 2 / static_cast<double>(k + 3);
    EXPECT_NEAR(mean, coat.mean_crossing().x, 1e-6) << index;
    for (double cosine = 0.15; cosine <= 1; cosine += 0.01) {
      double sum = 0;
      for (std::size_t k = powers.size(); k-- > 0;) sum = (sum + powers[k].y) * cosine;
      EXPECT_NEAR(sum, coat.crossing(cosine).y, 0.003 * coat.crossing(cosine).y) << index << " " << cosine;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline reference_optics
