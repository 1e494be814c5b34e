// Searches in trees of boxes, compared with testing every pair. Their work is counted at n and at 4 n.

#include "renderer/areas/solid_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/areas/growing_boxes.h"
#include "renderer/areas/test_random_solids.h"

namespace photonproof::inline renderer_areas {
namespace {

using test::Random;

/// Boxes of lights: small, flat, points, large ones around solids, and an empty one.
std::vector<ShapeBox> random_boxes(Random& random, std::size_t count) {
  std::vector<ShapeBox> boxes(1);
  while (boxes.size() < count) {
    const Vec3f middle(test::random_place(random, 4));
    const double kind = double{random.next()};
    const auto size = static_cast<float>(kind < 0.2 ? 0 : kind < 0.9 ? 0.2 * kind : 2 * kind);
    const Vec3f half{size * random.next(), kind > 0.7 ? 0 : size * random.next(), size * random.next()};
    boxes.push_back({middle - half, middle + half});
  }
  return boxes;
}

TEST(solid_search, finds_a_box_in_a_solid_where_testing_all_boxes_does) {
  std::size_t found = 0, tested = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    Random random(seed);
    const std::vector<Solid> solids = test::random_solids(random, 40);
    const std::vector<ShapeBox> boxes = random_boxes(random, 1 + 30 * seed);
    const HeldBoxes search(boxes);
    for (const Solid& solid : solids) {
      const bool any = std::ranges::any_of(boxes, [&](const ShapeBox& box) { return holds_part(solid, box); });
      ASSERT_EQ(search.any_in(solid), any) << seed << ": " << boxes.size() << " boxes";
      found += any ? 1 : 0;
      ++tested;
    }
  }
  EXPECT_GT(found, tested / 20);
  EXPECT_LT(found, tested * 9 / 10);
}

TEST(solid_search, leaves_out_no_solid_with_a_footprint) {
  std::size_t footprints = 0, candidates = 0, pairs = 0;
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    Random random(seed);
    const std::vector<Solid> solids = test::random_solids(random, 120);
    const SolidTree tree(solids);
    for (int i = 0; i < 12; ++i) {
      const auto compare = [&](const auto& flat) {
        const std::vector<std::uint32_t> near = tree.near_flat(FlatBounds(flat));
        EXPECT_TRUE(std::ranges::is_sorted(near));
        for (std::uint32_t k = 0; k < solids.size(); ++k) {
          const bool has_footprint = Footprint::of(solids[k], flat).has_value();
          EXPECT_TRUE(!has_footprint || std::ranges::binary_search(near, k)) << seed << " " << k;
          footprints += has_footprint ? 1 : 0;
        }
        candidates += near.size();
        pairs += solids.size();
      };
      const Quad quad = test::random_quad(random, solids);
      compare(quad);
      compare(renderer_shapes::Plane{Vec3d(quad.corner), normalize(Vec3d(quad.normal))});
    }
  }
  EXPECT_GT(footprints, 1000);
  EXPECT_LT(candidates, 3 * footprints) << "the search leaves out most others";
  EXPECT_LT(candidates, pairs / 4);
}

TEST(solid_search, holds_what_has_a_corner_or_the_middle_in_it_or_is_around_its_middle) {
  const Solid ball{{1, 2, 3}, {}, 0.5}, cube{{1, 2, 3}, {Vec3d(0.5, 0, 0), Vec3d(0, 0.5, 0), Vec3d(0, 0, 0.5)}, 0};
  for (const Solid& solid : {ball, cube}) {
    for (const float x : {-1.0f, 1.0f})
      for (const float y : {-1.0f, 1.0f})
        for (const float z : {-1.0f, 1.0f}) {
          const Vec3f inner = Vec3f(1, 2, 3) + Vec3f(x, y, z) * 0.2f, outer = Vec3f(1, 2, 3) + Vec3f(x, y, z) * 3.0f;
          ShapeBox corner;
          corner.add(inner);
          corner.add(outer);
          EXPECT_TRUE(holds_part(solid, corner)) << x << y << z;
        }
    EXPECT_TRUE(holds_part(solid, {{1, 1, 3}, {1, 3, 3}})) << "the middle of a rod";
    EXPECT_TRUE(holds_part(solid, {{0, 1.4f, 2}, {2, 9, 9}})) << "around it";
    EXPECT_FALSE(holds_part(solid, {{0, 1.4f, 3.1f}, {2, 9, 9}})) << "beside its middle";
    EXPECT_FALSE(holds_part(solid, {{1.6f, 2, 3}, {2, 3, 4}}));
  }
}

