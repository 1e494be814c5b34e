// Files that a scene names: the search path, refusals, and that a shared file is read once.
#include "scenes/parser/scene_files.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_parser {
namespace {

namespace fs = std::filesystem;

class SceneFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "scene/parts");
    TriangleMesh mesh;
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    write_ply(folder_ / "scene/parts/one.ply", mesh);
    mesh.triangles.push_back({2, 1, 0});
    write_ply(folder_ / "two.ply", mesh);
  }

  static std::string shape(const std::string& filename, const std::string& more = "") {
    return "<shape type='ply'><string name='filename' value='" + filename + "'/>" + more + "</shape>";
  }
  SceneDescription parse(const std::string& shapes, bool allow_outside = false) const {
    return parse_named(folder_ / "scene/scene.xml", shapes, allow_outside);
  }
  static SceneDescription parse_named(const fs::path& name, const std::string& shapes, bool allow_outside = false) {
    return parse_scene_text(
        "<scene version='3.0.0'><sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>"
        "<emitter type='point'/>\n" +
            shapes + "</scene>",
        name.string(), {{}, allow_outside});
  }
  std::string message(const std::string& shapes) const {
    try {
      parse(shapes);
      return "no error";
    } catch (const InputError& error) {
      std::string text = error.summary();
      for (auto at = text.find(folder_.string()); at != std::string::npos; at = text.find(folder_.string()))
        text.erase(at, folder_.string().size() + 1);
      return text;
    }
  }

  const ScratchFolder scratch_{"scene-files-test"};
  const fs::path folder_ = fs::canonical(scratch_.path());
};

TEST_F(SceneFiles, gives_a_mesh_with_mitsubas_defaults) {
  const ShapeDescription found = parse(shape("parts/one.ply")).shapes.at(0);
  const auto& ply = std::get<MeshDescription>(found.geometry);
  EXPECT_EQ(ply.filename, "parts/one.ply");
  EXPECT_FALSE(ply.face_normals);
  EXPECT_FALSE(found.flip_normals);
  EXPECT_EQ(*ply.mesh, read_ply((folder_ / "scene/parts/one.ply").string()));
  EXPECT_TRUE(ply.mesh->is_padded());
}

TEST_F(SceneFiles, reads_the_parameters_of_a_mesh) {
  const ShapeDescription found = parse(shape("parts/one.ply",
                                             "<boolean name='face_normals' value='true'/><boolean name='flip_normals' "
                                             "value='true'/><transform name='to_world'><scale value='2'/></transform>"))
                                     .shapes.at(0);
  EXPECT_TRUE(std::get<MeshDescription>(found.geometry).face_normals);
  EXPECT_TRUE(found.flip_normals);
  EXPECT_EQ(found.to_world, Transform::scale(Vec3d(2)));
}

TEST_F(SceneFiles, reads_a_file_once_however_it_is_spelled) {
  const SceneDescription scene = parse(shape("parts/one.ply") + shape("./parts/../parts/one.ply"));
  EXPECT_EQ(std::get<MeshDescription>(scene.shapes[0].geometry).mesh,
            std::get<MeshDescription>(scene.shapes[1].geometry).mesh);
  EXPECT_NE(scene.shapes[0].geometry, scene.shapes[1].geometry) << "the spelling is kept";
}

TEST_F(SceneFiles, tells_meshes_apart_by_content) {
  const SceneDescription one = parse(shape("../two.ply"), true), two = parse(shape("../two.ply"), true);
  EXPECT_EQ(one.shapes[0].geometry, two.shapes[0].geometry) << "read twice";
  TriangleMesh other = *std::get<MeshDescription>(two.shapes[0].geometry).mesh;
  other.positions[0].x = 0.5f;
  EXPECT_NE(one.shapes[0].geometry,
            decltype(ShapeDescription::geometry)(MeshDescription{MeshDescription::Format::ply, "../two.ply", false,
                                                                 false, std::make_shared<const TriangleMesh>(other)}));
}

