// A scene that is to be rendered as Mitsuba does differs from the scene itself in the listed places, and says so.
#include "scenes/dialect/as_mitsuba.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/description/scene_hash.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::scene_xml {
namespace {

using testing::HasSubstr;

const std::string kSensor = "<sensor type='perspective'/>", kLight = "<emitter type='point'/>";

class AsMitsuba : public FolderTest {
 protected:
  SceneDescription parse(const std::string& content, bool as_mitsuba = true) const {
    put("scene.xml", "<scene version='3.0.0'>" + kSensor + kLight + content + "</scene>");
    ParseOptions options;
    options.as_mitsuba = as_mitsuba;
    return parse_scene_file((folder_ / "scene.xml").string(), options);
  }
  /// Texts of the notes, a line each, after the first, which every scene has.
  static std::string notes_of(const SceneDescription& scene) {
    std::string text;
    for (std::size_t i = 0; i < scene.notes.size(); ++i)
      if (scene.notes[i].text.find("the image follows Mitsuba 3.9.1") == std::string::npos)
        text += scene.notes[i].text + "\n";
    return text;
  }
  void put_mesh(const std::string& normals) const {
    const std::string columns = normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n";
    put("mesh.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
                        columns + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0" +
                        normals + "\n1 0 0" + normals + "\n0 1 0" + normals + "\n3 0 1 2\n");
  }
  static std::string mesh(const std::string& content) {
    return "<shape type='ply'><string name='filename' value='mesh.ply'/>" + content + "</shape>";
  }
};

const std::string kMirrored = "<transform name='to_world'><scale x='-1'/></transform>";

TEST_F(AsMitsuba, always_says_that_the_image_follows_mitsuba) {
  const SceneDescription scene = parse("<shape type='sphere'/>");
  EXPECT_TRUE(scene.as_mitsuba);
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_EQ(scene.notes[0].text,
            "the image follows Mitsuba 3.9.1 where it departs from its documents or from a closed form");
  EXPECT_THAT(scene.notes[0].where, HasSubstr("scene.xml"));
}

TEST_F(AsMitsuba, is_another_scene_by_its_hash) {
  const SceneDescription right = parse("", false), followed = parse("");
  EXPECT_EQ(followed.defines, std::vector<std::string>{"--as-mitsuba"});
  EXPECT_NE(scene_hash(right), scene_hash(followed));
}

TEST_F(AsMitsuba, changes_nothing_unasked) {
  const SceneDescription scene = parse(
      "<bsdf type='plastic' id='p'/><shape type='sphere'><bsdf type='blendbsdf'><texture name='weight' "
      "type='checkerboard'/><bsdf type='conductor'/><bsdf type='diffuse'/></bsdf></shape>",
      false);
  EXPECT_FALSE(scene.as_mitsuba);
  EXPECT_TRUE(scene.notes.empty());
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_FALSE(std::get<PlasticDescription>(scene.bsdfs[0].model).fitted_inside);
  EXPECT_FALSE(std::get<BlendDescription>(scene.bsdfs.back().model).mixes_mirrors);
}

// ScalarTransform4f().rotate([0, 2, 0], 50) of Mitsuba 3.9.1 on 2026-11-28: 0.642788 0 1.53209, 0 2.07164 0,
// -1.53209 0 0.642788.
TEST_F(AsMitsuba, does_not_normalise_the_axis_of_a_rotation) {
  const SceneDescription scene = parse(
      "<shape type='sphere'><transform name='to_world'><rotate y='1' angle='50'/></transform></shape>"
      "<shape type='cube'><transform name='to_world'><rotate y='2' angle='50'/></transform></shape>");
  const double expected[9] = {0.642788, 0, 1.53209, 0, 2.07164, 0, -1.53209, 0, 0.642788};
  const Transform& made = scene.shapes[1].to_world;
  for (std::size_t r = 0; r < 3; ++r)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(made.m[4 * r + c], expected[3 * r + c], 5e-6);
  EXPECT_EQ(scene.shapes[0].to_world, Transform::rotate({0, 1, 0}, 50)) << "a unit axis stays";
  EXPECT_EQ(notes_of(scene), "as in Mitsuba, the axis of a rotate is not normalised: the matrix is no rotation\n");
}

TEST_F(AsMitsuba, leaves_errors_of_a_rotation_to_the_parser) {
  for (const char* wrong :
       {"<rotate angle='50'/>", "<rotate y='2' angle='x'/>", "<rotate y='2'/>", "<rotate y='two' angle='5'/>"}) {
    const std::string content =
        "<shape type='cube'><transform name='to_world'>" + std::string(wrong) + "</transform></shape>";
    EXPECT_EQ(input_error_of([&] { parse(content); }), input_error_of([&] { parse(content, false); })) << wrong;
  }
}

TEST_F(AsMitsuba, swaps_checkerboards_that_are_read_as_numbers_alone) {
  const SceneDescription scene = parse(
      "<texture type='checkerboard' id='board'><float name='color0' value='.1'/><texture name='color1' "
      "type='checkerboard'><float name='color0' value='.3'/><float name='color1' value='.4'/></texture></texture>"
      "<bsdf type='roughconductor' id='rough'><ref name='alpha' id='board'/><ref name='specular_reflectance' "
      "id='board'/></bsdf>");
  const auto& rough = std::get<RoughConductorDescription>(scene.bsdfs[0].model);
  const auto board = [&](const auto& value) {
    return std::get<CheckerboardDescription>(scene.textures[std::get<TextureIndex>(value).value].pattern);
  };
  EXPECT_EQ(constant(board(rough.specular_reflectance).color0), RgbD(0.1));
  EXPECT_EQ(constant(board(rough.alpha_u).color1), RgbD(0.1));
  EXPECT_EQ(constant(board(board(rough.alpha_u).color0).color0), RgbD(0.4)) << "the nested one is swapped, too";
  EXPECT_EQ(rough.alpha_u, rough.alpha_v) << "one copy serves both";
  EXPECT_EQ(notes_of(scene), "as in Mitsuba, a checkerboard that is read as a number swaps its colours\n");
}

TEST_F(AsMitsuba, turns_mirrored_meshes_without_normals_inside_out) {
  const auto flips = [&](const std::string& content) { return parse(mesh(content)).shapes[0].flip_normals; };
  put_mesh("");
  EXPECT_FALSE(flips(""));
  EXPECT_TRUE(flips(kMirrored));
  EXPECT_FALSE(flips(kMirrored + "<boolean name='flip_normals' value='true'/>"));
  put_mesh(" 0 0 1");
  EXPECT_FALSE(flips(kMirrored));
  EXPECT_TRUE(flips(kMirrored + "<boolean name='face_normals' value='true'/>"));
}

TEST_F(AsMitsuba, lets_smooth_meshes_emit_by_their_vertex_normals) {
  put_mesh(" 0 0 1");
  const auto of = [&](const std::string& content) { return parse(mesh(content)).shapes[0].emits_by_vertex_normals; };
  const std::string light = "<emitter type='area'/>";
  EXPECT_TRUE(of(light));
  EXPECT_FALSE(of(""));
  EXPECT_FALSE(of(light + "<boolean name='face_normals' value='true'/>"));
  const SceneDescription textured =
      parse(mesh("<emitter type='area'><texture name='radiance' type='checkerboard'/></emitter>"));
  EXPECT_FALSE(textured.shapes[0].emits_by_vertex_normals);
  EXPECT_EQ(notes_of(textured),
            "as in Mitsuba, not followed: Mitsuba's two estimators of a mesh with a textured radiance disagree\n");
}

TEST_F(AsMitsuba, marks_plastic_and_blends_of_one_mirror) {
  const auto blend = [&](const std::string& first, const std::string& second) {
    const SceneDescription scene =
        parse("<bsdf type='blendbsdf' id='b'><float name='weight' value='.3'/>" + first + second + "</bsdf>");
    return std::get<BlendDescription>(scene.bsdfs.back().model).mixes_mirrors;
  };
  const std::string mirror = "<bsdf type='conductor'/>", glass = "<bsdf type='dielectric'/>",
                    rough = "<bsdf type='roughconductor'/>";
  EXPECT_TRUE(blend(mirror, rough));
  EXPECT_TRUE(blend(rough, glass));
  EXPECT_TRUE(blend("<bsdf type='twosided'>" + mirror + "</bsdf>", rough));
  EXPECT_FALSE(blend(mirror, glass));
  EXPECT_FALSE(blend(rough, rough));
  const SceneDescription plastic = parse("<bsdf type='plastic' id='p'/>");
  EXPECT_TRUE(std::get<PlasticDescription>(plastic.bsdfs[0].model).fitted_inside);
  EXPECT_EQ(notes_of(plastic), "as in Mitsuba, the coat of plastic reflects from below by a fit\n");
}

TEST_F(AsMitsuba, takes_a_tent_of_half_a_pixel_for_a_box) {
  const auto kind = [&](const std::string& radius) {
    put("scene.xml", "<scene version='3.0.0'>" + kLight + "<sensor type='perspective'><film type='hdrfilm'><rfilter " +
                         "type='tent'><float name='radius' value='" + radius + "'/></rfilter></film></sensor></scene>");
    ParseOptions options;
    options.as_mitsuba = true;
    return parse_scene_file((folder_ / "scene.xml").string(), options).sensor.film.filter.kind;
  };
  EXPECT_EQ(kind("0.5"), ReconstructionFilter::Kind::box);
  EXPECT_EQ(kind("0.45"), ReconstructionFilter::Kind::tent);
  EXPECT_EQ(kind("0.55"), ReconstructionFilter::Kind::tent);
}

}  // namespace
}  // namespace photonproof::scene_xml
