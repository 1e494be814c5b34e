#include "scenes/meshes/obj.h"

#include <gtest/gtest.h>

#include "scenes/base/input_error.h"

namespace photonproof::inline scenes_meshes {
namespace {

TriangleMesh parse(const std::string& text) { return parse_obj(text, "a.obj"); }

std::string message(const std::string& text) {
  try {
    parse(text);
    return "no error";
  } catch (const InputError& error) {
    return error.summary();
  }
}

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
using Triangles = std::vector<TriangleMesh::Triangle>;

TEST(obj, gives_vertices_in_the_order_of_their_first_use) {
  const TriangleMesh mesh = parse(kTriangle + "f 3 1 2\n");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 1, 0}, {0, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
  EXPECT_TRUE(mesh.is_padded());
}

TEST(obj, counts_negative_indices_back_from_what_was_read_so_far) {
  const TriangleMesh mesh = parse(kTriangle + "f -3 -2 -1\nv 5 5 5\nf -4 -3 -1\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 1, 3}}));
  EXPECT_EQ(mesh.positions[3], Vec3f(5, 5, 5));
}

TEST(obj, cuts_polygons_into_fans) {
  const TriangleMesh mesh = parse("v 0 0 0\nv 1 0 0\nv 2 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5\n");
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}));
}

TEST(obj, makes_a_vertex_of_every_combination_once) {
  const TriangleMesh mesh = parse(kTriangle +
                                  "vt 0 0\nvt 1 0.5 7\nvn 0 0 1\nvn 0 0 -2\n"
                                  "f 1/1/1 2/2/1 3/1/1\nf 1/1/1 3/1/1 2/2/2\nf 1/2/1 2/2/1 3/1/1\n");
  // 1/1/1, 2/2/1, 3/1/1, then 2/2/2, then 1/2/1.
  ASSERT_EQ(mesh.positions.size(), 5u);
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}, {4, 1, 2}}));
  EXPECT_EQ(mesh.positions[3], mesh.positions[1]);
  EXPECT_EQ(mesh.normals[3], Vec3f(0, 0, -2));
  EXPECT_EQ(mesh.uvs[4], (Vec2<float>{1, 0.5f}));
}

TEST(obj, keeps_normals_only_when_every_corner_has_one) {
  EXPECT_EQ(parse(kTriangle + "vn 0 0 1\nf 1//1 2//1 3//1\n").normals.size(), 3u);
  EXPECT_TRUE(parse(kTriangle + "vn 0 0 1\nf 1//1 2//1 3\n").normals.empty());
}

TEST(obj, gives_corners_without_a_texture_coordinate_zero) {
  const TriangleMesh mesh = parse(kTriangle + "vt 0.5 0.5\nf 1/1 2 3\n");
  EXPECT_EQ(mesh.uvs, (std::vector<Vec2<float>>{{0.5f, 0.5f}, {0, 0}, {0, 0}}));
}

TEST(obj, skips_what_it_does_not_know) {
  EXPECT_EQ(parse("# by hand\nmtllib a.mtl\no thing\n" + kTriangle + "usemtl red\ns off\nf 1 2 3 # end\r\n").triangles,
            (Triangles{{0, 1, 2}}));
}

TEST(obj, takes_numbers_that_are_too_small_for_zero) {
  EXPECT_EQ(parse("v 0 0 -1e-400\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").positions[0], Vec3f(0, 0, 0));
}

TEST(obj, skips_a_byte_order_mark) {
  EXPECT_EQ(parse("\xEF\xBB\xBF" + kTriangle + "f 1 2 3\n").triangles, (Triangles{{0, 1, 2}}));
}

TEST(obj, says_what_is_wrong_and_where) {
  EXPECT_EQ(message(""), "a.obj: error: has no faces, expected at least one");
  EXPECT_EQ(message("v 1 2\n"), "a.obj:1:6: error: a vertex has too few numbers");
  EXPECT_EQ(message("v 1 2 x\n"), "a.obj:1:7: error: a vertex has 'x', expected a number");
  EXPECT_EQ(message("v 1 2 nan\n"),
            "a.obj:1:7: error: a vertex has 'nan', expected a finite number of single precision");
  EXPECT_EQ(message("v 1 2 1e40\n"),
            "a.obj:1:7: error: a vertex has '1e40', expected a finite number of single precision");
  EXPECT_EQ(message("v 1 2 -1e400\n"),
            "a.obj:1:7: error: a vertex has '-1e400', expected a finite number of single precision");
  EXPECT_EQ(message(kTriangle + "f 1 2\n"), "a.obj:4:1: error: a face has 2 corners, expected at least 3");
  EXPECT_EQ(message(kTriangle + "f 1 2 4\n"), "a.obj:4:7: error: a face names vertex 4 of 3");
  EXPECT_EQ(message(kTriangle + "f 1 2 -4\n"), "a.obj:4:7: error: a face names vertex -4 of 3");
  EXPECT_EQ(message(kTriangle + "f 0 1 2\n"), "a.obj:4:3: error: a face names vertex 0 of 3");
  EXPECT_EQ(message(kTriangle + "f 1/1 2/1 3/1\n"), "a.obj:4:3: error: a face names texture coordinate 1 of 0");
  EXPECT_EQ(message(kTriangle + "f 1//1 2 3\n"), "a.obj:4:3: error: a face names normal 1 of 0");
  EXPECT_EQ(message(kTriangle + "f a 2 3\n"), "a.obj:4:3: error: a face has 'a', expected the number of a vertex");
  EXPECT_EQ(message(kTriangle + "f 99999999999999999999 2 3\n"),
            "a.obj:4:3: error: a face has '99999999999999999999', expected the number of a vertex");
}

}  // namespace
}  // namespace photonproof::inline scenes_meshes
