// Ellipsoids and their shells as rays meet them: placed unit balls in closed form, the outside alone, and all entries
// of a ray in their order.
#include "renderer/shapes/ellipsoids.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/rays/rays.h"

namespace photonproof::inline renderer_rays {
namespace {

using test::Random;

/// Ellipsoids of random places, turns and sizes within a ball of radius 1.
std::shared_ptr<EllipsoidCloud> random_cloud(std::size_t count, std::uint64_t seed) {
  auto cloud = std::make_shared<EllipsoidCloud>();
  for (std::size_t i = 0; i < count; ++i) {
    Random random(seed, i);
    Ellipsoid e;
    e.center = square_to_sphere(random.next2()) * std::cbrt(random.next());
    const auto size = [&] { return 0.01f + 0.07f * random.next(); };
    e.scale = {size(), size(), size()};
    const Vec3f axis = square_to_sphere(random.next2());
    const float half = pi * random.next();
    const Vec3f xyz = axis * std::sin(half);
    e.turn = {xyz.x, xyz.y, xyz.z, std::cos(half)};
    cloud->ellipsoids.push_back(e);
    cloud->opacities.push_back(random.next());
  }
  return cloud;
}

EllipsoidsDescription description_of(std::shared_ptr<const EllipsoidCloud> cloud, bool triangles = false) {
  EllipsoidsDescription d;
  d.filename = "a.ply";
  d.cloud = std::move(cloud);
  d.triangles = triangles;
  return d;
}

SceneDescription scene_with(const EllipsoidsDescription& d, const Transform& to_world = {}) {
  SceneDescription scene;
  test::add_shape(scene, d, to_world, test::add_bsdf(scene, DiffuseDescription{}));
  test::set_camera(scene, Transform::look_at({0, 0, 5}, {0, 0, 0}, {0, 1, 0}), 40, 4);
  return scene;
}

/// v turned by a unit quaternion, by its product with v and the conjugate.
Vec3d turned(const std::array<float, 4>& q, const Vec3d& v) {
  const Vec3d u{double{q[0]}, double{q[1]}, double{q[2]}};
  const Vec3d t = cross(u, v) * 2.0;
  return v + t * double{q[3]} + cross(u, t);
}

/// Where a line enters the image of an ellipsoid under an affine map, or a negative value; solved among the images of
/// the unit ball's points.
double enters(const Ellipsoid& e, double reach, const Transform& map, const Vec3d& origin, const Vec3d& direction) {
  const Transform back = *map.inverse();
  const auto to_unit = [&](const Vec3d& v) {
    const std::array<float, 4> inverse{-e.turn[0], -e.turn[1], -e.turn[2], e.turn[3]};
    return turned(inverse, v) / (Vec3d(e.scale) * reach);
  };
  const Vec3d o = to_unit(back.point(origin) - Vec3d(e.center)), d = to_unit(back.vector(direction));
  const double a = dot(d, d), b = dot(o, d), c = dot(o, o) - 1, discriminant = b * b - a * c;
  return discriminant > 0 && c > 0 ? (-b - std::sqrt(discriminant)) / a : -1;
}

template <class Visit>
void for_random_rays(int count, Visit&& visit) {
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    Random random(83, i);
    const Vec3f from = square_to_sphere(random.next2()) * 3.0f;
    visit(from, normalize(square_to_sphere(random.next2()) * 0.8f - from));
  }
}

std::vector<CloudEntry> entries_of(const Scene& scene, const Vec3f& origin, const Vec3f& direction) {
  std::vector<CloudEntry> all;
  CloudEntries entries;
  do {
    scene.view().tracer->take_entries(origin, direction, entries);
    all.insert(all.end(), entries.found().begin(), entries.found().end());
  } while (entries.advance());
  return all;
}

// A to_world that turns, mirrors, moves and scales evenly by 1.5 is exact for ellipsoids.
TEST(ellipsoids, are_entered_in_order_where_their_closed_form_says) {
  const auto cloud = random_cloud(2000, 1);
  const Transform to_world =
      Transform::translate({3, -2, 7}) * Transform::rotate({1, 2, 3}, 70) * Transform::scale({-1.5, 1.5, 1.5});
  for (const bool adapts : {false, true}) {
    EllipsoidsDescription d = description_of(cloud);
    d.extent = 1.2;
    d.adapts_extent = adapts;
    const SceneDescription description = scene_with(d, to_world);
    const Scene scene = test::compiled(description, 4, 4);
    std::size_t found = 0;
    for_random_rays(300, [&](const Vec3f& from, const Vec3f& along) {
      const Vec3d origin = to_world.point(Vec3d(from)), direction = normalize(to_world.vector(Vec3d(along)));
      std::vector<std::pair<double, std::uint32_t>> expected;
      for (std::uint32_t i = 0; i < cloud->ellipsoids.size(); ++i) {
        const double t = enters(cloud->ellipsoids[i], d.reach(i), to_world, origin, direction);
        if (d.reach(i) > 0 && t > 0) expected.emplace_back(t, i);
      }
      std::ranges::sort(expected);
      const Vec3f local(origin + scene.frame.moved);
      const std::vector<CloudEntry> all = entries_of(scene, local, Vec3f(direction));
      // An entry at the silhouette may be there or not.
      ASSERT_NEAR(static_cast<double>(all.size()), static_cast<double>(expected.size()), 1);
      if (all.size() != expected.size()) return;
      found += all.size();
      for (std::size_t i = 0; i < all.size(); ++i) EXPECT_NEAR(double{all[i].t}, expected[i].first, 2e-4);
      ASSERT_TRUE(std::ranges::is_sorted(all));
      const Hit first = scene.intersect(local, Vec3f(direction));
      ASSERT_EQ(first.valid(), !all.empty());
      if (all.empty()) return;
      EXPECT_LT(length(first.p_world - (local + Vec3f(direction) * all[0].t)), 1e-4f);
      EXPECT_LT(dot(first.normal, Vec3f(direction)), 1e-3f);
    });
    EXPECT_GT(found, 1500u);
  }
}

// The gradient of |to_unit(p)|^2 by differences.
TEST(ellipsoids, have_the_normal_of_their_surface_also_in_instances_that_stretch) {
  const auto cloud = random_cloud(1, 5);
  const Transform stretch = Transform::rotate({0, 1, 1}, 30) * Transform::scale({1, 3, 0.5});
  const EllipsoidsDescription d = description_of(cloud);
  SceneDescription description = scene_with(d);
  ShapeGroupDescription group;
  group.shapes.push_back(description.shapes.back());
  description.groups.push_back(group);
  description.shapes.clear();
  test::add_shape(description, InstanceDescription{{0}}, stretch, {0});
  const Scene scene = test::compiled(description, 4, 4);
  const Ellipsoid& e = cloud->ellipsoids[0];
  const Vec3d center = stretch.point(Vec3d(e.center));
  int hits = 0;
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(9, i);
    const Vec3d origin = center + Vec3d(square_to_sphere(random.next2())) * 4.0;
    const Vec3d direction = normalize(center + Vec3d(square_to_sphere(random.next2())) * 0.05 - origin);
    const double t = enters(e, 3, stretch, origin, direction);
    const Hit hit = scene.intersect(Vec3f(origin + scene.frame.moved), Vec3f(direction));
    ASSERT_EQ(hit.valid(), t > 0);
    if (!hit.valid()) continue;
    ++hits;
    const Vec3d p = origin + direction * t;
    EXPECT_LT(length(Vec3d(hit.p_world) - scene.frame.moved - p), 1e-5);
    const auto value = [&](const Vec3d& q) {  // how far in a ray from outside enters, as a level set
      const Vec3d u = stretch.inverse()->point(q) - Vec3d(e.center);
      const Vec3d v = turned({-e.turn[0], -e.turn[1], -e.turn[2], e.turn[3]}, u) / Vec3d(e.scale);
      return dot(v, v);
    };
    const double h = 1e-5;
    const Vec3d gradient{value(p + Vec3d{h, 0, 0}) - value(p - Vec3d{h, 0, 0}),
                         value(p + Vec3d{0, h, 0}) - value(p - Vec3d{0, h, 0}),
                         value(p + Vec3d{0, 0, h}) - value(p - Vec3d{0, 0, h})};
    EXPECT_LT(length(Vec3d(hit.normal) - normalize(gradient)), 1e-4);
  }
  EXPECT_GT(hits, 100);
}

