// The photon grid, dense and compact, compared with brute force: exactly the same photons.

#include "renderer/photons/photon_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "renderer/photons/photon_gather.h"
#include "renderer/photons/query_order.h"
#include "renderer/photons/test_photon_clouds.h"

namespace photonproof::inline renderer_photons {
namespace {

using Layout = PhotonMap::Layout;

/// How often a gather visits each photon of make_cloud.
std::vector<std::uint8_t> found_by(const PhotonMap& map, const Vec3f& p, float radius) {
  std::vector<std::uint8_t> visits(map.size());
  map.for_each_within(p, radius, [&](std::size_t i) { ++visits[map[i].surface]; });
  return visits;
}

std::vector<std::uint8_t> found_by_brute_force(const Photons& photons, const Vec3f& p, float radius) {
  std::vector<std::uint8_t> visits(photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i)
    visits[i] = distance_squared(photons, i, p) <= radius * radius ? 1 : 0;
  return visits;
}

std::ptrdiff_t found(const std::vector<std::uint8_t>& visits) { return std::ranges::count(visits, 1); }

class PhotonMapOf : public testing::TestWithParam<Cloud> {};

TEST_P(PhotonMapOf, hundred_thousand_queries_find_exactly_what_brute_force_finds) {
  const Photons photons = make_cloud(GetParam(), 1000);
  const Threads threads(1);
  const PhotonMap dense(photons, 0.05f, threads);
  const PhotonMap fine(photons, 0.003f, threads);
  ASSERT_EQ(dense.layout(), Layout::dense);
  if (GetParam() == Cloud::uniform || GetParam() == Cloud::walls) {
    ASSERT_EQ(fine.layout(), Layout::compact);
  }
  for (std::uint64_t q = 0; q < 100'000; ++q) {
    const Vec3f p = query_point(GetParam(), photons, q);
    test::Random s(43, q);
    const float any = s.next();
    // The grids' own radii, any other, zero, and exactly the distance of some photon.
    const float radius = q % 5 == 0   ? 0.05f
                         : q % 5 == 1 ? 0.003f
                         : q % 5 == 2 ? 0.3f * any * any * any
                         : q % 5 == 3 ? 0
                                      : std::sqrt(distance_squared(photons, q % photons.size(), p));
    const auto expected = found_by_brute_force(photons, p, radius);
    ASSERT_EQ(found_by(dense, p, radius), expected) << q;
    ASSERT_EQ(found_by(fine, p, radius), expected) << q;
  }
}

TEST_P(PhotonMapOf, any_number_of_threads_builds_the_same_map) {
  const Photons photons = make_cloud(GetParam(), 100'000);  // several chunks, the last one short
  for (const float radius : {0.02f, 1e-3f}) {
    const PhotonMap one(photons, radius, Threads(1));
    for (const int count : {2, 7}) {
      const PhotonMap many(photons, radius, Threads(count));
      ASSERT_EQ(many.layout(), one.layout());
      ASSERT_EQ(many.cells(), one.cells());
      for (std::size_t i = 0; i < photons.size(); ++i) ASSERT_EQ(many[i].surface, one[i].surface) << i;
      for (std::uint64_t q = 0; q < 200; ++q) {
        const Vec3f p = query_point(GetParam(), photons, q);
        std::vector<std::size_t> runs, expected;
        one.for_each_run(p, radius, [&](std::size_t begin, std::size_t end) {
          expected.insert(expected.end(), {begin, end});
        });
        many.for_each_run(p, radius, [&](std::size_t begin, std::size_t end) {
          runs.insert(runs.end(), {begin, end});
        });
        ASSERT_EQ(runs, expected);
      }
    }
  }
}

TEST_P(PhotonMapOf, photons_are_in_cell_order_and_within_a_cell_in_that_of_their_input) {
  const Photons photons = make_cloud(GetParam(), 50'000);
  for (const float radius : {0.1f, 1e-3f}) {
    const PhotonMap map(photons, radius, Threads(2));
    for (std::size_t i = 1; i < map.size(); ++i) {
      const auto before = map.cell_order_key(map[i - 1].p_world);
      const auto key = map.cell_order_key(map[i].p_world);
      ASSERT_LE(before, key);
      ASSERT_TRUE(before < key || map[i - 1].surface < map[i].surface);
    }
  }
}

TEST_P(PhotonMapOf, runs_are_ascending_disjoint_and_never_empty) {
  const Photons photons = make_cloud(GetParam(), 5000);
  for (const float width : {0.1f, 1e-3f}) {
    const PhotonMap map(photons, width, Threads(1));
    for (std::uint64_t q = 0; q < 2000; ++q) {
      std::size_t last = 0;
      map.for_each_run(query_point(GetParam(), photons, q), 0.04f, [&](std::size_t begin, std::size_t end) {
        ASSERT_LE(last, begin);
        ASSERT_LT(begin, end);
        last = end;
      });
      ASSERT_LE(last, map.size());
    }
  }
}

TEST_P(PhotonMapOf, gathered_flux_is_the_sum_over_the_photons_that_pass_the_filter) {
  Photons photons = make_cloud(GetParam(), 20'000);
  for (std::uint32_t& surface : photons.surface) surface %= 3;
  const PhotonMap map(photons, 0.03f, Threads(1));
  for (std::uint64_t q = 0; q < 2000; ++q) {
    const Vec3f p = query_point(GetParam(), photons, q);
    const PhotonFilter filter{static_cast<std::uint32_t>(q % 4), static_cast<std::int32_t>(q % 20)};
    const float radius = q % 2 == 0 ? 0.03f : 0.1f;
    RgbD flux(0.0);
    int count = 0;
    map.for_each_within(p, radius, [&](std::size_t i) {
      if (map[i].surface != filter.surface || map[i].edges > filter.max_edges) return;
      flux += RgbD(map[i].flux);
      ++count;
    });
    const GatheredFlux gathered = gather(map.view(), p, radius, filter);
    ASSERT_EQ(gathered.count, count);
    ASSERT_EQ(RgbD(gathered.flux), flux);  // whole numbers below 2^24
  }
}

TEST_P(PhotonMapOf, queries_are_ordered_by_cell_and_then_as_they_came) {
  const Photons photons = make_cloud(GetParam(), 3000);
  for (const float width : {0.1f, 1e-3f}) {
    const PhotonMap map(photons, width, Threads(1));
    struct Point {
      Vec3f p;
    };
    std::vector<Point> points;
    for (std::uint64_t q = 0; q < 3000; ++q) points.push_back({query_point(GetParam(), photons, q)});
    std::vector<std::uint32_t> expected(points.size());
    for (std::uint32_t i = 0; i < expected.size(); ++i) expected[i] = i;
    std::ranges::stable_sort(expected, {}, [&](std::uint32_t i) { return map.cell_order_key(points[i].p); });
    EXPECT_EQ(cell_order(map, points), expected);
  }
}

INSTANTIATE_TEST_SUITE_P(photon_map, PhotonMapOf, testing::ValuesIn(all_clouds),
                         [](const auto& cloud) { return name_of(cloud.param); });

TEST(photon_map, keeps_each_photons_data_together) {
  const Photons photons = make_cloud(Cloud::uniform, 10'000);
  for (const float width : {0.1f, 1e-3f}) {
    const PhotonMap map(photons, width, Threads(1));
    ASSERT_EQ(map.size(), photons.size());
    for (std::size_t i = 0; i < map.size(); ++i) {
      const Photon original = photons[map[i].surface];
      EXPECT_EQ(map[i].p_world, original.p_world);
      EXPECT_EQ(map[i].flux, original.flux);
      EXPECT_EQ(map[i].edges, original.edges);
    }
  }
}

TEST(photon_map, without_photons_answers_nothing) {
  for (const PhotonMap& map : {PhotonMap(), PhotonMap({}, 0.1f, Threads(1))}) {
    map.for_each_run({0, 0, 0}, 1, [](std::size_t, std::size_t) { FAIL(); });
    EXPECT_EQ(gather(map.view(), {0, 0, 0}, 1, {0, 1}).count, 0);
    EXPECT_TRUE(map.empty());
  }
}

TEST(photon_map, of_one_photon_finds_it_up_to_exactly_the_radius) {
  Photons photons;
  photons.push_back({{1, 2, 3}, Rgb(1), 0, 1});
  const PhotonMap map(photons, 0.5f, Threads(1));
  EXPECT_EQ(found(found_by(map, {1.5f, 2, 3}, 0.5f)), 1);
  EXPECT_EQ(found(found_by(map, {std::nextafter(1.5f, 2.0f), 2, 3}, 0.5f)), 0);
}

TEST(photon_map, hits_just_outside_the_bounds_still_find_photons) {
  // Photons on an axis-aligned wall bound their box exactly; a hit on that wall may round to either side of it.
  const Photons photons = make_cloud(Cloud::walls, 20'000);
  for (const float width : {0.05f, 1e-3f}) {
    const PhotonMap map(photons, width, Threads(1));
    for (const float wall : {0.0f, 1.0f}) {
      for (const float beyond :
           {std::nextafter(wall, -9.0f), wall, std::nextafter(wall, 9.0f), wall - 0.04f, wall + 0.04f}) {
        for (const Vec3f& p : {Vec3f{beyond, 0.5f, 0.5f}, Vec3f{0.5f, beyond, 0.5f}, Vec3f{0.5f, 0.5f, beyond}}) {
          const auto visits = found_by(map, p, 0.05f);
          EXPECT_GT(found(visits), 0);  // pi .03^2 of a face with 3333 photons at the least: 9 expected
          EXPECT_EQ(visits, found_by_brute_force(photons, p, 0.05f));
        }
      }
    }
  }
}

/// Photons at positions where single precision runs out, one another's distances included.
Photons photons_at_the_limits_of_floats() {
  constexpr float most = std::numeric_limits<float>::max();
  Photons photons;
  for (const float a : {0.0f, std::numeric_limits<float>::denorm_min(), std::numeric_limits<float>::min(), -1e-30f,
                        1e-20f, 1.0f, -1e6f, 1e19f, 2e19f, -1e38f, most, -most})
    for (const float b : {0.0f, 1.0f, -most})
      photons.push_back({{a, b, b - a}, Rgb(1), static_cast<std::uint32_t>(photons.size()), 1});
  for (std::size_t i = 0; i < photons.size(); ++i)
    if (!std::isfinite(photons.z[i])) photons.z[i] = most;
  return photons;
}

TEST(photon_map, agrees_with_brute_force_at_the_limits_of_floats) {
  const Photons photons = photons_at_the_limits_of_floats();
  for (const float width : {0.0f, 1e-40f, 1e-20f, 1.0f, 1e18f, 1e37f, 3e38f}) {
    const PhotonMap map(photons, width, Threads(1));
    for (std::size_t i = 0; i < photons.size(); ++i)
      for (const float radius : {0.0f, 1e-40f, 1e-30f, 1e-22f, 1e-10f, 1.0f, 1e6f, 1.8e19f, 1e20f, 3e38f})
        EXPECT_EQ(found_by(map, photons[i].p_world, radius), found_by_brute_force(photons, photons[i].p_world, radius))
            << "width " << width << ", photon " << i << ", radius " << radius;
  }
}

TEST(photon_map, of_huge_extent_and_tiny_radius_is_compact_and_exact) {
  Photons photons = make_cloud(Cloud::uniform, 3000);
  for (std::size_t i = 0; i < photons.size(); i += 2)
    for (auto* axis : {&photons.x, &photons.y, &photons.z}) (*axis)[i] = 2e6f * (*axis)[i] - 1e6f;
  const PhotonMap map(photons, 1e-5f, Threads(1));
  EXPECT_EQ(map.layout(), Layout::compact);
  EXPECT_LE(map.cells(), photons.size());
  for (std::uint64_t q = 0; q < 3000; ++q)
    for (const float radius : {1e-5f, 0.1f, 1e4f})
      ASSERT_EQ(found_by(map, photons[q].p_world, radius), found_by_brute_force(photons, photons[q].p_world, radius));
}

TEST(photon_map, refilled_in_another_layout_keeps_nothing_of_the_last) {
  // As in passes: a photon of one of them may land far out.
  const Photons near_by = make_cloud(Cloud::uniform, 3000);
  Photons with_one_far_out = near_by;
  with_one_far_out.x[7] = 1e6f;
  const Photons& far_out = with_one_far_out;
  PhotonMap map;
  for (const auto& [photons, layout] :
       {std::pair{&near_by, Layout::dense}, std::pair{&far_out, Layout::compact}, std::pair{&near_by, Layout::dense}}) {
    map.build(*photons, 0.05f, Threads(1));
    ASSERT_EQ(map.layout(), layout);
    for (std::uint64_t q = 0; q < 3000; q += 3) {
      const Vec3f p = (*photons)[q].p_world;
      ASSERT_EQ(found_by(map, p, 0.05f), found_by_brute_force(*photons, p, 0.05f));
    }
  }
}

TEST(photon_map, radius_larger_than_the_scene_finds_everything_in_either_layout) {
  const Photons photons = make_cloud(Cloud::walls, 2000);
  for (const float width : {1e30f, 5.0f, 0.1f, 1e-4f}) {
    const PhotonMap map(photons, width, Threads(1));
    EXPECT_EQ(found(found_by(map, {0.5f, 0.5f, 0.5f}, 100)), 2000);
    EXPECT_EQ(found(found_by(map, {0.5f, 0.5f, 0.5f}, 1e25f)), 2000);
    EXPECT_EQ(found(found_by(map, {50, 0.5f, 0.5f}, 10)), 0);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_photons
