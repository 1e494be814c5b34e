#include "reports/page/viewer_data.h"

#include <nlohmann/json.hpp>

#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_page {
namespace {

using nlohmann::json;

/// The viewer's JSON for a scene of the sample, with pictures of 8 x 8 in a folder.
json viewer_of(const Results& results, const std::string& name) {
  const TemporaryFolder folder;
  write_sample_pictures(folder.path());
  write_png((folder.path() / "wide.png").string(), Image(16, 8));
  const View view = arrange(results);
  for (const SceneView& scene : view.scenes) {
    if (scene.record.name != name) continue;
    const std::string text = viewer_json(view, scene, scene_images(view, scene), folder.path(), "scene-1", 100000);
    return text.empty() ? json() : json::parse(text);
  }
  return {};
}

TEST(ViewerData, holds_every_image_that_there_is_with_its_engines_style) {
  const json box = viewer_of(sample_conclusions(), "box");
  ASSERT_EQ(box["images"].size(), 2u);  // the reference and photon; povray made no picture
  EXPECT_EQ(box["images"][0]["isReference"], true);
  EXPECT_EQ(box["images"][1]["title"], "photon");
  EXPECT_EQ(box["images"][1]["color"], "var(--engine-0, #0072B2)");
  EXPECT_EQ(box["images"][1]["maps"], (json{{"flip", "scene-1-image-1-flip"}}));
  EXPECT_EQ(box["width"], 8);
  EXPECT_EQ(box["reducedBy"], 1);
  EXPECT_EQ(box["notes"][0], "reference is from an 8-bit picture.");  // the sample has no EXR
}

TEST(ViewerData, tiles_are_shown_in_the_image_of_their_gate) {
  const json hole = viewer_of(sample_conclusions(), "hole");
  ASSERT_EQ(hole["tiles"].size(), 2u);
  EXPECT_EQ(hole["images"][hole["tiles"][0]["image"].get<std::size_t>()]["title"], "hole-photon-agreement");
  EXPECT_EQ(hole["tiles"][1]["x"], 4);
}

TEST(ViewerData, a_gate_without_an_image_has_its_tiles_in_its_engines) {
  Results results = sample_conclusions();
  results.gates[0].tiles = {{1, 2, 3, 4, 5, "here"}};
  const json box = viewer_of(results, "box");
  ASSERT_EQ(box["tiles"].size(), 1u);
  EXPECT_EQ(box["images"][box["tiles"][0]["image"].get<std::size_t>()]["title"], "photon");
}

TEST(ViewerData, an_image_of_another_size_is_left_out_and_said) {
  Results results = sample_conclusions();
  for (Result& result : results.results) {
    if (result.image == "box-photon.exr") result.pictures["image"] = "wide.png";
  }
  const json box = viewer_of(results, "box");
  EXPECT_EQ(box["images"].size(), 1u);
  EXPECT_EQ(box["notes"].back(), "photon has another size and is left out.");
}

TEST(ViewerData, two_gates_of_one_image_show_it_once) {
  Results results = sample_conclusions();
  results.gates.push_back(results.gates[1]);
  results.gates.back().name = "hole-photon-relmse";
  EXPECT_EQ(viewer_of(results, "hole")["images"].size(), 2u);  // the reference and that image
}

TEST(ViewerData, without_any_image_there_is_no_viewer) {
  Results results = sample_conclusions();
  for (Result& result : results.results) result.pictures.clear();
  EXPECT_TRUE(viewer_of(results, "box").is_null());
}

}  // namespace
}  // namespace photonproof::reports::inline reports_page
