#include "reports/view/cell_details.h"

#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_view {
namespace {

std::string detail(const Result& result, const std::string& term) {
  for (const Detail& entry : cell_details(result)) {
    if (entry.term == term) return entry.texts.front();
  }
  return "none";
}

TEST(CellDetails, counts_are_exact_and_measures_among_them_rounded) {
  Result result;
  result.counts = {{"photons", 1398324}, {"radius", 0.0427668541669846}};
  EXPECT_EQ(detail(result, "counts"), "photons 1\u202F398\u202F324, radius 0.04277");
}

TEST(CellDetails, what_a_cell_does_not_have_is_left_out) { EXPECT_TRUE(cell_details(Result{}).empty()); }

TEST(CellDetails, a_failure_without_a_reason_says_so) {
  Result result;
  result.caveats = {"host was busy", "clock stepped"};
  EXPECT_EQ(reason_text(result), "");
  EXPECT_EQ(caveats_text(result), "host was busy; clock stepped");
  result.status = Status::crash;
  EXPECT_EQ(reason_text(result), "The record gives no reason.");
}

TEST(CellDetails, command_of_a_comparison_has_the_scenes_exposures) {
  Result reference, result;
  reference.image = "a b.exr";
  result.image = "x.exr";
  SceneView scene;
  scene.reference = &reference;
  scene.record.exposure = -1;
  EXPECT_EQ(compare_command(scene, result), "photonproof compare 'a b.exr' x.exr --exposure -1");
  scene.record.hdr_exposures = ExposureRange{-2.5, 4, 7};
  EXPECT_EQ(compare_command(scene, result),
            "photonproof compare 'a b.exr' x.exr --exposure -1 --hdr-flip --exposures -2.5 4 7");
  EXPECT_EQ(compare_command(scene, reference), "");
}

TEST(CellDetails, an_engines_state_counts_its_cells) {
  Result ok, late, crashed;
  late.status = Status::timeout;
  crashed.status = Status::crash;
  EXPECT_EQ(state_text({0, {}, 0, nullptr}), "not run");
  EXPECT_EQ(state_text({0, {&ok, &ok}, 2, &ok}), "2 finished");
  EXPECT_EQ(state_text({0, {&ok, &late, &late}, 1, &ok}), "2 of 3 timeout");
  EXPECT_EQ(state_text({0, {&crashed, &late}, 0, nullptr}), "2 of 2 not finished");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
