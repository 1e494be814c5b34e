#include "scenes/generators/terrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scenes/meshes/icosphere.h"
#include "scenes/meshes/test_mesh_checks.h"

namespace photonproof::inline scenes_generators {
namespace {

TEST(icosphere, is_a_closed_sphere_at_every_level) {
  for (int level = 0; level <= 4; ++level) {
    const Icosphere ball = make_icosphere(level);
    const std::size_t faces = std::size_t{20} << (2 * level);
    EXPECT_EQ(ball.triangles.size(), faces);
    EXPECT_EQ(ball.directions.size(), faces / 2 + 2) << "Euler: V - E + F = 2 with E = 3/2 F";
    const EdgeCounts edges = count_edges(ball.triangles);
    EXPECT_EQ(edges.inner, faces * 3 / 2);
    EXPECT_EQ(edges.border + edges.bad, 0u);
    for (const Vec3d& d : ball.directions) EXPECT_NEAR(length(d), 1, 1e-15);
    for (const auto& [a, b, c] : ball.triangles)
      EXPECT_GT(dot(cross(ball.directions[b] - ball.directions[a], ball.directions[c] - ball.directions[a]),
                    ball.directions[a]),
                0)
          << "outward";
  }
}

TEST(terrain, ground_is_one_sheet_that_faces_up) {
  const std::uint32_t columns = 30, rows = 40;
  const TriangleMesh mesh = make_ground(columns, rows);
  EXPECT_TRUE(mesh.is_padded());
  EXPECT_EQ(mesh.triangles.size(), 2u * columns * rows);
  EXPECT_EQ(mesh.positions.size(), (columns + 1u) * (rows + 1u));
  const EdgeCounts edges = count_edges(mesh.triangles);
  EXPECT_EQ(edges.border, 2u * (columns + rows));
  EXPECT_EQ(edges.bad, 0u);
  for (const auto& t : mesh.triangles) EXPECT_GT(normal_of(mesh, t).y, 0);
}

TEST(terrain, ground_spans_its_square_and_is_of_landscape_height) {
  const TriangleMesh mesh = make_ground(64, 64);
  EXPECT_EQ(mesh.positions.front().x, -10);
  EXPECT_EQ(mesh.positions.front().z, -10);
  EXPECT_EQ(mesh.positions.back().x, 10);
  EXPECT_EQ(mesh.positions.back().z, 10);
  for (const Vec3f& p : mesh.positions) {
    EXPECT_GT(p.y, -3);
    EXPECT_LT(p.y, 7);
  }
}

TEST(terrain, finer_ground_is_the_same_landscape) {
  const TriangleMesh coarse = make_ground(10, 10), fine = make_ground(20, 20);
  for (std::size_t j = 0; j <= 10; ++j)
    for (std::size_t i = 0; i <= 10; ++i)
      EXPECT_EQ(coarse.positions[j * 11 + i], fine.positions[2 * j * 21 + 2 * i]) << i << " " << j;
}

TEST(terrain, rocks_are_closed_face_outward_and_lie_on_the_ground) {
  const std::uint32_t count = 50;
  const TriangleMesh mesh = make_rocks(count, 2);
  ASSERT_EQ(mesh.triangles.size(), count * 320u);
  ASSERT_EQ(mesh.positions.size(), count * 162u);
  EXPECT_TRUE(mesh.is_padded());
  const EdgeCounts edges = count_edges(mesh.triangles);
  EXPECT_EQ(edges.inner, count * 480u);
  EXPECT_EQ(edges.border + edges.bad, 0u);
  for (std::uint32_t rock = 0; rock < count; ++rock) {
    // The divergence theorem: a closed surface that faces outward has a positive volume.
    double volume = 0;
    for (std::size_t i = rock * 320; i < (rock + 1) * 320; ++i)
      volume += dot(Vec3d(mesh.positions[mesh.triangles[i][0]]), normal_of(mesh, mesh.triangles[i])) / 6;
    EXPECT_GT(volume, 0) << rock;
    double lowest = 1e9, highest = -1e9;
    for (std::size_t i = rock * 162; i < (rock + 1) * 162; ++i) {
      const Vec3f p = mesh.positions[i];
      const double above = p.y - ground_height(p.x, p.z);
      lowest = std::min(lowest, above);
      highest = std::max(highest, above);
      EXPECT_LT(std::abs(p.x), kTerrainHalfSize);
      EXPECT_LT(std::abs(p.z), kTerrainHalfSize);
    }
    EXPECT_LT(lowest, 0) << "it does not float";
    EXPECT_GT(highest, 0) << "it is not buried";
  }
}

TEST(terrain, is_the_same_to_the_bit_on_every_machine) {
  EXPECT_EQ(fingerprint(make_ground(40, 30)), 1754669091946380866u);
  EXPECT_EQ(fingerprint(make_rocks(5, 1)), 6977343288848052171u);
}

}  // namespace
}  // namespace photonproof::inline scenes_generators
