// Includes, $names, and the limits on what a hostile file can ask for.
#include "scenes/parser/expand.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "scenes/files/test_folder.h"

namespace photonproof::inline scenes_parser {
namespace {

namespace fs = std::filesystem;

const std::string kSensorAndLight =
    "<sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor><emitter type='point'/>";

std::string scene_of(const std::string& content) { return "<scene version='3.0.0'>" + content + "</scene>"; }

template <class Action>
std::string message_of(Action action) {
  try {
    action();
    return "no error";
  } catch (const InputError& error) {
    return error.summary();
  }
}

std::string message_of_text(const std::string& text, const ParseOptions& options = {}) {
  return message_of([&] { parse_scene_text(text, "test.xml", options); });
}

double radius_with(const std::string& content, const std::map<std::string, std::string>& defines) {
  const auto scene = parse_scene_text(scene_of(kSensorAndLight + content), "test.xml", {defines, false});
  return std::get<SphereDescription>(scene.shapes.at(0).geometry).radius;
}

const std::string kSphere = "<shape type='sphere'><float name='radius' value='$r'/></shape>";

TEST(names, take_the_command_line_before_the_first_default) {
  EXPECT_EQ(radius_with("<default name='r' value='2'/>" + kSphere, {}), 2);
  EXPECT_EQ(radius_with("<default name='r' value='2'/><default name='r' value='3'/>" + kSphere, {}), 2);
  EXPECT_EQ(radius_with("<default name='r' value='2'/>" + kSphere, {{"r", "4"}}), 4);
  EXPECT_EQ(radius_with(kSphere, {{"r", "4"}}), 4);
}

TEST(names, are_replaced_anywhere_in_a_value_but_only_whole) {
  EXPECT_EQ(radius_with("<default name='r' value='1.$d'/>" + kSphere, {{"d", "25"}}), 1.25);
  EXPECT_EQ(
      message_of_text(scene_of("<bsdf type='diffuse' id='$ab'/>"), {{{"a", "x"}}, false}),
      "test.xml:1:45: error: '$ab' is not defined (did you mean 'a'?), expected a <default> before it or -D ab=...");
}

TEST(names, are_not_replaced_behind_a_backslash) {
  const auto scene = parse_scene_text(scene_of(kSensorAndLight + "<bsdf type='diffuse' id='\\$r'/>"), "test.xml");
  EXPECT_EQ(scene.bsdfs[0].id, "$r");
}

TEST(names, given_on_the_command_line_must_be_used) {
  const std::string text = scene_of("<default name='size' value='1'/>" + kSensorAndLight);
  EXPECT_EQ(message_of_text(text, {{{"sise", "2"}}, false}),
            "-D sise: error: the scene has no '$sise' (did you mean 'size'?)");
  EXPECT_EQ(message_of_text(text, {{{"size", "2"}}, false}), "-D size: error: the scene has no '$size'");
}

TEST(names, given_on_the_command_line_must_be_names_with_printable_values) {
  EXPECT_EQ(message_of_text("", {{{"a\xFF", "1"}}, false}),
            "-D a?: error: 'a?' is not a name, expected letters, digits and _");
  EXPECT_EQ(message_of_text("", {{{"", "1"}}, false}), "-D : error: '' is not a name, expected letters, digits and _");
  EXPECT_EQ(message_of_text("", {{{"a", "gr\xFCn"}}, false}),
            "-D a: error: the value 'gr?n' is not printable UTF-8 text");
  EXPECT_EQ(message_of_text("", {{{"a", "\x1B[31m"}}, false}),
            "-D a: error: the value '?[31m' is not printable UTF-8 text");
}

TEST(limits, stop_a_scene_of_too_many_elements) {
  std::string text = "<scene version='3.0.0'>";
  for (std::size_t i = 0; i < scene_xml::kMaxElements; ++i) text += "<a/>";
  text += "</scene>";
  EXPECT_EQ(message_of_text(text).substr(0, 13), "test.xml:1:40");
  EXPECT_NE(message_of_text(text).find("error: the scene has more than 1000000 elements"), std::string::npos);
}

TEST(limits, stop_a_text_of_too_many_bytes) {
  EXPECT_EQ(message_of_text(std::string(scene_xml::kMaxFileBytes + 1, ' ')),
            "test.xml: error: text has 67108865 bytes, the limit is 67108864");
}

class includes : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    fs::create_directories(folder_ / "scene" / "parts");
  }
  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  std::string message(const ParseOptions& options = {}) const {
    return message_of([&] { parse_scene_file(path("scene/scene.xml"), options); });
  }
};

