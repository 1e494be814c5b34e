// The scalar integrators against the path tracer, against each other and against closed forms.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "renderer/integrators/bdpt_weights.h"
#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_chi_square.h"
#include "renderer/media/phase.h"
#include "renderer/scalar/scene_interface.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::job_with;

constexpr int seeds = 12, size = 24, block = 8;

/// Means of 8x8 blocks over renders of different seeds, and standard errors from their spread.
struct Blocks {
  std::vector<double> mean, error;
};

Blocks blocks_of(const SceneDescription& scene, const char* integrator, std::int64_t spp, std::uint64_t first_seed) {
  std::vector<double> sum, squares;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    RenderJob job = job_with(spp, 0, first_seed + seed);
    job.budget.photons.reset();
    job.sampler = SamplerKind::independent;
    const Image image = test::render(scene, integrator, job).image.mean;
    std::size_t at = 0;
    for (int y = 0; y < size; y += block)
      for (int x = 0; x < size; x += block)
        for (int c = 0; c < 3; ++c, ++at) {
          double value = 0;
          for (int j = 0; j < block * block; ++j) value += double{image.pixel(x + j % block, y + j / block)[c]};
          value /= block * block;
          if (sum.size() <= at) sum.resize(at + 1), squares.resize(at + 1);
          sum[at] += value;
          squares[at] += value * value;
        }
  }
  Blocks blocks;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    const double mean = sum[i] / seeds;
    blocks.mean.push_back(mean);
    blocks.error.push_back(std::sqrt(std::max(0.0, (squares[i] - sum[i] * mean) / (seeds - 1) / seeds)));
  }
  return blocks;
}

/// Student's t over all blocks and channels at Sidak's level: chance fails once in a hundred runs of new seeds. The
/// whole image must also agree to `percent`, so that noise hides no difference.
void expect_same(const Blocks& a, const Blocks& b, double percent, const std::string& what) {
  const auto n = static_cast<int>(a.mean.size());
  const boost::math::students_t t(2 * (seeds - 1));
  const double bound = boost::math::quantile(boost::math::complement(t, test::sidak_level(n) / 2));
  double mean_a = 0, mean_b = 0;
  for (std::size_t i = 0; i < a.mean.size(); ++i) {
    mean_a += a.mean[i];
    mean_b += b.mean[i];
    const double error = std::hypot(a.error[i], b.error[i]) + 1e-6 * a.mean[i];
    EXPECT_LE(std::abs(a.mean[i] - b.mean[i]), bound * error)
        << what << ", block value " << i << ": " << a.mean[i] << " and " << b.mean[i];
  }
  EXPECT_GT(mean_a, 0) << what;
  EXPECT_NEAR(mean_b / mean_a, 1, percent / 100) << what;
}

SceneDescription unlit_light_room(bool with_balls) {
  SceneDescription scene = test::room(size, with_balls);
  scene.integrator.method = PathDescription{{-1, 5, true}};
  return scene;
}

class Unbiased : public testing::TestWithParam<const char*> {};

TEST_P(Unbiased, agrees_with_the_path_tracer_in_a_room) {
  const SceneDescription scene = unlit_light_room(false);
  expect_same(blocks_of(scene, "path", 64, 100), blocks_of(scene, GetParam(), 64, 200), 1, GetParam());
}

TEST_P(Unbiased, shows_the_light_itself) {
  SceneDescription scene = test::room(size, false);
  scene.integrator.method = PathDescription{{1, 5, false}};
  expect_same(blocks_of(scene, "path", 64, 100), blocks_of(scene, GetParam(), 64, 200), 2, GetParam());
}

TEST_P(Unbiased, agrees_with_the_path_tracer_under_a_point_light) {
  SceneDescription scene = unlit_light_room(false);
  scene.shapes.pop_back();
  scene.emitters.push_back({{}, "", PointLightDescription{{0.2, 0.5, 0.1}, RgbD(1)}});
  expect_same(blocks_of(scene, "path", 64, 100), blocks_of(scene, GetParam(), 64, 200), 1, GetParam());
}

