#include "renderer/rays/cloud_entries.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace photonproof::inline renderer_rays {
namespace {

/// Entries of distinct ellipsoids at distances from 1 to 9, many of them equally far.
std::vector<CloudEntry> random_entries(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<CloudEntry> all;
  for (std::uint32_t i = 0; i < count; ++i) all.push_back({static_cast<float>(1 + random() % 9), i % 3, i});
  return all;
}

TEST(cloud_entries, come_in_order_some_at_a_time_whatever_the_order_of_the_traversal) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    std::vector<CloudEntry> entries = random_entries(100, seed);
    std::vector<CloudEntry> sorted = entries;
    std::ranges::sort(sorted);
    std::vector<CloudEntry> found;
    CloudEntries kept;
    std::mt19937 random(seed);
    do {
      std::ranges::shuffle(entries, random);
      for (const CloudEntry& entry : entries) kept.take(entry);
      EXPECT_LE(kept.found().size(), CloudEntries::most);
      found.insert(found.end(), kept.found().begin(), kept.found().end());
    } while (kept.advance());
    EXPECT_EQ(found, sorted) << seed;
  }
}

TEST(cloud_entries, need_more_attention_only_behind_all_kept_ones) {
  CloudEntries kept;
  for (std::uint32_t i = 0; i < CloudEntries::most; ++i) EXPECT_TRUE(kept.take({static_cast<float>(2 * i), 0, i}));
  const auto last = static_cast<float>(2 * (CloudEntries::most - 1));
  EXPECT_FALSE(kept.take({last + 1, 0, 100}));
  EXPECT_TRUE(kept.take({last - 1, 0, 101})) << "takes the place of the last";
  EXPECT_EQ(kept.found().back().ellipsoid, 101u);
  EXPECT_FALSE(kept.take({last, 0, CloudEntries::most - 1})) << "which is behind all kept ones now";
}

TEST(cloud_entries, of_one_ellipsoid_count_once_with_the_nearer_distance) {
  CloudEntries kept;
  for (const float t : {2.0f, 1.0f, 3.0f}) EXPECT_TRUE(kept.take({t, 0, 7}));
  ASSERT_EQ(kept.found().size(), 1u);
  EXPECT_EQ(kept.found()[0].t, 1);
}

TEST(cloud_entries, begin_a_traversal_a_little_before_the_last_entry) {
  CloudEntries kept;
  EXPECT_EQ(kept.from(), 0);
  for (std::uint32_t i = 0; i < CloudEntries::most; ++i) kept.take({5, 0, i});
  EXPECT_TRUE(kept.advance());
  EXPECT_LT(kept.from(), 5);
  EXPECT_GT(kept.from(), 5 * (1 - 1e-6f));
}

TEST(cloud_entries, end_at_a_surface_and_keep_those_as_near_as_it) {
  CloudEntries kept;
  for (const float t : {1.0f, 2.0f, 2.5f, 3.0f}) kept.take({t, 0, static_cast<std::uint32_t>(10 * t)});
  kept.end_at(2);
  ASSERT_EQ(kept.found().size(), 2u);
  EXPECT_EQ(kept.found()[1].t, 2);
  EXPECT_FALSE(kept.advance()) << "fewer than a traversal finds: there are no more";
}

}  // namespace
}  // namespace photonproof::inline renderer_rays
