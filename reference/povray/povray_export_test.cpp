// The structure of the exported text: parts that occur once, and parts that occur only when a scene needs them.
#include "reference/povray/povray_export.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "reference/engines/not_representable.h"
#include "scenes/description/expect.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_povray {
namespace {

const std::string kScenes = PHOTONPROOF_SOURCE_DIR "/scenes/";

PovrayExport exported(const std::string& scene, const PovrayOptions& options = {}) {
  return export_povray(parse_scene_file(kScenes + "library/" + scene + "/scene.xml"), options);
}

/// The text without its comments, which repeat what the scene's author wrote.
std::string code(const PovrayExport& scene) {
  std::istringstream lines(scene.sdl.str());
  std::string result;
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("//", 0) != 0) result += line + "\n";
  return result;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + word.size())) ++n;
  return n;
}

/// The reason why a scene of the library is refused; empty when it is not.
std::string why_refused(const std::string& scene) {
  try {
    exported(scene);
    return "";
  } catch (const NotRepresentable& error) {
    const std::string message = error.summary(), start = "not representable in POV-Ray: ";
    return message.substr(message.find(start) + start.size());
  }
}

TEST(povray_export, refuses_scenes_of_the_library_for_what_they_say_and_has_a_residual_of_the_others) {
  int rendered = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kScenes + "library")) {
    const std::string name = entry.path().filename().string(), why = why_refused(name);
    const Expect expect = read_expect((entry.path() / "expect.toml").string());
    const auto declared = expect.unsupported.find("povray");
    EXPECT_EQ(declared == expect.unsupported.end() ? "" : declared->second, why) << name;
    EXPECT_EQ(expect.povray.has_value(), why.empty()) << name << ": reference/measure_library.py --update";
    rendered += why.empty() ? 1 : 0;
  }
  EXPECT_GE(rendered, 48);
}

TEST(povray_export, balances_its_braces_in_every_scene_of_the_library) {
  for (const auto& entry : std::filesystem::directory_iterator(kScenes + "library")) {
    const std::string name = entry.path().filename().string();
    if (!why_refused(name).empty()) continue;
    const std::string text = code(exported(name));
    for (const auto& [open, close] : {std::pair("{", "}"), std::pair("(", ")"), std::pair("<", ">")})
      EXPECT_EQ(count(text, open), count(text, close)) << entry.path() << " " << open;
    EXPECT_EQ(count(text, "\ncamera{"), 1u) << entry.path();
    EXPECT_EQ(count(text, "\nglobal_settings{"), 1u) << entry.path();
    EXPECT_EQ(count(text, "#version 3.7;\n"), 1u) << entry.path();
    EXPECT_EQ(count(text, "#macro"), count(text, "#end")) << entry.path();
  }
}

TEST(povray_export, lights_cornell_spheres_by_as_many_points_as_the_preset_says) {
  // With photons 5 x 5 points at quality 1 and 6 x 6 above, and for radiosity 2 x 2, 3 x 3 and 4 x 4: one rectangle.
  const std::size_t expected[] = {25 + 4, 36 + 9, 36 + 16};
  for (int quality = 1; quality <= 3; ++quality) {
    const std::string text = code(exported("cornell-spheres", {.quality = quality}));
    EXPECT_EQ(count(text, "\nSpot("), expected[quality - 1]) << quality;
    EXPECT_EQ(count(text, "light_source{"), 1u) << "in the macro";
    EXPECT_EQ(count(text, "light_group{"), 1u);
  }
}

TEST(povray_export, writes_the_surfaces_of_cornell_spheres_once_each_and_the_walls_again_for_radiosity) {
  const std::string text = code(exported("cornell-spheres"));
  EXPECT_EQ(count(text, "\nsphere{"), 2u);
  EXPECT_EQ(count(text, "\npolygon{"), 5u + 1 + 6) << "walls, the light, and both for radiosity";
  EXPECT_EQ(count(text, "interior{Interior_"), 1u) << "the glass";
  EXPECT_EQ(count(text, "photons{target "), 2u) << "mirror and glass";
  EXPECT_EQ(count(text, " no_shadow}"), 5u);
  EXPECT_EQ(count(text, " no_shadow no_reflection}"), 1u) << "the light hides what is behind it from radiosity, too";
  EXPECT_EQ(count(text, "no_image"), 0u) << "which would show radiosity's rays no photons";
}

TEST(povray_export, asks_for_radiosity_only_where_surfaces_see_each_other) {
  EXPECT_EQ(count(code(exported("cornell-spheres")), "radiosity{"), 1u);
  const PovrayExport plane = exported("light-area");
  EXPECT_EQ(count(code(plane), "radiosity{"), 0u);
  EXPECT_EQ(plane.skipped.at(0), "radiosity: no two diffuse surfaces see each other");
}

TEST(povray_export, shoots_photons_only_where_something_is_specular) {
  EXPECT_EQ(count(code(exported("cornell-spheres")), "\n  photons{"), 1u);
  const PovrayExport matte = exported("cornell");
  EXPECT_EQ(count(code(matte), "photons{"), 0u);
  EXPECT_EQ(matte.skipped, std::vector<std::string>{"photons: nothing is specular"});
}

TEST(povray_export, has_a_point_for_each_of_many_lights_and_fewer_for_radiosity) {
  const std::string text = code(exported("many-lights"));
  // 1000 lights in the picture, and for radiosity every fourth, from the first on: 250.
  EXPECT_EQ(count(text, "\nlight_source{") + count(text, "\nSpot("), 1000u + 250);
  EXPECT_EQ(count(text, "count 24,20000"), 1u) << "by fewer rays";
}

