// The exported scene file: what is written for each conversion, and the scenes of the library.
#include "reference/mitsuba/mitsuba_export.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_mitsuba {
namespace {

namespace fs = std::filesystem;

const std::string kLibrary = PHOTONPROOF_SOURCE_DIR "/scenes/library";

MitsubaExport exported(const std::string& content, const MitsubaOptions& options = {.samples = 256, .threads = 2}) {
  return export_mitsuba(parse_scene_text("<scene version='3.0.0'>" + content + "</scene>", "s.xml", {{}, true}),
                        options);
}

std::string ball(const std::string& bsdf) {
  return "<shape type='sphere'>" + bsdf + "</shape><emitter type='constant'/>";
}

bool writes(const MitsubaExport& scene, const std::string& line) { return scene.text.find(line) != std::string::npos; }

/// The image or the mesh of the only file.
const MitsubaFile& only_file(const MitsubaExport& scene) {
  EXPECT_EQ(scene.files.size(), 1u);
  return scene.files.at(0);
}

TEST(mitsuba_export, scene_as_one_writes_it_by_hand) {
  const std::string sensor =
      "<sensor type='perspective'><float name='fov' value='50'/><film type='hdrfilm'><integer name='width' "
      "value='40'/><integer name='height' "
      "value='30'/><rfilter type='box'/></film></sensor>";
  EXPECT_EQ(exported(sensor + ball("<bsdf type='diffuse'><rgb name='reflectance' value='0.1,0.2,0.3'/></bsdf>")).text,
            R"(<scene version="3.0.0">
  <integrator type="path">
    <integer name="max_depth" value="-1"/>
    <integer name="rr_depth" value="5"/>
    <boolean name="hide_emitters" value="false"/>
  </integrator>
  <sensor type="perspective">
    <float name="fov" value="50"/>
    <string name="fov_axis" value="x"/>
    <float name="near_clip" value="0.01"/>
    <float name="far_clip" value="10000"/>
    <film type="hdrfilm">
      <integer name="width" value="40"/>
      <integer name="height" value="30"/>
      <boolean name="sample_border" value="false"/>
      <string name="pixel_format" value="rgb"/>
      <string name="component_format" value="float32"/>
      <rfilter type="box"/>
    </film>
    <sampler type="independent">
      <integer name="sample_count" value="256"/>
    </sampler>
  </sensor>
  <shape type="sphere">
    <point name="center" value="0, 0, 0"/>
    <float name="radius" value="1"/>
    <boolean name="flip_normals" value="false"/>
    <bsdf type="diffuse">
      <rgb name="reflectance" value="0.1, 0.2, 0.3"/>
    </bsdf>
  </shape>
  <emitter type="constant">
    <rgb name="radiance" value="1, 1, 1"/>
  </emitter>
</scene>
)");
}

// Its other samplers are biased where samples are few: `absorption` is 5 % too bright with 4 of multijitter.
TEST(mitsuba_export, samples_are_independent) {
  const MitsubaExport scene = exported("<sensor type='perspective'><sampler type='multijitter'/></sensor>" + ball(""));
  EXPECT_TRUE(writes(scene, "<sampler type=\"independent\">"));
  EXPECT_EQ(scene.picture.batches.size(), 16u);
}

// Mitsuba's checkerboard takes no colour above 1, and swaps them where they are read as a number.
TEST(mitsuba_export, checkerboards_are_images_of_four_texels) {
  const MitsubaExport scene = exported(
      "<emitter type='constant'/><shape type='rectangle'><emitter type='area'><texture name='radiance' "
      "type='checkerboard'><rgb name='color0' value='2,3,4'/><rgb name='color1' value='0.5'/></texture>"
      "</emitter></shape>");
  const Image& image = *only_file(scene).image;
  EXPECT_TRUE(writes(scene, "<texture type=\"bitmap\" name=\"radiance\">"));
  EXPECT_TRUE(writes(scene, "<string name=\"filename\" value=\"scene_image_0.exr\"/>"));
  EXPECT_TRUE(writes(scene, "<string name=\"filter_type\" value=\"nearest\"/>"));
  EXPECT_EQ(image.pixel(0, 0)[1], 3);
  EXPECT_EQ(image.pixel(1, 1)[1], 3);
  EXPECT_EQ(image.pixel(1, 0)[1], 0.5f);
  EXPECT_EQ(image.pixel(0, 1)[1], 0.5f);
}

TEST(mitsuba_export, sigma_t_above_1_goes_into_scale) {
  const MitsubaExport scene = exported(
      "<integrator type='volpath'/><emitter type='constant'/><shape type='sphere'><bsdf type='null'/><medium "
      "name='interior' type='homogeneous'><rgb name='sigma_t' value='1,2,4'/><float name='scale' value='3'/>"
      "</medium></shape>");
  EXPECT_TRUE(writes(scene, "<rgb name=\"sigma_t\" value=\"0.25, 0.5, 1\"/>"));
  EXPECT_TRUE(writes(scene, "<float name=\"scale\" value=\"12\"/>"));
}

TEST(mitsuba_export, planes_are_wide_squares_in_their_own_uv) {
  const MitsubaExport scene = exported(ball("") + "<shape type='plane'/>");
  const TriangleMesh& mesh = *only_file(scene).mesh;
  ASSERT_EQ(mesh.positions.size(), 4u);
  EXPECT_LT(mesh.positions[0].x, -1000);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(mesh.positions[i].z, 0);
    EXPECT_EQ(mesh.uvs[i].x, mesh.positions[i].x);
    EXPECT_EQ(mesh.uvs[i].y, mesh.positions[i].y);
  }
}