TEST(ellipsoids, turn_their_normals_inward_where_normals_are_flipped) {
  const EllipsoidsDescription d = description_of(random_cloud(3, 6));
  const PlacedEllipsoids placed(d, {});
  const Ellipsoids out = compiled_ellipsoids(d, placed, false), in = compiled_ellipsoids(d, placed, true);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d near = Vec3d(out.places[i].center) + Vec3d{0.1, 0.2, -0.1};
    const ShapePoint a = point_on(out, i, near), b = point_on(in, i, near);
    EXPECT_EQ(a.p, b.p);
    EXPECT_EQ(a.normal, -b.normal);
    EXPECT_GT(dot(a.normal, Vec3f(0.1f, 0.2f, -0.1f)), 0) << "away from the centre";
  }
}

TEST(ellipsoids, and_shells_pass_rays_from_inside) {
  auto cloud = std::make_shared<EllipsoidCloud>();
  cloud->ellipsoids.push_back({{0, 0, 0}, {0.1f, 0.2f, 0.3f}});
  for (const bool triangles : {false, true}) {
    EllipsoidsDescription d = description_of(cloud, triangles);
    const SceneDescription description = scene_with(d);
    const Scene scene = test::compiled(description, 4, 4);
    EXPECT_FALSE(scene.view().small);
    EXPECT_FALSE(scene.intersect({0, 0, 0}, {0, 0, 1}).valid());
    EXPECT_FALSE(scene.intersect({0.05f, 0.1f, 0}, {1, 0, 0}).valid());
    const Hit hit = scene.intersect({0, 0, 4}, {0, 0, -1});
    ASSERT_TRUE(hit.valid());
    EXPECT_GE(hit.p_world.z, 0.9f - 1e-6f);
    EXPECT_LT(hit.p_world.z, triangles ? 1.3f : 0.9f + 1e-6f);
    EXPECT_GT(hit.normal.z, triangles ? 0.5f : 1 - 1e-6f);
    const auto blocked = [&](const Vec3f& from, const Vec3f& way) {
      return occluded<float>(scene.view(), from, way, no_index, no_index, true);
    };
    EXPECT_FALSE(blocked({0, 0, 0}, {0, 0, 4}));
    EXPECT_TRUE(blocked({0, 0, 4}, {0, 0, -4}));
    EXPECT_FALSE(blocked({0, 0, 4}, {0, 0, -2.7f}));
    EXPECT_TRUE(entries_of(scene, {0, 0, 0}, {0, 0, 1}).empty());
    EXPECT_EQ(entries_of(scene, {0, 0, 4}, {0, 0, -1}).size(), 1u);
  }
}

