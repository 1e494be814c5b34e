#include "harness/grading/scene_findings.h"

#include <gmock/gmock.h>

#include <cmath>

#include "scenes/base/splitmix.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline harness_grading {
namespace {

TEST(SceneFindings, a_failed_render_leaves_plainer_sentences_and_is_told_once_a_scene) {
  Assignment assignment;
  assignment.image.format = "bmp";
  std::vector<WorkScene> scenes(1);
  scenes[0].row.name = "room";
  scenes[0].description = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell/scene.xml");
  Image grey(32, 32);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 32; ++x)
      for (int c = 0; c < 3; ++c) grey.pixel(x, y)[c] = 0.1f + 0.01f * static_cast<float>(x + c * y / 4);
  const std::vector<std::optional<SceneReference>> references{SceneReference{{grey, Image(32, 32), {}}, 4, 3, "given"}};
  OwnEngine none;
  none.program = "/there/is/no/such/program";
  SceneFindings findings(assignment, scenes, references, none, [](const std::string&) {});
  EXPECT_THAT(findings.problems(), testing::IsEmpty());
  for (const float factor : {0.46566129f, 0.58207661f}) {  // 1.25^9 / 16 and 1.25^10 / 16, which diagnosis tries
    SceneWorkGrade work;
    work.grade.verdict = SceneVerdict::wrong;
    work.images = {grey};
    for (float& v : work.images[0].rgb) v *= factor;
    findings.add(0, work);
    ASSERT_FALSE(work.grade.findings.empty());
    EXPECT_EQ(work.grade.findings[0].kind, "exposure");
  }
  ASSERT_THAT(findings.problems(), testing::SizeIs(1));
  EXPECT_THAT(findings.problems()[0], testing::StartsWith("findings for scene 'room' lack the parts of its light: "));
}

// Mistakes in the light look like noise, too, such as a cache whose weights are left out.
TEST(SceneFindings, noise_is_not_named) {
  const auto noisy = [](double deviation, std::uint64_t seed) {
    Image image(64, 64);
    for (std::size_t i = 0; i < image.rgb.size(); ++i) {
      double noise = 0;  // from 12 uniform numbers: variance 1
      for (std::uint64_t k = 0; k < 12; ++k)
        noise += static_cast<double>(splitmix64(seed * 1000 + k, i) >> 11) * 0x1p-53 - 0.5;
      image.rgb[i] = static_cast<float>(0.5 + deviation * noise);
    }
    return image;
  };
  Assignment assignment;
  assignment.image.format = "bmp";
  std::vector<WorkScene> scenes(1);
  const std::vector<std::optional<SceneReference>> references{
      SceneReference{{noisy(0.03 / 8, 1), Image(64, 64), {}}, 64, 63, "given"}};
  SceneFindings findings(assignment, scenes, references, {}, [](const std::string&) {});
  SceneWorkGrade work;
  work.grade.verdict = SceneVerdict::wrong;
  work.grade.checks.push_back({"flip", {}, 0.12, "", GradedCheck::Side::outside, ""});
  work.images = {noisy(0.03 * std::sqrt(8), 3)};
  findings.add(0, work);
  ASSERT_THAT(work.grade.findings, testing::SizeIs(1));
  EXPECT_EQ(work.grade.findings[0].sentence, "differs here, not explained");
}

}  // namespace
}  // namespace photonproof::inline harness_grading