TEST(povray_export, fills_its_cache_densely_with_fewer_rays_where_bounces_are_many) {
  EXPECT_EQ(count(code(exported("cornell")), "count 96,20000"), 1u);
  EXPECT_EQ(count(code(exported("cornell")), "low_error_factor 0.3 "), 1u);
  EXPECT_EQ(count(code(exported("million")), "count 192,20000"), 1u);
  EXPECT_EQ(count(code(exported("million")), "low_error_factor 0.8 "), 1u);
}

TEST(povray_export, refines_the_edges_of_lights_further) {
  const PovrayOptions apart{.width = 64, .height = 64, .lights_apart = true};
  EXPECT_EQ(exported("cornell").antialias.at(2), "+R7");
  EXPECT_EQ(exported("light-point").antialias.at(2), "+R5") << "its light has no body";
  EXPECT_EQ(exported("many-lights", apart).antialias.at(2), "+R2") << "every sample costs a thousand shadow rays";
  EXPECT_EQ(exported("caustic-glass", apart).besides.at(0).antialias.at(2), "+R6") << "of 13 x 13 sub-pixels";
}

TEST(povray_export, keeps_what_a_scene_says_inside_comments) {
  SceneDescription scene = parse_scene_file(kScenes + "library/light-point/scene.xml");
  scene.shapes.at(0).id = "a\nsphere{0,1} // \x01";
  const PovrayExport text = export_povray(scene, {});
  EXPECT_EQ(count(code(text), "sphere{"), 0u);
  EXPECT_EQ(count(text.sdl.str(), "// shape 'a?sphere{0,1} // ?' of "), 1u);
}

/// Two triangles that share an edge, with numbers that single precision holds.
SceneDescription scene_with_mesh(bool flip, const Transform& to_world) {
  SceneDescription scene = parse_scene_file(kScenes + "library/light-point/scene.xml");
  TriangleMesh mesh;
  mesh.resize_positions(4);
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 0, -1}, {0.1f, 0.25f, -1}};
  mesh.triangles = {{0, 1, 2}, {1, 3, 2}};
  ShapeDescription& shape = scene.shapes.at(0);
  shape.geometry =
      MeshDescription{MeshDescription::Format::ply, "two.ply", true, false, std::make_shared<const TriangleMesh>(mesh)};
  shape.id = "two";
  shape.to_world = to_world;
  shape.flip_normals = flip;
  return scene;
}

std::string mesh_text(const PovrayExport& scene) {
  const std::string text = scene.sdl.str();
  const auto begin = text.find("#declare Mesh_0");
  const auto end = text.find("\n", text.find("object{Mesh_0")) + 1;
  return text.substr(begin, end - begin);
}

TEST(povray_mesh, is_written_in_world_space_clockwise_from_the_front) {
  const PovrayExport text = export_povray(scene_with_mesh(false, Transform::translate({0, 2, 0})), {});
  // The light stands at y = 1: the ball around everything has a radius of some 1, and the scale is 64.
  EXPECT_EQ(mesh_text(text),
            "#declare Mesh_0 = mesh2{\n"
            "vertex_vectors{4\n,<0,128,0>\n,<64,128,0>\n,<0,128,-64>\n,<6.4,144,-64>\n}\n"
            "face_indices{2\n,<0,2,1>\n,<1,2,3>\n}}\n"
            "object{Mesh_0 texture{Bsdf_0} interior_texture{Black} no_radiosity}\n");
  EXPECT_NE(std::find(text.explanations.begin(), text.explanations.end(),
                      "shape 'two' of " + kScenes +
                          "library/light-point/scene.xml:29:3: a mesh2 of 2 flat "
                          "triangles, in world space and single precision"),
            text.explanations.end());
}

TEST(povray_mesh, turns_over_when_normals_are_flipped) {
  const std::string text = mesh_text(export_povray(scene_with_mesh(true, Transform()), {}));
  EXPECT_NE(text.find("face_indices{2\n,<0,1,2>\n,<1,3,2>\n}}"), std::string::npos) << text;
}

TEST(povray_mesh, has_normals_where_it_is_smooth) {
  SceneDescription scene = scene_with_mesh(false, Transform::scale({1, 1, 2}));
  std::get<MeshDescription>(scene.shapes.at(0).geometry).face_normals = false;
  const std::string text = mesh_text(export_povray(scene, {}));
  // The first triangle is flat on y = 0; its corner (0,0,0) has no other. Stretched along z the normal stays.
  EXPECT_NE(text.find("normal_vectors{4\n,<0,1,0>\n"), std::string::npos) << text;
  EXPECT_NE(text.find(",<1,2,3>\n}}"), std::string::npos) << "the faces come after";
}

TEST(povray_mesh, is_declared_once_for_the_picture_and_for_radiosity) {
  const std::string text = code(exported("million"));
  EXPECT_EQ(count(text, "mesh2{"), 2u);
  EXPECT_EQ(count(text, "\nobject{Mesh_0 "), 2u);
  EXPECT_EQ(count(text, "\nobject{Mesh_1 "), 2u);
}

TEST(povray_mesh, is_streamed_to_the_file) {
  const PovrayExport scene = exported("million");
  const ScratchFolder folder("povray-export-test");
  const auto file = folder.path() / "scene.pov";
  write_sdl(scene, file);
  EXPECT_EQ(read_file(file), scene.sdl.str());
  try {
    write_sdl(scene, "/nonexistent/scene.pov");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/nonexistent/scene.pov: error: folder '/nonexistent' does not exist");
  }
}

}  // namespace
}  // namespace photonproof::inline reference_povray
