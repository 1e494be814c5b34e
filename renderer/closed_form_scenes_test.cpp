// The library's scenes with a closed form, rendered: the image's mean within 3 standard errors of the stated one and
// within 0.1 %. What they state is held to the formulas by reference/library_closed_forms_test.cpp.

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderer/test_scenes.h"
#include "scenes/expect.h"
#include "scenes/parser.h"

namespace photonproof {
namespace {

struct Mean {
  RgbD value{0.0}, error{0.0};  ///< of the image, and one standard deviation
};

const std::string kLibrary = std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/library/";

/// Over renders that differ in their seed alone, whose spread is the error: the film takes Sobol samples for
/// independent and would state an error that is many times too large.
Mean mean_of(const std::string& name, const char* integrator, std::int64_t spp) {
  constexpr int kSeeds = 16;
  const SceneDescription scene = parse_scene_file(kLibrary + name + "/scene.xml");
  RgbD sum(0.0), squares(0.0);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Image image = test::render(scene, integrator, test::job_with(spp / kSeeds, 0, seed)).image.mean;
    std::array<double, 3> total{};
    for (std::size_t i = 0; i < image.rgb.size(); ++i) total[i % 3] += double{image.rgb[i]};
    const RgbD mean = RgbD{total[0], total[1], total[2]} / static_cast<double>(image.pixels());
    sum = sum + mean;
    squares = squares + mean * mean;
  }
  const RgbD mean = sum / double{kSeeds};
  const auto error = [](double square, double m) {
    return std::sqrt(std::max(0.0, square / kSeeds - m * m) / (kSeeds - 1));
  };
  return {mean, RgbD{error(squares.x, mean.x), error(squares.y, mean.y), error(squares.z, mean.z)}};
}

struct Case {
  const char* scene;
  const char* integrator;
  std::int64_t spp;  ///< of all seeds together
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene << " by " << c.integrator; }

class ClosedFormScene : public testing::TestWithParam<Case> {};

TEST_P(ClosedFormScene, has_the_stated_mean) {
  const auto [scene, integrator, spp] = GetParam();
  const RgbD expected = *read_expect(kLibrary + scene + "/expect.toml").analytic->mean;
  const Mean got = mean_of(scene, integrator, spp);
  std::printf("%s by %s: expected %.7g %.7g %.7g, got %.7g %.7g %.7g, standard error %.2g %.2g %.2g\n", scene,
              integrator, expected.x, expected.y, expected.z, got.value.x, got.value.y, got.value.z, got.error.x,
              got.error.y, got.error.z);
  const auto check = [&](double value, double mean, double error) {
    // Where nothing is random, floats round: 1e-5 at most.
    EXPECT_NEAR(value, mean, std::max(3 * error, 1e-5 * mean));
    EXPECT_NEAR(value, mean, 1e-3 * mean);
  };
  check(got.value.x, expected.x, got.error.x);
  check(got.value.y, expected.y, got.error.y);
  check(got.value.z, expected.z, got.error.z);
}

INSTANTIATE_TEST_SUITE_P(library, ClosedFormScene,
                         testing::Values(Case{"furnace", "path", 256}, Case{"furnace-conductor", "path", 256},
                                         Case{"furnace-dielectric", "path", 256},
                                         Case{"furnace-thindielectric", "path", 256},
                                         Case{"furnace-plastic", "path", 256}, Case{"furnace-layered", "path", 256},
                                         Case{"furnace-twosided", "path", 256}, Case{"furnace-mask", "path", 256},
                                         Case{"furnace-blendbsdf", "path", 256}, Case{"furnace-null", "path", 256},
                                         Case{"light-area", "path", 256}, Case{"light-sphere", "path", 256},
                                         Case{"light-disk", "path", 256}, Case{"light-cylinder", "path", 1024},
                                         Case{"light-mesh", "path", 1024}, Case{"light-point", "path", 256},
                                         Case{"light-spot", "path", 256}, Case{"light-directional", "path", 16},
                                         Case{"light-constant", "path", 256}, Case{"light-envmap", "path", 256},
                                         Case{"light-ies", "path", 256}, Case{"integrating-sphere", "path", 1024},
                                         Case{"concentric-spheres", "path", 256}, Case{"parallel-planes", "path", 256},
                                         Case{"glass-slab", "path", 1024}, Case{"invisible-glass", "path", 256},
                                         Case{"ball-lens", "ptracer", 1024}, Case{"water-caustic", "ptracer", 4096},
                                         Case{"absorption", "volpath", 64}, Case{"albedo-one", "volpath", 256}),
                         [](const auto& test) {
                           std::string name = std::string(test.param.scene) + "_by_" + test.param.integrator;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// What models without multiple scattering, and shading normals, lose is theirs; they must not gain.
struct Loss {
  const char* scene;
  double least, most;  ///< of the image's mean
};
void PrintTo(const Loss& loss, std::ostream* out) { *out << loss.scene; }

class LossyFurnace : public testing::TestWithParam<Loss> {};

TEST_P(LossyFurnace, loses_what_its_model_loses_and_gains_nothing) {
  const auto [scene, least, most] = GetParam();
  const Mean got = mean_of(scene, "path", 256);
  std::printf("%s: %.6g of 2, standard error %.2g\n", scene, got.value.x, got.error.x);
  EXPECT_GT(got.value.x, least);
  EXPECT_LT(got.value.x, most);
}

// The first two were calculated apart from this program: directional albedos by drawing facets (Heitz 2018) or the
// lobe, the wall's radiance by the balance of two concentric spheres, and both averaged over the view, to 0.5 %:
// - conductor: its albedo is 0.842 in the mean, 0.88 from above: GGX's tail at roughness 0.3 sends as much below the
//   surface. Image 1.811.
// - phong: 0.867. Image 1.833.
// Plastic would show 1.700 if all that its interface does not reflect reached the base; what is lost between the facets
// is missing, too. Of the others it is known only that they lose, glass twice, bumps as much as they hide.
INSTANTIATE_TEST_SUITE_P(library, LossyFurnace,
                         testing::Values(Loss{"furnace-roughconductor", 1.802, 1.820},
                                         Loss{"furnace-roughplastic", 1.6, 1.700}, Loss{"furnace-phong", 1.824, 1.842},
                                         Loss{"furnace-roughdielectric", 1.6, 1.812}, Loss{"furnace-bumpmap", 1.9, 2.0},
                                         Loss{"furnace-normalmap", 1.9, 2.0}),
                         [](const auto& test) {
                           std::string name = test.param.scene;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace photonproof
