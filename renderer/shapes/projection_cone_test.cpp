// The directions in a cone, from balls so near that they fill the view to balls that are 1e-6 of it.
#include "renderer/shapes/projection_cone.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_shapes {
namespace {

TEST(projection_cone, holds_what_is_drawn_in_it_and_little_else_however_narrow_it_is) {
  for (double distance = 2; distance < 1e7; distance *= 5) {
    SCOPED_TRACE(distance);
    const double angle = std::asin(1 / distance);
    int lost = 0, strays = 0;
    for (std::uint64_t i = 0; i < 5000; ++i) {
      test::Random random(58, i);
      const Vec3f p = square_to_sphere(random.next2()) * 3.0f;
      const Vec3f away = square_to_sphere(random.next2());
      const ProjectionCone<float> cone = cone_towards<float>(p + away * static_cast<float>(distance), 1, p);
      const Frame<float> frame(cone.axis);
      lost += cone.holds(normalize(frame.to_world(square_to_cone(random.next2(), cone.one_minus_cos)))) ? 0 : 1;
      // A twentieth of the angle outside, plus the rounding error.
      const double wide = 1.05 * angle + 1e-6, turn = 6.28 * double{random.next()};
      const Vec3d outside{std::sin(wide) * std::cos(turn), std::sin(wide) * std::sin(turn), std::cos(wide)};
      strays += cone.holds(normalize(frame.to_world(Vec3f(outside)))) ? 1 : 0;
    }
    EXPECT_EQ(lost, 0);
    EXPECT_EQ(strays, 0);
  }
}

TEST(projection_cone, holds_every_direction_from_within_the_ball) {
  const ProjectionCone<float> cone = cone_towards<float>({0, 0, 0.5f}, 1, {0, 0, 0});
  for (std::uint64_t i = 0; i < 1000; ++i) {
    test::Random random(59, i);
    EXPECT_TRUE(cone.holds(square_to_sphere(random.next2())));
  }
  EXPECT_TRUE(cone.holds(-cone.axis));
}

}  // namespace
}  // namespace photonproof::inline renderer_shapes
