// Warps compared with their densities.

#include "renderer/lanes/warp.h"

#include <gtest/gtest.h>

#include "renderer/lanes/test_chi_square.h"

namespace photonproof::inline renderer_lanes {
namespace {

TEST(warp, cosine_hemisphere_matches_its_density) {
  EXPECT_GT(test::direction_p_value([](test::Random& s) { return square_to_cosine_hemisphere(s.next2()); },
                                    [](const Vec3f& d) { return cosine_hemisphere_pdf(d.z); }, 11),
            test::sidak_level(4));
}

TEST(warp, sphere_is_uniform) {
  EXPECT_GT(test::direction_p_value([](test::Random& s) { return square_to_sphere(s.next2()); },
                                    [](const Vec3f&) { return 1 / (4 * pi); }, 12),
            test::sidak_level(4));
}

TEST(warp, cone_is_uniform_within_and_empty_outside) {
  // 1 - cos = 0.4 ends on a boundary of the histogram's 20 rows, so that no cell is cut by the cone.
  EXPECT_GT(test::direction_p_value([](test::Random& s) { return square_to_cone(s.next2(), 0.4f); },
                                    [](const Vec3f& d) { return d.z > 0.6f ? 1 / (2 * pi * 0.4f) : 0; }, 13),
            test::sidak_level(4));
}

TEST(warp, a_wrong_density_is_noticed) {
  // The test's own power: uniform hemisphere claimed for cosine-weighted samples.
  EXPECT_LT(test::direction_p_value([](test::Random& s) { return square_to_cosine_hemisphere(s.next2()); },
                                    [](const Vec3f& d) { return d.z > 0 ? 1 / (2 * pi) : 0; }, 14),
            1e-10);
}

TEST(warp, frames_are_orthonormal_and_right_handed_for_any_normal) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    test::Random random(15, i);
    Vec3f n = square_to_sphere(random.next2());
    if (i == 0) n = {0, 0, -1};
    if (i == 1) n = {0, 0, 1};
    const Frame<float> frame(n);
    EXPECT_NEAR(dot(frame.s, frame.t), 0, 1e-6f);
    EXPECT_NEAR(dot(frame.s, frame.n), 0, 1e-6f);
    EXPECT_NEAR(length(frame.s), 1, 1e-6f);
    EXPECT_NEAR(length(cross(frame.s, frame.t) - frame.n), 0, 1e-6f);
    const Vec3f v = square_to_sphere(random.next2());
    EXPECT_NEAR(length(frame.to_world(frame.to_local(v)) - v), 0, 2e-6f);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_lanes
