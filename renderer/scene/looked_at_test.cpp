#include "renderer/scene/looked_at.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/test_compiled.h"

namespace photonproof::inline renderer_scene {
namespace {

TEST(looked_at, balls_hold_what_is_seen_straight_and_at_a_slant) {
  for (const double height : {5.0, 1.0, 0.3}) {
    SceneDescription d = test::floor_under_point_light(48);
    test::set_camera(d, Transform::look_at({0, height, 3}, {0, 0, 0}, {0, 1, 0.01}), 20, 48);
    const Scene scene = test::compiled(d, 48, 48);
    const std::vector<ProjectionTarget> balls = looked_at(scene);
    const std::vector<Vec3f> points = points_looked_at(scene, 40);
    ASSERT_GT(points.size(), 1000u);
    const auto held = std::count_if(points.begin(), points.end(), [&](const Vec3f& p) {
      return std::any_of(balls.begin(), balls.end(),
                         [&](const ProjectionTarget& ball) { return length(p - ball.center) <= ball.radius; });
    });
    EXPECT_GT(static_cast<double>(held), 0.95 * static_cast<double>(points.size())) << height;
    // And little else: the widest ball is no larger than the visible part.
    Vec3f low = points[0], high = points[0];
    for (const Vec3f& p : points) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    for (const ProjectionTarget& ball : balls) EXPECT_LT(ball.radius, 0.5f * length(high - low)) << height;
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
