// Renders of the library's scenes with a closed form: the image's mean is within 3 standard errors of the stated one
// and within 0.1 %. The test reference/closed_forms/library_closed_forms_test.cpp checks the stated means.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "renderer/bsdfs/test_albedo.h"
#include "renderer/integrators/test_scenes.h"
#include "scenes/description/expect.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_integrators {
namespace {

struct Mean {
  RgbD value{0.0}, error{0.0};  ///< mean of the image, and one standard deviation
};

const std::string kLibrary = std::string(PHOTONPROOF_SOURCE_DIR) + "/scenes/library/";

/// Mean over renders that differ only in their seed; their spread is the error. The film's own error estimate would be
/// many times too large, as it treats Sobol samples as independent.
Mean mean_of(const std::string& name, const char* integrator, std::int64_t spp) {
  constexpr int kSeeds = 16;
  const SceneDescription scene = parse_scene_file(kLibrary + name + "/scene.xml");
  RgbD sum(0.0), squares(0.0);
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    RenderJob job = test::job_with(spp / kSeeds, 0, seed);
    job.budget.photons.reset();  // the photon mapper's own choice
    const Image image = test::render(scene, integrator, job).image.mean;
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
  std::int64_t spp;  ///< sum over all seeds
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
    // Where nothing is random, floats still round: 1e-5 at most.
    EXPECT_NEAR(value, mean, std::max(3 * error, 1e-5 * mean));
    EXPECT_NEAR(value, mean, 1e-3 * mean);
  };
  check(got.value.x, expected.x, got.error.x);
  check(got.value.y, expected.y, got.error.y);
  check(got.value.z, expected.z, got.error.z);
}

std::string name_of(const testing::TestParamInfo<Case>& test) {
  std::string name = std::string(test.param.scene) + "_by_" + test.param.integrator;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Scenes whose light path tracing finds.
std::vector<Case> by_path() {
  std::vector<Case> cases{{"light-directional", "path", 16}};
  for (const char* scene : {"furnace",           "furnace-conductor", "furnace-dielectric", "furnace-thindielectric",
                            "furnace-plastic",   "furnace-layered",   "furnace-twosided",   "furnace-mask",
                            "furnace-blendbsdf", "furnace-null",      "light-area",         "light-sphere",
                            "light-disk",        "light-point",       "light-spot",         "light-constant",
                            "light-envmap",      "light-ies",         "concentric-spheres", "parallel-planes",
                            "invisible-glass"})
    cases.push_back({scene, "path", 256});
  for (const char* scene : {"light-cylinder", "light-mesh", "integrating-sphere", "glass-slab"})
    cases.push_back({scene, "path", 1024});
  return cases;
}

/// The same for the photon mapper with automatic settings. Where caustics carry the light, seconds of rendering leave
/// more than 0.1 % of noise in the mean.
std::vector<Case> by_photon_mapper() {
  std::vector<Case> cases = by_path();
  for (Case& c : cases) c = {c.scene, "photonmapper", std::max<std::int64_t>(c.spp, 256)};
  return cases;
}

INSTANTIATE_TEST_SUITE_P(library, ClosedFormScene, testing::ValuesIn(by_path()), name_of);
INSTANTIATE_TEST_SUITE_P(photons, ClosedFormScene, testing::ValuesIn(by_photon_mapper()), name_of);
INSTANTIATE_TEST_SUITE_P(others, ClosedFormScene,
                         testing::Values(Case{"ball-lens", "ptracer", 1024}, Case{"water-caustic", "ptracer", 2048},
                                         Case{"absorption", "volpath", 64}, Case{"albedo-one", "volpath", 256}),
                         name_of);

/// Mean of the image of a furnace-* scene around an opaque ball. The wall has the radius R = 2, albedo rho = 1/2 and
/// emission 1. The ball, of radius r = 0.7, is concentric, so the wall's radiance B is the same everywhere. The ball
/// sees only the wall and reflects B a(theta), where a is its material's albedo at the angle theta. The wall sees the
/// ball in the projected solid angle pi F, F = (r/R)^2, in which sin^2 theta is evenly distributed. The ball's part of
/// the wall's irradiance is pi F B m, where m is the integral of a over sin^2 theta. So
///   `B = 1 + rho B (F m + 1 - F)`,
/// as for the concentric spheres of closed_forms_enclosures.h with an inner albedo of m.
/// The camera is D = 1.7 from the middle and sees the square of half-width h = tan 30 degrees one unit ahead. The ball
/// shows its angle theta at the distance t from the middle of the square, t^2 = k^2 s / (1 - k^2 s). Here k = r/D and s
/// = sin^2 theta, since sin(angle at the camera) = k sin(theta). The whole ball is in the image. The mean is
///   `B (1 - pi / (4 h^2) integral of (1 - a) d(t^2)),  d(t^2) = k^2 / (1 - k^2 s)^2 ds`.
double furnace_around(const Bsdf& ball, int steps) {
  const double k = 0.7 / 1.7, h = std::tan(std::numbers::pi / 6), inner = 0.7, outer = 2;
  double mean_albedo = 0, missing = 0;
  for (int i = 0; i < steps; ++i) {  // midpoints in the root of the cosine
    const double root = (i + 0.5) / steps, cosine = root * root, s = 1 - cosine * cosine;
    const double ds = 4 * cosine * root / steps, albedo = test::albedo_by_quadrature(ball, cosine, 2 * steps);
    mean_albedo += albedo * ds;
    missing += (1 - albedo) * k * k / ((1 - k * k * s) * (1 - k * k * s)) * ds;
  }
  const double f = inner * inner / (outer * outer);
  const double wall = 1 / (1 - 0.5 * (f * mean_albedo + 1 - f));
  return wall * (1 - std::numbers::pi / (4 * h * h) * missing);
}

class OpaqueFurnace : public testing::TestWithParam<const char*> {};

TEST_P(OpaqueFurnace, has_the_mean_that_the_integral_of_its_bsdf_gives) {
  const SceneDescription scene = parse_scene_file(kLibrary + GetParam() + "/scene.xml");
  const Bsdf ball = compile_bsdf(scene, scene.shapes.at(1).bsdf).record;
  const double expected = furnace_around(ball, 100), coarse = furnace_around(ball, 50);
  const Mean got = mean_of(GetParam(), "path", 256);
  std::printf("%s: expected %.6f (%.6f with half the steps), got %.6f, standard error %.2g\n", GetParam(), expected,
              coarse, got.value.x, got.error.x);
  EXPECT_NEAR(expected, coarse, 1e-4) << "the quadrature";
  EXPECT_NEAR(got.value.x, expected, 3 * got.error.x + 1e-5 * expected);
  EXPECT_NEAR(got.value.x, expected, 1e-3 * expected);
}

INSTANTIATE_TEST_SUITE_P(library, OpaqueFurnace,
                         testing::Values("furnace-roughconductor", "furnace-roughplastic", "furnace-phong"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

/// Bounds for models without multiple scattering and for shading normals: they may lose light but must not gain any.
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

// These are only known to lose light; glass loses twice, bumps as much as they hide.
INSTANTIATE_TEST_SUITE_P(library, LossyFurnace,
                         testing::Values(Loss{"furnace-roughdielectric", 1.6, 1.812}, Loss{"furnace-bumpmap", 1.9, 2.0},
                                         Loss{"furnace-normalmap", 1.9, 2.0}),
                         [](const auto& test) {
                           std::string name = test.param.scene;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace photonproof::inline renderer_integrators
