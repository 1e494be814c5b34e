// photonproof render --preset: what it asks for, of which scenes, and what overrides it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verbs_render {
namespace {

class RenderPresetTest : public FolderTest {
 protected:
  static ProcessOutcome course(const std::string& scene, std::vector<std::string> more) {
    std::vector<std::string> argv{PHOTONPROOF_BINARY, "render",
                                  PHOTONPROOF_SOURCE_DIR "/scenes/library/" + scene + "/scene.xml", "--preset",
                                  "course"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_process(argv, {.wall_limit_seconds = 120});
  }
  static std::string plan(const std::string& scene, std::vector<std::string> more = {}) {
    more.emplace_back("--plan");
    return course(scene, more).standard_output;
  }
  nlohmann::json stats(const std::vector<std::string>& more) const {
    std::vector<std::string> all{"-o", (folder_ / "a.exr").string(), "--json", "--quiet"};
    all.insert(all.end(), more.begin(), more.end());
    const ProcessOutcome outcome = course("course-1", all);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.standard_error;
    return nlohmann::json::parse(outcome.standard_output);
  }
};

TEST_F(RenderPresetTest, course_is_what_the_assignment_has) {
  const std::string words = plan("course-1");
  for (const char* part : {"preset              course: photonmapper", "1000 photons emitted, looked up within 30\n",
                           "10000 photons emitted, looked up within 4\n", "(364 rays a point, error up to 0.15)",
                           "paths of at most 12 edges", "36 samples in the middle of every pixel"})
    EXPECT_NE(words.find(part), std::string::npos) << part << "\n" << words;
}

TEST_F(RenderPresetTest, water_gets_two_million_caustic_photons) {
  for (const char* scene : {"course-2", "course-3"})
    EXPECT_NE(plan(scene).find("2000000 photons emitted, looked up within 4\n"), std::string::npos) << scene;
  EXPECT_NE(plan("cornell-spheres").find("10000 photons emitted, looked up within 4\n"), std::string::npos);
}

TEST_F(RenderPresetTest, renders_36_samples_of_each_of_600_pixels_a_side) {
  const nlohmann::json out = stats({"--crop", "300", "300", "8", "8"});
  EXPECT_EQ(out["width"], 8);
  EXPECT_EQ(out["counts"]["samples_per_pixel"], 36);
  EXPECT_EQ(out["counts"]["photons_emitted_caustic"], 10'000);
}

TEST_F(RenderPresetTest, other_options_override_it) {
  const nlohmann::json out = stats({"--size", "12x10", "--spp", "3", "--photons", "500"});
  EXPECT_EQ(out["width"], 12);
  EXPECT_EQ(out["height"], 10);
  EXPECT_EQ(out["counts"]["samples_per_pixel"], 3);
  EXPECT_EQ(out["counts"]["photons_emitted_caustic"], 500);
  EXPECT_NE(plan("course-1", {"--indirect", "path"}).find("on by path tracing"), std::string::npos);
  EXPECT_EQ(course("course-1", {"--integrator", "path", "--plan"}).standard_error,
            "--preset: error: 'course' is of integrator 'photonmapper', not of 'path'\n");
  EXPECT_EQ(course("course-1", {"--view", "photons", "--plan"}).exit_code, 0);
}

TEST_F(RenderPresetTest, is_one_of_those_that_there_are) {
  const ProcessOutcome wrong = run_process({PHOTONPROOF_BINARY, "render", "a.xml", "--preset", "cours"});
  EXPECT_EQ(wrong.exit_code, 2);
}

}  // namespace
}  // namespace photonproof::inline harness_verbs_render
