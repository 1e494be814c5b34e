// photonproof convert, and models in place of scenes. Files are written here by the formats' public descriptions.
#include <gtest/gtest.h>

#include <cmath>

#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_verbs_engines {
namespace {

/// A square of paint, a glossy and a glass triangle, and a lamp.
const char* const kObj =
    "mtllib m.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nv 0 1 0\nvt 0.25 0.75\n"
    "usemtl paint\nf 1/1 4/1 3/1 2/1\nusemtl gloss\nf 1 2 5\nusemtl glass\nf 2 3 5\nusemtl lamp\nf 3 4 5\n";
const char* const kMtl =
    "newmtl paint\nKd 0.8 0.4 0.2\nnewmtl gloss\nKd 0.3 0.3 0.3\nKs 0.4 0.4 0.4\nNs 50\n"
    "newmtl glass\nKd 1 1 1\nd 0.1\nNi 1.33\nnewmtl lamp\nKe 9 8 7\n";

/// A triangle moved by (0, 2, 0), a camera at (1, 2, 5) turned by 90 degrees about y to look along -x, and a lamp.
const char* const kGltf = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1, 2]}],
"extensionsUsed": ["KHR_lights_punctual"],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 30, "color": [1, 0.5, 0.25]}]}},
"nodes": [{"mesh": 0, "translation": [0, 2, 0], "name": "body"},
 {"camera": 0, "translation": [1, 2, 5], "rotation": [0, 0.7071068, 0, 0.7071068], "name": "eye"},
 {"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [1, 3, 1], "name": "lamp"}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 0.7, "aspectRatio": 2, "znear": 0.1, "zfar": 50}}],
"materials": [{"pbrMetallicRoughness": {"baseColorFactor": [0.9, 0.7, 0.3, 1], "metallicFactor": 1, "roughnessFactor": 0.5}}],
"buffers": [{"byteLength": 42,
 "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
 {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}]})";

class ConvertVerb : public FolderTest {
 protected:
  ProcessOutcome convert(const std::string& file, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "convert", file, "made"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 20, .working_folder = folder_});
  }
  SceneDescription made() const { return parse_scene_file((folder_ / "made/scene.xml").string()); }
  template <class Model>
  const Model& front(const SceneDescription& scene, const ShapeDescription& shape) const {
    return std::get<Model>(
        scene.bsdfs[std::get<TwoSidedDescription>(scene.bsdfs[shape.bsdf.value].model).front.value].model);
  }
};

