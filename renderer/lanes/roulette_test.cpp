// Roulette in rooms that hardly absorb: a closed room of albedo rho whose walls emit 1 - rho has radiance 1 everywhere
// (L = e / (1 - rho)). The film estimates errors from the samples' spread. Where that is infinite, images are too dark
// and the estimates too small. Any roulette that kills a constant share s does this from rho^2 >= 1 - s on. With a cap
// of 0.95, rho = 0.995 gave 0.65 with an estimated error of 0.06, and 0.9999 gave 0.02 with 0.004.

#include "renderer/lanes/roulette.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <numbers>
#include <string>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_chi_square.h"

namespace photonproof::inline renderer_lanes {
namespace {

using test::job_with;

constexpr int seeds = 12;

/// Renders of different seeds: their mean, and its estimated error. Errors are of the red channel of one pixel, so that
/// nothing is shared.
struct Claimed {
  double mean = 0, error = 0;
  double chi_square = 0;  ///< of the means over seeds against the errors claimed for each
};

Claimed render_seeds(const SceneDescription& scene, const char* integrator, std::int64_t spp, std::int64_t photons) {
  double value[seeds], variance[seeds], sum = 0, sum_of_variances = 0;
  for (int i = 0; i < seeds; ++i) {
    RenderJob job = job_with(spp, photons, 500 + static_cast<std::uint64_t>(i));
    if (photons == 0) job.budget.photons.reset();
    job.sampler = SamplerKind::independent;
    job.threads = 1;
    const Rendering out = test::render(scene, integrator, job).image;
    value[i] = double{out.mean.rgb[0]};
    variance[i] = double{out.variance->rgb[0]};
    sum += value[i];
    sum_of_variances += variance[i];
  }
  Claimed claimed{sum / seeds, std::sqrt(sum_of_variances) / seeds};
  for (int i = 0; i < seeds; ++i) claimed.chi_square += std::pow(value[i] - claimed.mean, 2) / variance[i];
  return claimed;
}

void expect_one(const Claimed& claimed, double most_error, const std::string& what) {
  EXPECT_NEAR(claimed.mean, 1, 4 * claimed.error) << what;
  EXPECT_LT(claimed.error, most_error) << what;
  // The spread over seeds must match the estimate, up to once in a thousand runs on either side.
  const boost::math::chi_squared spread(seeds - 1);
  EXPECT_GT(claimed.chi_square, boost::math::quantile(spread, 0.0005)) << what;
  EXPECT_LT(claimed.chi_square, boost::math::quantile(boost::math::complement(spread, 0.0005))) << what;
}

/// Seen through one pixel. The albedo that the renderer has is the nearest float.
SceneDescription closed_room(double albedo) {
  const auto rounded = static_cast<float>(albedo);
  SceneDescription scene = test::furnace(double{rounded}, 1 - double{rounded}, 1);
  PhotonMapperDescription settings;  // with the limits' defaults, which the other integrators take from it
  settings.global_radius = settings.caustic_radius = 0.3;
  scene.integrator.method = settings;
  return scene;
}

struct Budget {
  const char* integrator;
  double albedo;
  std::int64_t spp, photons;  ///< of each seed
  double most_error;
};
class ClosedRoom : public testing::TestWithParam<Budget> {};

TEST_P(ClosedRoom, is_right_within_the_error_it_claims) {
  const Budget& b = GetParam();
  expect_one(render_seeds(closed_room(b.albedo), b.integrator, b.spp, b.photons), b.most_error,
             b.integrator + std::string(" at albedo ") + std::to_string(b.albedo));
}

// The relative variance of a path is about rho, as roulette.h derives (15 at 0.9999 if its length were cut at that of
// lossless ones). That case leaves out bdpt, which connects each of its thousands of vertices with a light path's.
INSTANTIATE_TEST_SUITE_P(
    roulette, ClosedRoom,
    testing::Values(Budget{"path", 0.5, 512, 0, 0.02}, Budget{"path", 0.9, 512, 0, 0.02},
                    Budget{"path", 0.995, 512, 0, 0.02}, Budget{"path", 0.9999, 96, 0, 0.045},
                    Budget{"volpath", 0.5, 256, 0, 0.02}, Budget{"volpath", 0.9, 256, 0, 0.02},
                    Budget{"volpath", 0.995, 256, 0, 0.02}, Budget{"volpath", 0.9999, 32, 0, 0.1},
                    Budget{"bdpt", 0.5, 256, 0, 0.02}, Budget{"bdpt", 0.9, 256, 0, 0.02},
                    Budget{"bdpt", 0.995, 128, 0, 0.03}, Budget{"ptracer", 0.5, 512, 0, 0.02},
                    Budget{"ptracer", 0.9, 512, 0, 0.02}, Budget{"ptracer", 0.995, 512, 0, 0.02},
                    Budget{"ptracer", 0.9999, 32, 0, 0.1}, Budget{"photonmapper", 0.5, 32, 2000, 0.02},
                    Budget{"photonmapper", 0.9, 32, 2000, 0.02}, Budget{"photonmapper", 0.995, 32, 2000, 0.02},
                    Budget{"photonmapper", 0.9999, 32, 1000, 0.05}),
    [](const auto& test) {
      return test.param.integrator + std::string("_") + std::to_string(static_cast<int>(test.param.albedo * 10000));
    });

TEST(cloud, of_albedo_9999_in_uniform_light_loses_what_its_mean_path_absorbs) {
  // Parallel rays over a ball's whole cross-section meet it as uniform light would, since it looks the same from
  // everywhere. However a body scatters, the mean length of such paths in it is 4 V / S = 4/3 R (Blanco and Fournier
  // 2003). Red, with sigma_a = 10 (1 - 0.9999), then loses sigma_a 4/3 over the disc, pi/4 of the image, less
  // sigma_a <l^2> / (2 <l>) < 0.5 % of that. Blue, not absorbed, loses nothing. Paths continue for a hundred
  // scatterings and more: a share of 0.05 that dies each time makes blue's variance infinite.
  SceneDescription scene;
  HomogeneousDescription cloud{RgbD(10), RgbD{0.9999, 0.9999, 1}, 1, HenyeyGreensteinDescription{0.3}};
  scene.media.push_back({{}, "", cloud});
  ShapeDescription& ball = test::add_shape(scene, SphereDescription{}, {}, test::add_bsdf(scene, NullDescription{}));
  ball.interior = MediumIndex{0};
  scene.emitters.push_back({{}, "", ConstantLightDescription{RgbD(1)}});
  scene.sensor.camera = OrthographicDescription{};
  scene.sensor.to_world = Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0});
  scene.sensor.film.width = scene.sensor.film.height = 8;
  RenderJob job = job_with(1024);
  job.budget.photons.reset();
  job.sampler = SamplerKind::independent;
  const Rendering out = test::render(scene, "volpath", job).image;
  double red = 0, blue = 0, variance = 0;
  for (std::size_t i = 0; i < out.mean.rgb.size(); i += 3) {
    red += double{out.mean.rgb[i]} / 64;
    blue += double{out.mean.rgb[i + 2]} / 64;
    variance += double{out.variance->rgb[i + 2]} / (64 * 64);
  }
  const double error = std::sqrt(variance);
  EXPECT_NEAR(blue, 1, 4 * error);
  EXPECT_LT(error, 0.005);
  const double lost = std::numbers::pi / 4 * 10 * 1e-4 * 4 / 3;
  EXPECT_NEAR(blue - red, lost, 0.05 * lost);
}

