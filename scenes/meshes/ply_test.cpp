#include "scenes/meshes/ply.h"

#include <gtest/gtest.h>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_meshes {
namespace {

const std::string kCorpus = PHOTONPROOF_CORPORA "/ply_corpus/";

const std::string kVertices = "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
const std::string kFaces = "element face 1\nproperty list uchar int vertex_indices\n";
const std::string kCorners = "0 0 0\n1 0 0\n0 1 0\n";

std::string ascii(const std::string& declarations, const std::string& values) {
  return "ply\nformat ascii 1.0\n" + declarations + "end_header\n" + values;
}

/// Little-endian; the values are bytes.
std::string binary(const std::string& declarations, const std::string& values) {
  return "ply\nformat binary_little_endian 1.0\n" + declarations + "end_header\n" + values;
}

std::string floats(std::initializer_list<float> values) {
  std::string bytes;
  for (const float v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  return bytes;
}

std::string ints(std::initializer_list<std::int32_t> values) {
  std::string bytes;
  for (const std::int32_t v : values) bytes.append(reinterpret_cast<const char*>(&v), sizeof v);
  return bytes;
}

const std::string kBinaryCorners = floats({0, 0, 0, 1, 0, 0, 0, 1, 0});

std::string message_of(const std::string& bytes) {
  try {
    parse_ply(bytes, "mesh.ply");
    return "no error";
  } catch (const InputError& error) {
    return error.what();
  }
}

using Triangles = std::vector<TriangleMesh::Triangle>;

TEST(ply, reads_every_property_of_a_vertex_and_cuts_polygons_into_fans) {
  const TriangleMesh mesh = read_ply(kCorpus + "ascii_quad.ply");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}}));
  EXPECT_EQ(mesh.normals, std::vector<Vec3f>(4, Vec3f(0, 0, 1)));
  EXPECT_EQ(mesh.uvs, (std::vector<Vec2<float>>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {0, 2, 3}}));
}

TEST(ply, reads_both_byte_orders_in_any_order_of_properties_and_skips_the_rest) {
  const TriangleMesh little = read_ply(kCorpus + "little_endian_extras.ply");
  EXPECT_EQ(little.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0.5f}}));
  EXPECT_TRUE(little.normals.empty());
  EXPECT_TRUE(little.uvs.empty());
  EXPECT_EQ(little.triangles, (Triangles{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(read_ply(kCorpus + "big_endian_extras.ply"), little);
}

TEST(ply, reads_faces_before_vertices_windows_lines_and_lists_in_vertices) {
  const TriangleMesh mesh = read_ply(kCorpus + "faces_first.ply");
  EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1.5e-3f, -100}}));
  EXPECT_EQ(mesh.uvs, (std::vector<Vec2<float>>{{0, 0}, {1, 0}, {1, 1}}));
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}, {2, 1, 0}}));
}

TEST(ply, takes_comments_before_the_format) {
  EXPECT_EQ(parse_ply("ply\ncomment by hand\nobj_info none\nformat ascii 1.0\n" + kVertices + kFaces + "end_header\n" +
                          kCorners + "3 0 1 2\n",
                      "mesh.ply")
                .triangles.size(),
            1u);
}

TEST(ply, skips_normals_and_texture_coordinates_that_are_not_complete) {
  const TriangleMesh mesh =
      parse_ply(ascii(kVertices + "property float nx\nproperty float nz\nproperty float u\n" + kFaces,
                      "0 0 0 1 2 3\n1 0 0 1 2 3\n0 1 0 1 2 3\n3 0 1 2\n"),
                "mesh.ply");
  EXPECT_TRUE(mesh.normals.empty());
  EXPECT_TRUE(mesh.uvs.empty());
}

std::vector<std::string> attributes_of(const TriangleMesh& mesh) {
  std::vector<std::string> names;
  for (const MeshAttribute& attribute : mesh.attributes) names.push_back(attribute.name);
  return names;
}

