// The same image by different means. The number of threads does not change a bit of it. Instruction sets, ray tracing
// method and sampler change only rounding and noise.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/integrators/test_scenes.h"

namespace photonproof::inline renderer_integrators {
namespace {

constexpr std::size_t by_embree = 0, by_small_kernel = brute_force_limit;

/// The room with its light out of view, since those few bright pixels would carry most of the mean's noise.
SceneDescription dim_room(int size, bool with_balls, const char* integrator) {
  SceneDescription scene = test::room(size, with_balls);
  if (std::string(integrator) == "path") {
    scene.integrator.method = PathDescription{-1, 5, true};
    return scene;
  }
  PhotonMapperDescription method;
  method.hide_emitters = true;
  method.global_radius = 0.15;  // fixed, since a pilot's radius would make the bias depend on the seed
  method.caustic_radius = 0.05;
  scene.integrator.method = method;
  return scene;
}

struct How {
  std::string isa;
  SamplerKind sampler = SamplerKind::independent;
  std::size_t small_limit = by_small_kernel;
  int threads = 0;
};

Image image_of(const SceneDescription& scene, const char* integrator, const How& how, std::int64_t spp,
               std::uint64_t seed) {
  RenderJob job = test::job_with(spp, 20'000, seed);
  job.isa = how.isa;
  job.sampler = how.sampler;
  job.threads = how.threads;
  return test::render(scene, integrator, job, how.small_limit).image.mean;
}

/// Mean over the image, and its standard error from the spread over renders of different seeds.
struct Estimate {
  double mean, error;
};
Estimate mean_over_seeds(const SceneDescription& scene, const char* integrator, const How& how,
                         std::uint64_t first_seed) {
  constexpr int seeds = 32;
  double sum = 0, squares = 0;
  for (int i = 0; i < seeds; ++i) {
    const double mean =
        test::image_mean(image_of(scene, integrator, how, 32, first_seed + static_cast<std::uint64_t>(i)));
    sum += mean;
    squares += mean * mean;
  }
  const double mean = sum / seeds;
  return {mean, std::sqrt((squares - sum * mean) / (seeds - 1) / seeds)};
}

/// Checks agreement within four standard errors of the difference. For two groups of 32, chance exceeds this once in
/// 7000 times. The standard error must be small as well, so that noise hides no difference.
void expect_same(const Estimate& a, const Estimate& b, const std::string& what) {
  const double error = std::hypot(a.error, b.error);
  EXPECT_LT(std::abs(a.mean - b.mean), 4 * error) << what << ": " << a.mean << " and " << b.mean;
  EXPECT_LT(std::abs(a.mean - b.mean), 0.02 * b.mean) << what << ": " << a.mean << " and " << b.mean;
  EXPECT_LT(error, 0.01 * b.mean) << what;
}

/// Differences between the values of two images: the share of values that differ by more than rounding, and the
/// relative difference of the means.
struct Difference {
  double part_that_differs, of_means;
};
Difference difference(const Image& a, const Image& b) {
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i)
    if (std::abs(a.rgb[i] - b.rgb[i]) > 1e-4f * std::max(a.rgb[i], b.rgb[i])) ++differing;
  const double mean_a = test::image_mean(a), mean_b = test::image_mean(b);
  return {static_cast<double>(differing) / static_cast<double>(a.rgb.size()), std::abs(mean_a / mean_b - 1)};
}

class ImageOf : public testing::TestWithParam<const char*> {};

TEST_P(ImageOf, any_number_of_threads_is_the_same_bits_on_every_instruction_set) {
  for (const std::size_t limit : {by_small_kernel, by_embree}) {
    const SceneDescription scene = test::room(40, true);
    for (const Kernels& kernels : available_kernels()) {
      const auto with_threads = [&](int threads) {
        return image_of(scene, GetParam(), {kernels.isa, SamplerKind::sobol, limit, threads}, 4, 1);
      };
      const Image one = with_threads(1);
      EXPECT_GT(test::image_mean(one), 0);
      for (const int threads : {2, 7}) EXPECT_EQ(one.rgb, with_threads(threads).rgb) << kernels.isa << " " << threads;
    }
  }
}

TEST_P(ImageOf, instruction_sets_agree_at_equal_seeds_but_for_a_few_paths) {
  // Both take the same random numbers. Paths differ by rounding until a choice changes: a lobe, an edge, a roulette.
  // That is rare, and does not shift the mean.
  for (const SamplerKind sampler : {SamplerKind::sobol, SamplerKind::independent}) {
    const SceneDescription scene = dim_room(32, true, GetParam());
    const Image scalar = image_of(scene, GetParam(), {"scalar", sampler}, 16, 3);
    for (const Kernels& kernels : available_kernels()) {
      const Difference d = difference(image_of(scene, GetParam(), {kernels.isa, sampler}, 16, 3), scalar);
      std::printf("%s: %.4f of the values differ, the means by %.2e\n", kernels.isa, d.part_that_differs, d.of_means);
      EXPECT_LT(d.of_means, 1e-4) << kernels.isa;
      EXPECT_LT(d.part_that_differs, 0.01) << kernels.isa;
    }
  }
}

TEST_P(ImageOf, instruction_sets_that_fuse_multiply_and_add_agree_to_the_bit) {
  // v3 and v4 differ only in width: every lane's arithmetic is the same.
  const auto has = [](const char* isa) {
    return std::any_of(available_kernels().begin(), available_kernels().end(),
                       [&](const Kernels& kernels) { return std::string(kernels.isa) == isa; });
  };
  if (!has("v3") || !has("v4")) GTEST_SKIP() << "this processor has one of them at most";
  for (const bool with_balls : {false, true}) {
    const SceneDescription scene = test::room(32, with_balls);
    EXPECT_EQ(image_of(scene, GetParam(), {"v3", SamplerKind::sobol}, 8, 1).rgb,
              image_of(scene, GetParam(), {"v4", SamplerKind::sobol}, 8, 1).rgb);
  }
}

TEST_P(ImageOf, instruction_sets_agree_in_the_mean_of_other_seeds) {
  const SceneDescription scene = dim_room(16, true, GetParam());
  const Estimate scalar = mean_over_seeds(scene, GetParam(), {"scalar"}, 1000);
  std::uint64_t first_seed = 2000;
  for (const Kernels& kernels : available_kernels()) {
    if (std::string(kernels.isa) == "scalar") continue;
    expect_same(mean_over_seeds(scene, GetParam(), {kernels.isa}, first_seed), scalar, kernels.isa);
    first_seed += 1000;
  }
}

TEST_P(ImageOf, a_small_scenes_kernel_agrees_with_embree) {
  for (const bool with_balls : {false, true}) {
    const SceneDescription scene = dim_room(32, with_balls, GetParam());
    const How small{"", SamplerKind::independent, by_small_kernel}, embree{"", SamplerKind::independent, by_embree};
    const Difference d =
        difference(image_of(scene, GetParam(), small, 16, 5), image_of(scene, GetParam(), embree, 16, 5));
    std::printf("%.4f of the values differ, the means by %.2e\n", d.part_that_differs, d.of_means);
    EXPECT_LT(d.of_means, 1e-4);
    EXPECT_LT(d.part_that_differs, 0.01);
    const SceneDescription tile = dim_room(16, with_balls, GetParam());
    expect_same(mean_over_seeds(tile, GetParam(), small, 1), mean_over_seeds(tile, GetParam(), embree, 500),
                with_balls ? "with balls" : "without");
  }
}

TEST_P(ImageOf, samplers_agree_in_the_mean) {
  for (const bool with_balls : {false, true}) {
    const SceneDescription scene = dim_room(16, with_balls, GetParam());
    const Estimate sobol = mean_over_seeds(scene, GetParam(), {"", SamplerKind::sobol}, 1);
    const Estimate independent = mean_over_seeds(scene, GetParam(), {"", SamplerKind::independent}, 1000);
    expect_same(sobol, independent, with_balls ? "with balls" : "without");
    std::printf("standard errors: sobol %.2e, independent %.2e\n", sobol.error, independent.error);
  }
}

INSTANTIATE_TEST_SUITE_P(image, ImageOf, testing::Values("path", "photonmapper"),
                         [](const auto& integrator) { return std::string(integrator.param); });

}  // namespace
}  // namespace photonproof::inline renderer_integrators
