// The reader of clouds of ellipsoids, on files made here by the format's public description, and the shells.
#include "scenes/ellipsoids/ellipsoid_cloud.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>

#include "scenes/base/input_error.h"
#include "scenes/ellipsoids/ellipsoid_cloud_fuzz.h"
#include "scenes/ellipsoids/shell.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_ellipsoids {
namespace {

using Names = std::vector<std::string>;

const Names kBefore{"x", "y", "z", "nx", "ny", "nz"};
const Names kAfter{"scale_0", "scale_1", "scale_2", "rot_0", "rot_1", "rot_2", "rot_3"};

std::string head(const Names& names, std::size_t count, const std::string& format = "ascii") {
  std::string text = "ply\nformat " + format + " 1.0\nelement vertex " + std::to_string(count) + "\n";
  for (const std::string& name : names) text += "property float " + name + "\n";
  return text + "end_header\n";
}

Names names_with(const Names& between) {
  Names all = kBefore;
  all.insert(all.end(), between.begin(), between.end());
  all.insert(all.end(), kAfter.begin(), kAfter.end());
  return all;
}

const std::string kPlain = head(names_with({}), 1) + "1 2 3 0 0 0 0 0 0 1 0 0 0\n";

std::string message_of(const std::string& bytes) {
  try {
    parse_ellipsoids(bytes, "a.ply");
    return "";
  } catch (const InputError& error) {
    return error.summary();
  }
}

// A logit of 0 is an opacity of 1/2. The rotation of (w, x, y, z) = (0, 3, 0, 4) has length 5.
TEST(ellipsoid_cloud, of_splatting_has_activated_values_and_interleaved_harmonics) {
  Names between{"f_dc_0", "f_dc_1", "f_dc_2"};
  for (int i = 0; i < 9; ++i) between.push_back("f_rest_" + std::to_string(i));
  between.push_back("opacity");
  const std::string row = "1 2 3 9 9 9 .1 .2 .3 11 12 13 21 22 23 31 32 33 0 0.6931472 -1 -50 0 3 0 4\n";
  const EllipsoidCloud cloud = parse_ellipsoids(head(names_with(between), 1) + row, "a.ply");
  ASSERT_EQ(cloud.ellipsoids.size(), 1u);
  const Ellipsoid& e = cloud.ellipsoids[0];
  EXPECT_EQ(e.center, Vec3f(1, 2, 3));
  EXPECT_NEAR(e.scale.x, 2, 1e-6);
  EXPECT_NEAR(e.scale.y, std::exp(-1.0), 1e-6);
  EXPECT_FLOAT_EQ(e.scale.z, 1e-6f) << "the least";
  EXPECT_EQ(e.turn, (std::array<float, 4>{0.6f, 0, 0.8f, 0}));
  EXPECT_EQ(cloud.opacities, std::vector<float>{0.5f});
  EXPECT_EQ(cloud.coefficients, 4u);
  EXPECT_EQ(cloud.harmonics, (std::vector<Rgb>{{0.1f, 0.2f, 0.3f}, {11, 21, 31}, {12, 22, 32}, {13, 23, 33}}));
  EXPECT_TRUE(cloud.is_radiance_field());
}

TEST(ellipsoid_cloud, of_attributes_has_them_as_they_are) {
  const Names between{"albedo_0", "albedo_1", "opacities", "sh_coeffs_0", "sh_coeffs_1", "sh_coeffs_2"};
  const EllipsoidCloud cloud = parse_ellipsoids(
      head(names_with(between), 2) + "1 2 3 0 0 0 7 8 .25 4 5 6 0 0 0 1 0 0 0\n0 0 0 0 0 0 7 8 1 1 2 3 0 0 0 2 0 0 0",
      "a");
  EXPECT_EQ(cloud.opacities, (std::vector<float>{0.25f, 1}));
  EXPECT_EQ(cloud.harmonics, (std::vector<Rgb>{{4, 5, 6}, {1, 2, 3}}));
  EXPECT_EQ(cloud.ellipsoids[1].turn, (std::array<float, 4>{0, 0, 0, 1}));
  const EllipsoidCloud bare = parse_ellipsoids(kPlain, "a");
  EXPECT_FALSE(bare.is_radiance_field());
  EXPECT_TRUE(bare.opacities.empty() && bare.harmonics.empty());
}

TEST(ellipsoid_cloud, of_binary_files_is_that_of_text) {
  const EllipsoidCloud expected = parse_ellipsoids(kPlain, "a");
  const std::array<float, 13> row{1, 2, 3, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0};
  std::string little(reinterpret_cast<const char*>(row.data()), sizeof row), big;
  for (std::size_t i = 0; i < little.size(); i += 4)
    for (std::size_t k = 4; k-- > 0;) big += little[i + k];
  EXPECT_EQ(parse_ellipsoids(head(names_with({}), 1, "binary_little_endian") + little, "a"), expected);
  EXPECT_EQ(parse_ellipsoids(head(names_with({}), 1, "binary_big_endian") + big, "a"), expected);
}

TEST(ellipsoid_cloud, that_is_damaged_is_refused_at_its_place) {
  const auto rows = [](const std::string& text) { return head(names_with({}), 1) + text; };
  EXPECT_EQ(message_of(kPlain), "");
  EXPECT_EQ(message_of(rows("1 2 nan 0 0 0 0 0 0 1 0 0 0\n")),
            "a.ply:18:5: error: vertex 0 has the value nan, expected finite numbers that fit single precision");
  EXPECT_EQ(message_of(rows("1 2 3 0 0 0 0 0 89 1 0 0 0\n")),
            "a.ply:18:26: error: vertex 0 has the scale e^89, expected one that fits single precision");
  EXPECT_EQ(message_of(rows("1 2 3 0 0 0 0 0 0 0 0 0 0\n")),
            "a.ply:18:25: error: vertex 0 has a rotation of length 0, expected a quaternion");
  EXPECT_EQ(message_of(rows("11 22 33 0 0 0 0 0 0 1 0 0\n")), "a.ply:19:1: error: the file ends within vertex 0");
  EXPECT_EQ(message_of(head(names_with({}), 9) + "1 2"),
            "a.ply:3:1: error: element 'vertex' has 9 rows of at least 26 bytes each, more than the rest of the file: "
            "it is truncated or its header is wrong");
  EXPECT_EQ(message_of(head(names_with({}), 0)), "a.ply:3:1: error: has no ellipsoids, expected one or more");
  EXPECT_EQ(message_of(head({"x", "y", "z"}, 1) + "0 0 0"),
            "a.ply:3:1: error: element 'vertex' has 3 properties, expected x y z nx ny nz ... scale_0 to scale_2, "
            "rot_0 to rot_3");
  Names turned = names_with({});
  std::swap(turned[7], turned[8]);
  EXPECT_EQ(message_of(head(turned, 1)), "a.ply:11:1: error: property 'scale_2' stands in the place of 'scale_1'");
  EXPECT_EQ(message_of("ply\nformat ascii 1.0\nend_header\n"), "a.ply: error: has no elements, expected ellipsoids");
}

TEST(ellipsoid_cloud, of_wrong_attributes_is_refused) {
  const auto with = [](const Names& between, const std::string& values) {
    return message_of(head(names_with(between), 1) + "1 2 3 0 0 0 " + values + " 0 0 0 1 0 0 0\n");
  };
  EXPECT_EQ(with({"opacities"}, "1.5"), "a.ply:19:29: error: vertex 0 has the opacity 1.5, expected from 0 to 1");
  EXPECT_EQ(with({"opacities_0", "opacities_1"}, "1 1"), "a.ply:10:1: error: 'opacities' has 2 values, expected one");
  EXPECT_EQ(with({"sh_coeffs_0", "sh_coeffs_1", "sh_coeffs_2", "sh_coeffs_3"}, "1 1 1 1"),
            "a.ply:10:1: error: there are 4 values of spherical harmonics, expected 3, 12, 27, 48 or another 3 n^2 up "
            "to 243");
  EXPECT_EQ(with({"sh_coeffs_0", "a", "sh_coeffs_1"}, "1 1 1"),
            "a.ply:12:1: error: property 'sh_coeffs_1' is apart from the others of 'sh_coeffs'");
  EXPECT_EQ(with({"f_dc_0", "f_dc_1", "opacity"}, "1 1 1"),
            "a.ply:10:1: error: there are 2 values of spherical harmonics, expected 3, 12, 27, 48 or another 3 n^2 up "
            "to 243");
  std::string whole = kPlain;
  whole.replace(whole.find("float nx"), 5, "uchar");
  EXPECT_EQ(message_of(whole), "a.ply:7:1: error: property 'nx' is not of type float or double");
}

TEST(ellipsoid_cloud, corpus_gives_sound_clouds_or_messages) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_CORPORA "/ellipsoid_cloud_corpus")) {
    EXPECT_EQ(check_ellipsoids(read_file(entry.path())), "") << entry.path();
    ++files;
  }
  EXPECT_GE(files, 8);
}

