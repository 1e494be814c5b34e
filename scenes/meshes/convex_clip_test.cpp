#include "scenes/meshes/convex_clip.h"

#include <gtest/gtest.h>

#include <array>

namespace photonproof::inline scenes_meshes {
namespace {

const std::vector<Vec3d> square{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};

TEST(ConvexClip, keeps_what_is_inside_every_half_space) {
  // x <= 1 and y <= 1.5 leave 1 x 1.5.
  const std::array<HalfSpace, 2> region{{{{1, 0, 0}, 1}, {{0, 1, 0}, 1.5}}};
  EXPECT_DOUBLE_EQ(polygon_area(clip_polygon(square, region)), 1.5);
}

TEST(ConvexClip, a_corner_cut_off_leaves_five_vertices) {
  // x + y <= 3 cuts a triangle of area 1/2 off the square of area 4.
  const std::array<HalfSpace, 1> region{{{{1, 1, 0}, 3}}};
  const std::vector<Vec3d> left = clip_polygon(square, region);
  EXPECT_EQ(left.size(), 5u);
  EXPECT_DOUBLE_EQ(polygon_area(left), 3.5);
}

TEST(ConvexClip, nothing_is_left_of_a_polygon_outside) {
  const std::array<HalfSpace, 1> region{{{{0, 0, 1}, -1}}};
  EXPECT_TRUE(clip_polygon(square, region).empty());
  EXPECT_EQ(polygon_area({}), 0);
}

TEST(ConvexClip, distance_to_a_parallelogram_is_to_its_face_edge_or_corner) {
  const Vec3d corner{0, 0, 0}, u{2, 0, 0}, v{1, 1, 0};
  EXPECT_DOUBLE_EQ(distance_to_parallelogram({1.5, 0.5, -3}, corner, u, v), 3) << "over the face";
  EXPECT_DOUBLE_EQ(distance_to_parallelogram({1, -4, 3}, corner, u, v), 5) << "beside the edge y = 0: 3, 4, 5";
  EXPECT_DOUBLE_EQ(distance_to_parallelogram({4, 5, 3}, corner, u, v), std::sqrt(1. + 16 + 9)) << "past corner (3,1,0)";
}

TEST(ConvexClip, distance_to_a_triangle_is_to_its_face_edge_or_corner) {
  const std::array<Vec3d, 3> triangle{{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}};
  EXPECT_DOUBLE_EQ(distance_to_triangle({0.5, 0.5, -3}, triangle), 3) << "over the face";
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, -4, 3}, triangle), 5) << "beside the edge y = 0: 3, 4, 5";
  EXPECT_DOUBLE_EQ(distance_to_triangle({2, 2, 1}, triangle), std::sqrt(3.)) << "past the middle (1,1,0) of an edge";
  EXPECT_DOUBLE_EQ(distance_to_triangle({-3, -4, 12}, triangle), 13) << "past the corner at the origin";
}

TEST(ConvexClip, distance_to_a_triangle_without_area_is_to_its_edges) {
  EXPECT_DOUBLE_EQ(distance_to_triangle({1, 2, 0}, {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}}), 2);
  EXPECT_DOUBLE_EQ(distance_to_triangle({3, 4, 0}, {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}}), 5);
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
