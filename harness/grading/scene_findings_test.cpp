#include "harness/grading/scene_findings.h"

#include <gmock/gmock.h>

#include "scenes/parser/parser.h"

namespace photonproof {
namespace {

TEST(SceneFindings, a_failed_render_leaves_plainer_sentences_and_is_told_once_a_scene) {
  Assignment assignment;
  assignment.image.format = "bmp";
  std::vector<WorkScene> scenes(1);
  scenes[0].row.name = "room";
  scenes[0].description = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell/scene.xml");
  Image grey(32, 32);
  std::fill(grey.rgb.begin(), grey.rgb.end(), 0.4f);
  for (int y = 0; y < 32; ++y)
    for (int x = 0; x < 16; ++x) grey.pixel(x, y)[0] = 0.2f;
  const std::vector<std::optional<SceneReference>> references{SceneReference{{grey, Image(32, 32), {}}, 4, 3, "given"}};
  OwnEngine none;
  none.program = "/there/is/no/such/program";
  SceneFindings findings(assignment, scenes, references, none, [](const std::string&) {});
  EXPECT_THAT(findings.problems(), testing::IsEmpty());
  for (const float factor : {0.5f, 0.6f}) {
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

}  // namespace
}  // namespace photonproof
