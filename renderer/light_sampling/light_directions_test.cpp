// Next-event estimation of lights at infinity, over random and extreme parameters: the sampled directions against their
// density.

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/light_sampling/test_lights.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

using test::DirectionCells;
using test::Lights;
using test::Random;

constexpr int samples = 1'000'000;

Vec3d unit(Random& r) { return normalize(Vec3d(square_to_sphere(r.next2()))); }

struct NamedSky {
  std::string name;
  Sky sky;
  DirectionCells cells;
};

/// Texels from 10^-3 to 10^3, some black.
Image random_image(int width, int height, std::uint64_t seed) {
  Image image(width, height);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) {
    Random r(seed, i / 3);
    const float texel = r.next() < 0.2f ? 0 : std::pow(10.0f, 6 * r.next() - 3);
    image.rgb[i] = texel * (1 + static_cast<float>(i % 3));
  }
  return image;
}

std::vector<NamedSky> skies() {
  std::vector<NamedSky> all{{"constant", ConstantSky{Rgb(3)}, DirectionCells()}};
  std::uint64_t seed = 600;
  for (const auto& [width, height] : {std::pair(2, 3), {3, 3}, {5, 9}, {16, 8}, {24, 12}}) {
    Random r(++seed);
    const Vec3d axis = unit(r);
    const Transform turned = Transform::rotate(axis, 360 * double{r.next()});
    all.push_back({"envmap " + std::to_string(width) + "x" + std::to_string(height),
                   EnvmapSky(random_image(width, height, seed), 1, turned), DirectionCells()});
  }
  // The real sun and the smallest and largest. The cells of a small sun cover a cone that is larger than its disc, so
  // that its limb lies in the middle of cells. On a border of cells, rounding would move samples into a cell with
  // almost no expected ones.
  constexpr double degree = std::numbers::pi / 180;
  for (const double aperture : {0.1 * degree, 0.5358 * degree, 3 * degree, 20 * degree, 60 * degree})
    for (const double height : {1.0, 0.5, 0.02}) {
      Random r(++seed);
      const double phi = 2 * std::numbers::pi * double{r.next()}, across = std::sqrt(1 - height * height);
      const Vec3d sun{across * std::cos(phi), across * std::sin(phi), height};
      const Vec3d axis = unit(r);
      const Transform turned = Transform::rotate(axis, 360 * double{r.next()});
      const SunSkySettings settings{
          sun, 1 + 9 * double{r.next()}, {0.3, 0.2, 0.6}, double{r.next()}, double{r.next()}, aperture, turned};
      const double reach = (1 - std::cos(aperture / 2)) / (4.5 / DirectionCells::rows);
      all.push_back({"sunsky " + std::to_string(aperture) + " at " + std::to_string(height), SunSky(settings),
                     aperture < 10 * degree ? DirectionCells(Vec3f(turned.vector(sun)), reach) : DirectionCells()});
    }
  return all;
}

TEST(light_directions, to_skies_match_their_density) {
  const std::vector<NamedSky> all = skies();
  std::uint64_t seed = 620;
  for (const NamedSky& named : all) {
    const Lights lights({EnvironmentLight(named.sky, {0, 0, 0}, 2)});
    const Vec3f p(0.1f, -0.3f, 0.2f);
    EXPECT_GT(test::direction_p_value([&](Random& r) { return lights.scene.sample(p, 0.5f, r.next2()).wi; },
                                      [&](const Vec3f& d) { return lights.scene.environment_pdf(p, d); }, ++seed,
                                      samples, 8, named.cells),
              test::sidak_level(static_cast<int>(all.size())))
        << named.name;
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
