// Curves: their hits through Embree, compared with closed forms, their normals, texture coordinates and radii.
#include "renderer/shapes/curves.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/rays/rays.h"
#include "renderer/scene/scene.h"

namespace photonproof::inline renderer_shapes {
namespace {

struct Met {
  bool valid = false;
  std::uint32_t segment = 0;
  Vec3d p, normal;
};

Met meet(const Tracer& tracer, const Vec3f& origin, const Vec3f& direction, bool packet = false) {
  RayBlock rays{};
  HitBlock hits;
  fill_block<float>(rays, origin, direction, no_index, true);
  if (packet) {  // a second ray beside it, since one ray alone is traced singly
    rays.origin_x[1] = origin.x + 100;
    rays.direction_x[1] = 1;
    rays.active = 3;
  }
  tracer.intersect(rays, hits, packet);
  if (hits.surface[0] == no_index) return {};
  return {true,
          hits.primitive[0],
          {hits.p_x[0], hits.p_y[0], hits.p_z[0]},
          {hits.normal_x[0], hits.normal_y[0], hits.normal_z[0]}};
}

bool is_hidden(const Tracer& tracer, const Vec3f& origin, const Vec3f& segment) {
  RayBlock rays{};
  std::uint32_t blocked[RayBlock::width];
  fill_block<float>(rays, origin, segment, no_index, true);
  tracer.occluded(rays, blocked);
  return blocked[0] == 1;
}

/// A straight tube along x from -1 to 1 of radius 0.3.
Curves straight(bool linear) {
  Curves curves;
  curves.linear = linear;
  const int points = linear ? 2 : 4;
  const float reach = linear ? 2 : 6;  // the middle part of an even B-spline is a third of it
  for (int i = 0; i < points; ++i)
    curves.points.push_back({{reach * (static_cast<float>(i) / static_cast<float>(points - 1) - 0.5f), 0, 0}, 0.3f});
  curves.segments = {0};
  return curves;
}

/// Two tubes, bent and of changing radii; the first has two segments.
Curves bent(bool linear) {
  Curves curves;
  curves.linear = linear;
  curves.points = {{{-1, 0, 0}, 0.2f},       {{-0.3f, 0.6f, 0.1f}, 0.3f}, {{0.4f, 0.1f, 0.3f}, 0.15f},
                   {{1, 0.7f, -0.2f}, 0.1f}, {{1.4f, 0, 0}, 0.2f},        {{-1, -1, 1}, 0.1f},
                   {{0, -1, 1.1f}, 0.2f},    {{1, -0.8f, 1}, 0.1f},       {{2, -1, 0.5f}, 0.05f}};
  if (linear)
    curves.segments = {0, 1, 2, 3, 5, 6, 7};
  else
    curves.segments = {0, 1, 5};
  return curves;
}

template <class Visit>
void for_random_rays(int count, Visit&& visit) {
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    test::Random random(83, i);
    const Vec3f from = square_to_sphere(random.next2()) * 4.0f;
    visit(from, normalize(square_to_sphere(random.next2()) * 1.3f - from));
  }
}

/// Where a ray from outside meets the straight tube's front, with its ends; negative if it does not.
double to_straight(bool linear, const Vec3f& origin, const Vec3f& direction) {
  double nearest = -1;
  const ShapeRay ray{Vec3d(origin), Vec3d(direction), 0, 100};
  const auto add = [&](double t, bool front) {
    if (t >= 0 && front && (nearest < 0 || t < nearest)) nearest = t;
  };
  const Cylinder side{{-1, 0, 0}, {1, 0, 0}, 2, 0.3, false};
  const auto at = [&](double t) { return ray.origin + ray.direction * t; };
  const double t = hit_distance(side, ray);
  add(t, t >= 0 && dot(Vec3d(0, at(t).y, at(t).z), ray.direction) < 0);
  for (const double end : {-1.0, 1.0}) {
    const double s = hit_distance(Sphere{{end, 0, 0}, 0.3, false}, ray);
    add(s, linear && s >= 0 && at(s).x * end > 1);
  }
  return nearest;
}

TEST(curves, straight_ones_are_cylinders_with_or_without_round_ends) {
  for (const bool linear : {false, true}) {
    const std::vector<Surface> surfaces{{straight(linear)}};
    const Tracer tracer(surfaces);
    int hits = 0;
    for_random_rays(5000, [&](const Vec3f& origin, const Vec3f& direction) {
      const double expected = to_straight(linear, origin, direction);
      const Met met = meet(tracer, origin, direction), in_packet = meet(tracer, origin, direction, true);
      const Vec3d p = Vec3d(origin) + Vec3d(direction) * expected;
      if (expected >= 0 && std::abs(std::abs(p.x) - 1) < 1e-3) return;  // an edge, or the seam of an end
      const Vec3d out = normalize(p - Vec3d(std::clamp(p.x, -1.0, 1.0), 0, 0));
      if (expected >= 0 && std::abs(dot(out, Vec3d(direction))) < 0.02) return;  // the silhouette
      ASSERT_EQ(met.valid, in_packet.valid);
      if (expected < 0 && met.valid) {
        EXPECT_LT(std::abs(dot(met.normal, Vec3d(direction))), 0.02);
        return;
      }
      ASSERT_EQ(met.valid, expected >= 0) << linear << ' ' << p.x << ' ' << p.y << ' ' << p.z;
      if (!met.valid) return;
      ++hits;
      EXPECT_LT(length(met.p - p), 2e-5);
      EXPECT_LT(length(met.normal - out), 1e-4);
      EXPECT_LT(length(met.p - in_packet.p), 1e-5);  // Embree solves packets by other instructions
    });
    EXPECT_GT(hits, 500);
  }
}

TEST(curves, pass_rays_from_inside) {
  for (const bool linear : {false, true}) {
    const std::vector<Surface> surfaces{{straight(linear)}};
    const Tracer tracer(surfaces);
    for (const Vec3f& direction : {Vec3f(0, 0, 1), Vec3f(0.6f, 0.8f, 0), Vec3f(1, 0, 0)}) {
      EXPECT_FALSE(meet(tracer, {0, 0, 0.1f}, direction).valid);
      EXPECT_FALSE(is_hidden(tracer, {0, 0, 0.1f}, direction * 5.0f));
    }
    EXPECT_TRUE(is_hidden(tracer, {0, 0, 2}, {0, 0, -4}));
    EXPECT_FALSE(is_hidden(tracer, {0, 0, 2}, {0, 0, -1.69f}));
    // Through the open end of a B-spline to its far side, which is seen from inside.
    EXPECT_EQ(meet(tracer, {3, 0, 0}, normalize(Vec3f(-1, 0, 0.05f))).valid, linear);
  }
}

TEST(curves, bent_ones_have_their_radius_across_and_the_normal_of_their_surface) {
  for (const bool linear : {false, true}) {
    const Curves curves = bent(linear);
    const std::vector<Surface> surfaces{{curves}};
    const Tracer tracer(surfaces);
    int hits = 0;
    for_random_rays(5000, [&](const Vec3f& origin, const Vec3f& direction) {
      const Met met = meet(tracer, origin, direction);
      if (!met.valid || std::abs(dot(met.normal, Vec3d(direction))) < 0.05) return;
      ++hits;
      const Vec3d on_ray = Vec3d(origin) + Vec3d(direction) * dot(met.p - Vec3d(origin), Vec3d(direction));
      EXPECT_LT(length(met.p - on_ray), 2e-4);
      const double v = curve_parameter(curves, met.segment, met.p, met.normal);
      const CurveFrame at = curve_frame(curves, met.segment, v);
      EXPECT_NEAR(length(met.p - at.center), at.radius, 2e-5);
      const LocalGeometry local = local_geometry(curves, met.segment, Vec3f(met.p), Vec3f(met.normal));
      if (linear && (v < 1e-4 || v > 1 - 1e-4)) return;  // a round joint
      EXPECT_NEAR(dot(normalize(Vec3d(local.dp_du)), met.normal), 0, 2e-3);
      EXPECT_NEAR(dot(normalize(Vec3d(local.dp_dv)), met.normal), 0, 2e-3);
      EXPECT_GT(dot(cross(local.dp_du, local.dp_dv), Vec3f(met.normal)), 0);
      // Along the surface, uv change as the derivatives say.
      const Vec3d step = normalize(Vec3d(local.dp_dv)) * 1e-3;
      const LocalGeometry there = local_geometry(curves, met.segment, Vec3f(met.p + step), Vec3f(met.normal));
      if (v < 0.01 || v > 0.99 || local.uv.x < 0.01f || local.uv.x > 0.99f) return;
      EXPECT_NEAR((there.uv.y - local.uv.y) * length(local.dp_dv) / 1e-3f, 1, 0.05);
      EXPECT_NEAR((there.uv.x - local.uv.x) * length(local.dp_du) / 1e-3f, 0, 0.05);
    });
    EXPECT_GT(hits, 300);
  }
}

TEST(curves, are_counted_from_one_angle_and_along_all_segments) {
  // Along x the angle begins at z x x = y... seen from +z it is a quarter, from +y nothing; v runs over the segment.
  for (const bool linear : {false, true}) {
    const Curves curves = straight(linear);
    const LocalGeometry above = local_geometry(curves, 0, {0.5f, 0, 0.3f}, {0, 0, 1});
    EXPECT_NEAR(above.uv.x, 0.25f, 1e-5f);
    EXPECT_NEAR(above.uv.y, 0.75f, 1e-5f);
    EXPECT_NEAR(length(above.dp_dv - Vec3f(2, 0, 0)), 0, 1e-4f);
    const float u = local_geometry(curves, 0, {0, 0.3f, 0}, {0, 1, 0}).uv.x;
    EXPECT_NEAR(std::min(u, 1 - u), 0, 1e-5f);
  }
}

SceneDescription with_curve(const CurvesDescription& curves, const Transform& to_world) {
  SceneDescription d;
  test::add_shape(d, curves, to_world, test::add_bsdf(d, DiffuseDescription{}));
  return d;
}

CurvesDescription stick() {
  CurvesDescription curves;
  curves.basis = CurvesDescription::Basis::linear;
  curves.curves = std::make_shared<const CurveSet>(CurveSet{{{{-1, 0, 0}, 0.25f}, {{1, 0, 0}, 0.25f}}, {0}});
  return curves;
}

float radius_in(const SceneDescription& description) {
  const Scene scene = test::compiled(description, 4, 4);
  return std::get<Curves>(scene.surfaces[0].geometry).points[0].radius / static_cast<float>(scene.frame.scale);
}

TEST(curves, keep_their_radii_but_in_an_instance) {
  EXPECT_FLOAT_EQ(radius_in(with_curve(stick(), Transform::scale(Vec3d(4)))), 0.25f);
  SceneDescription d;
  ShapeGroupDescription group;
  ShapeDescription member;
  member.geometry = stick();
  member.to_world = Transform::scale(Vec3d(4));
  member.bsdf = test::add_bsdf(d, DiffuseDescription{});
  group.shapes.push_back(member);
  d.groups.push_back(group);
  test::add_shape(d, InstanceDescription{{0}}, Transform::scale(Vec3d(3)), member.bsdf);
  EXPECT_FLOAT_EQ(radius_in(d), 0.75f);
  d.shapes[0].to_world = Transform::scale({3, 3, 2});
  EXPECT_THROW(radius_in(d), InputError);
}

TEST(curves, of_extreme_sizes_are_in_proportion) {
  for (const double size : {1e-9, 1e9}) {
    CurvesDescription curves = stick();
    CurveSet scaled = *curves.curves;
    for (CurvePoint& point : scaled.points)
      point = {point.p * static_cast<float>(size), point.radius * static_cast<float>(size)};
    curves.curves = std::make_shared<const CurveSet>(scaled);
    EXPECT_NEAR(radius_in(with_curve(curves, {})) / size, 0.25, 1e-6);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_shapes
