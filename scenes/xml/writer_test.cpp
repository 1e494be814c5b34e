#include "scenes/xml/writer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "scenes/parser/parser.h"
#include "scenes/parser/test_same_scene.h"
#include "scenes/xml/test_named_files.h"
#include "scenes/xml/test_random_scene.h"

namespace photonproof::inline scenes_xml {
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
  for (const char* folder : {"/scenes/library", "/scenes/showcase"}) {
    int scenes = 0;
    for (const auto& entry : fs::directory_iterator(PHOTONPROOF_SOURCE_DIR + std::string(folder))) {
      const std::string path = (entry.path() / "scene.xml").string();
      expect_round_trip(parse_scene_file(path), path);
      ++scenes;
    }
    EXPECT_GE(scenes, 6) << folder;
  }
}

TEST(writer, gives_back_random_scenes) {
  const NamedFiles files;
  for (unsigned seed = 0; seed < 1000 && !::testing::Test::HasFailure(); ++seed) {
    const SceneDescription scene = RandomScene(seed, files).make();
    const std::string text = write_scene(scene);
    SceneDescription again;
    ASSERT_NO_THROW(
        try { again = parse_scene_text(text, files.scene()); } catch (const InputError& error) {
          ADD_FAILURE() << error.what();
          throw;
        })
        << seed;
    EXPECT_EQ(first_difference(scene, again), "") << seed << "\n" << text;
    EXPECT_EQ(write_scene(again), text) << seed;
  }
}

TEST(writer, repeats_a_shared_bsdf_that_has_no_id_in_every_shape) {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/light-area/scene.xml");
  scene.shapes[1].bsdf = scene.shapes[0].bsdf;
  const SceneDescription again = parse_scene_text(write_scene(scene), "written.xml");
  ASSERT_EQ(again.bsdfs.size(), 2u);
  EXPECT_EQ(again.bsdfs[0].model, again.bsdfs[1].model);
}

}  // namespace
}  // namespace photonproof::inline scenes_xml
