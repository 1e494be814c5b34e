#include "scenes/generators/million.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "scenes/description/expect.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/meshes/ply.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_generators {
namespace {

namespace fs = std::filesystem;

TEST(million, meets_every_count_within_one_percent) {
  for (double n = 1e3; n <= 1e7; n *= 1.07) {
    const auto wanted = static_cast<std::uint64_t>(n);
    const MillionPlan plan = plan_million(wanted);
    EXPECT_NEAR(static_cast<double>(plan.triangles()), n, 0.01 * n) << wanted;
    EXPECT_LE(2 * std::max(plan.columns, plan.rows), 3 * std::min(plan.columns, plan.rows)) << wanted;
    EXPECT_GE(plan.rocks, 10u);
  }
}

TEST(million, has_a_few_hundred_rocks_as_soon_as_there_are_triangles_for_them) {
  EXPECT_EQ(plan_million(1'000).rocks, 10u);
  EXPECT_EQ(plan_million(1'000).rock_level, 0);
  EXPECT_EQ(plan_million(1'000'000).rocks, 300u);
  EXPECT_EQ(plan_million(1'000'000).rock_level, 2);
  EXPECT_EQ(plan_million(10'000'000).rock_level, 4);
}

TEST(million, is_written_as_a_scene_of_that_many_triangles) {
  const ScratchFolder scratch("million-test");
  const fs::path& folder = scratch.path();
  const MillionPlan plan = plan_million(5'000);
  write_million(folder, plan);
  const SceneDescription scene = parse_scene_file((folder / "scene.xml").string());
  std::size_t triangles = 0;
  for (const ShapeDescription& shape : scene.shapes)
    if (const auto* ply = std::get_if<MeshDescription>(&shape.geometry)) {
      triangles += ply->mesh->triangles.size();
      EXPECT_TRUE(ply->face_normals);
    }
  EXPECT_EQ(triangles, plan.triangles());
  EXPECT_EQ(scene.sensor.film, (FilmDescription{256, 256}));
  EXPECT_EQ(std::get<PathDescription>(scene.integrator.method).max_depth, 5);
  EXPECT_TRUE(read_expect((folder / "expect.toml").string()).unsupported.empty());
  for (const std::string& file : million_files()) EXPECT_TRUE(fs::exists(folder / file)) << file;
}

TEST(million, of_the_library_is_what_the_program_generates) {
  const ScratchFolder scratch("million-test");
  const fs::path& folder = scratch.path();
  write_million(folder, plan_million(2'000));
  for (const std::string& file : million_files()) {
    std::string stored = read_file(fs::path(PHOTONPROOF_SOURCE_DIR "/scenes/library/million") / file);
    // The measured errors of other engines' images follow the generated text.
    if (file == "expect.toml") stored.resize(std::min(stored.find("\n[cycles]"), stored.find("\n[povray]")));
    EXPECT_EQ(read_file(folder / file), stored) << file;
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_generators
