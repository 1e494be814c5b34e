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
  const std::vector<std::optional<SceneWorkGrade>> baseline(1);
  SceneFindings findings(assignment, scenes, references, baseline, none, [](const std::string&) {});
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
  EXPECT_THAT(findings.problems()[0],
              testing::StartsWith("what is said of scene 'room' goes without what its light is made of: "));
}

// The reference is a mean of many renders with less noise than the baseline's render, whose samples are counted. Noise
// of deviation s in n samples is s sqrt(8) in n/8 of them.
TEST(SceneFindings, noise_is_told_in_samples_of_the_baseline) {
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
  std::vector<std::optional<SceneWorkGrade>> baseline(1);
  baseline[0].emplace();
  baseline[0]->images = {noisy(0.03, 2)};
  SceneFindings findings(assignment, scenes, references, baseline, {}, [](const std::string&) {});
  SceneWorkGrade work;
  work.grade.verdict = SceneVerdict::wrong;
  work.images = {noisy(0.03 * std::sqrt(8), 3)};
  findings.add(0, work);
  ASSERT_THAT(work.grade.findings, testing::SizeIs(1));
  EXPECT_THAT(work.grade.findings[0].sentence, testing::HasSubstr("the baseline's noise, as with 1/8 of its samples"));
}

}  // namespace
}  // namespace photonproof::inline harness_grading