TEST_P(Unbiased, agrees_with_the_path_tracer_at_every_depth) {
  for (int depth = 2; depth <= 5; ++depth) {
    SceneDescription scene = unlit_light_room(false);
    scene.integrator.method = PathDescription{{depth, 3, true}};
    expect_same(blocks_of(scene, "path", 32, 100), blocks_of(scene, GetParam(), 32, 200), 2,
                GetParam() + std::string(" to depth ") + std::to_string(depth));
  }
}

TEST_P(Unbiased, agrees_with_the_path_tracer_under_a_sky) {
  SceneDescription scene = unlit_light_room(false);
  scene.shapes.erase(scene.shapes.begin() + 2);  // no ceiling, and the light stays
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.5)}});
  expect_same(blocks_of(scene, "path", 64, 100), blocks_of(scene, GetParam(), 64, 200), 1, GetParam());
}

TEST_P(Unbiased, agrees_with_the_path_tracer_on_what_the_clip_planes_cut) {
  SceneDescription scene = unlit_light_room(false);
  std::get<PathDescription>(scene.integrator.method).hide_emitters = false;
  auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
  camera.near_clip = 3.3;  // the walls' first fifth
  camera.far_clip = 4.5;   // the back wall, and their last: the sky is seen there
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.5)}});
  expect_same(blocks_of(scene, "path", 64, 100), blocks_of(scene, GetParam(), 64, 200), 1, GetParam());
}

TEST_P(Unbiased, is_the_same_bits_at_1_2_and_7_threads) {
  const SceneDescription scene = test::room(40, true);
  const auto with_threads = [&](int threads) {
    RenderJob job = job_with(3);
    job.budget.photons.reset();
    job.threads = threads;
    return test::render(scene, GetParam(), job).image.mean.rgb;
  };
  const std::vector<float> one = with_threads(1);
  for (const int threads : {2, 7}) EXPECT_EQ(one, with_threads(threads)) << threads;
}

TEST_P(Unbiased, furnace_is_two) {
  // L = e / (1 - rho) = 2 everywhere. Roulette from depth 5 on, where 1/32 of the light is left, shortens paths.
  SceneDescription scene = test::furnace(0.5, 1, size);
  scene.integrator.method = PathDescription{{-1, 5, false}};
  const Blocks blocks = blocks_of(scene, GetParam(), 24, 300);
  double mean = 0, variance = 0;
  for (std::size_t i = 0; i < blocks.mean.size(); i += 3) {  // grey
    mean += blocks.mean[i];
    variance += blocks.error[i] * blocks.error[i];
  }
  const double n = static_cast<double>(blocks.mean.size()) / 3;
  std::printf("%s: the furnace is %.4f +- %.4f\n", GetParam(), mean / n, std::sqrt(variance) / n);
  EXPECT_NEAR(mean / n, 2.0, 3 * std::sqrt(variance) / n + 1e-4);
  EXPECT_NEAR(mean / n, 2.0, 0.02);
}

/// A room that absorbs a hundredth: L = e / (1 - rho) = 1; camera paths' first 16 edges bring 15 % of it. In the tail,
/// one join stands for all. Without that factor the image would lose more than half of the rest.
TEST(bdpt, joins_long_paths_by_draws_and_loses_nothing) {
  RenderJob job = job_with(64, 0, 11);
  job.sampler = SamplerKind::independent;
  const auto rendered = test::render(test::furnace(0.99, 0.01, size), "bdpt", job);
  const std::optional<MeanError> error = stored_mean_error(rendered.image);
  ASSERT_TRUE(error);
  double mean = 0;
  for (const float v : rendered.image.mean.rgb) mean += double{v};
  mean /= static_cast<double>(rendered.image.mean.rgb.size());
  EXPECT_NEAR(mean, 1, 4 * error->standard_error[0]);
  EXPECT_LT(error->standard_error[0], 0.006);
  // A bounce has shadow rays to a light's point, to the lens and, in the tail, to one light vertex. Joins to all
  // vertices of a light path would take 30 rays a bounce.
  EXPECT_LT(rendered.stats.counts.at("rays_shadow"), 8 * rendered.stats.counts.at("rays_bounce"));
}