TEST_F(ConvertVerb, gives_the_materials_of_an_obj) {
  put("m.obj", kObj);
  put("m.mtl", kMtl);
  const ProcessOutcome outcome = convert("m.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const SceneDescription scene = made();
  ASSERT_EQ(scene.shapes.size(), 4u);
  int found = 0;
  for (const ShapeDescription& shape : scene.shapes) {
    if (shape.radiance) {
      EXPECT_EQ(constant(*shape.radiance), RgbD(9, 8, 7));
      ++found;
    } else if (const auto* glass = std::get_if<DielectricDescription>(&scene.bsdfs[shape.bsdf.value].model)) {
      EXPECT_NEAR(glass->int_ior, 1.33, 1e-6);
      ++found;
    } else if (std::get<MeshDescription>(shape.geometry).mesh->triangles.size() == 2) {
      EXPECT_NEAR(constant(front<DiffuseDescription>(scene, shape).reflectance).y, 0.4, 1e-6);
      // OBJ counts v from below, images from above.
      EXPECT_NEAR(std::get<MeshDescription>(shape.geometry).mesh->uvs.at(0).y, 0.25, 1e-6);
      ++found;
    } else {
      EXPECT_NEAR(std::get<double>(front<PhongDescription>(scene, shape).exponent), 50, 1e-6);
      ++found;
    }
  }
  EXPECT_EQ(found, 4);
}

TEST_F(ConvertVerb, reads_numbers_of_an_obj_that_begin_with_a_point) {
  put("m.mtl", "newmtl a\nKd .5 .25 1.\n");
  put("m.obj",
      "mtllib m.mtl\r\nv\t.5 -.5 +.5\r\nv 1. .25e+1 0 .1 .2 .3\nv 0 1 .125\nvt .75 .5\nusemtl a\nf 1/1 2/1 3/1\n");
  const ProcessOutcome outcome = convert("m.obj");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  const SceneDescription scene = made();
  const TriangleMesh& mesh = *std::get<MeshDescription>(scene.shapes.at(0).geometry).mesh;
  const std::vector<Vec3f> expected{{0.5f, -0.5f, 0.5f}, {1, 2.5f, 0}, {0, 1, 0.125f}};
  ASSERT_EQ(mesh.positions.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(length(mesh.positions[i] - expected[i]), 0) << i;
  EXPECT_EQ(mesh.uvs.at(0).x, 0.75f);
}

TEST_F(ConvertVerb, gives_places_camera_light_and_metal_of_a_gltf) {
  put("m.gltf", kGltf);
  ASSERT_EQ(convert("m.gltf").exit_code, 0);
  const SceneDescription scene = made();
  ASSERT_EQ(scene.shapes.size(), 1u);
  EXPECT_NEAR(scene.shapes[0].to_world.point({0, 0, 0}).y, 2, 1e-6);
  const auto& metal = front<RoughConductorDescription>(scene, scene.shapes[0]);
  EXPECT_NEAR(std::get<double>(metal.alpha_u), 0.25, 1e-6) << "the roughness squared";
  EXPECT_NEAR(constant(metal.specular_reflectance).x, 0.9, 1e-6);
  const Vec3d eye = scene.sensor.to_world.point({0, 0, 0}), look = scene.sensor.to_world.vector({0, 0, 1});
  EXPECT_NEAR(length(eye - Vec3d(1, 2, 5)), 0, 1e-6);
  EXPECT_NEAR(length(look - Vec3d(-1, 0, 0)), 0, 1e-6);
  const auto& camera = std::get<PerspectiveDescription>(scene.sensor.camera);
  EXPECT_NEAR(camera.fov_degrees, 0.7 * 180 / std::acos(-1.0), 1e-4);
  EXPECT_EQ(camera.fov_axis, FovAxis::y);
  EXPECT_EQ(scene.sensor.film.width, 2 * scene.sensor.film.height);
  const auto& lamp = std::get<PointLightDescription>(scene.emitters.at(0).light);
  EXPECT_NEAR(length(lamp.position - Vec3d(1, 3, 1)), 0, 1e-6);
  EXPECT_NEAR(lamp.intensity.y, 15, 1e-5);
}

TEST_F(ConvertVerb, keeps_a_scene_of_another_folder_whole) {
  std::filesystem::create_directories(folder_ / "lib");
  put("lib/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  put("old.xml",
      "<scene version='0.6.0'><path value='lib'/><integrator type='mlt'/><sensor type='perspective'/>"
      "<shape type='obj'><string name='filename' value='m.obj'/></shape><shape type='hair'/><emitter "
      "type='point'/></scene>");
  EXPECT_EQ(convert("old.xml").exit_code, 2);
  EXPECT_FALSE(has("made/scene.xml"));
  const ProcessOutcome outcome = convert("old.xml", {"--lenient"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("note: old.xml:1:43: integrator 'mlt' is rendered as 'path'\n"),
            std::string::npos)
      << outcome.standard_output;
  const SceneDescription scene = made();
  EXPECT_EQ(scene.shapes.size(), 1u);
  EXPECT_TRUE(scene.notes.empty()) << "all is in this format now";
}

TEST_F(ConvertVerb, overwrites_only_when_forced) {
  put("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_EQ(convert("m.obj").exit_code, 0);
  EXPECT_EQ(convert("m.obj").standard_error, "made/scene.xml: error: already exists (--force overwrites it)\n");
  EXPECT_EQ(convert("m.obj", {"--force"}).exit_code, 0);
}

TEST_F(ConvertVerb, refuses_models_that_are_damaged_or_empty) {
  put("bad.gltf", std::string(kGltf).substr(0, 400));
  put("empty.gltf", R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": []}], "scene": 0})");
  put("bad.obj", "mtllib m.mtl\nv 0 0 0\nf 1 2 9\n");
  for (const char* file : {"bad.gltf", "empty.gltf", "bad.obj", "missing.glb", "missing.ply"}) {
    const ProcessOutcome outcome = convert(file);
    EXPECT_EQ(outcome.exit_code, 2) << file << outcome.standard_output;
    EXPECT_EQ(outcome.standard_error.find(": error: "), outcome.standard_error.find(": ")) << outcome.standard_error;
    EXPECT_FALSE(has("made")) << file << " left something";
  }
}

TEST_F(ConvertVerb, loses_no_file_that_another_program_left_there) {
  put("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  std::filesystem::create_directories(folder_ / "made");
  put("made/m.obj", "precious");
  const ProcessOutcome outcome = convert("m.obj");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.standard_error, "made/m.obj: error: already exists (--force overwrites it)\n");
  EXPECT_EQ(read_file(folder_ / "made/m.obj"), "precious");
  EXPECT_FALSE(has("made/scene.xml"));
  EXPECT_EQ(convert("m.obj", {"--force"}).exit_code, 0);
  EXPECT_EQ(made().shapes.size(), 1u);
}

TEST_F(ConvertVerb, does_not_replace_what_it_reads) {
  std::filesystem::create_directories(folder_ / "made");
  const std::string scene = "<scene version='3.0.0'><sensor type='perspective'/><emitter type='constant'/></scene>";
  put("made/scene.xml", scene);
  EXPECT_EQ(convert("made/../made/scene.xml", {"--force"}).standard_error,
            "made/scene.xml: error: is the scene that is read, expected another folder\n");
  EXPECT_EQ(read_file(folder_ / "made/scene.xml"), scene);
}

TEST_F(ConvertVerb, copies_nothing_where_one_file_cannot_be_replaced) {
  const std::string mesh = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  put("a.obj", mesh);
  put("b.obj", mesh);
  std::filesystem::create_directories(folder_ / "made/b.obj");
  std::string shapes;
  for (const char* name : {"a.obj", "b.obj"})
    shapes += "<shape type='obj'><string name='filename' value='" + std::string(name) + "'/></shape>";
  put("in.xml", "<scene version='3.0.0'><sensor type='perspective'/><emitter type='constant'/>" + shapes + "</scene>");
  EXPECT_EQ(convert("in.xml", {"--force"}).exit_code, 2);
  EXPECT_FALSE(has("made/a.obj"));
}

TEST_F(ConvertVerb, reads_files_of_models_outside_their_folder_only_where_that_is_allowed) {
  std::filesystem::create_directories(folder_ / "in");
  put("secret.mtl", "newmtl a\nKd 0.1 0.2 0.3\n");
  put("in/m.obj", "mtllib ../secret.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  const ProcessOutcome outcome = convert("in/m.obj");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_NE(outcome.standard_error.find("is outside the model's folder (--allow-outside reads it)"), std::string::npos)
      << outcome.standard_error;
  EXPECT_EQ(convert("in/m.obj", {"--allow-outside"}).exit_code, 0);

  put("secret.png", "private");
  put("in/t.mtl", "newmtl a\nKd 1 1 1\nmap_Kd ../secret.png\n");
  put("in/t.obj", "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nusemtl a\nf 1/1 2/1 3/1\n");
  const ProcessOutcome textured = convert("in/t.obj", {"--force"});
  EXPECT_EQ(textured.exit_code, 0) << textured.standard_error;
  EXPECT_NE(textured.standard_output.find("is outside the model's folder"), std::string::npos)
      << textured.standard_output;
  EXPECT_FALSE(has("made/secret.png"));
}

TEST_F(ConvertVerb, finds_no_missing_file_outside_the_folder) {
  put("m.obj", "mtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
  const ProcessOutcome outcome = convert("m.obj");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
}

TEST_F(ConvertVerb, places_a_camera_before_a_model_without_extent) {
  put("m.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  ASSERT_EQ(convert("m.obj").exit_code, 0);
  EXPECT_TRUE(std::isfinite(made().sensor.to_world.point({0, 0, 0}).z));
}

TEST_F(ConvertVerb, refuses_sizes_that_the_sensor_cannot_have) {
  const std::string film =
      "<film type='hdrfilm'><integer name='width' value='1'/><integer name='height' value='1'/></film>";
  put("meter.xml",
      "<scene version='3.0.0'><sensor type='radiancemeter'>" + film + "</sensor><emitter type='constant'/></scene>");
  EXPECT_EQ(convert("meter.xml", {"--size", "4x4"}).standard_error,
            "--size: error: the scene's sensor has a film of 4 x 4 pixels, expected 1 x 1\n");
  EXPECT_FALSE(has("made"));
  EXPECT_EQ(convert("meter.xml", {"--size", "1x1"}).exit_code, 0);
}

TEST_F(ConvertVerb, gives_files_of_one_name_two_and_a_file_that_is_used_twice_one) {
  std::filesystem::create_directories(folder_ / "in");
  const auto mesh = [](const char* height) { return "v 0 0 0\nv 1 0 0\nv 0 " + std::string(height) + " 0\nf 1 2 3\n"; };
  put("m.obj", mesh("1"));
  put("in/m.obj", mesh("2"));
  std::string shapes;
  for (const char* name : {"m.obj", "../m.obj", "m.obj", "../m.obj"})
    shapes += "<shape type='obj'><string name='filename' value='" + std::string(name) + "'/></shape>";
  put("in/scene.xml",
      "<scene version='3.0.0'><sensor type='perspective'/><emitter type='constant'/>" + shapes + "</scene>");
  const ProcessOutcome outcome = convert("in/scene.xml", {"--allow-outside"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_NE(outcome.standard_output.find("files 2\n"), std::string::npos) << outcome.standard_output;
  EXPECT_EQ(read_file(folder_ / "made/m.obj"), mesh("2"));
  EXPECT_EQ(read_file(folder_ / "made/m-2.obj"), mesh("1"));
  EXPECT_EQ(made().shapes.size(), 4u);
}

TEST_F(ConvertVerb, is_not_needed_to_render_a_model) {
  put("m.gltf", kGltf);
  const ProcessOutcome outcome =
      run_process({PHOTONPROOF_BINARY, "render", "m.gltf", "-o", "a.exr", "--size", "32x16", "--spp", "4"},
                  {.wall_limit_seconds = 20, .working_folder = folder_});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
  EXPECT_EQ(outcome.standard_error, "m.gltf: warning: lights: candela count as W sr^-1, lux as W m^-2\n");
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_engines
