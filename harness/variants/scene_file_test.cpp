// A course's scene file from a template: the numbers of course-1 and course-2, and scenes that it cannot express.

#include "harness/variants/scene_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <variant>

#include "harness/variants/variant.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_variants {
namespace {

const std::string course_template = R"(size {{width}} {{height}}
camera {{camera.x}} {{camera.y}} {{camera.z}} {{camera.dx}} {{camera.dy}} {{camera.dz}} {{camera.ux}} {{camera.uy}} {{camera.uz}} {{camera.fov}}
{{#objects}}
{{#kind_sphere}}sphere {{x}} {{y}} {{z}} {{radius}}{{/kind_sphere}}{{#kind_rectangle}}rectangle {{x}} {{y}} {{z}}, {{ax}} {{ay}} {{az}}, {{bx}} {{by}} {{bz}}{{/kind_rectangle}}{{#kind_box}}box{{/kind_box}}{{#kind_water}}water {{y}}, {{ax}} {{ay}} {{az}}, {{bx}} {{by}} {{bz}}, {{cx}} {{cy}} {{cz}}, {{columns}} {{rows}} {{frequency_x}} {{frequency_y}} {{noise_seed}}{{/kind_water}} {{name}} {{#material_diffuse}}diffuse {{r}} {{g}} {{b}}{{/material_diffuse}}{{#material_mirror}}mirror {{r}}{{/material_mirror}}{{#material_glass}}glass {{r}} {{ior}}{{/material_glass}}{{#material_light}}light {{er}}{{/material_light}}
{{/objects}}
)";

SceneDescription scene_of_library(const std::string& name) {
  return parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + name + "/scene.xml");
}

TEST(SceneFile, has_the_numbers_of_the_scene) {
  // Normals a x b: the floor's is +y, the ceiling's and the light's -y.
  EXPECT_EQ(scene_file_text(scene_of_library("course-1"), 96, 64, course_template, "t"), R"(size 96 64
camera 0 0 150 0 0 -1 0 1 0 52.62529698957768
rectangle 0 -50 0, 50 0 0, 0 0 -50 grey diffuse 0.7 0.7 0.7
rectangle 0 50 0, 50 0 0, 0 0 50 grey diffuse 0.7 0.7 0.7
rectangle 0 0 -50, 50 0 0, 0 50 0 grey diffuse 0.7 0.7 0.7
rectangle 0 0 50, -50 0 0, 0 50 0 grey diffuse 0.7 0.7 0.7
rectangle -50 0 0, 0 0 -50, 0 50 0 left diffuse 0.92941176 0.52156863 0.14117647
rectangle 50 0 0, 0 0 50, 0 50 0 right diffuse 0.14117647 0.52156863 0.92941176
rectangle 0 49.99 0, 16 0 0, 0 0 16 black light 4.6627424733953715
sphere -27 -30 -30 20 mirror mirror 0.7
sphere 29 -30 -5 20 glass glass 0.89 1.8
)");
  const std::string water = scene_file_text(scene_of_library("course-2"), 96, 96, course_template, "t");
  EXPECT_THAT(
      water, testing::HasSubstr("water 22, 50 0 0, 0 0 -50, 0 1 0, 499 499 5.833333333333333 7 0 water glass 1 1.3\n"));
}

TEST(SceneFile, says_where_a_part_of_a_view_lies) {
  const Variant crop = make_variant("crop", 3, scene_of_library("course-1"), 96, 96);
  int x = 0, y = 0;
  ASSERT_EQ(std::sscanf(scene_file_text(crop.scene, 96, 96, "{{shift_x}} {{shift_y}}", "t").c_str(), "%d %d", &x, &y),
            2);
  const auto& camera = std::get<PerspectiveDescription>(crop.scene.sensor.camera);
  EXPECT_NEAR(x, camera.principal_x * 96, 1e-9);
  EXPECT_NEAR(y, camera.principal_y * 96, 1e-9);
}

TEST(SceneFile, of_a_mirrored_scene_keeps_normals_inside) {
  const Variant mirrored = make_variant("mirror", 1, scene_of_library("course-1"), 96, 96);
  const std::string text = scene_file_text(mirrored.scene, 96, 96, course_template, "t");
  // The left wall is now the right one, with the normal -x: (0, 0, 50) x (0, 50, 0) = (-2500, 0, 0).
  EXPECT_THAT(text, testing::HasSubstr("sphere 27 -30 -30 20 mirror"));
  EXPECT_THAT(text, testing::HasSubstr("rectangle 50 0 0, 0 0 50, 0 50 0 left diffuse 0.92941176"));
  const Variant water = make_variant("mirror", 1, scene_of_library("course-2"), 96, 96);
  EXPECT_THAT(scene_file_text(water.scene, 96, 96, course_template, "t"),
              testing::HasSubstr("water 22, -50 0 0, 0 0 -50, 0 1 0, 499 499"));
}

TEST(SceneFile, says_what_it_cannot_say) {
  const auto error_of = [](const std::string& scene, const std::string& text) {
    return input_error_of([&] { scene_file_text(scene_of_library(scene), 8, 8, text, "scene.mustache"); });
  };
  EXPECT_THAT(error_of("roughness", "{{width}}"), testing::HasSubstr("the course's scene files cannot express"));
  EXPECT_THAT(error_of("light-point", "{{width}}"),
              testing::HasSubstr("cannot express a light other than a shape that shines"));
  EXPECT_THAT(error_of("course-1", "{{#objects}}"), testing::StartsWith("scene.mustache: error: "));
  EXPECT_EQ(error_of("course-1", "{{#objects}}{{shininess}}{{/objects}}"),
            "scene.mustache: error: it names 'shininess', which no scene has");
}

TEST(SceneFile, escapes_nothing_and_lets_no_name_out_of_its_word) {
  SceneDescription scene = scene_of_library("course-1");
  for (ShapeDescription& shape : scene.shapes) shape.id = "a&b <\"\n{{x}}";
  const std::string text = scene_file_text(scene, 8, 8, "{{#objects}}<&>{{name}};{{/objects}}", "t");
  EXPECT_THAT(text, testing::StartsWith("<&>a_b______x__;<&>"));
}

}  // namespace
}  // namespace photonproof::inline harness_variants
