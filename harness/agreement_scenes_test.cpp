// Estimators that share no sampling path must show the same image: path, light and bidirectional tracing of library
// scenes, by the program itself, held to `agreement`.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "harness/agreement.h"
#include "harness/test_folder.h"
#include "reference/process.h"

namespace photonproof {
namespace {

struct Case {
  const char* scene;
  int spp;
  bool light_tracing;  ///< not where the camera sees mirrors or glass, which no light path can be connected through
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class AgreementScene : public FolderTest, public testing::WithParamInterface<Case> {
 protected:
  Rendering render(const std::string& integrator, int seed) const {
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

TEST_P(AgreementScene, is_the_same_by_path_light_and_bidirectional_tracing) {
  std::map<std::string, Rendering> images;
  images["path"] = render("path", 1);
  images["bdpt"] = render("bdpt", 2);
  if (GetParam().light_tracing) images["ptracer"] = render("ptracer", 3);
  for (auto a = images.begin(); a != images.end(); ++a)
    for (auto b = std::next(a); b != images.end(); ++b) {
      const Agreement result = test_agreement(a->second, b->second);
      std::printf("%s, %s and %s: %s\n  %s\n  %s\n", GetParam().scene, a->first.c_str(), b->first.c_str(),
                  result.pass() ? "agree" : "DISAGREE", result.pixels.sentence.c_str(), result.blocks.sentence.c_str());
      EXPECT_TRUE(result.pass()) << a->first << " and " << b->first;
    }
}

INSTANTIATE_TEST_SUITE_P(library, AgreementScene,
                         testing::Values(Case{"cornell", 128, true}, Case{"corridor", 128, true},
                                         Case{"light-area", 128, true}, Case{"light-sphere", 128, true},
                                         Case{"light-disk", 128, true}, Case{"light-cylinder", 128, true},
                                         Case{"light-mesh", 128, true}, Case{"light-point", 128, true},
                                         Case{"light-spot", 128, true}, Case{"light-ies", 128, true},
                                         Case{"integrating-sphere", 128, true}, Case{"concentric-spheres", 128, true},
                                         Case{"many-lights", 128, true}, Case{"light-directional", 128, true},
                                         Case{"light-constant", 128, true}, Case{"light-envmap", 128, true},
                                         Case{"cornell-spheres", 256, false}, Case{"course-1", 256, false}),
                         [](const auto& test) {
                           std::string name = test.param.scene;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace photonproof