// A shell of 20 triangles contains its ellipsoid's ball up to the edges of its faces. Rays towards the middle enter it.
TEST(ellipsoids, of_shells_are_entered_once_each_also_on_edges) {
  const auto cloud = random_cloud(500, 2);
  for (const Shell shell : {Shell::ico_sphere, Shell::box, Shell::uv_sphere}) {
    EllipsoidsDescription d = description_of(cloud, true);
    d.shell = shell;
    d.extent = 1;
    for (const Transform& to_world : {Transform{}, Transform::scale({1, -1, 1})}) {
      const SceneDescription description = scene_with(d, to_world);
      const Scene scene = test::compiled(description, 4, 4);
      for (std::uint32_t i = 0; i < 100; ++i) {
        Random random(3, i);
        const Vec3d center = to_world.point(Vec3d(cloud->ellipsoids[i].center));
        const Vec3d origin = Vec3d(square_to_sphere(random.next2())) * 3.0;
        const Vec3d direction = normalize(center - origin);
        const std::vector<CloudEntry> all = entries_of(scene, Vec3f(origin + scene.frame.moved), Vec3f(direction));
        const auto is_it = [&](const CloudEntry& entry) { return entry.ellipsoid == i; };
        EXPECT_EQ(std::ranges::count_if(all, is_it), 1);
      }
    }
  }
}

