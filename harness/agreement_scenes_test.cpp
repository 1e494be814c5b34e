// Estimators that share no sampling path must show the same image: path, light and bidirectional tracing of library
// scenes, by the program itself, held to `agreement`.

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "harness/agreement.h"
#include "reference/process.h"
#include "scenes/test_folder.h"

namespace photonproof {
namespace {

struct Estimator {
  const char* integrator;
  int spp;
};

struct Case {
  const char* scene;
  std::vector<Estimator> estimators;
  /// Relative, of the whole image, with probability 0.99: an estimator whose image is off by more than this from the
  /// one that it agrees with most surely does not pass. (Two noisy ones say less of each other.)
  double largest_unseen = 0.02;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class AgreementScene : public FolderTest, public testing::WithParamInterface<Case> {
 protected:
  Rendering render(const Estimator& estimator, std::size_t seed) const {
    const std::string integrator = estimator.integrator;
    const std::string out = (folder_ / (integrator + ".exr")).string();
    const ProcessOutcome outcome =
        run_process({PHOTONPROOF_BINARY, "render",
                     PHOTONPROOF_SOURCE_DIR "/scenes/library/" + std::string(GetParam().scene) + "/scene.xml", "-o",
                     out, "--integrator", integrator, "--spp", std::to_string(estimator.spp), "--size", "48x48",
                     "--seed", std::to_string(seed), "--sampler", "independent"});
    EXPECT_TRUE(outcome.ok()) << outcome.sentence() << "\n" << outcome.standard_error;
    return read_rendering(out);
  }
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
  for (std::size_t i = 0; i < images.size(); ++i)
    EXPECT_LE(unseen[i], GetParam().largest_unseen) << estimators[i].integrator;
}

std::vector<Estimator> paths_and_light(int path, int bdpt, int ptracer) {
  return {{"path", path}, {"bdpt", bdpt}, {"ptracer", ptracer}};
}
std::vector<Estimator> paths(int path, int bdpt) { return {{"path", path}, {"bdpt", bdpt}}; }
std::vector<Estimator> light(int ptracer, int bdpt) { return {{"ptracer", ptracer}, {"bdpt", bdpt}}; }
std::vector<Estimator> media(int volpath, int bdpt) { return {{"volpath", volpath}, {"bdpt", bdpt}}; }

// Light paths alone show no scene where the camera sees mirrors, glass, clear coats or holes, through which none can be
// connected, and need too many samples where lamps cover slivers of pixels (many-lights), the view is a speck of the
// scene (parallel-planes) or light comes round corners (corridor). Light from a direction or a point that comes
// through glass is found by them alone (ball-lens, water-caustic).
//
// Samples are as many as 2 % takes. Five scenes would take minutes for that, since camera paths find their caustics by
// luck or nothing but a keyhole; what they would show is stated for each.
INSTANTIATE_TEST_SUITE_P(
    library, AgreementScene,
    testing::Values(
        Case{"cornell", paths_and_light(128, 128, 192)}, Case{"corridor", paths(20480, 1024)},
        Case{"light-area", paths_and_light(128, 128, 256)}, Case{"light-sphere", paths_and_light(128, 128, 768)},
        Case{"light-disk", paths_and_light(128, 128, 256)}, Case{"light-cylinder", paths_and_light(256, 256, 1024)},
        Case{"light-mesh", paths_and_light(128, 128, 768)}, Case{"light-point", paths_and_light(128, 128, 768)},
        Case{"light-spot", paths_and_light(128, 128, 128)}, Case{"light-ies", paths_and_light(128, 128, 192)},
        Case{"light-directional", paths_and_light(128, 128, 1536)},
        Case{"light-constant", paths_and_light(128, 128, 6144)}, Case{"light-envmap", paths_and_light(128, 128, 3072)},
        Case{"light-sunsky", paths_and_light(128, 128, 10240)}, Case{"integrating-sphere", paths_and_light(64, 24, 64)},
        Case{"concentric-spheres", paths_and_light(64, 24, 64)},
        Case{"furnace-normalmap", paths_and_light(64, 24, 160)}, Case{"furnace-bumpmap", paths_and_light(64, 24, 160)},
        Case{"furnace-roughplastic", paths_and_light(64, 24, 160)}, Case{"furnace-mask", paths(64, 24)},
        Case{"furnace-phong", paths_and_light(64, 24, 160)}, Case{"furnace-layered", paths(64, 24)},
        Case{"lens", paths_and_light(128, 128, 2048)}, Case{"million", paths_and_light(64, 64, 1024)},
        Case{"parallel-planes", paths(64, 24)}, Case{"many-lights", paths(4096, 2048)},
        Case{"cornell-spheres", paths(2048, 256)}, Case{"course-1", paths(256, 256)}, Case{"fisheye", paths(128, 128)},
        Case{"roughness", paths(128, 128)}, Case{"ball-lens", light(512, 192)},
        Case{"water-caustic", light(2560, 2560)}, Case{"absorption", media(64, 64)},
        Case{"daylight", paths(1024, 128), 0.25}, Case{"keyhole", paths(1024, 256), 0.10},
        Case{"course-2", paths(256, 64), 0.08}, Case{"course-3", paths(256, 64), 0.05},
        Case{"pool", media(512, 256), 0.08}),
    [](const auto& test) {
      std::string name = test.param.scene;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace photonproof
