// Areas that footprints on a flat shape cover, compared bit for bit with testing all footprints.

#include "renderer/areas/covered_part.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "renderer/areas/test_random_solids.h"

namespace photonproof::inline renderer_areas {
namespace {

using test::Random;

const Quad floor_of_8{{-4, 0, -4}, {0, 0, 8}, {8, 0, 0}, {0, 1, 0}, 64};

std::vector<Footprint> footprints_of(const std::vector<Solid>& solids) {
  std::vector<Footprint> found;
  for (const Solid& solid : solids)
    if (const std::optional<Footprint> f = Footprint::of(solid, floor_of_8)) found.push_back(*f);
  return found;
}

/// The largest of overlapping footprints, by all pairs.
std::vector<Footprint> apart_by_pairs(std::vector<Footprint> found) {
  std::ranges::stable_sort(found, std::ranges::greater{}, [](const Footprint& f) { return f.area(); });
  std::vector<Footprint> apart;
  for (const Footprint& f : found)
    if (std::ranges::none_of(apart, [&](const Footprint& larger) { return f.overlaps(larger); })) apart.push_back(f);
  return apart;
}

TEST(covered_part, is_the_same_number_as_from_all_footprints) {
  std::size_t covered = 0, kept = 0, all = 0;
  for (std::uint64_t seed = 0; seed < 14; ++seed) {
    Random random(seed);
    std::vector<Solid> solids = test::random_solids(random, 10 + 10 * seed);
    for (Solid& solid : solids) solid.middle.y *= 0.1;
    const std::vector<Footprint> found = footprints_of(solids), apart = apart_by_pairs(found);
    const CoveredPart part(found);
    ASSERT_EQ(part.footprints().size(), apart.size()) << seed;
    all += found.size();
    kept += apart.size();
    for (int i = 0; i < 200; ++i) {
      Vec3d p = test::random_place(random, 5);
      p.y = 0;
      // Up to all of the floor, where more footprints are near than a search keeps.
      const double radius = 8 * double{random.next()} * double{random.next()} * double{random.next()};
      double expected = 3;
      for (const Footprint& f : apart) expected -= f.in_disc(p, radius);
      ASSERT_EQ(part.left_of(3, p, radius), expected) << seed << " " << p.x << " " << p.z << " " << radius;
      covered += expected < 3 ? 1 : 0;
    }
  }
  EXPECT_GT(covered, 400);
  EXPECT_LT(kept, all * 9 / 10) << "some overlap";
}

TEST(covered_part, looks_at_as_many_footprints_beside_any_number_of_solids) {
  // Balls at distances of 1, and discs at their middles that meet no other.
  const auto near_with = [](int side) {
    std::vector<Footprint> found;
    for (int i = 0; i < side * side; ++i) {
      const Solid ball{Vec3d(i % side, 0.1, i / side), {}, 0.25};
      found.push_back(*Footprint::of(ball, renderer_shapes::Plane{{0, 0, 0}, {0, 1, 0}}));
    }
    const CoveredPart part(std::move(found));
    std::size_t near = 0;
    CoveredPart::Near found_near;
    for (int i = 0; i < side * side; ++i) near += part.near(Vec3d(i % side, 0, i / side), 0.3, found_near);
    return static_cast<double>(near) / (side * side);
  };
  EXPECT_LE(near_with(8), 4);  // a leaf of the tree
  EXPECT_LE(near_with(32), 4);
}

}  // namespace
}  // namespace photonproof::inline renderer_areas
