// Grids of signed distances: a plane is exact, a ball is one within the interpolation's error.
#include "renderer/shapes/sdf_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/shapes/local_geometry.h"
#include "renderer/shapes/shape_place.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_shapes {
namespace {

using Distance = std::function<double(const Vec3d&)>;

std::shared_ptr<const VolumeGrid> sampled(int width, int height, int depth, const Distance& distance) {
  auto grid = std::make_shared<VolumeGrid>();
  grid->width = width;
  grid->height = height;
  grid->depth = depth;
  for (int z = 0; z < depth; ++z)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        grid->values.push_back(
            static_cast<float>(distance({static_cast<double>(x) / (width - 1), static_cast<double>(y) / (height - 1),
                                         static_cast<double>(z) / (depth - 1)})));
  return grid;
}

SdfGrid placed_grid(std::shared_ptr<const VolumeGrid> grid, const Transform& to_world = {}, bool flip = false,
                    SdfGridDescription::Normals normals = SdfGridDescription::Normals::smooth) {
  const SceneDescription scene;
  ShapeDescription shape;
  shape.flip_normals = flip;
  SdfGridDescription description;
  description.grid = std::move(grid);
  description.normals = normals;
  return placed(description, ShapePlace{scene, shape, to_world}).shape;
}

double ball(const Vec3d& p) { return length(p - Vec3d(0.5)) - 0.35; }

template <class Visit>
void for_random_rays(int count, Visit&& visit) {
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    test::Random random(89, i);
    const Vec3d from = Vec3d(0.5) + Vec3d(square_to_sphere(random.next2())) * 2.0;
    const Vec3d to = Vec3d(0.5) + Vec3d(square_to_sphere(random.next2())) * 0.6;
    visit(from, normalize(to - from));
  }
}

TEST(sdf_grid, of_a_plane_is_that_plane) {
  const Vec3d normal = normalize(Vec3d(1, 2, -0.5));
  const double offset = 0.7;
  const auto grid = sampled(5, 4, 7, [&](const Vec3d& p) { return dot(p, normal) - offset; });
  for (const bool flip : {false, true}) {
    const SdfGrid sdf = placed_grid(grid, {}, flip);
    int hits = 0;
    for_random_rays(4000, [&](const Vec3d& origin, const Vec3d& direction) {
      const double t = (offset - dot(origin, normal)) / dot(direction, normal);
      const Vec3d p = origin + direction * t;
      const double inside = std::min({p.x, p.y, p.z, 1 - p.x, 1 - p.y, 1 - p.z});
      if (std::abs(inside) < 1e-4) return;
      const double met = hit_distance(sdf, {origin, direction, 0, 100});
      ASSERT_EQ(met >= 0, inside > 0 && t > 0) << p.x << ' ' << p.y << ' ' << p.z;
      if (met < 0) return;
      ++hits;
      EXPECT_NEAR(met, t, 1e-6 * t / std::abs(dot(direction, normal)));
      const ShapePoint point = point_on(sdf, origin + direction * met);
      const Vec3d front = flip ? -normal : normal;
      EXPECT_LT(length(Vec3d(point.normal) - front), 1e-5);
      EXPECT_LT(length(Vec3d(point.p) - p), 1e-5);
      const LocalGeometry local = local_geometry(sdf, AffineMap(), point.p, point.normal);
      EXPECT_LT(length(Vec3d(local.normal) - front), 1e-5);
      EXPECT_EQ(hit_distance(sdf, {origin, direction, 0, met * 0.999}), shape_missed);
    });
    EXPECT_GT(hits, 500);
  }
}

// Interpolation between samples h apart errs by h^2 / 8 of second derivatives: those of a distance are up to 1 / r
// along two directions, together h^2 / 4r. Its gradient errs by h / 2r along each of them.
TEST(sdf_grid, of_a_ball_is_one_within_the_interpolations_error) {
  constexpr int samples = 65;
  const double h = 1.0 / (samples - 1), off = h * h / 4 / 0.3;
  const auto grid = sampled(samples, samples, samples, ball);
  const SdfGrid smooth = placed_grid(grid),
                analytic = placed_grid(grid, {}, false, SdfGridDescription::Normals::analytic);
  int hits = 0;
  for_random_rays(4000, [&](const Vec3d& origin, const Vec3d& direction) {
    const Vec3d nearest = origin + direction * dot(Vec3d(0.5) - origin, direction);
    if (std::abs(ball(nearest)) < 2 * off) return;  // the silhouette
    const double met = hit_distance(smooth, {origin, direction, 0, 100});
    ASSERT_EQ(met >= 0, ball(nearest) < 0);
    if (met < 0) return;
    ++hits;
    const ShapePoint point = point_on(smooth, origin + direction * met);
    EXPECT_LT(std::abs(ball(Vec3d(point.p))), off);
    const Vec3d out = normalize(Vec3d(point.p) - Vec3d(0.5));
    EXPECT_LT(dot(point.normal, Vec3f(direction)), 0.02);
    EXPECT_LT(length(Vec3d(point.normal) - out), h / 0.35);
    EXPECT_EQ(local_geometry(analytic, AffineMap(), point.p, point.normal).normal, point.normal);
    EXPECT_LT(length(Vec3d(local_geometry(smooth, AffineMap(), point.p, point.normal).normal) - out), 0.3 * h / 0.35);
  });
  EXPECT_GT(hits, 500);
}

