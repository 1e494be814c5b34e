#include "reports/view/view.h"

#include "reports/view/conclusions.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_view {
namespace {

TEST(View, cells_are_ordered_by_budget_and_the_largest_finished_one_is_shown) {
  const Results results = sample_results();
  const View view = arrange(results);
  const EngineOutcome& photon = view.scenes[0].engines[0];
  ASSERT_EQ(photon.cells.size(), 2u);  // the reference is not among them
  EXPECT_EQ(photon.cells[0]->cell.budget.amount, 2000);
  EXPECT_EQ(photon.shown, photon.cells[1]);
  const EngineOutcome& povray = view.scenes[0].engines[1];
  EXPECT_EQ(povray.finished, 1u);
  EXPECT_EQ(povray.shown->cell.budget.amount, 1);  // quality 2 timed out
}

TEST(View, of_several_seeds_the_first_is_shown) {
  Results results = sample_results();
  results.results.push_back(finished("box", "photon", {"photons", 20000}, 0, 0.02));
  EXPECT_EQ(arrange(results).scenes[0].engines[0].shown->cell.seed, 0u);
}

TEST(View, an_engine_that_only_made_references_is_not_compared) {
  const Results results = sample_results();
  const View view = arrange(results);
  ASSERT_EQ(view.engines.size(), 3u);  // photon and povray are listed; only the reference uses path
  EXPECT_EQ(view.engines[2].name, "path");
  EXPECT_EQ(view.compared, (std::vector<std::size_t>{0, 1}));
}

TEST(View, a_scene_that_only_cells_name_is_kept) {
  Results results = sample_results();
  results.results.push_back(finished("unlisted", "photon", {"photons", 10}, 1, 0.1));
  const View view = arrange(results);
  ASSERT_EQ(view.scenes.size(), 3u);
  EXPECT_EQ(view.scenes[2].record.name, "unlisted");
  EXPECT_EQ(view.scenes[2].engines[0].cells.size(), 1u);
}

TEST(View, says_why_there_is_no_reference) {
  Results results = sample_results();
  EXPECT_EQ(arrange(results).scenes[1].reference_problem,
            "No reference is named for this scene, so there is nothing to measure errors against.");
  results.scenes[1].reference_label = "hole/path/spp=1/seed=1";
  EXPECT_EQ(arrange(results).scenes[1].reference_problem,
            "The reference hole/path/spp=1/seed=1 is not among the results.");
  Result crashed = sample_result("hole", "path", {"spp", 1}, 1);
  crashed.status = Status::crash;
  crashed.detail = "killed by SIGSEGV";
  results.results.push_back(crashed);
  const View view = arrange(results);
  EXPECT_EQ(view.scenes[1].reference, nullptr);
  EXPECT_EQ(view.scenes[1].reference_problem,
            "The reference hole/path/spp=1/seed=1 did not finish (crash): killed by SIGSEGV");
  EXPECT_EQ(view.failures.back().cells.front()->cell.engine, "path");
}

TEST(View, cells_that_failed_alike_are_one_failure) {
  Results results = sample_results();
  Result again = results.results[2];
  again.cell.seed = 2;
  results.results.push_back(again);
  again.cell.seed = 3;
  again.detail = "another reason";
  results.results.push_back(again);
  const View view = arrange(results);
  ASSERT_EQ(view.failures.size(), 2u);
  EXPECT_EQ(failed_cells_text(view.failures[0]), "2 images, first quality 2, seed 1");
  EXPECT_EQ(failed_cells_text(view.failures[1]), "quality 2, seed 3");
}

TEST(View, parameters_are_said_once_where_they_hold) {
  Results results = sample_results();
  results.results[5] = finished("hole", "photon", {"photons", 2000}, 1, 0.5);  // exposure -1, the box has 0
  const View view = arrange(results);
  EXPECT_EQ(view.parameters,
            (std::vector<MetricParameters>{{"relmse", "epsilon=0.01"},
                                           {"relmse_trimmed", "epsilon=0.01, trimmed=0.1% of pixels"}}));
  EXPECT_EQ(view.scenes[1].parameters, (std::vector<MetricParameters>{{"ssim, psnr, flip", "exposure=-1"}}));
}

TEST(View, an_empty_record_gives_an_empty_view) {
  const Results results;
  const View view = arrange(results);
  EXPECT_TRUE(view.scenes.empty());
  EXPECT_EQ(totals_text(results), "0 scenes, 0 engines, 0 images");
}

TEST(View, texts_read_well) {
  EXPECT_EQ(budget_text({"spp", 64}), "64 spp");
  EXPECT_EQ(budget_text({"seconds", 1}), "1 second");
  EXPECT_EQ(budget_text({"seconds", 0.5}), "0.5 seconds");
  EXPECT_EQ(budget_text({"quality", 3}), "quality 3");
  EXPECT_EQ(exposure_text(0), "exposure 0 EV");
  EXPECT_EQ(exposure_text(-1.5), "exposure −1.5 EV");
  EXPECT_EQ(time_text("2026-02-03T04:05:06.5Z"), "2026-02-03 04:05:06 UTC");
  EXPECT_EQ(time_text("yesterday"), "yesterday");
  EXPECT_EQ(totals_text(sample_results()), "2 scenes, 2 engines, 6 images: 5 finished, 1 did not");
}

TEST(View, scenes_gates_and_changes_come_worst_first) {
  const Results results = sample_conclusions();
  const View view = arrange(results);
  ASSERT_EQ(view.scenes.size(), 2u);
  EXPECT_EQ(view.scenes[0].record.name, "hole");  // second in the record, but its gate fails
  EXPECT_EQ(view.scenes[0].verdict, GateVerdict::fail);
  EXPECT_EQ(view.scenes[1].verdict, GateVerdict::inconclusive);  // one passes, one is not decided
  EXPECT_EQ(view.scenes[1].gates[0]->name, "box-povray-ssim");
  EXPECT_EQ(view.gates[0]->name, "hole-photon-agreement");
  EXPECT_EQ(view.gates[2]->verdict, GateVerdict::pass);
  EXPECT_EQ(view.changes[0]->change, Change::regression);
  EXPECT_EQ(verdicts_text(view.gates), "3 gates: 1 passes, 1 fails, 1 inconclusive");
}

TEST(View, only_tiles_of_gates_that_weigh_noise_are_so_many_standard_errors_off) {
  const FailingTile tile{0, 0, 8, 8, 0.067, "6.7 % of the error"};
  GateRecord gate;
  for (const char* metric : {"agreement", "bias", "block_bias"}) {
    gate.metric = metric;
    EXPECT_EQ(beyond_noise(gate, tile), ", 0.0670 standard errors beyond noise") << metric;
  }
  for (const char* metric : {"ssim", "relmse_trimmed"}) {
    gate.metric = metric;
    EXPECT_EQ(beyond_noise(gate, tile), "") << metric;
  }
}

TEST(View, tiles_of_all_gates_are_ranked_by_score) {
  Results results = sample_conclusions();
  results.gates[2].tiles = {{0, 0, 1, 1, 9, "between the others"}};
  const View view = arrange(results);
  ASSERT_EQ(view.tiles.size(), 3u);
  EXPECT_EQ(view.tiles[0].tile->score, 12.5);
  EXPECT_EQ(view.tiles[1].gate->name, "box-povray-ssim");
  EXPECT_EQ(view.tiles[2].tile->score, 7.25);
}

TEST(View, a_stored_reference_is_a_reference) {
  const Results results = sample_conclusions();
  const View view = arrange(results);
  const SceneView& hole = view.scenes[0];
  EXPECT_TRUE(has_reference(hole));
  EXPECT_EQ(hole.reference_problem, "");
  EXPECT_EQ(reference_caption(hole), "stored: path, 65536 spp, standard error 0.1 %");
  EXPECT_EQ(reference_picture(hole), "hole-ref.png");
}

TEST(View, scenes_and_engines_that_only_a_gate_names_are_kept) {
  Results results;
  results.gates = sample_conclusions().gates;
  const View view = arrange(results);
  EXPECT_EQ(view.scenes.size(), 2u);
  EXPECT_EQ(view.engines.size(), 2u);
  EXPECT_TRUE(view.compared.empty());  // nothing was benchmarked
}

TEST(View, names_the_worst_failing_gate) {
  Results results = sample_conclusions();
  const GateRecord& worst = *arrange(results).gates.front();
  ASSERT_EQ(worst.verdict, GateVerdict::fail);
  for (GateRecord& gate : results.gates)
    if (gate.name == worst.name) gate.sentence = "light is missing: -42 % over 9 px at (0, 28); 8 images of spp=64";
  EXPECT_EQ(failing_text(arrange(results)),
            worst.scene + " by " + worst.engine + ": light is missing: -42 % over 9 px at (0, 28)");
  results.gates.clear();
  EXPECT_EQ(failing_text(arrange(results)), "");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