INSTANTIATE_TEST_SUITE_P(scalar, Unbiased, testing::Values("bdpt", "ptracer", "volpath"),
                         [](const auto& name) { return std::string(name.param); });

TEST(bdpt, agrees_with_the_path_tracer_by_mirrors_and_glass) {
  const SceneDescription scene = unlit_light_room(true);
  expect_same(blocks_of(scene, "path", 1024, 100), blocks_of(scene, "bdpt", 256, 200), 2, "bdpt");
}

TEST(volpath, agrees_with_the_path_tracer_by_mirrors_and_glass) {
  const SceneDescription scene = unlit_light_room(true);
  expect_same(blocks_of(scene, "path", 256, 100), blocks_of(scene, "volpath", 256, 200), 2, "volpath");
}

TEST(whitted, is_direct_light_where_nothing_is_specular) {
  SceneDescription scene = unlit_light_room(false);
  scene.integrator.method = PathDescription{{2, 5, true}};
  expect_same(blocks_of(scene, "path", 64, 100), blocks_of(scene, "whitted", 64, 200), 1, "whitted");
}

TEST(difftrans, shows_the_share_of_a_sky_that_passes) {
  // A sheet before a sky of radiance 1 fills the image: L = transmittance / pi * pi * 1, from either side.
  for (const double turn : {0.0, 180.0})
    for (const char* integrator : {"path", "bdpt", "volpath", "ptracer", "photonmapper", "whitted"}) {
      SceneDescription scene;
      const BsdfIndex paper = test::add_bsdf(scene, DiffuseTransmitterDescription{RgbD(0.6)});
      test::add_shape(scene, RectangleDescription{}, Transform::rotate({0, 1, 0}, turn), paper);
      scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
      test::set_camera(scene, Transform::look_at({0, 0, 1}, {0, 0, 0}, {0, 1, 0}), 60, size);
      RenderJob job = job_with(256);
      job.budget.photons.reset();
      EXPECT_NEAR(test::image_mean(test::render(scene, integrator, job).image.mean), 0.6, 0.006) << integrator;
    }
}

TEST(bdpt, weights_are_those_of_the_definition_and_sum_to_one) {
  // A path of eight vertices with random densities per solid angle and cosines. p_s is the product of f_i for i < s and
  // b_i for i >= s. Every strategy's weight by ratios is p_s^2 over the sum of squares, computed here from products.
  constexpr std::size_t n = 8;
  test::Random random(7);
  const auto any = [&] { return 0.1 + double{random.next()}; };
  double toward_camera[n], toward_light[n], cos_camera[n], cos_light[n], distance2[n];  // distance2[i]: to vertex i + 1
  for (std::size_t i = 0; i < n; ++i) {
    toward_camera[i] = any(), toward_light[i] = any(), cos_camera[i] = any(), cos_light[i] = any();
    distance2[i] = any();
  }
  const double f0 = any(), b_last = any();
  double f[n], b[n];
  for (std::size_t i = 1; i < n; ++i) f[i] = toward_camera[i - 1] * cos_light[i] / distance2[i - 1];
  for (std::size_t i = 0; i + 1 < n; ++i) b[i] = toward_light[i + 1] * cos_camera[i] / distance2[i];
  f[0] = f0;
  b[n - 1] = b_last;
  const auto p = [&](std::size_t s) {
    double product = 1;
    for (std::size_t i = 0; i < n; ++i) product *= i < s ? f[i] : b[i];
    return product;
  };
  // Strategies are 1 to n - 1. Here next-event estimation and f_0 are one density, and no path meets the light or lens.
  double total = 0;
  for (std::size_t s = 1; s < n; ++s) total += p(s) * p(s);
  double sum = 0;
  for (std::size_t s = 2; s + 1 < n; ++s) {
    SubpathWeights light(1 / (f[1] * f[1]), 0);
    for (std::size_t i = 1; i + 1 < s; ++i) {
      light.scatter(toward_camera[i], toward_light[i], cos_camera[i]);
      light.arrive(distance2[i], cos_light[i + 1]);
    }
    SubpathWeights camera(1 / (b[n - 2] * b[n - 2]), 0);
    for (std::size_t i = n - 2; i > s; --i) {
      camera.scatter(toward_light[i], toward_camera[i], cos_light[i]);
      camera.arrive(distance2[i - 1], cos_camera[i - 1]);
    }
    const double weight = 1 / (1 + light.ratio(b[s - 1], toward_light[s - 1]) + camera.ratio(f[s], toward_camera[s]));
    EXPECT_NEAR(weight, p(s) * p(s) / total, 1e-12) << s;
    sum += weight;
  }
  EXPECT_NEAR(sum + (p(1) * p(1) + p(n - 1) * p(n - 1)) / total, 1, 1e-12);
}

