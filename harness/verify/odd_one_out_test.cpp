#include "harness/verify/odd_one_out.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace photonproof::inline harness_verify {
namespace {

using enum PairVerdict;
using End = OddOnes::End;

const Witness path{"path", "path"}, mapper{"photonmapper", "path"}, bdpt{"bdpt", "bdpt"}, light{"ptracer", "ptracer"},
    povray{"povray", "povray"}, cycles{"cycles", "cycles"}, formula{"closed form", "closed form", true};

/// All pairs agree, or have another verdict, except the given ones.
std::vector<WitnessPair> pairs_but(std::size_t count, const std::vector<WitnessPair>& others,
                                   PairVerdict usual = agree) {
  std::vector<WitnessPair> pairs;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      PairVerdict verdict = usual;
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

// One of the two is wrong. The others, which agree, say nothing about them.
TEST(OddOnes, differ_from_a_believed_one_and_not_only_from_each_other) {
  const OddOnes odd = odd_ones({path, bdpt, light, povray}, pairs_but(4, {{0, 1, agree}, {2, 3, differ}}, undecided));
  EXPECT_EQ(odd.end, End::cannot_tell);
  EXPECT_EQ(odd.odd, (std::vector<std::size_t>{2, 3}));
}

// Three ways of finding light contradict path, and bdpt alone agrees with it. Two camps that are undecided about each
// other are no camp of four against povray.
TEST(OddOnes, camps_that_are_undecided_about_each_other_do_not_add_up) {
  const OddOnes odd =
      odd_ones({path, bdpt, light, cycles, povray},
               pairs_but(5, {{0, 1, agree}, {2, 3, agree}, {2, 4, agree}, {3, 4, agree}, {0, 4, differ}}, undecided));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, std::vector<std::size_t>{0});
  EXPECT_EQ(odd.believed, (std::vector<std::size_t>{2, 3, 4}));
}

// The closed form confirms path only. Light tracing and bdpt decide about povray.
TEST(OddOnes, closed_form_decides_nothing_where_it_is_undecided) {
  const std::vector<Witness> witnesses{path, bdpt, light, povray, formula};
  const OddOnes odd = odd_ones(witnesses, pairs_but(5, {{0, 4, agree}, {1, 2, agree}, {1, 3, differ}}, undecided));
  EXPECT_EQ(odd.end, End::odd);
  EXPECT_EQ(odd.odd, std::vector<std::size_t>{3});
  EXPECT_EQ(odd.believed, (std::vector<std::size_t>{1, 2}));
  EXPECT_FALSE(odd.by_closed_form);
  EXPECT_EQ(odd_ones(witnesses, pairs_but(5, {{0, 4, agree}, {1, 3, differ}}, undecided)).end, End::cannot_tell);
}

/// Every verdict of every pair of `count` witnesses.
std::vector<std::vector<WitnessPair>> all_verdicts(std::size_t count) {
  std::vector<std::vector<WitnessPair>> tables{{}};
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      std::vector<std::vector<WitnessPair>> longer;
      for (const std::vector<WitnessPair>& table : tables)
        for (const PairVerdict verdict : {agree, differ, undecided}) {
          longer.push_back(table);
          longer.back().push_back({i, j, verdict});
        }
      tables = std::move(longer);
    }
  return tables;
}

TEST(OddOnes, every_one_that_is_named_differs_from_a_believed_one_with_more_support) {
  const std::vector<Witness> witnesses{path, bdpt, light, povray};
  std::size_t named = 0;
  for (const std::vector<WitnessPair>& pairs : all_verdicts(witnesses.size())) {
    const OddOnes odd = odd_ones(witnesses, pairs);
    if (odd.end != End::odd) continue;
    ++named;
    std::vector<std::size_t> supporters(witnesses.size());
    std::vector<bool> contradicted(witnesses.size());
    for (const WitnessPair& pair : pairs) {
      if (pair.verdict == agree) ++supporters[pair.first], ++supporters[pair.second];
      const auto is_believed = [&](std::size_t side) {
        return std::ranges::find(odd.believed, side) != odd.believed.end();
      };
      if (pair.verdict != differ) continue;
      EXPECT_FALSE(is_believed(pair.first) && is_believed(pair.second));
      if (is_believed(pair.first)) contradicted[pair.second] = true;
      if (is_believed(pair.second)) contradicted[pair.first] = true;
    }
    for (const std::size_t side : odd.odd) {
      EXPECT_TRUE(contradicted[side]);
      // The others could outvote the believed ones only if they were as many.
      EXPECT_LT(supporters[side] + 1, witnesses.size() - 1);
    }
    for (const std::size_t side : odd.believed) EXPECT_GE(supporters[side], 1u);
    // The order of the witnesses does not matter.
    std::vector<WitnessPair> reversed = pairs;
    const std::size_t last = witnesses.size() - 1;
    for (WitnessPair& pair : reversed) pair = {last - pair.second, last - pair.first, pair.verdict};
    std::vector<std::size_t> mirrored;
    for (const std::size_t side : odd_ones(witnesses, reversed).odd) mirrored.insert(mirrored.begin(), last - side);
    EXPECT_EQ(mirrored, odd.odd);
  }
  EXPECT_GT(named, 50u);
}

TEST(OddOnes, known_wrong_one_decides_only_where_the_others_differ_no_more) {
  const std::vector<WitnessPair> all_differ = pairs_but(3, {}, differ);
  const OddOnes open = odd_ones({path, bdpt, povray}, all_differ);
  ASSERT_EQ(open.end, End::cannot_tell);
  EXPECT_EQ(decided_by_known_wrong(open, {2}, all_differ).end, End::cannot_tell);
  EXPECT_EQ(decided_by_known_wrong(open, {}, all_differ).end, End::cannot_tell);
  EXPECT_EQ(decided_by_known_wrong(open, {0, 1, 2}, all_differ).end, End::cannot_tell);
  const OddOnes decided = decided_by_known_wrong(open, {1, 2}, all_differ);
  EXPECT_EQ(decided.end, End::odd);
  EXPECT_EQ(decided.odd, (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(decided.believed, std::vector<std::size_t>{0});
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
