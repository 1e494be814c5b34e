// Integrals over dielectric interfaces against brute force, and the limits that are known.

#include "renderer/bsdfs/interface_tables.h"

#include <gtest/gtest.h>

#include "renderer/bsdfs/bsdf_roughdielectric.h"

namespace photonproof::inline renderer_bsdfs {
namespace {

Vec3f at_cosine(double c) { return {static_cast<float>(std::sqrt(1 - c * c)), 0, static_cast<float>(c)}; }

/// The share of light from wo that is transmitted or reflected: the integral of the rough dielectric's eval times the
/// cosine. It uses the midpoint rule in azimuth and sqrt(1 - z), and shares no sampling with the tables.
double brute_force(const Microfacets<float>& facets, double cos_wo, double eta, bool transmitted) {
  const RoughDielectricBsdf<float> glass{facets, static_cast<float>(eta), Rgb(1), Rgb(1)};
  const Vec3f wo = at_cosine(cos_wo);
  constexpr int rows = 800, columns = 800;
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double root = (i + 0.5) / rows, z = 1 - root * root;
      const double r = std::sqrt(1 - z * z), phi = std::numbers::pi * (j + 0.5) / columns;
      const Vec3f wi{static_cast<float>(r * std::cos(phi)), static_cast<float>(r * std::sin(phi)),
                     static_cast<float>(transmitted ? -z : z)};
      sum += static_cast<double>(glass.eval(wo, wi).x) * z * 2 * root;
    }
  // Half of the azimuths suffices by symmetry; eval is for radiance, 1 / eta^2 of the flux.
  return sum * 2 * std::numbers::pi / (rows * columns) * (transmitted ? eta * eta : 1);
}

TEST(interface_tables, shares_of_rough_interfaces_are_those_of_brute_force) {
  for (const float ggx : {0.0f, 1.0f})
    for (const float alpha : {0.2f, 0.5f, 1.0f})
      for (const double eta : {1.5, 1 / 1.5})
        for (const double cos_wo : {1.0, 0.6, 0.15}) {
          const Microfacets<float> facets{alpha, alpha, ggx, 1};
          EXPECT_NEAR(rough_transmittance(facets, cos_wo, eta), brute_force(facets, cos_wo, eta, true), 3e-3)
              << ggx << " " << alpha << " " << eta << " " << cos_wo;
          EXPECT_NEAR(rough_reflectance(facets, cos_wo, eta), brute_force(facets, cos_wo, eta, false), 3e-3)
              << ggx << " " << alpha << " " << eta << " " << cos_wo;
        }
}

TEST(interface_tables, polynomials_are_the_transmittance) {
  for (const float ggx : {0.0f, 1.0f})
    for (const float alpha : {0.01f, 0.1f, 0.5f, 1.0f}) {
      const Microfacets<float> facets{alpha, alpha, ggx, 1};
      RoughPlasticBsdf<float> plastic{facets, 1.5f, 0, 0, {}, {}, {}};
      const RoughInterface interface = rough_interface(facets, 1.5);
      std::copy(interface.through.begin(), interface.through.end(), plastic.through);
      for (const double cos_theta : {0.01, 0.03, 0.1, 0.2, 0.35, 0.5, 0.8, 1.0})
        EXPECT_NEAR(plastic.transmittance(static_cast<float>(cos_theta)), rough_transmittance(facets, cos_theta, 1.5),
                    2e-3)
            << ggx << " " << alpha << " " << cos_theta;
    }
}

TEST(interface_tables, interfaces_become_smooth) {
  // Nearly flat facets: the results are Fresnel's reflectance and its complement. A roughness of 1e-3 moves cosines by
  // about as much. Fresnel's reflectance is steepest, about -6, at grazing angles.
  for (const float ggx : {0.0f, 1.0f})
    for (const double cos_wo : {1.0, 0.7, 0.3}) {
      const Microfacets<float> facets{1e-3f, 1e-3f, ggx, 1};
      const double smooth = static_cast<double>(fresnel_dielectric(static_cast<float>(cos_wo), 1.5f).reflectance);
      EXPECT_NEAR(rough_reflectance(facets, cos_wo, 1.5), smooth, 1e-4) << cos_wo;
      EXPECT_NEAR(rough_transmittance(facets, cos_wo, 1.5), 1 - smooth, 1e-4) << cos_wo;
    }
}

/// Reflectance for diffuse light from the thin side (Walsh 1926; Egan and Hilgeman 1973 print 0.0918 for n = 1.5).
double walsh(double n) {
  const double n2 = n * n, n4 = n2 * n2;
  return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
         n2 * (n2 - 1) * (n2 - 1) / std::pow(n2 + 1, 3) * std::log((n - 1) / (n + 1)) -
         2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
         8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * std::log(n);
}

TEST(interface_tables, diffuse_reflectance_from_both_sides_is_walshs) {
  // A diffuse interior lets out 1/n^2 of the light that a diffuse exterior lets in (Duntley 1942): 1 - R(1/n) = (1 -
  // R(n)) / n^2. The brightness of a base under the interface is in proportion to 1 / (1 - R). The test therefore
  // compares 1 - R, 5e-6 at n = 100.
  for (const double n : {1.01, 1.1, 1.5, 2.4, 10.0, 100.0}) {
    EXPECT_NEAR(1 - diffuse_fresnel_loss(n), walsh(n), 1e-6) << n;
    const double leaves = (1 - walsh(n)) / (n * n);
    EXPECT_NEAR(diffuse_fresnel_loss(1 / n), leaves, 1e-5 * leaves) << n;
  }
  EXPECT_NEAR(diffuse_fresnel_loss(1.5), 1 - 0.0918, 1e-4);
  EXPECT_NEAR(diffuse_fresnel_loss(1 / 1.5), 1 - 0.5963, 1e-4);
}

TEST(interface_tables, a_layer_under_an_interface_absorbs_on_both_ways) {
  // Reference: the midpoint rule over cosines inside, with Born and Wolf's amplitudes; the kink costs 1e-6. Beyond the
  // critical angle the interface reflects everything that the layer leaves.
  constexpr double n = 1.5, depth = 0.4;
  constexpr int cells = 20'000;
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const double c = (i + 0.5) / cells, sin2 = n * n * (1 - c * c);
    double reflects = 1;
    if (sin2 < 1) {
      const double t = std::sqrt(1 - sin2), s = (n * c - t) / (n * c + t), p = (c - n * t) / (c + n * t);
      reflects = (s * s + p * p) / 2;
    }
    sum += 2 * c * reflects * std::exp(-2 * depth / c) / cells;
  }
  EXPECT_NEAR(diffuse_fresnel_loss(1 / n, depth), 1 - sum, 2e-6);
  // A layer that absorbs everything returns nothing.
  EXPECT_NEAR(diffuse_fresnel_loss(1 / 1.5, 30), 1, 1e-12);
}

}  // namespace
}  // namespace photonproof::inline renderer_bsdfs