TEST(henyey_greenstein, draws_by_its_density) {
  const Vec3f travel = normalize(Vec3f(0.3f, -0.5f, 0.8f));
  const float means[] = {-0.7f, 0.0f, 0.4f, 0.9f};
  for (const float g : means) {
    const HenyeyGreenstein phase{g};
    const double p_value =
        test::direction_p_value([&](test::Random& random) { return phase.sample(travel, random.next2()); },
                                [&](const Vec3f& d) { return phase.eval(travel, d); }, 11);
    EXPECT_GT(p_value, test::sidak_level(4)) << g;
  }
}

/// A light of radiance 1 that just fills the view (0.035 across), 2 units before the camera, in an infinite medium.
/// Rays start on the near plane, 0.01 ahead of the camera, as do the media along them.
SceneDescription light_in_medium(const HomogeneousDescription& medium) {
  SceneDescription scene;
  ShapeDescription& area_light =
      test::add_shape(scene, RectangleDescription{}, Transform::rotate({1, 0, 0}, 180) * Transform::scale(Vec3d(0.02)),
                      test::add_bsdf(scene, DiffuseDescription{RgbD(0)}));
  area_light.radiance = RgbD(1);
  scene.media.push_back({{}, "", medium});
  scene.sensor.medium = MediumIndex{0};
  test::set_camera(scene, Transform::look_at({0, 0, -2}, {0, 0, 0}, {0, 1, 0}), 1, size);
  scene.integrator.method = PathDescription{{-1, 50, false}};
  return scene;
}

TEST(media, absorption_is_beers_law) {
  // Within half a degree of the axis, the distance is 2 - 0.01 to 4 parts in 10^5. The transmittance is e^(-1.99
  // sigma).
  const SceneDescription scene = light_in_medium({{0.2, 0.5, 1.5}, RgbD(0), 1, {}});
  for (const char* integrator : {"volpath", "bdpt"}) {
    const Image image = test::render(scene, integrator, job_with(2)).image.mean;
    for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
      EXPECT_NEAR(image.rgb[i], std::exp(-0.2 * 1.99), 2e-4) << integrator;
      EXPECT_NEAR(image.rgb[i + 1], std::exp(-0.5 * 1.99), 2e-4) << integrator;
      EXPECT_NEAR(image.rgb[i + 2], std::exp(-1.5 * 1.99), 2e-4) << integrator;
    }
  }
}

