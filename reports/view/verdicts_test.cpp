#include "reports/view/verdicts.h"

#include "reports/view/console_conclusions.h"
#include "reports/view/test_sample_results.h"

namespace photonproof::reports::inline reports_view {
namespace {

CorrectnessRecord record(Correctness verdict, std::optional<Estimate> whole = {},
                         std::optional<double> would_see = {}) {
  CorrectnessRecord out;
  out.verdict = verdict;
  out.whole = whole;
  out.would_see = would_see;
  return out;
}

TEST(Verdicts, say_the_number_that_goes_with_them) {
  EXPECT_EQ(verdict_text(record(Correctness::right, Estimate{0.0001, Interval{-0.001, 0.0012}}, 0.0031)),
            "right within 0.31 %");
  EXPECT_EQ(verdict_text(record(Correctness::biased, Estimate{-0.51, Interval{-0.53, -0.49}})), "biased −51 %");
  CorrectnessRecord local = record(Correctness::biased, Estimate{0.001, Interval{-0.003, 0.005}});
  EXPECT_EQ(verdict_text(local), "biased in places") << "an older record";
  local.block = Estimate{-0.03, Interval{-0.04, -0.02}};
  EXPECT_EQ(verdict_text(local), "biased −3.0 % in a block");
  local.block = Estimate{0.001, Interval{-0.001, 0.003}};
  EXPECT_EQ(verdict_text(local), "biased at most 0.30 % of a block");
  local.block = Estimate{-0.019, Interval{-5.93, 5.89}};
  EXPECT_EQ(verdict_text(local), "biased −1.9 % in a block");
  EXPECT_EQ(verdict_text(record(Correctness::noisy, Estimate{0.01, Interval{-0.11, 0.13}})), "noisy ±12 %");
  EXPECT_EQ(verdict_text(record(Correctness::noisy, Estimate{0.01, Interval{-25.81, 25.83}})), "noisy beyond measure");
  EXPECT_EQ(verdict_text(record(Correctness::unknown)), "unknown");
  EXPECT_EQ(verdict_text(record(Correctness::unknown, Estimate{0.02, {}})), "unknown +2.0 %");
}

TEST(Verdicts, of_bias_have_the_size_that_is_known) {
  const auto size_of = [](const CorrectnessRecord& r) { return seen_bias(r) ? bias_text(*seen_bias(r)) : ""; };
  CorrectnessRecord biased = record(Correctness::biased, Estimate{-0.05, Interval{-0.06, -0.04}});
  EXPECT_EQ(size_of(biased), "5.0 %");
  biased.whole = Estimate{0.001, Interval{-0.003, 0.005}};
  EXPECT_EQ(size_of(biased), "") << "an older record";
  biased.block = Estimate{-0.03, Interval{-0.04, -0.02}};
  EXPECT_EQ(size_of(biased), "3.0 % of a block's light");
  biased.block = Estimate{-0.001, Interval{-0.003, 0.001}};
  EXPECT_EQ(size_of(biased), "0.30 % of a block's light");
  biased.block = Estimate{-0.019, Interval{-5.93, 5.89}};
  EXPECT_EQ(size_of(biased), "1.9 % of a block's light");
  biased.verdict = Correctness::noisy;
  EXPECT_EQ(size_of(biased), "");
}

TEST(Verdicts, that_rest_on_the_engines_own_sampling_say_so) {
  CorrectnessRecord own = record(Correctness::right, {}, 0.01);
  own.regression_only = "the reference is by path, whose sampling is the engine's";
  EXPECT_EQ(verdict_text(own), "right within 1.0 % (regression only)");
}

TEST(Verdicts, are_green_for_right_alone_and_red_for_more_than_a_small_bias) {
  EXPECT_STREQ(verdict_class(record(Correctness::right)), "good");
  EXPECT_STREQ(verdict_class(record(Correctness::noisy)), "open");
  EXPECT_STREQ(verdict_class(record(Correctness::unknown)), "open");
  EXPECT_STREQ(verdict_class(record(Correctness::biased)), "poor") << "of unknown size";
  EXPECT_STREQ(verdict_class(record(Correctness::biased, Estimate{0.012, {}})), "poor");
  CorrectnessRecord small = record(Correctness::biased, Estimate{0.002, {}});
  small.block = Estimate{-0.009, {}};
  EXPECT_STREQ(verdict_class(small), "open");
  small.block = Estimate{-0.011, {}};
  EXPECT_STREQ(verdict_class(small), "poor");
  EXPECT_EQ(status_text(Status::ok), "finished") << "an engine's end says nothing of its image";
}

TEST(Verdicts, at_a_glance_count_the_right_scenes_and_name_the_others) {
  const Results results = sample_conclusions();
  const View view = arrange(results);
  const std::vector<EngineGlance> seen = glances(view);
  ASSERT_EQ(seen.size(), 1u) << "POV-Ray has no verdict";
  EXPECT_EQ(seen[0].text, "biased on box (+1.2 %)");
}

TEST(Verdicts, on_the_console_stand_beside_the_error_with_the_doubt_about_the_reference) {
  Results results = sample_conclusions();
  results.races.clear();
  results.scenes[0].reference_doubt = "the reference is by path, which is biased";
  EXPECT_EQ(console_conclusions(arrange(results), false),
            "\n"
            "scene  engine  budget          verdict          relMSE  seconds\n"
            "box    photon  20\u202f000 photons  biased +1.2 %  0.0125 †     4.50\n"
            "\n"
            "box: † the reference is by path, which is biased: these numbers say how far from it an image is, not how "
            "wrong\n");
}

}  // namespace
}  // namespace photonproof::reports::inline reports_view