TEST(ply, reads_attributes_of_vertices_and_faces_by_mitsubas_names) {
  // Mitsuba 3.9.1 takes bytes as they are. A polygon's triangles share its value, which may stand before its corners.
  const std::string properties =
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
      "property float heat_0\nproperty double w_x\nproperty double w_y\nproperty double w_z\n"
      "property float tint_r\nproperty float tint_g\nproperty float tint_b\n";
  const std::string faces =
      "element face 2\nproperty float part_1\nproperty list uchar int vertex_indices\n"
      "property float glow_1\nproperty float glow_2\nproperty float glow_3\n";
  const TriangleMesh mesh =
      parse_ply(ascii("element vertex 4\nproperty float x\nproperty float y\nproperty float z\n" + properties + faces,
                      "0 0 0  255 0 188 9  0.5  1 2 3  4 5 6\n1 0 0  0 255 0 9  -2  7 8 9  10 11 12\n"
                      "1 1 0  0 0 0 9  0  0 0 0  0 0 0\n0 1 0  0 0 0 9  0  0 0 0  0 0 0\n"
                      "0.25 4 0 1 2 3 1 2 3\n0.75 3 0 1 2 4 5 6\n"),
                "mesh.ply");
  EXPECT_EQ(attributes_of(mesh), (std::vector<std::string>{"vertex_color", "vertex_heat", "vertex_w",
                                                           "vertex_tint_color", "face_part", "face_glow"}));
  EXPECT_EQ(mesh.attributes[0].values[0], Rgb(255, 0, 188));
  EXPECT_EQ(mesh.attributes[0].values[1], Rgb(0, 255, 0));
  EXPECT_EQ(mesh.attributes[1].values, (std::vector<Rgb>{Rgb(0.5f), Rgb(-2), Rgb(0.0f), Rgb(0.0f)}));
  EXPECT_EQ(mesh.attributes[2].values[1], Rgb(7, 8, 9));
  EXPECT_EQ(mesh.attributes[3].values[1], Rgb(10, 11, 12));
  EXPECT_EQ(mesh.attributes[4].values, (std::vector<Rgb>{Rgb(0.25f), Rgb(0.25f), Rgb(0.75f)}));
  EXPECT_EQ(mesh.attributes[5].values, (std::vector<Rgb>{Rgb(1, 2, 3), Rgb(1, 2, 3), Rgb(4, 5, 6)}));
}

TEST(ply, takes_no_attribute_of_other_names_numbers_or_types) {
  // Two values, four values, a name without an end, an end that begins no group, an integer type, a list.
  const std::string others =
      "property float pair_x\nproperty float pair_y\nproperty float four_0\nproperty float four_1\n"
      "property float four_2\nproperty float four_3\nproperty float quality\nproperty float end_z\n"
      "property int label_0\nproperty list uchar float tags_0\nproperty float r\nproperty float g\n";
  const TriangleMesh mesh = parse_ply(ascii(kVertices + others + kFaces,
                                            "0 0 0 1 2 1 2 3 4 5 6 7 1 8 9 9\n1 0 0 1 2 1 2 3 4 5 6 7 1 8 9 9\n"
                                            "0 1 0 1 2 1 2 3 4 5 6 7 1 8 9 9\n3 0 1 2\n"),
                                      "mesh.ply");
  EXPECT_EQ(attributes_of(mesh), std::vector<std::string>());
  EXPECT_EQ(mesh.triangles, (Triangles{{0, 1, 2}}));
}

TEST(ply, leaves_room_for_embree_behind_the_last_position) {
  const TriangleMesh mesh = read_ply(kCorpus + "written.ply");
  EXPECT_TRUE(mesh.is_padded());
  const TriangleMesh copy = mesh;
  EXPECT_FALSE(copy.is_padded()) << "a copy is as large as it must be, and no larger";
}

