// The areas that gathers on ellipsoids divide by, compared with spheres and with counting.
#include "renderer/areas/ellipsoid_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/photons/surface_side.h"
#include "renderer/shapes/sphere.h"

namespace photonproof::inline renderer_areas {
namespace {

Ellipsoids::Place ball(const Vec3f& center, float radius) {
  const float inverse = 1 / radius;
  return {center, {Vec3f(inverse, 0, 0), Vec3f(0, inverse, 0), Vec3f(0, 0, inverse)}, 1};
}

Ellipsoids with(std::vector<Ellipsoids::Place> places) {
  Ellipsoids made;
  made.places = std::move(places);
  return made;
}

TEST(ellipsoid_area, of_a_ball_is_the_spheres) {
  Ellipsoids::Place place = ball({1, 2, 3}, 0.25f);
  place.reach = 2;
  const Ellipsoids one = with({place});
  const EllipsoidArea area(one);
  const Sphere sphere{{1, 2, 3}, 0.5, false};
  for (const float radius : {0.01f, 0.1f, 0.2f, 0.5f, 2.0f}) {
    const double expected = double{disc_area(sphere, {1.5f, 2, 3}, radius)};
    EXPECT_NEAR(area.within({1.5f, 2, 3}, {1, 0, 0}, radius), expected, 1e-3 * expected) << radius;
  }
}

// Counts points of the unit sphere, each with the area of its image under the map with axes 1, 0.5 and 0.3.
TEST(ellipsoid_area, of_a_stretched_one_is_the_area_that_counting_finds) {
  const Vec3d axes{1, 0.5, 0.3};
  const Ellipsoids one =
      with({{{0, 0, 0}, {Vec3f(1, 0, 0), Vec3f(0, 2, 0), Vec3f(0, 0, static_cast<float>(1 / 0.3))}, 1}});
  const EllipsoidArea area(one);
  const Vec3d unit = normalize(Vec3d{0.5, 0.6, 0.7});
  const Vec3d p = unit * axes, normal = normalize(unit / axes);
  for (const double radius : {0.05, 0.3}) {
    double counted = 0;
    constexpr int points = 4'000'000;
    for (int i = 0; i < points; ++i) {
      test::Random random(7, static_cast<std::uint64_t>(i));
      const Vec3d u(square_to_sphere(random.next2()));
      const Vec3d g = u / axes, offset = u * axes - p;
      if (dot(offset, offset) > radius * radius || std::abs(dot(offset, normal)) > double{sheet_height} * radius)
        continue;
      if (dot(g, normal) < double{least_side_cosine} * length(g)) continue;
      counted += length(g);
    }
    counted *= axes.x * axes.y * axes.z * 4 * std::numbers::pi / points;
    const double found = area.within(Vec3f(p), Vec3f(normal), static_cast<float>(radius));
    EXPECT_NEAR(found, counted, (radius < 0.1 ? 0.025 : 0.006) * counted) << radius;  // five standard errors
  }
}

// Two equal balls side by side: each has the height, normals and distance that the other's points need.
TEST(ellipsoid_area, counts_neighbours_in_the_radius) {
  const Ellipsoids two = with({ball({0, 0, 0}, 1), ball({0.4f, 0, 0}, 1)}), one = with({ball({0, 0, 0}, 1)});
  const EllipsoidArea both(two), single(one);
  const double of_one = single.within({0, 0, 1}, {0, 0, 1}, 0.5f);
  EXPECT_NEAR(of_one, double{disc_area(Sphere{{0, 0, 0}, 1, false}, {0, 0, 1}, 0.5f)}, 1e-3);
  double counted = 0;
  constexpr int points = 1'000'000;
  for (int i = 0; i < points; ++i) {
    test::Random random(8, static_cast<std::uint64_t>(i));
    const Vec3f u = square_to_sphere(random.next2());
    const Vec3f offset = u + Vec3f(0.4f, 0, -1);
    if (dot(offset, offset) <= 0.25f && std::abs(offset.z) <= sheet_height * 0.5f && u.z >= least_side_cosine)
      ++counted;
  }
  counted *= 4 * std::numbers::pi / points;
  EXPECT_NEAR(both.within({0, 0, 1}, {0, 0, 1}, 0.5f) - of_one, counted, 0.03 * counted);
  EXPECT_EQ(both.within({0, 9, 0}, {0, 1, 0}, 0.5f), 0);
}

// A small stretched ellipsoid near the gather's point counts where its normals agree. The area sums 256 points, of
// which some hundred lie there: three more or less at the edge are 3 %.
TEST(ellipsoid_area, counts_a_small_neighbour_by_its_own_points) {
  const Vec3d axes{0.02, 0.01, 0.006};
  const auto inverse = [](double axis) { return static_cast<float>(1 / axis); };
  const Ellipsoids one =
      with({{{0.1f, 0.05f, -0.01f},
             {Vec3f(inverse(axes.x), 0, 0), Vec3f(0, inverse(axes.y), 0), Vec3f(0, 0, inverse(axes.z))},
             1}});
  double counted = 0;
  constexpr int points = 1'000'000;
  for (int i = 0; i < points; ++i) {
    test::Random random(9, static_cast<std::uint64_t>(i));
    const Vec3d g = Vec3d(square_to_sphere(random.next2())) / axes;
    if (g.z >= double{least_side_cosine} * length(g)) counted += length(g);
  }
  counted *= axes.x * axes.y * axes.z * 4 * std::numbers::pi / points;
  EXPECT_NEAR(EllipsoidArea(one).within({0, 0, 0}, {0, 0, 1}, 0.5f), counted, 0.04 * counted);
}

}  // namespace
}  // namespace photonproof::inline renderer_areas
