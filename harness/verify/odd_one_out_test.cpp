#include "harness/verify/odd_one_out.h"

#include <gtest/gtest.h>

namespace photonproof::inline harness_verify {
namespace {

using enum PairVerdict;
using End = OddOnes::End;

const Witness path{"path", "path"}, mapper{"photonmapper", "path"}, bdpt{"bdpt", "bdpt"}, light{"ptracer", "ptracer"},
    povray{"povray", "povray"}, formula{"closed form", "closed form", true};

/// All pairs agree except the given ones.
std::vector<WitnessPair> pairs_but(std::size_t count, const std::vector<WitnessPair>& others) {
  std::vector<WitnessPair> pairs;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      PairVerdict verdict = agree;
      for (const WitnessPair& other : others)
        if (other.first == i && other.second == j) verdict = other.verdict;
      pairs.push_back({i, j, verdict});
    }
  return pairs;
}

TEST(OddOnes, are_those_that_differ_from_all_who_agree) {
  const OddOnes odd = odd_ones({path, bdpt, povray}, pairs_but(3, {{0, 2, differ}, {1, 2, differ}}));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, std::vector<std::size_t>{2});
  EXPECT_EQ(odd.believed, (std::vector<std::size_t>{0, 1}));
}

TEST(OddOnes, are_none_where_all_agree) { EXPECT_EQ(odd_ones({path, bdpt}, pairs_but(2, {})).end, End::agree); }

TEST(OddOnes, are_not_known_of_two) {
  const OddOnes odd = odd_ones({path, povray}, pairs_but(2, {{0, 1, differ}}));
  EXPECT_EQ(odd.end, End::cannot_tell);
  EXPECT_EQ(odd.odd, (std::vector<std::size_t>{0, 1}));
}

TEST(OddOnes, are_known_of_two_by_a_closed_form) {
  const OddOnes odd = odd_ones({path, povray, formula}, pairs_but(3, {{0, 1, differ}, {0, 2, differ}}));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, std::vector<std::size_t>{0});
  EXPECT_TRUE(odd.by_closed_form);
}

TEST(OddOnes, closed_form_outweighs_a_majority) {
  const OddOnes odd =
      odd_ones({path, bdpt, light, formula}, pairs_but(4, {{0, 3, differ}, {1, 3, differ}, {2, 3, differ}}));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, (std::vector<std::size_t>{0, 1, 2}));
}

// The photon mapper's camera paths are path's, so together they count once, and two others outvote them.
TEST(OddOnes, engines_that_share_their_sampling_count_once) {
  const std::vector<WitnessPair> two_against_one = pairs_but(3, {{0, 2, differ}, {1, 2, differ}});
  EXPECT_EQ(odd_ones({path, mapper, povray}, two_against_one).end, End::cannot_tell);
  const OddOnes odd = odd_ones({path, mapper, bdpt, light},
                               pairs_but(4, {{0, 2, differ}, {0, 3, differ}, {1, 2, differ}, {1, 3, differ}}));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, (std::vector<std::size_t>{0, 1}));
}

TEST(OddOnes, are_not_known_where_camps_are_equal) {
  const OddOnes odd = odd_ones({path, bdpt, light, povray},
                               pairs_but(4, {{0, 2, differ}, {0, 3, differ}, {1, 2, differ}, {1, 3, differ}}));
  EXPECT_EQ(odd.end, End::cannot_tell);
  EXPECT_EQ(odd.odd.size(), 4u);
}

// A noisy third picture differs from no other and decides nothing.
TEST(OddOnes, noisy_witness_decides_nothing) {
  const OddOnes odd =
      odd_ones({path, povray, light}, pairs_but(3, {{0, 1, differ}, {0, 2, undecided}, {1, 2, undecided}}));
  EXPECT_EQ(odd.end, End::cannot_tell);
  EXPECT_EQ(odd.odd, (std::vector<std::size_t>{0, 1}));
}

TEST(OddOnes, noise_alone_proves_no_agreement) {
  const OddOnes odd = odd_ones({path, bdpt}, pairs_but(2, {{0, 1, undecided}}));
  EXPECT_EQ(odd.end, End::cannot_tell);
  EXPECT_TRUE(odd.odd.empty());
}

TEST(OddOnes, two_may_be_wrong_in_different_ways) {
  const OddOnes odd =
      odd_ones({path, bdpt, light, povray},
               pairs_but(4, {{0, 2, differ}, {1, 2, differ}, {0, 3, differ}, {1, 3, differ}, {2, 3, differ}}));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, (std::vector<std::size_t>{2, 3}));
}

}  // namespace
}  // namespace photonproof::inline harness_verify
