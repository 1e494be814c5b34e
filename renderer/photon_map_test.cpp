// The photon grid against brute force, and the clipped look-up disc against closed forms and counting.

#include "renderer/photon_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/disc_area.h"
#include "renderer/sampler.h"

namespace photonproof {
namespace {

enum class Cloud { uniform, clustered, coplanar, one_point };

std::vector<Photon> make_cloud(Cloud kind, int count) {
  std::vector<Photon> photons;
  for (int i = 0; i < count; ++i) {
    Sampler s(41, Stream::camera, static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(kind));
    const auto xy = s.next2();
    Vec3f p{xy.x, xy.y, s.next()};
    if (kind == Cloud::clustered) p = p * p * p * p;
    if (kind == Cloud::coplanar) p.y = 0.25f;
    if (kind == Cloud::one_point) p = {0.5f, 0.5f, 0.5f};
    photons.push_back({p, Rgb(static_cast<float>(i)), static_cast<std::uint32_t>(i), i});
  }
  return photons;
}

TEST(photon_map, finds_exactly_what_brute_force_finds) {
  for (const Cloud kind : {Cloud::uniform, Cloud::clustered, Cloud::coplanar, Cloud::one_point}) {
    const auto photons = make_cloud(kind, 2000);
    const PhotonMap map(photons, 0.05f);
    ASSERT_EQ(map.size(), photons.size());
    for (std::uint64_t q = 0; q < 500; ++q) {
      Sampler s(42, Stream::camera, q, 0);
      const auto xy = s.next2();
      Vec3f p{1.2f * xy.x - 0.1f, 1.2f * xy.y - 0.1f, 1.2f * s.next() - 0.1f};  // also outside the photons' box
      if (q % 3 == 0) p = photons[q].p_world;
      const float radius = q % 2 == 0 ? 0.05f : 0.3f * s.next();  // the grid's own, and any other
      std::vector<std::uint32_t> found, expected;
      map.for_each_within(p, radius, [&](std::size_t i) { found.push_back(map.surface(i)); });
      for (const Photon& photon : photons)
        if (length_squared(photon.p_world - p) <= radius * radius) expected.push_back(photon.surface);
      std::sort(found.begin(), found.end());
      EXPECT_EQ(found, expected) << static_cast<int>(kind) << " " << q;
    }
  }
}

TEST(photon_map, keeps_each_photons_data_together) {
  const auto photons = make_cloud(Cloud::uniform, 1000);
  const PhotonMap map(photons, 0.1f);
  for (std::size_t i = 0; i < map.size(); ++i) {
    const Photon& original = photons[map.surface(i)];
    EXPECT_EQ(map.position(i), original.p_world);
    EXPECT_EQ(map.flux(i), original.flux);
    EXPECT_EQ(map.edges(i), original.edges);
  }
}

TEST(photon_map, empty_map_answers_nothing) {
  const PhotonMap map({}, 0.1f);
  map.for_each_within({0, 0, 0}, 1, [](std::size_t) { FAIL(); });
}

TEST(photon_map, radius_far_below_the_extent_does_not_exhaust_memory) {
  auto photons = make_cloud(Cloud::uniform, 100);
  photons.push_back({{1e6f, -1e6f, 1e6f}, Rgb(1), 100, 100});
  const PhotonMap map(photons, 1e-5f);
  int found = 0;
  map.for_each_within(photons[3].p_world, 1e-5f, [&](std::size_t) { ++found; });
  EXPECT_EQ(found, 1);
}

const Quad unit_square{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, 1};

TEST(disc_area, is_whole_half_and_quarter_where_the_square_leaves_that_much) {
  const double r = 0.1, disc = std::numbers::pi * r * r;
  EXPECT_NEAR(disc_area(unit_square, {0.5f, 0.5f, 0}, 0.1f), disc, 1e-8);
  EXPECT_NEAR(disc_area(unit_square, {0.5f, 0, 0}, 0.1f), disc / 2, 1e-8);
  EXPECT_NEAR(disc_area(unit_square, {0, 1, 0}, 0.1f), disc / 4, 1e-8);
}

TEST(disc_area, of_a_disc_that_covers_the_square_is_the_squares) {
  EXPECT_NEAR(disc_area(unit_square, {0.3f, 0.8f, 0}, 5), 1, 1e-7);
}

TEST(disc_area, near_an_edge_is_the_circular_segment) {
  // At distance h from one edge: pi r^2 - r^2 acos(h/r) + h sqrt(r^2 - h^2).
  const double r = 0.2, h = 0.05;
  const double expected = std::numbers::pi * r * r - r * r * std::acos(h / r) + h * std::sqrt(r * r - h * h);
  EXPECT_NEAR(disc_area(unit_square, {0.05f, 0.5f, 0}, 0.2f), expected, 1e-7);
}

TEST(disc_area, of_a_sheared_parallelogram_matches_counting) {
  // 1e6 points uniform over the parallelogram: the fraction within r has standard error below 5e-4 of area 2.
  const Quad quad{{1, 2, 3}, {2, 0, 0}, {0.7f, 1, 0}, {0, 0, 1}, 2};
  const Vec3f p = quad.corner + quad.edge_u * 0.1f + quad.edge_v * 0.2f;
  int inside = 0;
  constexpr int n = 1'000'000;
  Sampler s(43, Stream::camera, 0, 0);
  for (int i = 0; i < n; ++i) {
    const auto u = s.next2();
    const Vec3f q = quad.corner + quad.edge_u * u.x + quad.edge_v * u.y;
    if (length_squared(q - p) <= 0.6f * 0.6f) ++inside;
  }
  EXPECT_NEAR(disc_area(quad, p, 0.6f), 2.0 * inside / n, 4e-3);
}

TEST(disc_area, on_a_sphere_is_pi_r_squared_up_to_the_whole_sphere) {
  const Sphere sphere{{0, 0, 0}, 1, false};
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 0.5f), std::numbers::pi / 4, 1e-6);
  EXPECT_NEAR(disc_area(sphere, {0, 0, 1}, 9), 4 * std::numbers::pi, 1e-5);
}

}  // namespace
}  // namespace photonproof
