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

struct Case {
  const char* scene;
  int spp;
  std::vector<const char*> integrators = {"path", "bdpt", "ptracer"};
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class AgreementScene : public FolderTest, public testing::WithParamInterface<Case> {
 protected:
  Rendering render(const std::string& integrator, std::size_t seed) const {
    const std::string out = (folder_ / (integrator + ".exr")).string();
    const ProcessOutcome outcome =
        run_process({PHOTONPROOF_BINARY, "render",
                     PHOTONPROOF_SOURCE_DIR "/scenes/library/" + std::string(GetParam().scene) + "/scene.xml", "-o",
                     out, "--integrator", integrator, "--spp", std::to_string(GetParam().spp), "--size", "48x48",
                     "--seed", std::to_string(seed), "--sampler", "independent"});
    EXPECT_TRUE(outcome.ok()) << outcome.sentence() << "\n" << outcome.standard_error;
    return read_rendering(out);
  }
};

/// Relative, of the whole image, with probability 0.99: an estimator whose image is off by more does not pass here.
constexpr double largest_unseen = 0.02;

TEST_P(AgreementScene, is_the_same_by_every_integrator) {
  const std::vector<const char*>& names = GetParam().integrators;
  std::vector<Rendering> images;
  for (std::size_t i = 0; i < names.size(); ++i) images.push_back(render(names[i], i + 1));
  for (std::size_t a = 0; a < images.size(); ++a)
    for (std::size_t b = a + 1; b < images.size(); ++b) {
      const Agreement result = test_agreement(images[a], images[b]);
      std::printf("%s, %s and %s: %s; %s\n  %s\n  %s\n  %s\n", GetParam().scene, names[a], names[b],
                  result.pass() ? "agree" : "DISAGREE", result.power_sentence().c_str(), result.pixels.sentence.c_str(),
                  result.blocks.sentence.c_str(), result.whole.sentence.c_str());
      EXPECT_TRUE(result.pass()) << names[a] << " and " << names[b];
      EXPECT_LE(result.would_see.value_or(1), largest_unseen) << names[a] << " and " << names[b];
    }
}

// Light paths alone show no scene where the camera sees mirrors, glass, clear coats or holes, through which none can be
// connected, and need too many samples where lamps cover slivers of pixels (many-lights) or the view is a speck of the
// scene (parallel-planes). Light from a direction or a point that comes
// through glass is found by them alone (ball-lens, water-caustic).
const std::vector<const char*> kNoLightTracing = {"path", "bdpt"}, kLightTracing = {"ptracer", "bdpt"},
                               kMedia = {"volpath", "bdpt"};

INSTANTIATE_TEST_SUITE_P(
    library, AgreementScene,
    testing::Values(Case{"cornell", 128}, Case{"corridor", 128}, Case{"light-area", 128}, Case{"light-sphere", 128},
                    Case{"light-disk", 128}, Case{"light-cylinder", 128}, Case{"light-mesh", 128},
                    Case{"light-point", 128}, Case{"light-spot", 128}, Case{"light-ies", 128},
                    Case{"light-directional", 128}, Case{"light-constant", 128}, Case{"light-envmap", 128},
                    Case{"light-sunsky", 128}, Case{"integrating-sphere", 64}, Case{"concentric-spheres", 64},
                    Case{"furnace-normalmap", 64}, Case{"furnace-bumpmap", 64}, Case{"furnace-roughplastic", 64},
                    Case{"furnace-mask", 64, kNoLightTracing}, Case{"furnace-phong", 64},
                    Case{"furnace-layered", 64, kNoLightTracing}, Case{"lens", 128}, Case{"million", 64},
                    Case{"parallel-planes", 64, kNoLightTracing}, Case{"many-lights", 128, kNoLightTracing},
                    Case{"cornell-spheres", 256, kNoLightTracing}, Case{"course-1", 256, kNoLightTracing},
                    Case{"fisheye", 128, kNoLightTracing}, Case{"roughness", 128, kNoLightTracing},
                    Case{"daylight", 128, kNoLightTracing}, Case{"keyhole", 128, kNoLightTracing},
                    Case{"course-2", 64, kNoLightTracing}, Case{"course-3", 64, kNoLightTracing},
                    Case{"ball-lens", 128, kLightTracing}, Case{"water-caustic", 128, kLightTracing},
                    Case{"absorption", 64, kMedia}, Case{"pool", 64, kMedia}),
    [](const auto& test) {
      std::string name = test.param.scene;
      std::replace(name.begin(), name.end(), '-', '_');
      return name;
    });

}  // namespace
}  // namespace photonproof
