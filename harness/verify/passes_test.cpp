#include "harness/verify/passes.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_verify {
namespace {

SceneDescription scene_of(const std::string& content) {
  return parse_scene_text(R"(<scene version="3.0.0"><sensor type="perspective"/>)" + content + "</scene>", "scene.xml");
}

std::vector<std::string> names_of(const SceneDescription& scene) {
  std::vector<std::string> names;
  for (const ScenePass& pass : passes_of(scene)) names.push_back(pass.name);
  return names;
}

const SceneDescription& pass_of(const std::vector<ScenePass>& passes, const std::string& name) {
  return std::ranges::find(passes, name, &ScenePass::name)->scene;
}

const std::string area_light = R"(<shape type="sphere"><emitter type="area"><rgb name="radiance" value="7"/></emitter>
  <bsdf type="diffuse"><rgb name="reflectance" value="0.64"/></bsdf></shape>)";
const std::string glass = R"(<medium type="homogeneous" id="ink"/><shape type="sphere"><bsdf type="dielectric"/>
  <ref name="interior" id="ink"/></shape>)";

TEST(Passes, are_those_that_the_scene_has_light_for) {
  EXPECT_EQ(names_of(scene_of(area_light)), (std::vector<std::string>{"shapes", "direct", "indirect"}));
  EXPECT_EQ(names_of(scene_of(area_light + glass)),
            (std::vector<std::string>{"shapes", "direct", "indirect", "glass", "caustic", "medium"}));
  EXPECT_EQ(names_of(scene_of(area_light + R"(<shape type="sphere"><bsdf type="conductor"/></shape>
    <shape type="sphere"><bsdf type="plastic"/></shape><shape type="sphere"><bsdf type="diffuse">
    <texture name="reflectance" type="checkerboard"/></bsdf></shape>)")),
            (std::vector<std::string>{"shapes", "direct", "indirect", "texture", "gloss", "mirror", "caustic"}));
}

double albedo(const SceneDescription& scene, std::size_t shape) {
  const auto& model = scene.bsdfs[scene.shapes[shape].bsdf.value].model;
  return std::get<RgbD>(std::get<DiffuseDescription>(model).reflectance).x;
}

TEST(Passes, direct_light_is_dim_and_has_no_glass) {
  const std::vector<ScenePass> passes = passes_of(scene_of(area_light + glass));
  EXPECT_EQ(albedo(pass_of(passes, "direct"), 0), 0.02);
  EXPECT_EQ(albedo(pass_of(passes, "direct"), 1), 0);
  EXPECT_EQ(albedo(pass_of(passes, "indirect"), 0), 0.64);
  EXPECT_TRUE(pass_of(passes, "direct").media.empty());
  EXPECT_FALSE(pass_of(passes, "direct").shapes[1].interior);
  EXPECT_EQ(std::get<RgbD>(*pass_of(passes, "direct").shapes[0].radiance).x, 7);
}

TEST(Passes, surfaces_emit_where_mirrors_and_glass_are_looked_at) {
  const SceneDescription scene = pass_of(
      passes_of(scene_of(area_light + glass + R"(<emitter type="point"/><emitter type="constant"/>)")), "glass");
  EXPECT_TRUE(scene.shapes[0].radiance);
  EXPECT_FALSE(scene.shapes[1].radiance);
  EXPECT_EQ(albedo(scene, 0), 0);
  EXPECT_TRUE(std::holds_alternative<DielectricDescription>(scene.bsdfs[scene.shapes[1].bsdf.value].model));
  ASSERT_EQ(scene.emitters.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<ConstantLightDescription>(scene.emitters[0].light));
}

TEST(Passes, textures_are_their_mean_where_they_are_left_out) {
  const std::vector<ScenePass> passes = passes_of(scene_of(R"(<shape type="sphere"><bsdf type="diffuse">
    <texture name="reflectance" type="checkerboard"><rgb name="color0" value="0.2"/><rgb name="color1" value="0.6"/>
    </texture></bsdf></shape><emitter type="point"/>)"));
  EXPECT_NEAR(albedo(pass_of(passes, "indirect"), 0), 0.4, 1e-12);
  const auto& model = pass_of(passes, "texture").bsdfs[0].model;
  EXPECT_TRUE(std::holds_alternative<TextureIndex>(std::get<DiffuseDescription>(model).reflectance));
}

// Engines read passes from files.
TEST(Passes, of_every_library_scene_can_be_written_and_read) {
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_SOURCE_DIR "/scenes/library")) {
    const std::string file = (entry.path() / "scene.xml").string();
    if (entry.path().filename() == "million") continue;  // takes seconds to read
    for (const ScenePass& pass : passes_of(parse_scene_file(file))) {
      const std::string error = input_error_of([&] { parse_scene_text(write_scene(pass.scene), file); });
      EXPECT_EQ(error, "no error") << file << " " << pass.name;
    }
  }
}

}  // namespace
}  // namespace photonproof::inline harness_verify
