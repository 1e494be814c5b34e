// The library's scenes with a closed form, rendered: the image's mean within 3 standard errors of the stated one and
// within 0.1 %. What they state is held to the formulas by reference/closed_forms/library_closed_forms_test.cpp.

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

std::string name_of(const testing::TestParamInfo<Case>& test) {
  std::string name = std::string(test.param.scene) + "_by_" + test.param.integrator;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// Those whose light path tracing finds.
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

/// The same with its automatic settings: where caustics carry the light, its mean is noisier than 0.1 % in seconds.
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

/// Mean of the image of a furnace-* scene around an opaque ball: the wall, of radius R = 2, albedo rho = 1/2 and
/// emission 1, and the ball, of radius r = 0.7, are concentric, so that the wall's radiance B is the same everywhere.
/// The ball sees nothing but the wall and sends back B a(theta), a the albedo of its material at the angle theta. The
/// wall sees it in the projected solid angle pi F, F = (r/R)^2, in which sin^2 theta is evenly distributed: its share
/// of the wall's irradiance is pi F B m, m the integral of a over sin^2 theta, and
///   B = 1 + rho B (F m + 1 - F),
/// which are the concentric spheres of closed_forms_enclosures.h with an inner albedo of m.
/// The camera is D = 1.7 from the middle and sees the square of half-width h = tan 30 degrees one unit ahead. The ball
/// shows its angle theta at the distance t from the middle of the square, t^2 = k^2 s / (1 - k^2 s) with k = r/D and
/// s = sin^2 theta, since sin(angle at the camera) = k sin(theta). All of it is in the picture. The mean is
///   B (1 - pi / (4 h^2) integral of (1 - a) d(t^2)),  d(t^2) = k^2 / (1 - k^2 s)^2 ds.
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

// Of these it is known only that they lose, glass twice, bumps as much as they hide.
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
