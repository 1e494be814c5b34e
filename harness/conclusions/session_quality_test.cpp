#include "harness/conclusions/session_quality.h"

#include <gtest/gtest.h>

namespace photonproof::inline harness_conclusions {
namespace {

// `pairs` cells by "a" that take 1, 2, 3 ... s. The same cells by "b" take `ratio` times as long, 1 % up and down in
// turn.
Results twins(int pairs, double ratio) {
  Results results;
  for (int i = 1; i <= pairs; ++i) {
    for (const char* engine : {"a", "b"}) {
      Result result;
      result.cell = {"s", engine, {"spp", 1}, static_cast<std::uint64_t>(i)};
      result.wall_seconds = engine[0] == 'a' ? i : i * ratio * (i % 2 == 0 ? 1.01 : 0.99);
      results.results.push_back(result);
    }
  }
  return results;
}

TEST(SessionQuality, engine_that_agrees_with_itself_is_no_caveat) {
  EXPECT_EQ(control_caveat(twins(8, 1), "a", "b"), "");
}

// All eight ratios are 1.188 or 1.212, and so are the ends of their median's interval.
TEST(SessionQuality, engine_that_disagrees_with_itself_makes_the_session_noisy) {
  EXPECT_EQ(control_caveat(twins(8, 1.2), "a", "b"),
            "this session is noisy, its times decide nothing: 'a' against itself takes 1.200 (95 % interval 1.188 to "
            "1.212) times as long");
}

TEST(SessionQuality, five_pairs_are_too_few_to_tell) {
  EXPECT_EQ(control_caveat(twins(5, 1), "a", "b"), "control: 5 pairs of 'a' with itself are too few for an interval");
}

TEST(SessionQuality, control_that_was_not_measured_says_nothing) {
  EXPECT_EQ(control_caveat(twins(0, 1), "a", "b"), "");
}

TEST(SessionQuality, load_above_the_number_of_cores_is_a_caveat) {
  EXPECT_EQ(load_caveat(2.0, 2), "");
  EXPECT_EQ(load_caveat(2.1, 2),
            "load average 2.1 on 2 cores when it began: wall times are longer than the engines need");
}

TEST(SessionQuality, no_machine_is_overloaded_with_a_million_cores) { EXPECT_EQ(load_caveat(1000000), ""); }

}  // namespace
}  // namespace photonproof::inline harness_conclusions