/// A lossless ball in a furnace of radiance 2 all around it.
SceneDescription ball_in_furnace(const decltype(BsdfDescription::model)& model) {
  SceneDescription scene = test::furnace(0.5, 1, 8);
  const BsdfIndex bsdf = test::add_bsdf(scene, model);
  test::add_shape(scene, SphereDescription{{0.4, -0.1, 0.4}, 0.3}, {}, bsdf);
  scene.integrator.method = PathDescription{};  // roulette from depth 5 on
  return scene;
}

template <class Model>
SceneDescription furnace_with_index(Model model, double index) {
  model.int_ior = index;
  model.ext_ior = 1;
  return ball_in_furnace(model);
}

TEST(roulette, knows_that_refraction_scales_radiance) {
  // Inside, a camera path's throughput is 1 / ior^2 of its value outside. Roulette that treats this as absorption lets
  // one path in 10^4 live at ior 100, with 10^4 times the weight, which hardly ever shows in an image. Then bdpt was 5
  // % too dark here, and claimed 0.1 %. Plastic needs 1 - R of the interface from inside, 5e-6 at ior 100.
  for (const double ior : {1.0001, 1.5, 10.0, 100.0}) {
    PlasticDescription plastic;
    plastic.diffuse_reflectance = RgbD(1);
    const std::pair<const char*, SceneDescription> cases[] = {
        {"dielectric", furnace_with_index(DielectricDescription{}, ior)},
        {"thin dielectric", furnace_with_index(ThinDielectricDescription{}, ior)},
        {"plastic", furnace_with_index(plastic, ior)}};
    for (const auto& [what, scene] : cases)
      for (const char* integrator : {"path", "volpath", "bdpt"}) {
        RenderJob job = job_with(96);
        job.budget.photons.reset();
        job.sampler = SamplerKind::independent;
        const Rendering out = test::render(scene, integrator, job).image;
        double mean = 0, variance = 0;
        for (std::size_t i = 0; i < out.mean.rgb.size(); i += 3) {
          mean += double{out.mean.rgb[i]} / 64;
          variance += double{out.variance->rgb[i]} / (64 * 64);
        }
        EXPECT_NEAR(mean, 2, 4 * std::sqrt(variance)) << what << " of ior " << ior << " by " << integrator;
        EXPECT_LT(std::sqrt(variance), 0.015) << what << " of ior " << ior << " by " << integrator;
      }
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_lanes