class MitsubaMeshes : public FolderTest {
 protected:
  /// A triangle with normals that lean, as a shape with this content.
  MitsubaExport mesh(const std::string& content) const {
    put("m.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float "
        "nx\nproperty float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0 0.6 0 0.8\n1 0 0 0.6 0 0.8\n0 1 0 0.6 0 0.8\n3 0 1 2\n");
    const std::string text =
        "<scene version='3.0.0'><emitter type='constant'/><shape type='ply'><string "
        "name='filename' value='m.ply'/>" +
        content + "</shape></scene>";
    return export_mitsuba(parse_scene_text(text, (folder_ / "s.xml").string(), {{}, true}), {});
  }
};

// Mitsuba emits by the normals of shading, which is not what a lamp of that shape does.
TEST_F(MitsubaMeshes, that_emit_are_flat) {
  const std::string light = "<emitter type='area'/>";
  EXPECT_TRUE(writes(mesh("<bsdf type='diffuse'><float name='reflectance' value='0'/></bsdf>" + light),
                     "<boolean name=\"face_normals\" value=\"true\"/>"));
  EXPECT_TRUE(writes(mesh(""), "<boolean name=\"face_normals\" value=\"false\"/>"));
}

TEST_F(MitsubaMeshes, that_are_mirrored_and_flat_have_their_front_in_the_file) {
  const std::string mirrored = "<transform name='to_world'><scale x='-2'/></transform>";
  const MitsubaExport flat = mesh(mirrored + "<boolean name='face_normals' value='true'/>");
  EXPECT_TRUE(writes(flat, "<matrix value=\"2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\"/>")) << flat.text;
  EXPECT_EQ(only_file(flat).mesh->positions[1].x, -1);
  EXPECT_EQ(only_file(flat).mesh->triangles[0], (TriangleMesh::Triangle{0, 2, 1}));
  const MitsubaExport smooth = mesh(mirrored);
  EXPECT_EQ(only_file(smooth).mesh->positions[1].x, 1);
}

TEST(mitsuba_export, a_cube_with_a_texture_as_radiance_is_six_rectangles) {
  const MitsubaExport scene = exported(
      "<shape type='cube'><emitter type='area'><texture name='radiance' type='checkerboard'/></emitter>"
      "</shape>");
  std::size_t count = 0;
  for (std::size_t at = scene.text.find("type=\"rectangle\""); at != std::string::npos;
       at = scene.text.find("type=\"rectangle\"", at + 1))
    ++count;
  EXPECT_EQ(count, 6u);
  EXPECT_FALSE(writes(scene, "type=\"cube\""));
}

TEST(mitsuba_export, other_integrators_become_its_path_tracers) {
  EXPECT_TRUE(writes(exported("<integrator type='bdpt'><integer name='max_depth' value='7'/></integrator>" + ball("")),
                     "<integrator type=\"path\">\n    <integer name=\"max_depth\" value=\"7\"/>"));
  EXPECT_TRUE(
      writes(exported(ball("<bsdf type='mask'><bsdf type='diffuse'/></bsdf>")), "<integrator type=\"volpath\">"));
}

TEST(mitsuba_export, plugins_that_mitsuba_lacks_are_named) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(exported(ball("<bsdf type='diffuse'/>")).plugins, Names{});
  EXPECT_EQ(exported(ball("<bsdf type='phong'/>")).plugins, Names{"phong"});
  EXPECT_EQ(exported("<sensor type='fisheye'/>" + ball("")).plugins, Names{"fisheye"});
  const MitsubaExport blend =
      exported(ball("<bsdf type='blendbsdf'><float name='weight' value='0.5'/><bsdf type='diffuse'/><bsdf "
                    "type='conductor'/></bsdf>"));
  EXPECT_EQ(blend.plugins, Names{"mixture"});
  EXPECT_TRUE(writes(blend, "<bsdf type=\"mixture\">"));
}

TEST(mitsuba_export, explanations_are_a_comment_at_the_head) {
  const MitsubaExport scene = exported("<sensor type='fisheye'/>" + ball(""));
  EXPECT_EQ(scene.text.find("<!--\n  fisheye of s.xml:1:24: our plugin, as Mitsuba 3 has none\n-->\n<scene"), 0u)
      << scene.text;
}

// Each needs a light without size beside mirrors or glass, or a lacquer.
TEST(mitsuba_export, of_the_library_seven_scenes_are_refused) {
  std::set<std::string> refused;
  for (const auto& entry : fs::directory_iterator(kLibrary)) {
    const fs::path file = entry.path() / "scene.xml";
    if (!fs::exists(file)) continue;
    try {
      export_mitsuba(parse_scene_file(file.string()), {});
    } catch (const NotRepresentable&) {
      refused.insert(entry.path().filename());
    }
  }
  EXPECT_EQ(refused, (std::set<std::string>{"ball-lens", "daylight", "furnace-layered", "materials", "water-caustic",
                                            "whitted", "whitted-orthographic"}));
}

class MitsubaFiles : public FolderTest {};

TEST_F(MitsubaFiles, are_written_beside_the_scene) {
  const MitsubaExport scene = exported(ball("<bsdf type='diffuse'><texture name='reflectance' type='checkerboard'/>"
                                            "</bsdf>") +
                                       "<shape type='plane'/>");
  write_mitsuba(scene, folder_ / "scene.xml");
  EXPECT_TRUE(has("scene.xml"));
  EXPECT_EQ(read_image((folder_ / "scene_image_0.exr").string()).width, 2);
  EXPECT_TRUE(has("scene_mesh_1.ply"));
}

}  // namespace
}  // namespace photonproof::inline reference_mitsuba
