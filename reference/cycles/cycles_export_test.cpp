// The exported text compared with handwritten text, and lines that are written only where a scene needs them.
#include "reference/cycles/cycles_export.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>
#include <sstream>

#include "scenes/description/expect.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_cycles {
namespace {

const std::string kScenes = PHOTONPROOF_SOURCE_DIR "/scenes/";

CyclesExport exported(const std::string& content, const CyclesOptions& options = {.samples = 8, .threads = 2}) {
  return export_cycles(parse_scene_text("<scene version='3.0.0'>" + content + "</scene>", "s.xml", {}), options);
}

/// The lines without comments, and without the last, which renders.
std::string scene_lines(const CyclesExport& scene) {
  std::istringstream lines(scene.text);
  std::string result;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("#", 0) != 0 && line.rfind("render(", 0) != 0) result += line + "\n";
  return result;
}

// fov 90 across: the tangent of half of it is 1, and 3/4 of that up. Mitsuba's camera looks along local +z with +x to
// the left, so one without to_world has Blender's right at (-1, 0, 0) and its backward at (0, 0, -1).
const std::string kCamera =
    "<sensor type='perspective'><float name='fov' value='90'/><float name='near_clip' value='0.5'/>"
    "<float name='far_clip' value='50'/><film type='hdrfilm'><integer name='width' value='40'/><integer name='height' "
    "value='30'/><rfilter type='box'/></film></sensor>";
const std::string kHead =
    "clear()\nsettings(40, 30, 2, 1024, \"BOX\", 1)\n"
    "camera(\"perspective\", ((-1, 0, 0), (0, 1, 0), (-0, -0, -1), (0, 0, 0)), 0.5, 50, (0.9999999999999999, "
    "0.7499999999999999))\n";

TEST(cycles_export, light_and_wall_as_one_writes_them_by_hand) {
  const std::string scene =
      kCamera +
      "<shape type='rectangle'><transform name='to_world'><translate z='4'/></transform><boolean name='flip_normals' "
      "value='true'/><bsdf type='diffuse'><rgb name='reflectance' value='0.1,0.2,0.3'/></bsdf></shape>"
      "<shape type='sphere'><point name='center' value='1,2,3'/><float name='radius' value='0.5'/><bsdf "
      "type='twosided'><bsdf type='diffuse'/></bsdf><emitter type='area'><rgb name='radiance' value='7,8,9'/></emitter>"
      "</shape><emitter type='point'><rgb name='intensity' value='1,2,3'/></emitter>";
  EXPECT_EQ(
      scene_lines(exported(scene)),
      kHead +
          "material_0 = material(\"material_0\", lambda g: g.sides(g.diffuse((0.1, 0.2, 0.3)), None))\n"
          "shape(\"shape_0\", form(\"rectangle\", True), ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 4)), material_0)\n"
          "material_1 = material(\"material_1\", lambda g: g.sum(g.sides(g.glow((7, 8, 9)), None), g.diffuse((0.5, "
          "0.5, "
          "0.5))))\n"
          "shape(\"shape_1\", form(\"sphere\", False, 128), ((0.5, 0, 0), (0, 0.5, 0), (0, 0, 0.5), (1, 2, 3)), "
          "material_1)\n"
          "point_light(\"light_0\", (0, 0, 0), (1, 2, 3))\n");
}

std::string material(const std::string& bsdf) {
  const std::string text =
      exported(kCamera + "<emitter type='constant'/><shape type='sphere'>" + bsdf + "</shape>").text;
  const std::string start = "material_0 = material(\"material_0\", lambda g: ";
  const std::size_t at = text.find(start) + start.size();
  return text.substr(at, text.find('\n', at) - at - 1);
}