TEST_F(SceneFiles, refuses_what_is_missing_or_outside) {
  EXPECT_EQ(message(shape("none.ply")), "scene/scene.xml:2:43: error: no such file: 'none.ply'");
  EXPECT_EQ(message(shape("")), "scene/scene.xml:2:43: error: expected a file name");
  EXPECT_EQ(message(shape("parts")), "scene/scene.xml:2:43: error: cannot read scene/parts: error: not a regular file");
  EXPECT_EQ(message(shape("../two.ply")),
            "scene/scene.xml:2:43: error: '../two.ply' lies outside the scene's folder (--allow-outside permits it)");
  EXPECT_EQ(parse(shape("../two.ply"), true).shapes.size(), 1u);
}

TEST_F(SceneFiles, says_what_is_missing_beside_a_scene_named_without_a_folder) {
  const fs::path before = fs::current_path();
  fs::current_path(folder_ / "scene");
  std::string summary;
  try {
    parse_named("scene.xml", shape("none.ply"));
  } catch (const InputError& error) {
    summary = error.summary();
  }
  fs::current_path(before);
  EXPECT_EQ(summary, "scene.xml:2:43: error: no such file: 'none.ply'");
}

TEST_F(SceneFiles, names_the_line_of_the_scene_and_that_of_a_broken_file) {
  write_file_atomically(folder_ / "scene/bad.ply", "ply\nformat ascii 2.0\n");
  const std::string said = message(shape("bad.ply"));
  EXPECT_TRUE(said.starts_with("scene/scene.xml:2:43: error: cannot use scene/bad.ply:2:")) << said;
}

TEST_F(SceneFiles, refuses_a_link_that_leads_outside) {
  fs::create_symlink("../two.ply", folder_ / "scene/link.ply");
  EXPECT_EQ(message(shape("link.ply")),
            "scene/scene.xml:2:43: error: 'link.ply' lies outside the scene's folder (--allow-outside permits it)");
}

const std::string kLight = "<emitter type='point'/>", kSensor = "<sensor type='perspective'/>";

class files : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "scene/pictures");
    fs::create_directories(folder_ / "common");
    Image image(2, 1);
    image.rgb = {0.25f, 0.5f, 1, 0, 0, 0};
    write_png((folder_ / "scene/pictures/a.png").string(), image);
    write_exr((folder_ / "common/b.exr").string(), {image, {}, {}});
    image.rgb[4] = -1;
    write_exr((folder_ / "scene/negative.exr").string(), {image, {}, {}});
    image.rgb[4] = std::nanf("");
    write_exr((folder_ / "scene/nan.exr").string(), {image, {}, {}});
  }
  static std::string bitmap(const std::string& file, const std::string& more = "") {
    return "<bsdf type='diffuse' id='" + file + more +
           "'><texture type='bitmap' name='reflectance'><string name='filename' value='" + file + "'/>" + more +
           "</texture></bsdf>";
  }
  SceneDescription load(const std::string& content, bool allow_outside = false) const {
    return parse_scene_text("<scene version='3.0.0'>" + kSensor + kLight + "\n" + content + "</scene>",
                            (folder_ / "scene/scene.xml").string(), {{}, allow_outside});
  }
  std::string message(const std::string& content) const {
    try {
      load(content);
      return "no error";
    } catch (const InputError& error) {
      const std::string text = error.summary();
      return text.substr(text.find("error: "));
    }
  }

  const ScratchFolder scratch_{"plugins-test"};
  const fs::path folder_ = fs::canonical(scratch_.path());
};

