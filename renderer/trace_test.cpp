// Ray queries: exact answers, robustness far from the origin, hostile rays.

#include "renderer/trace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/sampler.h"
#include "renderer/warp.h"

namespace photonproof {
namespace {

Surface quad(const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  const Vec3f n = cross(u, v);
  return {Quad{corner, u, v, normalize(n), length(n)}};
}

/// Closed box [-1,1]^3 + center, normals inward.
std::vector<Surface> box(const Vec3f& center) {
  const float s = 2;
  const Vec3f low = center - Vec3f(1), high = center + Vec3f(1);
  return {quad(low, {s, 0, 0}, {0, s, 0}),    quad(low, {0, s, 0}, {0, 0, s}),    quad(low, {0, 0, s}, {s, 0, 0}),
          quad(high, {0, -s, 0}, {-s, 0, 0}), quad(high, {0, 0, -s}, {0, -s, 0}), quad(high, {-s, 0, 0}, {0, 0, -s})};
}

TEST(tracer, hits_quads_and_spheres_where_geometry_says) {
  std::vector<Surface> surfaces = box({0, 0, 0});
  surfaces.push_back({Sphere{{0, 0, 0}, 0.5f, false}});
  const Tracer tracer(surfaces);
  const Hit ball = tracer.intersect({{0, 0, 0.9f}, {0, 0, -1}});
  EXPECT_EQ(ball.surface, 6u);
  EXPECT_NEAR(ball.p_world.z, 0.5f, 1e-6f);
  EXPECT_EQ(ball.normal, Vec3f(0, 0, 1));
  const Hit wall = tracer.intersect({{0.8f, 0.7f, 0}, {0, 0, -1}});
  EXPECT_EQ(wall.surface, 0u);
  EXPECT_NEAR(length(wall.p_world - Vec3f(0.8f, 0.7f, -1)), 0, 2e-7f);
  EXPECT_TRUE(tracer.occluded({{0, 0, 0.9f}, {0, 0, -1.8f}, 0, 1}));
  EXPECT_FALSE(tracer.occluded({{0.8f, 0.7f, 0.9f}, {0, 0, -1.8f}, 0, 1}));
}

TEST(tracer, no_ray_leaves_a_closed_box_or_meets_its_own_surface_however_far_out_it_stands) {
  // From a random wall point into the room: the next hit is another wall, never a miss (leak), never the same wall
  // (self-hit).
  for (const float shift : {0.0f, 100.0f, 1e4f, 1e5f}) {
    const std::vector<Surface> surfaces = box(Vec3f(shift, -shift, shift));
    const Tracer tracer(surfaces);
    int leaks = 0, self_hits = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Sampler s(51, Stream::camera, i, 0);
      const std::uint32_t start = static_cast<std::uint32_t>(i % 6);
      const auto& wall = std::get<Quad>(surfaces[start].geometry);
      const auto u = s.next2();
      const Vec3f p = wall.corner + wall.edge_u * u.x + wall.edge_v * u.y;
      const Vec3f d = Frame(wall.normal).to_world(square_to_cosine_hemisphere(s.next2()));
      const Hit hit = tracer.intersect({tracer.offset(p, wall.normal, d), d});
      if (!hit.valid()) ++leaks;
      if (hit.surface == start) ++self_hits;
    }
    EXPECT_EQ(leaks, 0) << shift;
    EXPECT_EQ(self_hits, 0) << shift;
  }
}

TEST(tracer, rays_leaving_a_sphere_never_meet_it_again) {
  for (const float shift : {0.0f, 100.0f, 1e4f}) {
    const Vec3f center(shift, shift, -shift);
    const std::vector<Surface> surfaces{{Sphere{center, 1, false}}};
    const Tracer tracer(surfaces);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      Sampler s(52, Stream::camera, i, 0);
      const Vec3f from = center + square_to_sphere(s.next2()) * 3;
      const Hit first = tracer.intersect({from, normalize(center + square_to_sphere(s.next2()) * 0.99f - from)});
      ASSERT_TRUE(first.valid());
      const Vec3f d = Frame(first.normal).to_world(square_to_cosine_hemisphere(s.next2()));
      EXPECT_FALSE(tracer.intersect({tracer.offset(first.p_world, first.normal, d), d}).valid()) << shift;
    }
  }
}

TEST(tracer, a_ray_with_a_nan_or_infinity_hits_nothing) {
  const std::vector<Surface> surfaces = box({0, 0, 0});
  const Tracer tracer(surfaces);
  for (const float bad : {std::nanf(""), INFINITY, -INFINITY}) {
    EXPECT_FALSE(tracer.intersect({{bad, 0, 0}, {0, 0, 1}}).valid());
    EXPECT_FALSE(tracer.intersect({{0, 0, 0}, {0, bad, 1}}).valid());
    EXPECT_FALSE(tracer.occluded({{0, 0, bad}, {0, 0, 5}, 0, 1}));
  }
}

TEST(tracer, an_empty_scene_is_all_misses) {
  const std::vector<Surface> none;
  EXPECT_FALSE(Tracer(none).intersect({{0, 0, 0}, {0, 0, 1}}).valid());
}

}  // namespace
}  // namespace photonproof
