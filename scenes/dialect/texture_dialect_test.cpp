// Textures that Mitsuba 3 takes in other places mean the same as the scenes of this format beside them.
#include <gtest/gtest.h>

#include "scenes/parser/parser.h"
#include "scenes/parser/test_same_scene.h"

namespace photonproof::scene_xml {
namespace {

SceneDescription parse(const std::string& content) {
  return parse_scene_text(
      "<scene version='3.0.0'><sensor type='perspective'/><emitter type='point'/>" + content + "</scene>", "test.xml");
}

/// Empty when both texts mean the same.
std::string difference(const std::string& text, const std::string& same) {
  return first_difference(parse(text), parse(same));
}

const std::string kBoard = "<float name='color1' value='0.7'/>";

std::string board(const std::string& name = "") {
  return "<texture type='checkerboard'" + (name.empty() ? "" : " name='" + name + "'") + ">" + kBoard + "</texture>";
}
std::string shown(const std::string& attribute, const std::string& content = "") {
  return "<texture type='mesh_attribute' name='reflectance'><string name='name' value='" + attribute + "'/>" + content +
         "</texture>";
}
std::string diffuse(const std::string& content, const std::string& id = "") {
  return "<bsdf type='diffuse'" + (id.empty() ? "" : " id='" + id + "'") + ">" + content + "</bsdf>";
}
std::string ball(const std::string& content) { return "<shape type='sphere'>" + content + "</shape>"; }

TEST(attributes, of_shapes_are_their_textures) {
  EXPECT_EQ(difference(ball(board("vertex_a") + diffuse(shown("vertex_a"))), ball(diffuse(board("reflectance")))), "");
  EXPECT_EQ(difference(ball("<bsdf type='twosided'>" + diffuse(shown("face_a")) + "</bsdf>" + board("face_a")),
                       ball("<bsdf type='twosided'>" + diffuse(board("reflectance")) + "</bsdf>")),
            "");
  EXPECT_EQ(difference(ball(board("vertex_a") + diffuse(shown("vertex_a", "<float name='scale' value='0.5'/>"))),
                       ball(diffuse("<texture type='scale' name='reflectance'>" + board() +
                                    "<float name='scale' value='0.5'/></texture>"))),
            "");
}

TEST(attributes, of_shapes_change_no_other_shape_of_a_shared_bsdf) {
  const std::string shared = diffuse(shown("vertex_a"), "paint"), user = "<ref id='paint'/>";
  const auto scene = parse(shared + ball(board("vertex_a") + user) + ball(user));
  const auto reflectance = [&](std::size_t shape) {
    const auto& diffuse_one = std::get<DiffuseDescription>(scene.bsdfs.at(scene.shapes.at(shape).bsdf.value).model);
    return scene.textures.at(std::get<TextureIndex>(diffuse_one.reflectance).value).pattern;
  };
  EXPECT_TRUE(std::holds_alternative<CheckerboardDescription>(reflectance(0)));
  EXPECT_TRUE(std::holds_alternative<MeshAttributeDescription>(reflectance(1)));
}

TEST(attributes, of_another_name_stay) {
  const auto scene = parse(ball(board("vertex_a") + diffuse(shown("vertex_b"))));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_TRUE(std::holds_alternative<MeshAttributeDescription>(scene.textures[0].pattern));
}

TEST(d65, colours_a_texture) {
  const auto lamp = [](const std::string& radiance) {
    return "<shape type='rectangle'><emitter type='area'>" + radiance + "</emitter></shape>";
  };
  const std::string scaled =
      "<texture type='scale' name='radiance'>" + board() + "<float name='scale' value='6'/></texture>";
  EXPECT_EQ(difference(lamp("<spectrum type='d65' name='radiance'>" + board("nested") +
                            "<float name='scale' value='6'/></spectrum>"),
                       lamp(scaled)),
            "");
  EXPECT_EQ(difference(lamp("<texture type='d65' name='radiance'><float name='scale' value='6'/>" + board("any") +
                            "</texture>"),
                       lamp(scaled)),
            "");
}

}  // namespace
}  // namespace photonproof::scene_xml