TEST(media, light_path_through_an_absorber_loses_as_much) {
  const SceneDescription scene = light_in_medium({{0.2, 0.5, 1.5}, RgbD(0), 1, {}});
  expect_same(blocks_of(scene, "volpath", 4, 1), blocks_of(scene, "ptracer", 64, 1), 5, "ptracer");
}

TEST(media, scattering_without_loss_leaves_uniform_light_as_it_is) {
  // Albedo 1 inside a closed black light of radiance 1: L = 1 from everywhere, whatever a channel's extinction.
  SceneDescription scene = test::furnace(0, 1, size);
  scene.media.push_back({{}, "", HomogeneousDescription{{0.5, 1, 3}, RgbD(1), 1, HenyeyGreensteinDescription{0.5}}});
  scene.shapes[0].exterior = MediumIndex{0};  // the normal points inward
  scene.sensor.medium = MediumIndex{0};
  const Blocks blocks = blocks_of(scene, "volpath", 64, 5);
  for (int channel = 0; channel < 3; ++channel) {
    double mean = 0, variance = 0, n = 0;
    for (std::size_t i = static_cast<std::size_t>(channel); i < blocks.mean.size(); i += 3, n += 1) {
      mean += blocks.mean[i];
      variance += blocks.error[i] * blocks.error[i];
    }
    EXPECT_NEAR(mean / n, 1, 3.5 * std::sqrt(variance) / n + 1e-4) << channel;
    EXPECT_NEAR(mean / n, 1, 0.03) << channel;
  }
}

/// A grid over the unit cube whose values differ from cell to cell and, with three channels, from channel to channel.
GridVolumeDescription cloudy_grid(float scale, int channels) {
  VolumeGrid grid;
  grid.width = 3;
  grid.height = grid.depth = 2;
  grid.channels = channels;
  for (int i = 0; i < 12 * channels; ++i) grid.values.push_back(scale * static_cast<float>((i * 7 + 3) % 11) / 10);
  grid.largest = *std::max_element(grid.values.begin(), grid.values.end());
  GridVolumeDescription volume;
  volume.grid = std::make_shared<const VolumeGrid>(grid);
  return volume;
}

TEST(media, scattering_without_loss_in_a_cloud_leaves_uniform_light_as_it_is) {
  // As above, with an extinction that varies: L = 1 from everywhere.
  SceneDescription scene = test::furnace(0, 1, size);
  HeterogeneousDescription cloud{cloudy_grid(2, 3), RgbD(1), 1, RayleighDescription{}};
  std::get<GridVolumeDescription>(cloud.sigma_t).to_world =
      Transform::translate(Vec3d(-1)) * Transform::scale(Vec3d(2));
  scene.media.push_back({{}, "", cloud});
  scene.shapes[0].exterior = MediumIndex{0};
  scene.sensor.medium = MediumIndex{0};
  const Blocks blocks = blocks_of(scene, "volpath", 64, 5);
  double mean = 0, variance = 0;
  for (std::size_t i = 0; i < blocks.mean.size(); ++i) {
    mean += blocks.mean[i];
    variance += blocks.error[i] * blocks.error[i];
  }
  const double n = static_cast<double>(blocks.mean.size());
  EXPECT_NEAR(mean / n, 1, 3.5 * std::sqrt(variance) / n + 1e-4);
  EXPECT_NEAR(mean / n, 1, 0.01);
}

/// A body filled by a medium, from -0.5 to 0.5, beside a wall, under a point light and a faint sky.
SceneDescription body_of(const decltype(MediumDescription::model)& medium) {
  SceneDescription scene = test::room(size, false);
  scene.integrator.method = PathDescription{{-1, 50, true}};
  scene.media.push_back({{}, "", medium});
  scene.shapes.clear();
  test::add_shape(scene, CubeDescription{}, Transform::translate({0, 0, -1.5}) * Transform::scale({2, 2, 0.1}),
                  test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)}));
  test::add_shape(scene, CubeDescription{}, Transform::scale(Vec3d(0.5)), test::add_bsdf(scene, NullDescription{}))
      .interior = MediumIndex{0};
  scene.emitters.push_back({{}, "", PointLightDescription{{1, 1, 1}, RgbD(2)}});
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(0.2)}});
  test::set_camera(scene, Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 25, size);
  return scene;
}

