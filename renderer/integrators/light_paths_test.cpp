// Error estimates of images from light paths, for pixels, blocks and the mean, and light that light tracing cannot
// show.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline renderer_integrators {
namespace {

using test::job_with;

constexpr int seeds = 12, size = 24, block = 8;

SceneDescription unlit_light_room() {
  SceneDescription scene = test::room(size, false);
  scene.integrator.method = PathDescription{{-1, 5, true}};
  return scene;
}

TEST(film, variances_of_splats_are_those_that_seeds_show) {
  // The mean over pixels of the estimated variance of the mean, against the sample variance over seeds.
  const SceneDescription scene = unlit_light_room();
  for (const char* integrator : {"ptracer", "bdpt"}) {
    std::vector<double> sum(3 * size * size), squares(3 * size * size);
    double estimated = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      RenderJob job = job_with(64, 0, 40 + seed);
      job.budget.photons.reset();
      job.sampler = SamplerKind::independent;
      const Rendering r = test::render(scene, integrator, job).image;
      for (std::size_t i = 0; i < sum.size(); ++i) {
        sum[i] += double{r.mean.rgb[i]};
        squares[i] += double{r.mean.rgb[i]} * double{r.mean.rgb[i]};
        estimated += double{r.variance->rgb[i]} / seeds;
      }
    }
    double observed = 0;
    for (std::size_t i = 0; i < sum.size(); ++i) observed += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1);
    EXPECT_NEAR(estimated / observed, 1, 0.2) << integrator;
  }
}

TEST(ptracer, says_that_light_from_infinity_does_not_reach_a_plane_to_its_horizon) {
  SceneDescription scene;
  const BsdfIndex grey = test::add_bsdf(scene, DiffuseDescription{RgbD(0.5)});
  test::add_shape(scene, PlaneDescription{}, Transform::rotate({1, 0, 0}, -90), grey);
  test::add_shape(scene, SphereDescription{{0, 0.5, 0}, 0.5}, {}, grey);
  test::set_camera(scene, Transform::look_at({0, 1, 4}, {0, 0.5, 0}, {0, 1, 0}), 40, 16);
  scene.emitters.push_back({{}, "", PointLightDescription{{0, 3, 0}, RgbD(1)}});
  const auto losses = [&] { return test::render(scene, "ptracer", job_with(256)).stats.losses; };
  EXPECT_THAT(losses(), testing::Not(testing::Contains(testing::HasSubstr("plane without end"))));
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  EXPECT_THAT(losses(), testing::Contains(testing::HasSubstr("plane without end")));
}

// Variances of blocks of 8 x 8 pixels over 60 seeds: one is known to 18 %, the mean over 27 blocks and channels to some
// 5 %. A splat of this Gaussian spans 6.2 pixels, some of which lie beyond the block's edge.
TEST(film, neighbours_that_splats_span_vary_together_as_the_image_says) {
  constexpr int many = 60;
  SceneDescription scene = unlit_light_room();
  scene.sensor.film.filter = {ReconstructionFilter::Kind::gaussian, 0.7, 1};
  std::vector<double> sum, squares;
  double stated = 0, spans = 0;
  for (std::uint64_t seed = 0; seed < many; ++seed) {
    RenderJob job = job_with(16, 0, 500 + seed);
    job.sampler = SamplerKind::independent;
    const Rendering r = test::render(scene, "ptracer", job).image;
    spans = pixels_a_splat(r);
    std::size_t at = 0;
    for (int y = 0; y < size; y += block)
      for (int x = 0; x < size; x += block)
        for (int c = 0; c < 3; ++c, ++at) {
          double value = 0;
          for (int j = 0; j < block * block; ++j) {
            value += double{r.mean.pixel(x + j % block, y + j / block)[c]};
            stated += double{r.variance->pixel(x + j % block, y + j / block)[c]} / many;
          }
          if (sum.size() <= at) sum.resize(at + 1), squares.resize(at + 1);
          sum[at] += value;
          squares[at] += value * value;
        }
  }
  double observed = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) observed += (squares[i] - sum[i] * sum[i] / many) / (many - 1);
  std::printf("a splat spans %.2f pixels; blocks vary %.2f times as their pixels' variances say\n", spans,
              observed / stated);
  EXPECT_NEAR(spans, 4 * std::numbers::pi * 0.7 * 0.7, 0.05);
  EXPECT_LT(observed / stated, 1.15 * spans);
  EXPECT_GT(observed / stated, 0.6 * spans);
}