TEST(ellipsoid_cloud, of_any_bytes_is_sound_or_one_message) {
  for (std::size_t size = 0; size <= kPlain.size(); ++size) {
    EXPECT_EQ(check_ellipsoids(std::string_view(kPlain).substr(0, size)), "") << size;
    for (int bit = 0; bit < 8 && size < kPlain.size(); ++bit) {
      std::string bent = kPlain;
      bent[size] = static_cast<char>(bent[size] ^ (1 << bit));
      EXPECT_EQ(check_ellipsoids(bent), "") << size << " bit " << bit;
    }
  }
}

// A closed surface has each edge once in either direction. Half an edge of the box is that of Mitsuba's: the centroid
// (1/3, 1, 1/3) of a triangle of the cube is sqrt(11)/3 from the middle.
TEST(shell, is_closed_around_the_unit_ball_with_its_front_outside) {
  for (const auto& [shell, faces] :
       {std::pair{Shell::ico_sphere, 20u}, std::pair{Shell::box, 12u}, std::pair{Shell::uv_sphere, 72u}}) {
    const TriangleMesh mesh = unit_shell(shell);
    EXPECT_EQ(mesh.triangles.size(), faces);
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    float least = 10;
    for (const auto& t : mesh.triangles) {
      const Vec3f a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
      EXPECT_GT(dot(cross(b - a, c - a), a + b + c), 0);
      for (std::size_t k = 0; k < 3; ++k) ++edges[{t[k], t[(k + 1) % 3]}];
      least = std::min({least, length(a), length(b), length(c), length(a + b + c) / 3});
    }
    EXPECT_NEAR(least, 1, 1e-6);
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
    }
  }
  EXPECT_NEAR(std::abs(unit_shell(Shell::box).positions[0].x), 3 / std::sqrt(11.0), 1e-6);
}

}  // namespace
}  // namespace photonproof::inline scenes_ellipsoids