TEST(cycles_export, writes_every_material_that_blender_has) {
  EXPECT_EQ(material("<bsdf type='dielectric'><float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>"
                     "</bsdf>"),
            "g.glass(1.5, (1, 1, 1), (1, 1, 1))");
  EXPECT_EQ(material("<bsdf type='thindielectric'><float name='int_ior' value='3'/><float name='ext_ior' value='2'/>"
                     "</bsdf>"),
            "g.pane(1.5, (1, 1, 1), (1, 1, 1))");
  EXPECT_EQ(material("<bsdf type='conductor'><string name='material' value='none'/></bsdf>"),
            "g.sides(g.mirror((1, 1, 1)), None)");
  EXPECT_EQ(material("<bsdf type='conductor'><rgb name='eta' value='0.2,0.9,1.1'/><rgb name='k' value='4,2.5,2.4'/>"
                     "</bsdf>"),
            "g.sides(g.conductor((0.2, 0.9, 1.1), (4, 2.5, 2.4), (1, 1, 1)), None)");
  EXPECT_EQ(material("<bsdf type='roughconductor'><string name='material' value='none'/><float name='alpha' "
                     "value='0.3'/><string name='distribution' value='ggx'/></bsdf>"),
            "g.sides(g.metal((1, 1, 1), \"GGX\", 0.3), None)");
  EXPECT_EQ(
      material("<bsdf type='roughconductor'><rgb name='eta' value='0.2,0.9,1.1'/><rgb name='k' value='4,2.5,2.4'/>"
               "</bsdf>"),
      "g.sides(g.rough_conductor((0.2, 0.9, 1.1), (4, 2.5, 2.4), (1, 1, 1), \"BECKMANN\", 0.1), None)");
  EXPECT_EQ(material("<bsdf type='roughdielectric'><float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>"
                     "<float name='alpha' value='0.2'/></bsdf>"),
            "g.rough_glass(1.5, (1, 1, 1), (1, 1, 1), \"BECKMANN\", 0.2)");
  EXPECT_EQ(material("<bsdf type='plastic'><float name='int_ior' value='1.5'/><float name='ext_ior' value='1'/>"
                     "<boolean name='nonlinear' value='true'/></bsdf>"),
            "g.sides(g.plastic(1.5, (0.5, 0.5, 0.5), (1, 1, 1), True), None)");
  EXPECT_EQ(material("<bsdf type='phong'><float name='exponent' value='20'/></bsdf>"),
            "g.sides(g.phong(20, (0.5, 0.5, 0.5), (0.2, 0.2, 0.2)), None)");
  EXPECT_EQ(material("<bsdf type='mask'><float name='opacity' value='0.25'/><bsdf type='diffuse'/></bsdf>"),
            "g.mix(g.clear(), g.sides(g.diffuse((0.5, 0.5, 0.5)), None), 0.25)");
  EXPECT_EQ(material("<bsdf type='blendbsdf'><float name='weight' value='0.25'/><bsdf type='diffuse'/><bsdf "
                     "type='dielectric'><float name='int_ior' value='2'/><float name='ext_ior' value='1'/></bsdf>"
                     "</bsdf>"),
            "g.mix(g.sides(g.diffuse((0.5, 0.5, 0.5)), None), g.glass(2, (1, 1, 1), (1, 1, 1)), 0.25)");
}

TEST(cycles_export, textures_are_looked_up_through_their_to_uv) {
  EXPECT_EQ(material("<bsdf type='diffuse'><texture name='reflectance' type='checkerboard'><rgb name='color0' "
                     "value='0.9'/><rgb name='color1' value='0.1'/><transform name='to_uv'><scale x='2' y='3'/>"
                     "<translate x='0.5'/></transform></texture></bsdf>"),
            "g.sides(g.diffuse(g.checkerboard((0.9, 0.9, 0.9), (0.1, 0.1, 0.1), ((2, 0, 0.5), (0, 3, 0)))), None)");
}

// Scattering 2 x 3 x (0.5, 0.25, 0), absorption the rest of 6.
TEST(cycles_export, media_are_what_scatters_and_what_absorbs) {
  EXPECT_EQ(material("<bsdf type='null'/><medium type='homogeneous' name='interior'><float name='sigma_t' value='2'/>"
                     "<float name='scale' value='3'/><rgb name='albedo' value='0.5,0.25,0'/><phase type='hg'><float "
                     "name='g' value='0.7'/></phase></medium>"),
            "g.clear(), lambda g: g.medium((3, 1.5, 0), (3, 4.5, 6), 0.7)");
}

