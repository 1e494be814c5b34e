// Samplers and warps against their densities.

#include "renderer/warp.h"

#include <gtest/gtest.h>

#include "renderer/chi_square.h"

namespace photonproof {
namespace {

TEST(sampler, draws_are_uniform_within_and_across_streams) {
  // 64 cells, one draw from each of 1e5 streams (across), then 1e5 draws of one stream (within).
  std::vector<double> across(64), within(64);
  const std::vector<double> expected(64, 100'000.0 / 64);
  Sampler one(7, Stream::camera, 3, 5);
  for (std::uint64_t i = 0; i < 100'000; ++i) {
    across[static_cast<std::size_t>(64 * Sampler(7, Stream::camera, i, 0).next())] += 1;
    within[static_cast<std::size_t>(64 * one.next())] += 1;
  }
  EXPECT_GT(test::chi_square_p_value(across, expected), test::sidak_level(2));
  EXPECT_GT(test::chi_square_p_value(within, expected), test::sidak_level(2));
}

TEST(sampler, neighbouring_names_are_uncorrelated) {
  // Correlation of n = 1e5 independent uniforms has standard deviation 1/sqrt(n) = 0.0032; five of them bound it.
  const auto correlation = [](auto&& first, auto&& second) {
    double sum = 0;
    constexpr int n = 100'000;
    for (std::uint64_t i = 0; i < n; ++i)
      sum += (static_cast<double>(first(i)) - 0.5) * (static_cast<double>(second(i)) - 0.5);
    return sum / n * 12;
  };
  const auto pixel = [](std::uint64_t i) { return Sampler(1, Stream::camera, i, 0).next(); };
  EXPECT_NEAR(correlation(pixel, [](auto i) { return Sampler(1, Stream::camera, i + 1, 0).next(); }), 0, 0.016);
  EXPECT_NEAR(correlation(pixel, [](auto i) { return Sampler(1, Stream::camera, i, 1).next(); }), 0, 0.016);
  EXPECT_NEAR(correlation(pixel, [](auto i) { return Sampler(2, Stream::camera, i, 0).next(); }), 0, 0.016);
  EXPECT_NEAR(correlation(pixel, [](auto i) { return Sampler(1, Stream::global_photon, i, 0).next(); }), 0, 0.016);
}

TEST(warp, cosine_hemisphere_matches_its_density) {
  EXPECT_GT(test::direction_p_value([](Sampler& s) { return square_to_cosine_hemisphere(s.next2()); },
                                    [](const Vec3f& d) { return cosine_hemisphere_pdf(d.z); }, 11),
            test::sidak_level(4));
}

TEST(warp, sphere_is_uniform) {
  EXPECT_GT(test::direction_p_value([](Sampler& s) { return square_to_sphere(s.next2()); },
                                    [](const Vec3f&) { return 1 / (4 * pi); }, 12),
            test::sidak_level(4));
}

TEST(warp, cone_is_uniform_within_and_empty_outside) {
  // 1 - cos = 0.4 ends on a boundary of the histogram's 20 rows, so that no cell is cut by the cone.
  EXPECT_GT(test::direction_p_value([](Sampler& s) { return square_to_cone(s.next2(), 0.4f); },
                                    [](const Vec3f& d) { return d.z > 0.6f ? 1 / (2 * pi * 0.4f) : 0; }, 13),
            test::sidak_level(4));
}

TEST(warp, a_wrong_density_is_noticed) {
  // The test's own power: uniform hemisphere claimed for cosine-weighted samples.
  EXPECT_LT(test::direction_p_value([](Sampler& s) { return square_to_cosine_hemisphere(s.next2()); },
                                    [](const Vec3f& d) { return d.z > 0 ? 1 / (2 * pi) : 0; }, 14),
            1e-10);
}

TEST(warp, frames_are_orthonormal_and_right_handed_for_any_normal) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Sampler sampler(15, Stream::camera, i, 0);
    Vec3f n = square_to_sphere(sampler.next2());
    if (i == 0) n = {0, 0, -1};
    if (i == 1) n = {0, 0, 1};
    const Frame frame(n);
    EXPECT_NEAR(dot(frame.s, frame.t), 0, 1e-6f);
    EXPECT_NEAR(dot(frame.s, frame.n), 0, 1e-6f);
    EXPECT_NEAR(length(frame.s), 1, 1e-6f);
    EXPECT_NEAR(length(cross(frame.s, frame.t) - frame.n), 0, 1e-6f);
    const Vec3f v = square_to_sphere(sampler.next2());
    EXPECT_NEAR(length(frame.to_world(frame.to_local(v)) - v), 0, 2e-6f);
  }
}

}  // namespace
}  // namespace photonproof
