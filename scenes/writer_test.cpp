#include "scenes/writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <random>

#include "scenes/parser.h"
#include "scenes/ply.h"
#include "scenes/same_scene.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

/// `what` is a file in the folder that the scene's meshes are in.
void expect_round_trip(const SceneDescription& scene, const std::string& what) {
  const std::string text = write_scene(scene);
  const SceneDescription again = parse_scene_text(text, what);
  EXPECT_EQ(first_difference(scene, again), "") << what << "\n" << text;
  EXPECT_EQ(write_scene(again), text) << what;
}

TEST(writer, gives_back_every_library_scene) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(PHOTONPROOF_SOURCE_DIR "/scenes/library")) {
    const std::string path = (entry.path() / "scene.xml").string();
    expect_round_trip(parse_scene_file(path), path);
    ++scenes;
  }
  EXPECT_GE(scenes, 7);
}

const std::string kCorpus = PHOTONPROOF_SOURCE_DIR "/scenes/ply_corpus/";
const char* const kMesh = "ascii_quad.ply";

/// Random but valid scenes, canonical as the parser makes them: BSDFs with an id first, the others in shape order.
class RandomScene {
 public:
  explicit RandomScene(unsigned seed) : random_(seed) {}

  SceneDescription make() {
    SceneDescription scene;
    const std::size_t named = 1 + pick(4);
    for (std::size_t i = 0; i < named; ++i) scene.bsdfs.push_back({{}, "b" + std::to_string(i) + nasty(), model()});
    const std::size_t shapes = pick(6);
    for (std::size_t i = 0; i < shapes; ++i) scene.shapes.push_back(shape(scene, named));
    const std::size_t emitters = 1 + pick(3);
    for (std::size_t i = 0; i < emitters; ++i) {
      const std::string id = coin() ? "e" + std::to_string(i) + nasty() : "";
      scene.emitters.push_back({{}, id, PointLightDescription{vector(), RgbD(positive(), positive(), positive())}});
    }
    scene.sensor = sensor();
    scene.integrator.method = method();
    return scene;
  }

 private:
  std::size_t pick(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }
  bool coin() { return pick(2) == 1; }
  double unit() { return std::uniform_real_distribution<double>(0, 1)(random_); }
  double positive() { return std::exp(std::uniform_real_distribution<double>(-80, 80)(random_)); }
  double number() { return coin() ? positive() : -positive(); }
  Vec3d vector() { return {number(), number(), number()}; }
  RgbD colour() { return {unit(), coin() ? 0.0 : 1.0, unit()}; }

  /// Characters that XML, white space rules and `$name` could trip over.
  std::string nasty() {
    const char* const pieces[] = {"", " & <tag> \"quoted\" 'single'", "$size \\$ \\\\", "\ttab\nline\r\n", "grün ∮",
                                  "a"};
    return pieces[pick(6)];
  }

  Transform similarity() {
    return Transform::translate(vector()) * Transform::rotate({number(), 1, 1}, 720 * unit()) *
           Transform::scale(Vec3d(positive()));
  }
  Transform stretched() { return similarity() * Transform::scale({0.5 + unit(), 0.5 + unit(), -0.5 - unit()}); }

  decltype(BsdfDescription::model) model() {
    switch (pick(4)) {
      case 0:
        return DiffuseDescription{colour()};
      case 1:
        return ConductorDescription{std::nullopt, colour()};
      case 2:
        return ConductorDescription{ComplexIor{{unit(), 1, positive()}, {positive(), unit(), 0}}, colour()};
      default:
        return DielectricDescription{positive(), positive(), colour(), colour()};
    }
  }

  ShapeDescription shape(SceneDescription& scene, std::size_t named) {
    ShapeDescription result;
    if (coin()) result.id = "s" + std::to_string(scene.shapes.size()) + nasty();
    switch (pick(4)) {
      case 0:
        result.geometry = SphereDescription{vector(), positive()};
        result.to_world = similarity();
        break;
      case 1:
        result.geometry = RectangleDescription{};
        result.to_world = stretched();
        break;
      case 2:
        result.geometry = MeshDescription{MeshDescription::Format::ply, kMesh, coin(), false, mesh_};
        result.to_world = stretched();
        break;
      default:
        result.geometry = CubeDescription{};
        result.to_world = coin() ? stretched() : Transform();
    }
    result.flip_normals = coin();
    if (coin()) result.radiance = RgbD(positive(), 0, positive());
    if (coin()) {
      result.bsdf = {static_cast<std::uint32_t>(pick(named))};
    } else {
      result.bsdf = {static_cast<std::uint32_t>(scene.bsdfs.size())};
      scene.bsdfs.push_back({{}, "", model()});
    }
    return result;
  }

  SensorDescription sensor() {
    SensorDescription result;
    if (coin()) result.id = "sensor" + nasty();
    const double near = positive();
    result.camera =
        PerspectiveDescription{180 * unit() + 1e-9, static_cast<FovAxis>(pick(5)), near, near * (1.5 + unit())};
    result.to_world = Transform::look_at(Vec3d(unit()), {3, unit(), 4}, {0, 1, 0});
    result.film = {1 + static_cast<int>(pick(65536)), 1 + static_cast<int>(pick(4096))};
    result.sample_count = 1 + static_cast<int>(pick(100000));
    return result;
  }

  decltype(IntegratorDescription::method) method() {
    const int max_depth = coin() ? -1 : 1 + static_cast<int>(pick(100));
    const int rr_depth = 1 + static_cast<int>(pick(100));
    if (coin()) return PathDescription{max_depth, rr_depth, coin()};
    return PhotonMapperDescription{max_depth, rr_depth,   coin(), static_cast<std::int64_t>(pick(1u << 30)) << 9,
                                   0,         positive(), 0};
  }

  std::mt19937 random_;
  std::shared_ptr<const TriangleMesh> mesh_ = std::make_shared<const TriangleMesh>(read_ply(kCorpus + kMesh));
};

TEST(writer, gives_back_random_scenes) {
  for (unsigned seed = 0; seed < 500 && !::testing::Test::HasFailure(); ++seed)
    expect_round_trip(RandomScene(seed).make(), kCorpus + "scene with seed " + std::to_string(seed));
}

TEST(writer, repeats_a_shared_bsdf_that_has_no_id_in_every_shape) {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/light-area/scene.xml");
  scene.shapes[1].bsdf = scene.shapes[0].bsdf;
  const SceneDescription again = parse_scene_text(write_scene(scene), "written.xml");
  ASSERT_EQ(again.bsdfs.size(), 2u);
  EXPECT_EQ(again.bsdfs[0].model, again.bsdfs[1].model);
}

}  // namespace
}  // namespace photonproof