TEST(sdf_grid, is_met_first_where_its_values_first_are_zero) {
  const auto noise = sampled(6, 7, 5, [](const Vec3d& p) {
    return std::sin(40 * p.x + 3) * std::cos(35 * p.y) + std::sin(31 * p.z + p.x * 9) * 0.7;
  });
  const SdfGrid sdf = placed_grid(noise);
  // Trilinear interpolation, written out.
  const auto value = [&](const Vec3d& p) {
    const double x = p.x * 5, y = p.y * 6, z = p.z * 4;
    const int i = std::clamp(static_cast<int>(x), 0, 4), j = std::clamp(static_cast<int>(y), 0, 5),
              k = std::clamp(static_cast<int>(z), 0, 3);
    double sum = 0;
    for (int c = 0; c < 8; ++c) {
      const int a = c & 1, b = c >> 1 & 1, d = c >> 2;
      const double weight = (a != 0 ? x - i : 1 - x + i) * (b != 0 ? y - j : 1 - y + j) * (d != 0 ? z - k : 1 - z + k);
      sum += weight * double{noise->values[static_cast<std::size_t>(((k + d) * 7 + j + b) * 6 + i + a)]};
    }
    return sum;
  };
  int hits = 0;
  for_random_rays(1500, [&](const Vec3d& origin, const Vec3d& direction) {
    double expected = -1, before = 0;
    for (int step = 0; step < 40000 && expected < 0; ++step) {
      const double t = 0.5 + step * 1e-4;
      const Vec3d p = origin + direction * t;
      const bool inside = std::min({p.x, p.y, p.z, 1 - p.x, 1 - p.y, 1 - p.z}) >= 0;
      const double f = inside ? value(p) : 0;
      if (f * before < 0) expected = t;
      before = f;
    }
    const double met = hit_distance(sdf, {origin, direction, 0, 100});
    if (expected < 0 && met < 0) return;
    // Where the ray only touches the surface, or leaves the cube at it, steps miss what is there.
    if (expected < 0 || met < expected - 2e-4) {
      EXPECT_LT(std::abs(value(origin + direction * met)), 1e-3);
      return;
    }
    ++hits;
    EXPECT_NEAR(met, expected, 2e-4);
  });
  EXPECT_GT(hits, 500);
}

TEST(sdf_grid, is_met_by_rays_along_its_axes_and_edges_and_from_inside) {
  const SdfGrid sdf = placed_grid(sampled(9, 9, 9, ball));
  for (const Vec3d& direction : {Vec3d(1, 0, 0), Vec3d(0, 1, 0), Vec3d(0, 0, 1), Vec3d(-1, 0, 0), Vec3d(0, 0, -1)}) {
    EXPECT_NEAR(hit_distance(sdf, {Vec3d(0.5) - direction * 2.0, direction, 0, 100}), 1.65, 0.01);
    EXPECT_NEAR(hit_distance(sdf, {Vec3d(0.5), direction, 0, 100}), 0.35, 0.01);
  }
  EXPECT_EQ(hit_distance(sdf, {{-1, 0, 0}, {1, 0, 0}, 0, 100}), shape_missed);
  EXPECT_EQ(hit_distance(sdf, {{-1, 1.5, 0.5}, {1, 0, 0}, 0, 100}), shape_missed);
  EXPECT_EQ(hit_distance(sdf, {{2, 0.5, 0.5}, {1, 0, 0}, 0, 100}), shape_missed);
}

TEST(sdf_grid, is_turned_and_stretched_with_normals_by_the_inverse_transpose) {
  const Transform to_world =
      Transform::translate({3, -2, 5}) * Transform::rotate({1, 1, 0}, 50) * Transform::scale({2, 1, -0.5});
  const SdfGrid sdf = placed_grid(sampled(65, 65, 65, ball), to_world);
  const Transform back = *to_world.inverse();
  int hits = 0;
  for_random_rays(500, [&](const Vec3d& origin, const Vec3d& direction) {
    const ShapeRay ray{to_world.point(origin), to_world.vector(direction), 0, 100};
    const double met = hit_distance(sdf, ray);
    if (met < 0) return;
    ++hits;
    const ShapePoint point = point_on(sdf, ray.origin + ray.direction * met);
    const Vec3d out = normalize(back.point(Vec3d(point.p)) - Vec3d(0.5)), n(point.normal);
    // The normal is across the images of directions across `out`.
    const Tangents across = any_tangents(Vec3f(out));
    for (const Vec3f& tangent : {across.s, across.t})
      EXPECT_LT(std::abs(dot(normalize(to_world.vector(Vec3d(tangent))), n)), 0.1);
    EXPECT_GT(dot(to_world.vector(out), n), 0);
  });
  EXPECT_GT(hits, 50);
}

TEST(sdf_grid, has_the_areas_of_what_it_is) {
  const SdfGrid flat = placed_grid(sampled(4, 4, 4, [](const Vec3d& p) { return p.z - 0.4; }));
  EXPECT_NEAR(disc_area(flat, {0.5f, 0.5f, 0.4f}, 0.2f), std::numbers::pi * 0.04, 1e-5);
  const SdfGrid round = placed_grid(sampled(65, 65, 65, ball));
  const Sphere sphere{{0.5, 0.5, 0.5}, 0.35, false};
  for (const float radius : {0.02f, 0.1f, 0.14f})
    for (const Vec3f& out : {Vec3f(0, 0, 1), Vec3f(0.6f, 0, -0.8f), Vec3f(0.48f, 0.64f, 0.6f)}) {
      const Vec3f p = Vec3f(0.5f) + out * 0.35f;
      const float expected = disc_area(sphere, p, radius);
      EXPECT_NEAR(disc_area(round, p, radius), expected, 0.005f * expected) << radius;
    }
}

}  // namespace
}  // namespace photonproof::inline renderer_shapes