TEST(media, that_could_vary_and_do_not_look_like_those_that_cannot) {
  // The grid's cells are all the same in a channel, and its majorant is that of the densest channel. The volume is
  // placed over the cube, and `scale` doubles it.
  const RgbD sigma_t{0.5, 1, 2}, albedo{0.9, 0.5, 0.7};
  VolumeGrid grid;
  grid.width = 2;
  grid.channels = 3;
  for (int i = 0; i < 2; ++i)
    for (const double v : {sigma_t.x, sigma_t.y, sigma_t.z}) grid.values.push_back(static_cast<float>(v));
  grid.largest = 2;
  GridVolumeDescription volume;
  volume.grid = std::make_shared<const VolumeGrid>(grid);
  volume.to_world = Transform::translate(Vec3d(-0.5));
  const HenyeyGreensteinDescription phase{0.4};
  expect_same(blocks_of(body_of(HomogeneousDescription{sigma_t, albedo, 2, phase}), "volpath", 128, 100),
              blocks_of(body_of(HeterogeneousDescription{volume, albedo, 2, phase}), "volpath", 128, 200), 1, "cube");
}

TEST(media, that_vary_are_the_same_bits_at_1_2_and_7_threads) {
  const SceneDescription scene = body_of(HeterogeneousDescription{cloudy_grid(3, 3), cloudy_grid(0.9f, 1), 1, {}});
  const auto with_threads = [&](int threads) {
    RenderJob job = job_with(3);
    job.budget.photons.reset();
    job.threads = threads;
    return test::render(scene, "volpath", job).image.mean.rgb;
  };
  const std::vector<float> one = with_threads(1);
  for (const int threads : {2, 7}) EXPECT_EQ(one, with_threads(threads)) << threads;
}

TEST(media, light_scattered_once_is_the_line_integral) {
  // A point light I = 1 at distance h = 1 beside the axis, sigma_t = 0.5 (half of it from `scale`), albedo 0.8, paths
  // of two edges. L = integral of sigma_s p(cos) e^(-sigma_t (t + r)) / r^2 dt with r^2 = h^2 + (t - t0)^2, by the
  // midpoint rule. The variable t starts on the near plane, 0.01 ahead. Light on its way to the camera turns by
  // cos = (t0 - t) / r. By Henyey and Greenstein 1941, p = (1 - g^2) / (4 pi (1 + g^2 - 2 g cos)^(3/2)). For g > 0 it
  // is forward: more light arrives from the nearer half of the line. An error of 5 % in sigma_t, scale or g changes one
  // of the three results by 2.5 to 5 %. In albedo it changes all by 5 %; a wrong sign of g nearly halves one.
  for (const double g : {0.0, 0.6, -0.6}) {
    SceneDescription scene;
    HomogeneousDescription medium{RgbD(0.25), RgbD(0.8), 2, IsotropicDescription{}};
    if (g != 0) medium.phase = HenyeyGreensteinDescription{g};
    scene.media.push_back({{}, "", medium});
    scene.sensor.medium = MediumIndex{0};
    scene.emitters.push_back({{}, "", PointLightDescription{{1, 0, 0}, RgbD(1)}});
    test::set_camera(scene, Transform::look_at({0, 0, -2}, {0, 0, 0}, {0, 1, 0}), 0.1, size);
    scene.integrator.method = PathDescription{{2, 50, false}};
    double expected = 0;
    constexpr double step = 1e-3;
    for (double t = step / 2; t < 60; t += step) {
      const double r = std::sqrt(1 + (t - 1.99) * (t - 1.99)), cos_turn = (1.99 - t) / r;
      const double p = (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cos_turn, 1.5));
      expected += 0.5 * 0.8 * p * std::exp(-0.5 * (t + r)) / (r * r) * step;
    }
    const Blocks blocks = blocks_of(scene, "volpath", 64, 9);
    double mean = 0, variance = 0;
    for (std::size_t i = 0; i < blocks.mean.size(); i += 3) {
      mean += blocks.mean[i];
      variance += blocks.error[i] * blocks.error[i];
    }
    const double n = static_cast<double>(blocks.mean.size()) / 3;
    EXPECT_NEAR(mean / n, expected, 3.5 * std::sqrt(variance) / n) << g;
    EXPECT_LT(std::sqrt(variance) / n, 0.005 * expected) << g;
  }
}

