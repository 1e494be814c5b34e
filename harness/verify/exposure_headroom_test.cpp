// Checks that at every library scene's exposure the display metrics detect images that are too bright or too dark.

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "harness/metrics/metrics.h"
#include "scenes/base/process.h"
#include "scenes/description/expect.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

class ExposureHeadroom : public FolderTest {
 protected:
  /// The scene's committed reference, if it has one.
  Image image_of(const fs::path& scene) const {
    for (const auto& file : fs::directory_iterator(scene.parent_path()))
      if (file.path().filename().string().starts_with("reference-") && file.path().extension() == ".exr")
        return read_rendering(file.path().string()).mean;
    const std::string out = (folder_ / "image.exr").string();
    const ProcessOutcome outcome =
        run_process({PHOTONPROOF_BINARY, "render", scene.string(), "-o", out, "--spp", "4", "--size", "32x32"});
    EXPECT_TRUE(outcome.ok()) << scene << outcome.sentence() << "\n" << outcome.standard_error;
    return read_rendering(out).mean;
  }
};

Image times(Image image, float factor) {
  for (float& value : image.rgb) value *= factor;
  return image;
}

double metric(const std::vector<MetricValue>& values, const std::string& name) {
  for (const MetricValue& v : values)
    if (v.name == name) return v.value;
  ADD_FAILURE() << name;
  return 0;
}

// In a uniform picture at sRGB 0.8, 20 % more or less is a psnr of 23, an ssim of 0.996 and a flip of 0.23. Dark
// pictures with few bright places give less. Where the relevant parts are clipped, a fifth more changes nothing (psnr
// of equal images is given as 0).
TEST_F(ExposureHeadroom, of_every_library_scene_shows_a_fifth_more_and_less) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(PHOTONPROOF_SOURCE_DIR "/scenes/library")) {
    if (entry.path().filename() == "million") continue;  // takes seconds to make
    ++scenes;
    const fs::path scene = entry.path() / "scene.xml";
    const Image image = image_of(scene);
    const double exposure = read_expect(expect_path_of(scene.string())).exposure;
    for (const float factor : {1.2f, 0.8f}) {
      const auto values = compute_metrics(image, times(image, factor), {.parameters = {.exposure = exposure}});
      const std::string what = scene.parent_path().filename().string() + " times " + std::to_string(factor);
      EXPECT_LT(metric(values, "psnr"), 38) << what;
      EXPECT_LT(metric(values, "ssim"), 0.998) << what;
      EXPECT_GT(metric(values, "flip"), 0.05) << what;
    }
  }
  EXPECT_GE(scenes, 60);
}

}  // namespace
}  // namespace photonproof::inline harness_verify