TEST(ply, shows_no_line_of_a_message_that_is_longer_than_any_line) {
  const std::string message = message_of(ascii(kVertices + kFaces, std::string(2'000'000, ' ') + "zero"));
  EXPECT_EQ(message,
            "mesh.ply:10:2000001: error: vertex 0 has 'zero', expected a number in the range of double precision");
}

TEST(ply, refuses_a_missing_file) {
  try {
    read_ply("/nonexistent/mesh.ply");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/mesh.ply: error: no such file");
  }
}

struct Refusal {
  const char* name;
  std::string bytes;
  std::string message;
};

class refused_ply : public ::testing::TestWithParam<Refusal> {};

TEST_P(refused_ply, is_refused_with_the_whole_message) { EXPECT_EQ(message_of(GetParam().bytes), GetParam().message); }

std::string name_of(const ::testing::TestParamInfo<Refusal>& refusal) { return refusal.param.name; }

/// A message about a line of the header, which follows after "ply" and "format": the third line is the first of these.
std::string at(const std::string& place, const std::string& message, const std::string& line, std::size_t indent = 0) {
  return "mesh.ply:" + place + ": error: " + message + "\n  " + line + "\n  " + std::string(indent, ' ') + "^";
}

INSTANTIATE_TEST_SUITE_P(
    header, refused_ply,
    ::testing::Values(
        Refusal{"empty", "", "mesh.ply:1:1: error: not a PLY file: the first line is not 'ply'"},
        Refusal{"other_file", "<scene>\n", at("1:1", "not a PLY file: the first line is not 'ply'", "<scene>")},
        Refusal{"no_format", "ply\nelement vertex 3\n",
                at("2:1", "expected 'format' as the second line of a PLY file", "element vertex 3")},
        Refusal{"unknown_format", "ply\nformat binary 1.0\n",
                at("2:8", "format 'binary' is not known, expected ascii, binary_little_endian or binary_big_endian",
                   "format binary 1.0", 7)},
        Refusal{"unknown_version", "ply\nformat ascii 2.0\n",
                at("2:14", "version '2.0' is not known, expected 1.0", "format ascii 2.0", 13)},
        Refusal{"short_format", "ply\nformat ascii\n",
                at("2:1", "the line ends early, expected 'format <encoding> 1.0'", "format ascii")},
        Refusal{"long_format", "ply\nformat ascii 1.0 utf-8\n",
                at("2:18", "unexpected 'utf-8' after 'format <encoding> 1.0'", "format ascii 1.0 utf-8", 17)},
        Refusal{"no_end", "ply\nformat ascii 1.0\n" + kVertices,
                "mesh.ply:7:1: error: the file ends before its header does: 'end_header' is missing"},
        Refusal{
            "endless", "ply\nformat ascii 1.0\n" + std::string(70'000, '\n'),
            "mesh.ply:65518:1: error: the header does not end within its first 65536 bytes: 'end_header' is missing"},
        Refusal{"unknown_keyword", ascii("elment vertex 3\n", ""),
                at("3:1",
                   "'elment' is not known in a PLY header (did you mean 'element'?), expected element, property, "
                   "comment, obj_info or end_header",
                   "elment vertex 3")},
        Refusal{"second_element", ascii(kVertices + "element vertex 3\n", ""),
                at("7:9", "a second element 'vertex'", "element vertex 3", 8)},
        Refusal{"negative_count", ascii("element vertex -1\n", ""),
                at("3:16", "the count of element 'vertex' is '-1', expected a whole number from 0", "element vertex -1",
                   15)},
        Refusal{"property_of_nothing", ascii("property float x\n", ""),
                at("3:1", "a property before the first element", "property float x")},
        Refusal{"second_property", ascii(kVertices + "property float x\n", ""),
                at("7:16", "a second property 'x' of element 'vertex'", "property float x", 15)},
        Refusal{"unknown_type", ascii("element vertex 3\nproperty flaot x\n", ""),
                at("4:10",
                   "type 'flaot' is not known (did you mean 'float'?), expected char, uchar, short, ushort, int, uint, "
                   "float or double",
                   "property flaot x", 9)},
        Refusal{"list_counted_by_float", ascii("element face 1\nproperty list float int vertex_indices\n", ""),
                at("4:15", "a list's count is of type 'float', expected an integer type",
                   "property list float int vertex_indices", 14)},
        Refusal{"short_list", ascii("element face 1\nproperty list uchar vertex_indices\n", ""),
                at("4:1", "the line ends early, expected 'property list <count type> <type> <name>'",
                   "property list uchar vertex_indices")}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    layout, refused_ply,
    ::testing::Values(
        Refusal{"no_vertices", ascii(kFaces, ""),
                "mesh.ply: error: the file has no element 'vertex': it has no surface"},
        Refusal{"no_faces", ascii(kVertices, kCorners),
                "mesh.ply: error: the file has no element 'face': it is a cloud of points and has no surface"},
        Refusal{"zero_faces", ascii(kVertices + "element face 0\nproperty list uchar int vertex_indices\n", kCorners),
                at("7:1", "element 'face' has no rows: the mesh has no triangles", "element face 0")},
        Refusal{"too_many", ascii("element vertex 300000000\n" + kFaces, ""),
                at("3:1", "element 'vertex' has 300000000 rows, the limit is 268435456", "element vertex 300000000")},
        Refusal{"no_z", ascii("element vertex 3\nproperty float x\nproperty float y\n" + kFaces, ""),
                at("3:1", "element 'vertex' lacks one of the properties x, y and z", "element vertex 3")},
        Refusal{"integer_x",
                ascii("element vertex 3\nproperty int x\nproperty float y\nproperty float z\n" + kFaces, ""),
                at("4:1", "property 'x' is of type 'int', expected float or double", "property int x")},
        Refusal{
            "list_of_x",
            ascii("element vertex 3\nproperty list uchar float x\nproperty float y\nproperty float z\n" + kFaces, ""),
            at("4:1", "property 'x' is a list, expected one float or double", "property list uchar float x")},
        Refusal{"no_indices", ascii(kVertices + "element face 1\nproperty list uchar int corners\n", ""),
                at("7:1", "element 'face' lacks the property vertex_indices (or vertex_index)", "element face 1")},
        Refusal{"one_index", ascii(kVertices + "element face 1\nproperty int vertex_index\n", ""),
                at("8:1", "property 'vertex_index' is one value, expected a list", "property int vertex_index")},
        Refusal{"float_indices", ascii(kVertices + "element face 1\nproperty list uchar float vertex_index\n", ""),
                at("8:1", "property 'vertex_index' is of type 'float', expected an integer type",
                   "property list uchar float vertex_index")},
        Refusal{"count_beyond_the_file",
                binary("element vertex 100000000\nproperty float x\nproperty float y\nproperty float z\n" + kFaces,
                       kBinaryCorners),
                at("3:1",
                   "element 'vertex' has 100000000 rows of at least 12 bytes each, more than the rest of the file: it "
                   "is truncated or its header is wrong",
                   "element vertex 100000000")},
        Refusal{"faces_beyond_the_file",
                ascii(kVertices + "element face 1000\nproperty list uchar int vertex_indices\n", kCorners + "3 0 1 2"),
                at("7:1",
                   "element 'face' has 1000 rows of at least 2 bytes each, more than the rest of the file: it is "
                   "truncated or its header is wrong",
                   "element face 1000")}),
    name_of);

INSTANTIATE_TEST_SUITE_P(
    text, refused_ply,
    ::testing::Values(
        Refusal{"truncated", ascii(kVertices + kFaces, kCorners + "3 0 1"),
                at("13:6", "the file ends within face 0", "3 0 1", 5)},
        Refusal{"word_for_a_number", ascii(kVertices + kFaces, "0 zero 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                at("10:3", "vertex 0 has 'zero', expected a number in the range of double precision", "0 zero 0", 2)},
        Refusal{
            "nan", ascii(kVertices + kFaces, "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n"),
            at("11:3", "vertex 1 has the value nan, expected finite numbers that fit single precision", "1 nan 0", 2)},
        Refusal{"too_large", ascii(kVertices + kFaces, "0 0 0\n1 0 1e39\n0 1 0\n3 0 1 2\n"),
                at("11:5", "vertex 1 has the value 1e+39, expected finite numbers that fit single precision",
                   "1 0 1e39", 4)},
        Refusal{"byte_of_256", ascii(kVertices + "property uchar heat_0\n" + kFaces, "0 0 0 256\n0 0 0 1\n0 0 0 2\n"),
                at("11:7", "vertex 0 has the value 256, expected from 0 to 255", "0 0 0 256", 6)},
        Refusal{"fraction_for_an_index", ascii(kVertices + kFaces, kCorners + "3 0 1.5 2\n"),
                at("13:5", "face 0 has '1.5', expected an integer", "3 0 1.5 2", 4)},
        Refusal{"index_out_of_range", ascii(kVertices + kFaces, kCorners + "3 0 1 3\n"),
                at("13:7", "face 0 names vertex 3, expected 0 to 2", "3 0 1 3", 6)},
        Refusal{"two_corners", ascii(kVertices + kFaces, kCorners + "2 0 1\n"),
                at("13:1", "face 0 has 2 corners, expected at least 3", "2 0 1")},
        Refusal{"negative_list", ascii(kVertices + kFaces, kCorners + "-3 0 1 2\n"),
                at("13:1", "face 0 has a list of -3 values, expected at least 0", "-3 0 1 2")},
        Refusal{"more_text", ascii(kVertices + kFaces, kCorners + "3 0 1 2\n3 2 1 0\n"),
                at("14:1", "unexpected text after the last element, expected the end of the file", "3 2 1 0")}),
    name_of);

// The header of these is 169 bytes long, the three vertices take 36: the face starts at byte 205.
INSTANTIATE_TEST_SUITE_P(
    bytes, refused_ply,
    ::testing::Values(
        Refusal{"truncated", binary(kVertices + kFaces, kBinaryCorners + "\3" + ints({0, 1})),
                "mesh.ply: error: at byte 214: the file ends within face 0"},
        Refusal{"infinite",
                binary(kVertices + kFaces, floats({0, 0, 0, 1, HUGE_VALF, 0, 0, 1, 0}) + "\3" + ints({0, 1, 2})),
                "mesh.ply: error: at byte 185: vertex 1 has the value inf, expected finite numbers that fit single "
                "precision"},
        Refusal{"index_out_of_range", binary(kVertices + kFaces, kBinaryCorners + "\3" + ints({0, 1, 3})),
                "mesh.ply: error: at byte 214: face 0 names vertex 3, expected 0 to 2"},
        Refusal{"negative_index", binary(kVertices + kFaces, kBinaryCorners + "\3" + ints({-1, 1, 2})),
                "mesh.ply: error: at byte 206: face 0 names vertex -1, expected 0 to 2"},
        Refusal{"no_corners", binary(kVertices + kFaces, kBinaryCorners + std::string(1, '\0')),
                "mesh.ply: error: at byte 205: face 0 has 0 corners, expected at least 3"},
        Refusal{"more_bytes", binary(kVertices + kFaces, kBinaryCorners + "\3" + ints({0, 1, 2}) + "more"),
                "mesh.ply: error: at byte 218: 4 bytes follow the last element, expected none"},
        Refusal{"list_beyond_the_file",
                binary(kVertices + "element face 1\nproperty list int int tags\n"
                                   "property list uchar int vertex_indices\n",
                       kBinaryCorners + ints({2'000'000'000}) + "\3"),
                "mesh.ply: error: at byte 237: the file ends within face 0"}),
    name_of);

}  // namespace
}  // namespace photonproof::inline scenes_meshes