/// A glass ball under a sky before a light, with an optional ball of water in its middle.
SceneDescription ball_in_ball(const DielectricDescription& outer, const std::optional<DielectricDescription>& inner) {
  SceneDescription scene = unlit_light_room(false);
  test::add_shape(scene, SphereDescription{{0, -0.3, 0}, 0.6}, {}, test::add_bsdf(scene, outer));
  if (inner) test::add_shape(scene, SphereDescription{{0, -0.3, 0}, 0.4}, {}, test::add_bsdf(scene, *inner));
  return scene;
}

TEST(straight_ways, come_to_an_end_where_coordinates_are_coarse) {
  // A ball at 2e5, where floats are 1/64 apart: offset from the ball, the ray would start where it started before.
  const Scene scene = test::compiled(test::furnace(0.5, 1, size), size, size);
  const SceneInterface world(scene);
  const Vec3f start{-106496.453f, -131070.648f, 229376.688f}, direction{0.157587945f, 0.916875303f, -0.366750121f};
  Interaction ball;
  ball.p = {-106496.508f, -131070.609f, 229376.766f};
  ball.ng = {-0.506111264f, 0.392672539f, 0.767892957f};
  Ray ray{start, direction};
  for (int surface = 0; surface < 100; ++surface) {
    const Ray next = world.pass(ray, ball, direction);
    ASSERT_GT(dot(Vec3d(next.origin) - Vec3d(ray.origin), Vec3d(direction)), 0) << surface;
    EXPECT_NEAR(next.gap, dot(Vec3d(next.origin) - Vec3d(ball.p), Vec3d(direction)), 1e-3) << surface;
    ball.p = ball.p + (next.origin - ray.origin);
    ray = next;
  }
  // Where the offset suffices, nothing is added.
  const Ray far{start - direction, direction};
  EXPECT_EQ(world.pass(far, ball, direction).origin, world.leave(ball, direction).origin);
}

TEST(nested_dielectrics, the_higher_priority_hides_what_it_holds) {
  const SceneDescription alone = ball_in_ball({1.5, 1.0}, std::nullopt);
  const SceneDescription hidden =
      ball_in_ball({1.5, 1.0, RgbD(1), RgbD(1), 2}, DielectricDescription{1.33, 1.0, RgbD(1), RgbD(1), 1});
  expect_same(blocks_of(alone, "path", 128, 1), blocks_of(hidden, "volpath", 128, 50), 3, "volpath");
  expect_same(blocks_of(alone, "path", 128, 1), blocks_of(hidden, "bdpt", 64, 50), 3, "bdpt");
}

TEST(nested_dielectrics, the_lower_priority_gives_way_to_what_it_holds) {
  const SceneDescription spelled_out = ball_in_ball({1.5, 1.0}, DielectricDescription{1.33, 1.5});
  const SceneDescription nested =
      ball_in_ball({1.5, 1.0, RgbD(1), RgbD(1), 1}, DielectricDescription{1.33, 1.0, RgbD(1), RgbD(1), 2});
  expect_same(blocks_of(spelled_out, "path", 128, 1), blocks_of(nested, "volpath", 128, 50), 3, "volpath");
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