TEST(solid_search, tests_a_few_boxes_for_each_solid_however_many_there_are) {
  // A grid of balls and turned cubes, and a small box beside each: none holds one, so that no search ends early.
  const auto tests_with = [](int side) {
    std::vector<ShapeBox> boxes;
    std::vector<Solid> solids;
    for (int i = 0; i < side * side; ++i) {
      const Vec3d at(i % side, 0, i / side);
      solids.push_back({at, {}, 0.3});
      solids.push_back({at, {Vec3d(0.2, 0, 0.2), Vec3d(-0.2, 0, 0.2), Vec3d(0, 0.3, 0)}, 0});
      boxes.push_back({Vec3f(at) + Vec3f(0.4f, 0, 0.4f), Vec3f(at) + Vec3f(0.45f, 0.1f, 0.45f)});
    }
    const HeldBoxes search(boxes);
    std::size_t tests = 0;
    for (const Solid& solid : solids) {
      search.any_near(SolidBounds(solid), [&](const ShapeBox& box) {
        ++tests;
        return holds_part(solid, box);
      });
    }
    return static_cast<double>(tests) / static_cast<double>(solids.size());
  };
  const double few = tests_with(16), many = tests_with(32);
  EXPECT_GT(few, 0);
  EXPECT_LE(few, 8);
  EXPECT_LE(many, few * 1.1);
}

TEST(solid_search, gives_a_flat_shape_the_solids_that_it_cuts_alone) {
  // Rods in a grid, and a tile across each: 4 n solids take 4 times as many tests.
  const auto near_with = [](int side) {
    std::vector<Solid> solids;
    for (int i = 0; i < side * side; ++i)
      solids.push_back({Vec3d(i % side, 0, i / side), {Vec3d(0.2, 0, 0), Vec3d(0, 3, 0), Vec3d(0, 0, 0.2)}, 0});
    const SolidTree tree(solids);
    std::size_t near = 0;
    for (int i = 0; i < side * side; ++i) {
      const Vec3f corner(static_cast<float>(i % side) - 0.4f, 0, static_cast<float>(i / side) - 0.4f);
      near += tree.near_flat(FlatBounds(Quad{corner, {0, 0, 0.8f}, {0.8f, 0, 0}, {0, 1, 0}, 0.64f})).size();
    }
    return near;
  };
  EXPECT_EQ(near_with(16), 256);
  EXPECT_EQ(near_with(32), 1024);
}

TEST(solid_search, visits_a_number_of_boxes_that_grows_with_the_logarithm) {
  const auto visited_with = [](int side) {
    std::vector<BoxTree::Part> parts;
    for (int i = 0; i < side * side; ++i) {
      const Vec3f at(static_cast<float>(i % side), 0, static_cast<float>(i / side));
      parts.push_back(part_of_box({at, at + Vec3f(0.5f)}));
    }
    std::vector<std::uint32_t> order;
    const BoxTree tree(parts, order);
    int visited = 0, found = 0;
    const Vec3f middle(static_cast<float>(side / 2), 0, static_cast<float>(side / 2));
    const ShapeBox wanted{middle, middle + Vec3f(0.25f)};
    tree.visit(
        [&](const ShapeBox& box) {
          ++visited;
          return boxes_meet(box, wanted);
        },
        [&](std::uint32_t place) { found += boxes_meet(parts[order[place]].box, wanted) ? 1 : 0; });
    EXPECT_EQ(found, 1);
    return visited;
  };
  // Two levels more, each with two boxes, for one way down; half a box of slack beside it.
  EXPECT_LE(visited_with(64), visited_with(32) + 8);
  EXPECT_LE(visited_with(128), 64);
}

TEST(growing_boxes, find_what_testing_all_boxes_finds_while_they_grow) {
  Random random(7);
  const std::vector<ShapeBox> boxes = random_boxes(random, 700);
  GrowingBoxes growing;
  for (std::uint32_t i = 0; i < boxes.size(); ++i) {
    std::vector<std::uint32_t> expected, found;
    for (std::uint32_t k = 0; k < i; ++k)
      if (boxes_meet(boxes[i], boxes[k])) expected.push_back(k);
    growing.any_of(boxes[i], [&](std::uint32_t k) {
      found.push_back(k);
      return false;
    });
    std::ranges::sort(found);
    ASSERT_EQ(found, expected) << i;
    growing.add(boxes[i], i);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_areas