TEST(ptracer, says_when_few_light_paths_arrive_or_none) {
  const auto losses = [](const SceneDescription& scene, int spp) {
    return test::render(scene, "ptracer", job_with(spp)).stats.losses;
  };
  using testing::ElementsAre;
  using testing::HasSubstr;
  SceneDescription floor = test::floor_under_point_light(16);
  EXPECT_THAT(losses(floor, 64), testing::IsEmpty());
  EXPECT_THAT(losses(floor, 4), ElementsAre(HasSubstr("light paths arrived in each of the ")));
  // The view is from within the room and spans 90 degrees across the single column. The outermost of 80 rows show 40^3
  // times less of a wall than the middle ones.
  SceneDescription tall = test::room(24, false);
  tall.sensor.to_world = Transform::look_at({0, 0, 0.5}, {0, 0, 0}, {0, 1, 0});
  auto& camera = std::get<PerspectiveDescription>(tall.sensor.camera);
  camera.fov_degrees = 90;
  camera.near_clip = 1e-6;
  EXPECT_THAT(losses(tall, 64), testing::IsEmpty());
  tall.sensor.film.width = 1;
  tall.sensor.film.height = 80;
  EXPECT_THAT(losses(tall, 64), ElementsAre(HasSubstr("they may be dark by chance")));
  test::add_shape(floor, RectangleDescription{},
                  Transform::translate({0, 100, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(100)),
                  {0});
  std::get<PointLightDescription>(floor.emitters[0].light).position = {0, 1e6, 0};
  EXPECT_THAT(losses(floor, 4), ElementsAre(HasSubstr("no light path arrived where the camera looks")));
}

// A room of radiance 1 is 1 through any filter. Where the filter is too narrow for light paths, a warning must follow.
// The mean has an error of 0.2 %, so that the test detects a loss of 1.5 %.
TEST(ptracer, loses_nothing_to_a_narrow_filter) {
  SceneDescription room;
  ShapeDescription& wall =
      test::add_shape(room, SphereDescription{}, {}, test::add_bsdf(room, DiffuseDescription{RgbD(0.5)}));
  wall.flip_normals = true;
  wall.radiance = RgbD(0.5);
  test::set_camera(room, Transform::look_at({0.2, 0.1, -0.3}, {0.4, -0.2, 1}, {0, 1, 0}), 90, 8);
  for (const char* engine : {"ptracer", "bdpt"})
    for (const double radius : {1.0, 0.6, 0.1, 1e-3, 1e-9}) {
      room.sensor.film.filter = {.kind = ReconstructionFilter::Kind::tent, .radius = radius};
      const test::Rendered r = test::render(room, engine, job_with(1024));
      EXPECT_NEAR(test::image_mean(r.image.mean), 1, 0.01) << engine << " " << radius;
      if (radius >= 0.5)
        EXPECT_THAT(r.stats.losses, testing::IsEmpty());
      else
        EXPECT_THAT(r.stats.losses, testing::ElementsAre(testing::HasSubstr("are spread over 0.5"))) << radius;
    }
}

// Pixels that share light paths or photons vary together. Over 60 seeds the variance of the image's mean is known to
// sqrt(2/59) = 18 %. The test detects an error of 60 % in the stated variance. It also prints the estimate from the
// pixels alone.
TEST(mean_error, is_what_the_spread_over_seeds_shows) {
  constexpr std::uint64_t runs = 60;
  SceneDescription scene = test::room(12, false);
  for (const char* integrator : {"ptracer", "bdpt", "photonmapper"}) {
    double sum = 0, squares = 0, stated = 0, of_pixels = 0;
    for (std::uint64_t seed = 1; seed <= runs; ++seed) {
      RenderJob job = job_with(32, 0, seed);
      job.budget.photons.reset();
      if (integrator == std::string("photonmapper")) job.budget.photons = 2000;
      job.sampler = SamplerKind::independent;
      const Rendering image = test::render(scene, integrator, job).image;
      double mean = 0, variance = 0;
      for (std::size_t i = 0; i < image.mean.rgb.size(); i += 3) {
        mean += double{image.mean.rgb[i]} / static_cast<double>(image.mean.pixels());
        variance += double{image.variance->rgb[i]};
      }
      sum += mean;
      squares += mean * mean;
      of_pixels += variance / std::pow(static_cast<double>(image.mean.pixels()), 2) / runs;
      stated += std::pow(stored_mean_error(image).value().standard_error[0], 2) / runs;
    }
    const double shown = (squares - sum * sum / runs) / (runs - 1.0);
    std::printf("%s: standard error of the mean %.3g %%, stated %.3g %%, by the pixels alone %.3g %%\n", integrator,
                100 * std::sqrt(shown) / (sum / runs), 100 * std::sqrt(stated) / (sum / runs),
                100 * std::sqrt(of_pixels) / (sum / runs));
    EXPECT_NEAR(stated / shown, 1, 0.6) << integrator;
  }
  RenderJob job = job_with(8);
  job.budget.photons.reset();
  EXPECT_FALSE(stored_mean_error(test::render(scene, "path", job).image));  // its pixels are independent
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
