#include "harness/cells/scene_copies.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>

#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_cells {
namespace {

namespace fs = std::filesystem;

class SceneCopiesOf : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    fs::create_directories(folder_ / "cornell" / "meshes");
    fs::create_directories(folder_ / "results");
    put("cornell/scene.xml", "the scene");
    put("cornell/meshes/tree.ply", "a tree");
    scene_.name = "night";
    scene_.path = folder_ / "cornell" / "scene.xml";
  }
  std::vector<std::string> files_in(const fs::path& folder) const {
    std::vector<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      if (!entry.is_directory() || entry.is_symlink()) names.push_back(fs::relative(entry.path(), folder));
    std::ranges::sort(names);
    return names;
  }
  SuiteScene scene_;
};

using Names = std::vector<std::string>;

TEST_F(SceneCopiesOf, a_copy_has_everything_but_the_answers) {
  for (const char* answer :
       {"reference-64x48.exr", "reference-64x48.json", "expect.toml", ".hidden", "meshes/reference-8x8.exr"})
    put(std::string("cornell/") + answer, "an answer");
  for (const char* kept : {"reference-sky.exr", "reference-64x.exr", "reference-1x1.png", "notes.json"})
    put(std::string("cornell/") + kept, "no answer");
  fs::create_directories(folder_ / "cornell" / "out" / "references");
  put("cornell/out/results.json", "{}");
  put("cornell/out/references/cornell.exr", "an answer");
  SceneCopies copies(folder_ / "results");
  const fs::path copy = copies.of(scene_, scene_.path);
  EXPECT_EQ(read_file(copy), "the scene");
  EXPECT_EQ(copy.parent_path().filename(), "cornell");  // its name may matter
  EXPECT_EQ(files_in(copy.parent_path()), (Names{"meshes/tree.ply", "notes.json", "reference-1x1.png",
                                                 "reference-64x.exr", "reference-sky.exr", "scene.xml"}));
  EXPECT_FALSE(fs::exists(copy.parent_path().parent_path() / "expect.toml"));
}

TEST_F(SceneCopiesOf, results_inside_the_scenes_folder_are_not_copied_into_themselves) {
  fs::create_directories(folder_ / "cornell" / "o");
  put("cornell/o/old.exr", "an answer");
  fs::create_directories(folder_ / "cornell" / "o2" / "cells");  // another run's, at work
  put("cornell/o2/.lock", "");
  put("cornell/o2/cells/new.exr", "an answer");
  SceneCopies copies(folder_ / "cornell" / "o");
  EXPECT_EQ(files_in(copies.of(scene_, scene_.path).parent_path()), (Names{"meshes/tree.ply", "scene.xml"}));
}

TEST_F(SceneCopiesOf, what_an_engine_writes_into_a_small_file_stays_in_the_copy_and_large_ones_take_no_space) {
  put("cornell/large.ply", std::string(3 << 20, 'x'));
  SceneCopies copies(folder_ / "results");
  const fs::path copy = copies.of(scene_, scene_.path);
  { std::ofstream(copy) << "vandalism"; }
  EXPECT_EQ(get("cornell/scene.xml"), "the scene");
  // A hard link. If the file system clones, blocks are shared, which stat does not show.
  struct stat original {
  }, given{};
  ASSERT_EQ(stat((folder_ / "cornell/large.ply").c_str(), &original), 0);
  ASSERT_EQ(stat((copy.parent_path() / "large.ply").c_str(), &given), 0);
  EXPECT_TRUE(original.st_ino == given.st_ino || original.st_nlink == 1u);
  EXPECT_EQ(given.st_size, original.st_size);
}

TEST_F(SceneCopiesOf, links_do_not_lead_back) {
  put("cornell/reference-8x8.exr", "an answer");
  fs::create_directories(folder_ / "shared");
  put("shared/wood.png", "wood");
  const fs::path cornell = folder_ / "cornell";
  fs::create_symlink("reference-8x8.exr", cornell / "truth.exr");
  fs::create_symlink(cornell / "meshes" / "tree.ply", cornell / "tree.ply");  // absolute, and inside
  fs::create_symlink("../shared/wood.png", cornell / "wood.png");
  fs::create_directory_symlink("../shared", cornell / "shared");
  fs::create_directory_symlink("..", cornell / "up");
  fs::create_directory_symlink(cornell, cornell / "self");
  SceneCopies copies(folder_ / "results");
  const fs::path copy = copies.of(scene_, scene_.path).parent_path();
  EXPECT_FALSE(fs::exists(copy / "truth.exr"));
  EXPECT_EQ(read_file(copy / "wood.png"), "wood");
  EXPECT_EQ(read_file(copy / "shared" / "wood.png"), "wood");
  EXPECT_EQ(fs::canonical(copy / "tree.ply"), fs::canonical(copy / "meshes" / "tree.ply"));
  EXPECT_FALSE(fs::is_symlink(copy / "up"));
  EXPECT_FALSE(fs::exists(copy / "self" / "reference-8x8.exr"));
}

TEST_F(SceneCopiesOf, are_made_once_and_are_gone_afterwards_also_those_of_a_killed_run) {
  fs::create_directories(folder_ / "results" / ".photonproof-scenes" / "old");
  {
    SceneCopies copies(folder_ / "results");
    EXPECT_TRUE(fs::is_empty(folder_ / "results"));
    const fs::path first = copies.of(scene_, scene_.path);
    put("cornell/late.txt", "");
    EXPECT_EQ(copies.of(scene_, scene_.path), first);
    EXPECT_FALSE(fs::exists(first.parent_path() / "late.txt"));
  }
  EXPECT_TRUE(fs::is_empty(folder_ / "results"));
}

}  // namespace
}  // namespace photonproof::inline harness_cells