TEST_F(includes, are_read_in_place_relative_to_the_file_that_names_them) {
  write("scene/scene.xml", scene_of("<default name='r' value='7'/>" + kSensorAndLight +
                                    "<include filename='parts/a.xml'/><shape type='cube'/>"));
  write("scene/parts/a.xml", scene_of("<include filename='b.xml'/>"));
  write("scene/parts/b.xml", scene_of("\n" + kSphere));
  const auto scene = parse_scene_file(path("scene/scene.xml"));
  ASSERT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(std::get<SphereDescription>(scene.shapes[0].geometry).radius, 7);
  EXPECT_EQ(scene.where(scene.shapes[0].loc), path("scene/parts/b.xml") + ":2:1");
  EXPECT_EQ(scene.where(scene.shapes[1].loc).substr(0, path("scene/scene.xml").size()), path("scene/scene.xml"));
  EXPECT_EQ(scene.files,
            (std::vector<std::string>{path("scene/scene.xml"), path("scene/parts/a.xml"), path("scene/parts/b.xml")}));
}

TEST_F(includes, may_leave_the_folder_only_when_allowed) {
  write("outside.xml", scene_of("<shape type='cube'/>"));
  write("scene/scene.xml", scene_of(kSensorAndLight + "<include filename='../outside.xml'/>"));
  EXPECT_NE(message().find("'../outside.xml' lies outside the scene's folder"), std::string::npos) << message();
  EXPECT_EQ(parse_scene_file(path("scene/scene.xml"), {{}, true}).shapes.size(), 1u);
}

TEST_F(includes, may_not_leave_the_folder_through_a_symbolic_link) {
  write("outside.xml", scene_of("<shape type='cube'/>"));
  fs::create_symlink("../outside.xml", folder_ / "scene" / "inside.xml");
  fs::create_directory_symlink("..", folder_ / "scene" / "up");
  for (const char* name : {"inside.xml", "up/outside.xml", "parts/../../outside.xml"}) {
    write("scene/scene.xml", scene_of(kSensorAndLight + "<include filename='" + name + "'/>"));
    EXPECT_NE(message().find("lies outside the scene's folder"), std::string::npos) << message();
  }
}

TEST_F(includes, may_stay_in_the_folder_through_a_symbolic_link) {
  write("scene/parts/real.xml", scene_of("<shape type='cube'/>"));
  fs::create_symlink("parts/real.xml", folder_ / "scene" / "link.xml");
  write("scene/scene.xml", scene_of(kSensorAndLight + "<include filename='link.xml'/>"));
  EXPECT_EQ(message(), "no error");
}

TEST_F(includes, must_be_regular_files) {
  write("scene/scene.xml", scene_of(kSensorAndLight + "<include filename='parts'/>"));
  EXPECT_NE(message().find("cannot include " + path("scene/parts") + ": error: not a regular file"), std::string::npos)
      << message();
}

TEST_F(includes, are_limited_in_number) {
  write("scene/leaf.xml", scene_of(""));
  std::string content = kSensorAndLight;
  for (std::size_t i = 0; i < scene_xml::kMaxIncludes; ++i) content += "<include filename='leaf.xml'/>";
  write("scene/scene.xml", scene_of(content));
  EXPECT_EQ(message(), "no error");
  write("scene/scene.xml", scene_of(content + "<include filename='leaf.xml'/>"));
  EXPECT_NE(message().find("error: more than 256 includes"), std::string::npos) << message();
}

TEST_F(includes, are_limited_in_depth) {
  for (int i = 0; i < 70; ++i)
    write("scene/" + std::to_string(i) + ".xml", scene_of("<include filename='" + std::to_string(i + 1) + ".xml'/>"));
  write("scene/scene.xml", scene_of("<include filename='0.xml'/>"));
  EXPECT_NE(message().find("error: elements are nested more than 64 deep"), std::string::npos) << message();
}

TEST_F(includes, are_limited_in_size) {
  write("scene/big.xml", "");
  fs::resize_file(folder_ / "scene" / "big.xml", scene_xml::kMaxFileBytes + 1);
  write("scene/scene.xml", scene_of("<include filename='big.xml'/>"));
  EXPECT_NE(message().find("file has 67108865 bytes, the limit is 67108864"), std::string::npos) << message();
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
