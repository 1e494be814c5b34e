// Estimators that share no sampling path must show the same image. The program renders library scenes by path, light
// and bidirectional tracing, and `agreement` compares the images.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "harness/statistics/agreement.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline harness_statistics {
namespace {

/// Minimum detectable relative error of the whole image, with probability 0.99. An estimator that is off by more from
/// the one it agrees with almost surely fails. Two noisy ones test each other less sharply. The second value is for
/// scenes in which paths find light by chance: 2 % would take minutes there.
constexpr double largest_unseen = 0.02, largest_unseen_of_noisy = 0.03;

struct Estimator {
  const char* integrator;
  int spp;
};

struct Case {
  const char* scene;
  std::vector<Estimator> estimators;
  const char* definition = nullptr;  ///< Definition of the scene's variable.
  double unseen = largest_unseen;
  bool early_roulette = false;  ///< Paths end at random from depth 5 on, not from the scene's depth 24.
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class AgreementScene : public FolderTest, public testing::WithParamInterface<Case> {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    const std::filesystem::path library = PHOTONPROOF_SOURCE_DIR "/scenes/library/" + std::string(GetParam().scene);
    scene_ = library / "scene.xml";
    if (!GetParam().early_roulette) return;
    const std::string late = R"(<integer name="rr_depth" value="24"/>)", text = read_file(scene_);
    const std::size_t at = text.find(late);
    ASSERT_NE(at, std::string::npos);
    std::filesystem::copy(library, folder_);
    put("scene.xml", std::string(text).replace(at, late.size(), R"(<integer name="rr_depth" value="5"/>)"));
    scene_ = folder_ / "scene.xml";
  }

  Rendering render(const Estimator& estimator, std::size_t seed) const {
    const std::string integrator = estimator.integrator;
    const std::string out = (folder_ / (integrator + ".exr")).string();
    std::vector<std::string> command{PHOTONPROOF_BINARY,
                                     "render",
                                     scene_.string(),
                                     "-o",
                                     out,
                                     "--integrator",
                                     integrator,
                                     "--spp",
                                     std::to_string(estimator.spp),
                                     "--size",
                                     "48x48",
                                     "--seed",
                                     std::to_string(seed),
                                     "--sampler",
                                     "independent"};
    if (GetParam().definition != nullptr) command.insert(command.end(), {"-D", GetParam().definition});
    const ProcessOutcome outcome = run_process(command);
    EXPECT_TRUE(outcome.ok()) << outcome.sentence() << "\n" << outcome.standard_error;
    return read_rendering(out);
  }