TEST_F(files, of_textures_are_decoded_unless_raw_and_read_once) {
  const auto scene = load(
      "<texture type='bitmap' id='a'><string name='filename' value='pictures/a.png'/></texture>"
      "<texture type='bitmap' id='b'><string name='filename' value='pictures/../pictures/a.png'/></texture>"
      "<texture type='bitmap' id='c'><string name='filename' value='pictures/a.png'/><boolean name='raw' "
      "value='true'/></texture>");
  const auto& a = std::get<BitmapDescription>(scene.textures[0].pattern);
  const auto& b = std::get<BitmapDescription>(scene.textures[1].pattern);
  const auto& raw = std::get<BitmapDescription>(scene.textures[2].pattern);
  EXPECT_EQ(a.image, b.image);
  EXPECT_NE(a.image, raw.image);
  // 0.25 is sRGB code 0.5371, rounded to 137/255.
  EXPECT_NEAR(a.image->rgb[0], 0.25, 0.003);
  EXPECT_NEAR(raw.image->rgb[0], 137 / 255.0, 1e-6);
}

TEST_F(files, of_textures_must_have_sound_values) {
  EXPECT_NE(message(bitmap("negative.exr")).find("negative.exr: error: has a negative value at column 1, row 0"),
            std::string::npos);
  EXPECT_NE(message(bitmap("nan.exr")).find("nan.exr: error: has a value that is not finite at column 1, row 0"),
            std::string::npos);
}

TEST_F(files, are_looked_for_in_the_folders_of_path_the_last_one_first) {
  fs::copy(folder_ / "scene/pictures/a.png", folder_ / "common/a.png");
  const std::string both = "<path value='pictures'/><path value='../common'/>" + bitmap("a.png");
  EXPECT_EQ(std::get<BitmapDescription>(load(both, true).textures[0].pattern).filename, "../common/a.png")
      << "the name that a scene without <path> would use";
  EXPECT_EQ(
      std::get<BitmapDescription>(load("<path value='pictures'/>" + bitmap("a.png")).textures[0].pattern).filename,
      "pictures/a.png");
  EXPECT_EQ(message(both), "error: '../common' lies outside the scene's folder (--allow-outside permits it)");
  EXPECT_EQ(message("<path value='pictures'/>" + bitmap("../../common/b.exr")),
            "error: '../../common/b.exr' lies outside the scene's folder (--allow-outside permits it)");
}

TEST_F(files, of_an_include_find_what_they_name_from_the_scene_or_from_themselves) {
  fs::create_directories(folder_ / "scene/include");
  std::ofstream(folder_ / "scene/include/a.xml")
      << "<scene version='3.0.0'><path value='../pictures'/><include filename='include/b.xml'/><include "
         "filename='c.xml'/>" +
             bitmap("a.png") + "</scene>";
  std::ofstream(folder_ / "scene/include/b.xml") << "<scene version='3.0.0'><shape type='cube'/></scene>";
  std::ofstream(folder_ / "scene/include/c.xml") << "<scene version='3.0.0'><shape type='disk'/></scene>";
  const auto scene = load("<include filename='include/a.xml'/>");
  EXPECT_EQ(scene.shapes.size(), 2u);
  EXPECT_EQ(std::get<BitmapDescription>(scene.textures[0].pattern).filename, "include/../pictures/a.png");
}

TEST_F(files, of_spectra_hold_a_pair_a_line) {
  std::ofstream(folder_ / "scene/a.spd") << "# nm value\n400 0.78\n\n700 0.78\n";
  std::ofstream(folder_ / "scene/bad.spd") << "400 0.78 1\n";
  const auto spectrum = [](const std::string& file) {
    return "<bsdf type='diffuse' id='b'><spectrum name='reflectance' filename='" + file + "'/></bsdf>";
  };
  const RgbD found = constant(std::get<DiffuseDescription>(load(spectrum("a.spd")).bsdfs[0].model).reflectance);
  // As written inline: grey except for the missing ends of the spectrum.
  EXPECT_NEAR(found.y, 0.78, 1e-3);
  EXPECT_EQ(message(spectrum("bad.spd")),
            "error: the spectrum's file has the line '400 0.78 1', expected a wavelength and a value");
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