TEST(ellipsoids, behind_another_surface_are_not_entered) {
  auto cloud = random_cloud(300, 4);
  for (Ellipsoid& e : cloud->ellipsoids) e.center.z = -1 + e.center.z * 0.1f;
  for (const bool plane : {false, true}) {
    SceneDescription description = scene_with(description_of(cloud));
    if (plane)
      test::add_shape(description, PlaneDescription{}, {}, {0});
    else
      test::add_shape(description, RectangleDescription{}, Transform::scale(Vec3d(9)), {0});
    const Scene scene = test::compiled(description, 4, 4);
    const Vec3f moved(scene.frame.moved);
    EXPECT_TRUE(entries_of(scene, Vec3f(0, 0, 5) + moved, {0, 0, -1}).empty());
    EXPECT_FALSE(entries_of(scene, Vec3f(0, 0, -5) + moved, {0, 0, 1}).empty());
  }
}

// Entries of the same place are in the order of their numbers, and none gets lost between traversals.
TEST(ellipsoids, at_one_place_are_all_entered) {
  auto cloud = std::make_shared<EllipsoidCloud>();
  for (int i = 0; i < 50; ++i) cloud->ellipsoids.push_back({{0, 0, 0}, {0.1f, 0.1f, 0.1f}});
  for (const bool triangles : {false, true}) {
    const SceneDescription description = scene_with(description_of(cloud, triangles));
    const Scene scene = test::compiled(description, 4, 4);
    const std::vector<CloudEntry> all = entries_of(scene, {0.01f, 0.02f, 4}, {0, 0, -1});
    ASSERT_EQ(all.size(), 50u);
    for (std::uint32_t i = 0; i < 50; ++i) EXPECT_EQ(all[i].ellipsoid, i);
  }
}

// The mean of (2, 1, 0.6) is 1.2. Under this shear the symmetric factor of the polar decomposition is not diagonal.
TEST(ellipsoids, keep_their_proportions_under_a_to_world_that_stretches) {
  auto cloud = std::make_shared<EllipsoidCloud>();
  cloud->ellipsoids.push_back({{1, 1, 1}, {0.1f, 0.2f, 0.3f}});
  const EllipsoidsDescription d = description_of(cloud);
  const PlacedEllipsoid e = PlacedEllipsoids(d, Transform::scale({2, 1, 0.6}))[0];
  EXPECT_LT(length(e.center - Vec3d{2, 1, 0.6}), 1e-12);
  EXPECT_LT(length(e.axes[0] - Vec3d{0.12, 0, 0}), 1e-8);
  EXPECT_LT(length(e.axes[2] - Vec3d{0, 0, 0.36}), 2e-8);
  Transform shear;
  shear.m[1] =
      1;  // x + y. Its polar turn is that of (2, -1) / sqrt(5), and the trace of the symmetric factor 1 + sqrt(5)
  const PlacedEllipsoid sheared = PlacedEllipsoids(d, shear)[0];
  const double scale = (1 + std::sqrt(5.0)) / 3;
  EXPECT_LT(length(sheared.axes[0] - Vec3d{2, -1, 0} * (0.1 * scale / std::sqrt(5.0))), 1e-8);
  EXPECT_LT(length(sheared.axes[1] - Vec3d{1, 2, 0} * (0.2 * scale / std::sqrt(5.0))), 1e-8);
}

}  // namespace
}  // namespace photonproof::inline renderer_rays
