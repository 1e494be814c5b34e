// The kd-tree's nearest photons against brute force: the same photons in the same order, ties included.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "renderer/photons/test_photon_clouds.h"
#include "renderer/photons/test_photon_kdtree.h"

namespace photonproof::inline renderer_photons {
namespace {

using Neighbour = PhotonKdTree::Neighbour;

std::vector<Neighbour> nearest(const PhotonKdTree& tree, const Vec3f& p, float max_radius, std::size_t k) {
  std::vector<Neighbour> found(k);
  found.resize(tree.nearest(p, max_radius, found));
  return found;
}

std::vector<Neighbour> nearest_by_brute_force(const Photons& photons, const Vec3f& p, float max_radius, std::size_t k) {
  std::vector<float> distances(photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i) distances[i] = distance_squared(photons, i, p);
  std::vector<Neighbour> all;
  for (std::uint32_t i = 0; i < photons.size(); ++i)
    if (distances[i] <= max_radius * max_radius) all.push_back({distances[i], i});
  const std::size_t kept = std::min(k, all.size());
  std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(kept));
  all.resize(kept);
  return all;
}

class PhotonKdTreeOf : public testing::TestWithParam<Cloud> {};

TEST_P(PhotonKdTreeOf, hundred_thousand_queries_find_exactly_what_brute_force_finds) {
  const Photons photons = make_cloud(GetParam(), 500);
  const PhotonKdTree tree(photons, Threads(1));
  for (std::uint64_t q = 0; q < 100'000; ++q) {
    const Vec3f p = query_point(GetParam(), photons, q);
    const std::size_t k = q % 7 == 0 ? 50 : q % 11;
    // Often exactly the distance of some photon.
    const float radius = q % 3 == 0 ? 1e9f : std::sqrt(distance_squared(photons, q % 100, p));
    ASSERT_EQ(nearest(tree, p, radius, k), nearest_by_brute_force(photons, p, radius, k)) << q;
  }
}

TEST_P(PhotonKdTreeOf, deep_trees_and_many_neighbours_are_exact_too) {
  const Photons photons = make_cloud(GetParam(), 20'000);
  const PhotonKdTree tree(photons, Threads(2));
  for (std::uint64_t q = 0; q < 60; ++q) {
    const Vec3f p = query_point(GetParam(), photons, q);
    for (const std::size_t k : {1, 50, 65, 1000, 30'000}) {
      const float radius = q % 2 == 0 ? 1e9f : 0.2f;
      ASSERT_EQ(nearest(tree, p, radius, k), nearest_by_brute_force(photons, p, radius, k)) << q;
    }
  }
}

TEST_P(PhotonKdTreeOf, any_number_of_threads_gives_the_same_answers) {
  const Photons photons = make_cloud(GetParam(), 30'000);
  const PhotonKdTree one(photons, Threads(1));
  for (const int count : {2, 7}) {
    const PhotonKdTree many(photons, Threads(count));
    for (std::uint64_t q = 0; q < 500; ++q) {
      const Vec3f p = query_point(GetParam(), photons, q);
      ASSERT_EQ(nearest(many, p, 1, 20), nearest(one, p, 1, 20));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(photon_kdtree, PhotonKdTreeOf, testing::ValuesIn(all_clouds),
                         [](const auto& cloud) { return name_of(cloud.param); });

TEST(photon_kdtree, equally_near_photons_come_in_the_order_of_their_indices) {
  // A 9 x 9 x 9 lattice seen from its middle: shells of up to 24 photons at one distance.
  Photons photons;
  for (int i = 0; i < 729; ++i) {
    const Vec3f p(Vec3<int>(i * 7 % 9, i * 7 / 9 % 9, i / 81));
    photons.push_back({p, Rgb(1), 0, 1});
  }
  const PhotonKdTree tree(photons, Threads(1));
  for (std::size_t k = 1; k < 200; ++k)
    EXPECT_EQ(nearest(tree, {4, 4, 4}, 100, k), nearest_by_brute_force(photons, {4, 4, 4}, 100, k));
}

TEST(photon_kdtree, without_photons_or_with_one_answers_what_there_is) {
  EXPECT_TRUE(nearest(PhotonKdTree(), {0, 0, 0}, 1, 5).empty());
  EXPECT_TRUE(nearest(PhotonKdTree({}, Threads(1)), {0, 0, 0}, 1, 5).empty());
  Photons photons;
  photons.push_back({{1, 2, 3}, Rgb(1), 7, 1});
  const PhotonKdTree tree(photons, Threads(1));
  EXPECT_EQ(nearest(tree, {1.5f, 2, 3}, 0.5f, 5), (std::vector<Neighbour>{{0.25f, 0}}));
  EXPECT_TRUE(nearest(tree, {std::nextafter(1.5f, 2.0f), 2, 3}, 0.5f, 5).empty());
  EXPECT_TRUE(nearest(tree, {1, 2, 3}, 1, 0).empty());
}

TEST(photon_kdtree, agrees_with_brute_force_at_the_limits_of_floats) {
  constexpr float most = std::numeric_limits<float>::max();
  Photons photons;
  for (const float a :
       {0.0f, std::numeric_limits<float>::denorm_min(), -1e-30f, 1e-20f, 1.0f, -1e6f, 1e19f, most, -most})
    for (const float b : {0.0f, 1.0f, 1e18f, -most})
      for (const float c : {0.0f, -1e-22f, most}) photons.push_back({{a, b, c}, Rgb(1), 0, 1});
  const PhotonKdTree tree(photons, Threads(1));
  for (std::size_t i = 0; i < photons.size(); ++i)
    for (const float radius : {0.0f, 1e-30f, 1.0f, 1e18f, 3e38f}) {
      const Vec3f p = photons[i].p_world;
      EXPECT_EQ(nearest(tree, p, radius, 10), nearest_by_brute_force(photons, p, radius, 10)) << i << " " << radius;
    }
}

}  // namespace
}  // namespace photonproof::inline renderer_photons
