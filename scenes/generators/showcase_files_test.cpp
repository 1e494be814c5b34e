// The scenes of scenes/showcase: they load, and their files are those that the program generates.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "scenes/description/expect.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/generators/showcase_assets.h"
#include "scenes/generators/showcase_shapes.h"
#include "scenes/images/image.h"
#include "scenes/meshes/ply.h"
#include "scenes/meshes/test_mesh_checks.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_generators {
namespace {

namespace fs = std::filesystem;

const fs::path kShowcase = fs::path(PHOTONPROOF_SOURCE_DIR) / "scenes/showcase";

std::set<std::string> names() {
  std::set<std::string> all;
  for (const auto& entry : fs::directory_iterator(kShowcase)) all.insert(entry.path().filename().string());
  return all;
}

TEST(showcase_files, scenes_take_a_size_and_an_integrator_and_say_what_they_show) {
  EXPECT_EQ(names(), (std::set<std::string>{"door-ajar", "foggy-stage", "gallery", "glass-interior", "murky-pool",
                                            "ring-caustic"}));
  for (const std::string& name : names()) {
    const std::string path = (kShowcase / name / "scene.xml").string();
    const SceneDescription scene =
        parse_scene_file(path, {{{"width", "40"}, {"height", "30"}, {"integrator", "volpath"}}, false});
    EXPECT_EQ(scene.sensor.film.width, 40) << path;
    EXPECT_EQ(scene.sensor.film.height, 30) << path;
    EXPECT_TRUE(std::holds_alternative<VolPathDescription>(scene.integrator.method)) << path;
    EXPECT_EQ(read_expect(expect_path_of(path)).purpose.back(), '.') << path;
  }
}

TEST(showcase_files, generated_files_are_the_stored_ones) {
  const ScratchFolder folder("showcase-test");
  std::set<fs::path> generated;
  for (const ShowcaseAsset& asset : showcase_assets()) {
    SCOPED_TRACE(asset.path);
    const fs::path made = folder.path() / fs::path(asset.path).filename(), kept = kShowcase / asset.path;
    generated.insert(kept);
    asset.write(made, 1);
    // The maths library may round another way, which the last bits of a float or a byte of a PNG may show.
    if (made.extension() == ".ply") {
      const TriangleMesh a = read_ply(made.string()), b = read_ply(kept.string());
      EXPECT_EQ(a.triangles, b.triangles);
      ASSERT_EQ(a.positions.size(), b.positions.size());
      ASSERT_EQ(a.normals.size(), b.normals.size());
      for (std::size_t i = 0; i < a.positions.size(); ++i) ASSERT_LT(length(a.positions[i] - b.positions[i]), 1e-5f);
      for (std::size_t i = 0; i < a.normals.size(); ++i) ASSERT_LT(length(a.normals[i] - b.normals[i]), 1e-4f);
    } else {
      const Image a = read_image(made.string()), b = read_image(kept.string());
      ASSERT_EQ(a.rgb.size(), b.rgb.size());
      for (std::size_t i = 0; i < a.rgb.size(); ++i) ASSERT_NEAR(a.rgb[i], b.rgb[i], 0.01f) << i;
    }
  }
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kShowcase)) {
    if (!entry.is_regular_file()) continue;
    EXPECT_LT(entry.file_size(), 600'000u) << entry.path();
    bytes += entry.file_size();
    const std::string ending = entry.path().extension();
    EXPECT_EQ(generated.contains(entry.path()), ending != ".xml" && ending != ".toml") << entry.path();
  }
  EXPECT_LT(bytes, 4'500'000u);
}

/// Sheets have a border; all other bodies are closed.
bool is_sheet(const std::string& path) {
  return std::ranges::any_of(std::initializer_list<const char*>{"can.ply", "curtain.ply", "ripples.ply", "shade.ply"},
                             [&](const char* name) { return path.ends_with(name); });
}

TEST(showcase_files, bodies_are_closed_and_face_outward_at_every_detail) {
  const ScratchFolder folder("showcase-test");
  for (const ShowcaseAsset& asset : showcase_assets()) {
    if (!asset.path.ends_with(".ply")) continue;
    std::size_t coarser = 0;
    for (const double detail : {kLeastDetail, 1.0, 4.0}) {
      SCOPED_TRACE(asset.path + " at " + std::to_string(detail));
      asset.write(folder.path() / "body.ply", detail);
      const TriangleMesh mesh = read_ply((folder.path() / "body.ply").string());
      const EdgeCounts edges = count_edges(mesh.triangles);
      EXPECT_EQ(edges.bad, 0u);
      EXPECT_EQ(edges.border == 0, !is_sheet(asset.path));
      double volume = 0;
      for (const auto& t : mesh.triangles) {
        const Vec3d normal = normal_of(mesh, t);
        volume += dot(Vec3d(mesh.positions[t[0]]), normal) / 6;
        ASSERT_GT(length(normal), 0);
        if (mesh.normals.empty() || detail < 1) continue;
        for (const std::uint32_t corner : t) ASSERT_GT(dot(normal, Vec3d(mesh.normals[corner])), 0);
      }
      EXPECT_TRUE(is_sheet(asset.path) || volume > 0) << volume;
      if (detail > 1 && !asset.path.ends_with("prism.ply")) {
        EXPECT_GT(mesh.triangles.size(), 3.3 * static_cast<double>(coarser));
        EXPECT_LT(mesh.triangles.size(), 4.7 * static_cast<double>(coarser));
      }
      coarser = mesh.triangles.size();
    }
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_generators
