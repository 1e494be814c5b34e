#include "harness/references/reference_estimator.h"

#include <gtest/gtest.h>

#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_references {
namespace {

std::string scene_path(const std::string& name) {
  return PHOTONPROOF_SOURCE_DIR "/scenes/library/" + name + "/scene.xml";
}

std::string chosen(const std::string& name) {
  const std::string path = scene_path(name);
  return choose_estimator(parse_scene_file(path), read_expect(expect_path_of(path)),
                          [](const std::string&) { return std::string(); });
}

TEST(ReferenceEstimator, is_chosen_by_what_the_scene_holds) {
  EXPECT_EQ(chosen("cornell"), "path");             // diffuse
  EXPECT_EQ(chosen("many-lights"), "path");         // diffuse
  EXPECT_EQ(chosen("caustic-glass"), "bdpt");       // glass and a light
  EXPECT_EQ(chosen("cornell-spheres"), "bdpt");     // and a mirror
  EXPECT_EQ(chosen("light-envmap"), "path");        // light from all around
  EXPECT_EQ(chosen("furnace-dielectric"), "bdpt");  // glass within a sphere that emits
  EXPECT_EQ(chosen("fog"), "volpath");              // a medium that scatters
  EXPECT_EQ(chosen("albedo-one"), "volpath");
  EXPECT_EQ(chosen("ball-lens"), "bdpt");  // its expectations forbid path and volpath
}

TEST(ReferenceEstimator, takes_the_next_that_the_renderer_does_not_refuse) {
  const SceneDescription scene = parse_scene_file(scene_path("cornell"));
  std::vector<std::string> asked;
  const std::string chosen = choose_estimator(scene, std::nullopt, [&](const std::string& name) {
    asked.push_back(name);
    return std::string(name == "bdpt" ? "" : "cannot");
  });
  EXPECT_EQ(chosen, "bdpt");
  EXPECT_EQ(asked, (std::vector<std::string>{"path", "volpath", "bdpt"}));
}

TEST(ReferenceEstimator, scene_that_none_can_render_is_an_error_with_all_reasons) {
  const SceneDescription scene = parse_scene_file(scene_path("fog"));
  Expect expect;
  expect.unsupported["volpath"] = "too foggy";
  EXPECT_EQ(input_error_of([&] { choose_estimator(scene, expect, [](const std::string&) { return std::string(); }); }),
            scene_path("fog") + ": error: no unbiased integrator can render this scene (volpath: too foggy)");
}

}  // namespace
}  // namespace photonproof::inline harness_references
