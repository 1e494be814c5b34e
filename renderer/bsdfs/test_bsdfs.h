// One of each BSDF over a range of parameters, extremes included, for tests that hold for all.
#pragma once

#include <cmath>
#include <string>

#include "renderer/bsdfs/compile_bsdf.h"

namespace photonproof::test {

struct NamedBsdf {
  std::string name;
  Bsdf bsdf;
  bool lossless = false;  ///< reflects and transmits all light, the parameters being white
};

inline Bsdf compiled(const decltype(BsdfDescription::model)& model,
                     const decltype(BsdfDescription::model)& base = DiffuseDescription{}) {
  SceneDescription scene;
  scene.files = {"test.xml"};
  scene.bsdfs.push_back({{}, "", base});
  scene.bsdfs.push_back({{}, "", model});
  return compile_bsdf(scene, {1}).record;
}

/// Approximate eta and k of copper at 650, 550 and 450 nm.
inline ComplexIor copper() { return {{0.21, 1.04, 1.16}, {3.67, 2.59, 2.42}}; }

/// White principled BSDFs. The main facets' roughness is that of `alpha`.
inline void add_principled(std::vector<NamedBsdf>& all, double alpha) {
  const RgbD one(1.0);
  const std::string of_alpha = " alpha " + std::to_string(alpha);
  PrincipledDescription d{.base_color = one, .roughness = std::sqrt(alpha)};
  const auto add = [&](const std::string& name, const auto& description) {
    all.push_back({name + of_alpha, compiled(description), false});
  };
  add("principled", d);
  d.metallic = 1.0;
  d.anisotropic = 0.7;
  add("principled metal", d);
  d.metallic = 0.4;
  d.clearcoat = 1.0;
  d.clearcoat_gloss = 0.2;
  d.flatness = 0.5;
  d.spec_tint = 0.5;
  add("coated principled", d);
  for (const double eta : {1.5, 1 / 1.5}) {
    PrincipledDescription glass{.base_color = one, .roughness = std::sqrt(alpha), .spec_trans = 1.0, .eta = eta};
    add("principled glass eta " + std::to_string(eta), glass);
    glass.spec_trans = 0.5;
    glass.anisotropic = 0.6;
    glass.specular_rate = 2;
    add("half principled glass eta " + std::to_string(eta), glass);
  }
  PrincipledThinDescription thin{.base_color = one, .roughness = std::sqrt(alpha)};
  add("principledthin", thin);
  thin.spec_trans = 0.6;
  thin.diff_trans = 0.8;
  thin.anisotropic = 0.5;
  thin.transmitted_rate = 3;
  add("principledthin that transmits", thin);
  thin.spec_trans = 1.0;
  add("principledthin glass", thin);
}

/// White BSDFs with a smooth part. `alphas` are the roughnesses of the microfacets.
inline std::vector<NamedBsdf> white_bsdfs(const std::vector<double>& alphas) {
  std::vector<NamedBsdf> all;
  const auto add = [&](const std::string& name, const Bsdf& bsdf, bool lossless) {
    all.push_back({name, bsdf, lossless});
  };
  const RgbD one(1.0);
  add("diffuse", compiled(DiffuseDescription{one}), true);
  add("difftrans", compiled(DiffuseTransmitterDescription{one}), true);
  for (const double eta : {1.5, 1 / 1.5, 2.4}) {
    const std::string with_eta = " eta " + std::to_string(eta);
    add("plastic" + with_eta, compiled(PlasticDescription{one, one, eta, 1.0, false}), true);
    add("lacquer on diffuse" + with_eta,
        compiled(LayeredDescription{{0}, eta, 1.0, RgbD(0.0), 1, one}, DiffuseDescription{one}), true);
    add("tinted lacquer on diffuse" + with_eta,
        compiled(LayeredDescription{{0}, eta, 1.0, {0.2, 1, 5}, 0.5, one}, DiffuseDescription{one}), false);
    add("lacquer on phong" + with_eta,
        compiled(LayeredDescription{{0}, eta, 1.0, {0.1, 0.0, 0.3}, 1, one},
                 PhongDescription{40.0, RgbD(0.6), RgbD(0.4)}),
        false);
  }
  for (const double alpha : alphas) add_principled(all, alpha);
  add("nonlinear plastic", compiled(PlasticDescription{RgbD{0.9, 0.5, 0.1}, one, 1.5, 1.0, true}), false);
  for (const double n : {0.0, 1.0, 30.0, 1e4})
    add("phong " + std::to_string(n), compiled(PhongDescription{n, RgbD(0.5), RgbD(0.5)}), false);
  for (const MicrofacetDistribution d : {MicrofacetDistribution::beckmann, MicrofacetDistribution::ggx})
    for (const double alpha : alphas) {
      const std::string what = (d == MicrofacetDistribution::ggx ? " ggx " : " beckmann ") + std::to_string(alpha);
      add("roughconductor" + what, compiled(RoughConductorDescription{d, alpha, alpha, true, {}, one}), false);
      add("roughconductor by area" + what, compiled(RoughConductorDescription{d, alpha, alpha, false, {}, one}), false);
      add("anisotropic roughconductor" + what,
          compiled(RoughConductorDescription{d, alpha, std::min(1.0, 5 * alpha), true, copper(), one}), false);
      for (const double eta : {1.5, 1 / 1.5})
        add("roughdielectric" + what + " eta " + std::to_string(eta),
            compiled(RoughDielectricDescription{d, alpha, alpha, true, eta, 1.0, one, one}), false);
      add("roughdielectric by area" + what,
          compiled(RoughDielectricDescription{d, alpha, alpha, false, 1.5, 1.0, one, one}), false);
      add("roughplastic" + what, compiled(RoughPlasticDescription{d, alpha, true, one, one, 1.5, 1.0, false}), false);
      add("lacquer on roughconductor" + what,
          compiled(LayeredDescription{{0}, 1.5, 1.0, RgbD(0.0), 1, one},
                   RoughConductorDescription{d, alpha, alpha, true, {}, one}),
          false);
    }
  return all;
}

/// A direction at this angle to the normal, off the axes' planes.
inline Vec3f slanted(double degrees) {
  const double theta = degrees * std::numbers::pi / 180, phi = degrees / 20;
  return {static_cast<float>(std::sin(theta) * std::cos(phi)), static_cast<float>(std::sin(theta) * std::sin(phi)),
          static_cast<float>(std::cos(theta))};
}

/// Directions to the surface: steep, slanted, nearly grazing, on both sides.
inline std::vector<Vec3f> test_directions(bool both_sides) {
  std::vector<Vec3f> all;
  for (const double degrees : {0.0, 50.0, 88.0}) {
    all.push_back(slanted(degrees));
    if (both_sides) all.push_back(-all.back());
  }
  return all;
}

}  // namespace photonproof::test
