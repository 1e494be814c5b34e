// The folder that programs get for a scene with files renders to the same bits as the scene itself.

#include "harness/grading/scene_folder.h"

#include "harness/variants/own_engine.h"
#include "scenes/description/file_names.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

class SceneFolderTest : public FolderTest {
 protected:
  static SceneDescription library(const std::string& name) {
    return parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + name + "/scene.xml");
  }
};

TEST_F(SceneFolderTest, scene_of_its_copies_renders_to_the_same_bits) {
  const OwnEngine engine{.program = PHOTONPROOF_BINARY};
  for (const char* name : {"light-mesh", "light-ies", "maps", "daylight"}) {
    const SceneDescription scene = library(name);
    const SceneFolder made = make_scene_folder(scene, folder_ / "made");
    SceneDescription copy = parse_scene_file((made.path / "scene.xml").string());
    int files = 0;
    visit_file_names(copy, [&](const std::string& file) {
      ++files;
      EXPECT_TRUE(file.starts_with("file-") && fs::is_regular_file(made.path / file)) << file;
    });
    EXPECT_GT(files, 0) << name;
    const OwnRender render{.width = 16, .height = 12, .spp = 4};
    EXPECT_EQ(render_with(engine, copy, render).mean.rgb, render_with(engine, scene, render).mean.rgb) << name;
  }
}

TEST_F(SceneFolderTest, checksum_follows_from_text_and_files_alone) {
  const std::string maps = make_scene_folder(library("maps"), folder_ / "a").checksum;
  EXPECT_EQ(make_scene_folder(library("maps"), folder_ / "b").checksum, maps);
  SceneDescription other = library("maps");
  other.sensor.film.width += 1;
  EXPECT_NE(make_scene_folder(other, folder_ / "b").checksum, maps);
}

}  // namespace
}  // namespace photonproof::inline harness_grading