  std::filesystem::path scene_;
};

TEST_P(AgreementScene, is_the_same_by_every_integrator) {
  const std::vector<Estimator>& estimators = GetParam().estimators;
  std::vector<Rendering> images;
  for (std::size_t i = 0; i < estimators.size(); ++i) images.push_back(render(estimators[i], i + 1));
  std::vector<double> unseen(images.size(), 1);
  for (std::size_t a = 0; a < images.size(); ++a)
    for (std::size_t b = a + 1; b < images.size(); ++b) {
      const char* names[] = {estimators[a].integrator, estimators[b].integrator};
      const Agreement result = test_agreement(images[a], images[b]);
      std::printf("%s, %s and %s: %s; %s\n  %s\n  %s\n  %s\n", GetParam().scene, names[0], names[1],
                  result.pass() ? "agree" : "DISAGREE", result.power_sentence().c_str(), result.pixels.sentence.c_str(),
                  result.blocks.sentence.c_str(), result.whole.sentence.c_str());
      EXPECT_TRUE(result.pass()) << names[0] << " and " << names[1];
      for (const std::size_t i : {a, b}) unseen[i] = std::min(unseen[i], result.would_see.value_or(1));
    }
  for (std::size_t i = 0; i < images.size(); ++i) EXPECT_LE(unseen[i], GetParam().unseen) << estimators[i].integrator;
}

std::vector<Estimator> paths_and_light(int path, int bdpt, int ptracer) {
  return {{"path", path}, {"bdpt", bdpt}, {"ptracer", ptracer}};
}
std::vector<Estimator> paths(int path, int bdpt) { return {{"path", path}, {"bdpt", bdpt}}; }
std::vector<Estimator> light(int ptracer, int bdpt) { return {{"ptracer", ptracer}, {"bdpt", bdpt}}; }
Case noisy(const char* scene, std::vector<Estimator> estimators) {
  return {scene, std::move(estimators), nullptr, largest_unseen_of_noisy};
}
/// A closed scene, where paths of 24 and more vertices would take most of the time. With albedos of 0.5 to 0.8, light
/// has at most a third of its energy left at depth 5.
Case closed(const char* scene, std::vector<Estimator> estimators) {
  return {scene, std::move(estimators), nullptr, largest_unseen, true};
}
std::vector<Estimator> media(int volpath, int bdpt) { return {{"volpath", volpath}, {"bdpt", bdpt}}; }

// Light tracing renders no scene where the camera sees mirrors, glass, clear coats or holes: no light path connects to
// the camera through them. It needs too many samples in three scenes: lights cover slivers of pixels (many-lights), the
// view is a speck of the scene (parallel-planes), light comes round corners (corridor). Only light tracing finds light
// from a direction or a point that comes through glass (ball-lens, water-caustic).
//
// The samples reach that error, shared between the two estimators for the least time. Estimators that take c_i for a
// squared error of 1 share in the ratio of sqrt(c_i).
//
// In `daylight` camera paths find the sun in the lacquered ball only by chance. The light that the ball reflects to the
// ground is .3 to 1 % of the image's by channel. It comes as one sample in ten million, 75,000 times as bright as the
// others. No test can afford enough paths to estimate it, and most images that miss it look certain. So the sun is 5
// degrees wide there, of the same irradiance, and found 87 times as often.
INSTANTIATE_TEST_SUITE_P(
    library, AgreementScene,
    testing::Values(
        Case{"cornell", paths_and_light(128, 128, 160)}, noisy("corridor", paths(7168, 384)),
        Case{"light-area", paths_and_light(128, 128, 256)}, Case{"light-sphere", paths_and_light(128, 128, 768)},
        Case{"light-disk", paths_and_light(128, 128, 256)}, Case{"light-cylinder", paths_and_light(128, 128, 512)},
        Case{"light-mesh", paths_and_light(128, 128, 768)}, Case{"light-point", paths_and_light(128, 128, 768)},
        Case{"light-spot", paths_and_light(128, 128, 128)}, Case{"light-ies", paths_and_light(128, 128, 192)},
        Case{"light-directional", paths_and_light(128, 128, 192)},
        Case{"light-constant", paths_and_light(128, 128, 448)}, Case{"light-envmap", paths_and_light(128, 128, 320)},
        Case{"light-sunsky", paths_and_light(128, 128, 384)}, closed("integrating-sphere", paths_and_light(80, 30, 80)),
        closed("concentric-spheres", paths_and_light(64, 24, 64)),
        closed("furnace-normalmap", paths_and_light(64, 24, 160)),
        closed("furnace-bumpmap", paths_and_light(64, 24, 160)),
        closed("furnace-roughplastic", paths_and_light(64, 24, 160)), closed("furnace-mask", paths(64, 24)),
        closed("furnace-phong", paths_and_light(64, 24, 160)), closed("furnace-layered", paths(64, 24)),
        Case{"lens", paths_and_light(128, 128, 384)}, Case{"million", paths_and_light(64, 64, 768)},
        closed("parallel-planes", paths(64, 24)), noisy("many-lights", paths(2048, 1024)),
        Case{"cornell-spheres", paths(2048, 256)}, Case{"course-1", paths(128, 112)}, Case{"fisheye", paths(128, 128)},
        Case{"roughness", paths(128, 128)}, Case{"ball-lens", light(1024, 320)},
        noisy("water-caustic", light(768, 768)), Case{"absorption", media(64, 64)},
        Case{"daylight", paths(2048, 320), "sun_aperture=5"}, noisy("keyhole", paths(6144, 768)),
        noisy("course-2", paths(1024, 176)), noisy("course-3", paths(448, 96)), noisy("pool", media(1024, 512))),
    [](const auto& test) {
      std::string name = test.param.scene;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace photonproof::inline harness_statistics