TEST(cycles_export, lenses_filters_depths_and_hidden_lights_are_told) {
  const std::string lens =
      "<integrator type='path'><integer name='max_depth' value='5'/><boolean name='hide_emitters' value='true'/>"
      "</integrator><sensor type='thinlens'><float name='fov' value='90'/><float name='near_clip' value='0.5'/>"
      "<float name='far_clip' value='50'/><float name='aperture_radius' value='0.1'/><float name='focus_distance' "
      "value='3'/><film type='hdrfilm'><integer name='width' value='40'/><integer name='height' value='40'/><rfilter "
      "type='gaussian'><float name='stddev' value='0.5'/></rfilter></film></sensor>";
  const std::string text = exported(lens +
                                    "<emitter type='constant'/><shape type='rectangle'><emitter type='area'/>"
                                    "</shape>")
                               .text;
  EXPECT_NE(text.find("settings(40, 40, 2, 3, \"GAUSSIAN\", 2)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("lens_radius=0.1, focus=3)\n"), std::string::npos) << text;
  EXPECT_NE(text.find("sky((1, 1, 1), hidden=True)\n"), std::string::npos) << text;
  EXPECT_NE(text.find(", material_0, hidden=True)\n"), std::string::npos) << text;
}

// The scene's box is 2 x 2 x 4 with the camera in it, so its diagonal is sqrt(24). Squares are at most
// (sqrt(24) / 100 / sqrt(2))^(1/3) = 0.326 wide, so 7 of them span 2. A light 30 times as wide as the scene's thinnest
// side is not sampled directly.
TEST(cycles_export, rectangular_lights_are_squares_and_wide_ones_are_met_by_chance) {
  const auto light = [](const std::string& scale) {
    return exported(kCamera + "<shape type='rectangle'><transform name='to_world'><scale value='" + scale +
                    "'/><translate z='4'/></transform><emitter type='area'/></shape>")
        .text;
  };
  EXPECT_NE(light("1").find("form(\"rectangle\", False, 7)"), std::string::npos) << light("1");
  EXPECT_EQ(light("1").find("sampled=False"), std::string::npos);
  EXPECT_NE(light("61").find(", sampled=False)"), std::string::npos) << light("61");
}

TEST(cycles_export, spots_and_skies_are_told_by_their_angles_and_axes) {
  const std::string text =
      exported(
          kCamera +
          "<emitter type='spot'><float name='cutoff_angle' value='45'/><float name='beam_width' value='0'/><texture "
          "name='texture' type='checkerboard'/></emitter><emitter type='directional'><vector name='direction' "
          "value='0,0,-2'/></emitter>")
          .text;
  EXPECT_NE(text.find("spot_light(\"light_0\", ((1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)), (1, 1, 1), "
                      "0.7853981633974483, 0, lambda g: g.checkerboard("),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("sun(\"light_1\", ((0, -1, 0), (1, 0, 0), (0, 0, 1), (0, 0, 0)), (1, 1, 1))"), std::string::npos)
      << text;
}

TEST(cycles_export, batches_share_the_samples_and_no_seed) {
  const auto sizes = [](int samples) {
    std::vector<int> result;
    for (const EngineBatch& batch : engine_batches(samples, 1)) result.push_back(batch.samples);
    return result;
  };
  EXPECT_EQ(sizes(1), std::vector<int>{1});
  EXPECT_EQ(sizes(7), (std::vector<int>{3, 2, 2}));
  EXPECT_EQ(sizes(1024), std::vector<int>(16, 64));
  std::set<std::uint32_t> seeds;
  for (std::uint64_t seed = 0; seed < 100; ++seed)
    for (const EngineBatch& batch : engine_batches(64, seed)) {
      seeds.insert(batch.seed);
      EXPECT_LT(batch.seed, 1u << 31);
    }
  EXPECT_EQ(seeds.size(), 1600u);
}

TEST(cycles_export, comments_cannot_be_left) {
  const std::string text =
      exported(kCamera +
               "<emitter type='constant'/><shape type='sphere'><bsdf type='diffuse' id='a&#10;import os'/></shape>")
          .text;
  EXPECT_NE(text.find("# material_0: bsdf 'a?import os'"), std::string::npos) << text;
  EXPECT_EQ(text.find("\nimport"), std::string::npos);
}

/// The reason why a scene of the library is refused; empty when it is not.
std::string why_refused(const std::string& scene) {
  try {
    export_cycles(parse_scene_file(kScenes + "library/" + scene + "/scene.xml"), {});
    return "";
  } catch (const NotRepresentable& error) {
    const std::string message = error.summary(), start = "not representable in Cycles: ";
    return message.substr(message.find(start) + start.size());
  }
}

TEST(cycles_export, refuses_scenes_of_the_library_for_what_they_say_and_has_no_residual_of_those) {
  int rendered = 0, measured = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes + "library")) {
    const std::string name = entry.path().filename().string(), why = why_refused(name);
    const Expect expect = read_expect((entry.path() / "expect.toml").string());
    const auto declared = expect.unsupported.find("cycles");
    EXPECT_EQ(declared == expect.unsupported.end() ? "" : declared->second, why) << name;
    EXPECT_FALSE(expect.cycles && !why.empty()) << name;
    rendered += why.empty() ? 1 : 0;
    measured += expect.cycles ? 1 : 0;
  }
  EXPECT_GE(rendered, 40);
  EXPECT_EQ(measured, rendered);
}

class CyclesFiles : public FolderTest {};

TEST_F(CyclesFiles, images_and_meshes_lie_beside_the_script) {
  const CyclesExport scene = export_cycles(parse_scene_file(kScenes + "library/forms/scene.xml"), {.stem = "mine"});
  write_script(scene, folder_ / "mine.py");
  const std::string text = get("mine.py");
  EXPECT_EQ(text.find("# Building blocks of the scene script below"), 0u);
  ASSERT_FALSE(scene.files.empty());
  for (const CyclesFile& file : scene.files) {
    EXPECT_EQ(file.name.rfind("mine_", 0), 0u);
    ASSERT_TRUE(has(file.name));
    EXPECT_NE(text.find("\"" + file.name + "\""), std::string::npos);
    if (!file.mesh) continue;
    const std::size_t vertices = file.mesh->positions.size();
    EXPECT_EQ(get(file.name).size(), 4 * (3 * vertices + 3 * file.mesh->triangles.size() + 2 * file.mesh->uvs.size() +
                                          3 * file.mesh->normals.size()));
  }
}

}  // namespace
}  // namespace photonproof::inline reference_cycles
