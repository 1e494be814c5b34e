// Gates as a run decides them: how alpha is spent over looks, and images whose sides are neither equal nor multiples of
// a block's.
#include "harness/gate_look.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <functional>
#include <random>

namespace photonproof {
namespace {

using Random = std::mt19937_64;

constexpr int width = 21, height = 11;  // blocks of 8 and 5 columns, of 8 and 3 rows

double expected(int x, int y, int c) { return 0.3 + 0.05 * c + 0.02 * x + 0.07 * y; }

/// Each value off by a normal 10 %, times `factor`.
Image draw(Random& random, double factor = 1) {
  std::normal_distribution<double> noise(1, 0.1);
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<float>(factor * expected(x, y, c) * noise(random));
  return image;
}

/// The expectation, known to a hundredth of an image's noise.
StoredReference reference() {
  StoredReference stored;
  stored.rendering = {Image(width, height), Image(width, height), {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) {
        stored.rendering.mean.pixel(x, y)[c] = static_cast<float>(expected(x, y, c));
        stored.rendering.variance->pixel(x, y)[c] = static_cast<float>(std::pow(1e-3 * expected(x, y, c), 2));
      }
  stored.provenance.estimator = "bdpt";
  stored.provenance.seeds.resize(1000);
  return stored;
}

Gate gate(const std::string& metric, double bound, double alpha, int looks) {
  Gate gate;
  gate.engine = "path";
  gate.budget = {"photons", 1};  // so that edges are no stratified samples'
  gate.metric = metric;
  gate.bound = bound;
  gate.block_bound = bound;
  gate.alpha = alpha;
  gate.seeds = 8;
  gate.looks = looks;
  return gate;
}

std::vector<const Image*> pointers(const std::vector<Image>& images) {
  std::vector<const Image*> all;
  for (const Image& image : images) all.push_back(&image);
  return all;
}

/// How a run of the gate ends; empty: no look decides.
std::optional<GateVerdict> decide(const Gate& gate, const StoredReference& stored, Random& random, double factor) {
  std::vector<Image> images;
  for (int look = 0; look < gate.looks; ++look) {
    while (images.size() < static_cast<std::size_t>(gate.seeds) << look) images.push_back(draw(random, factor));
    if (const auto verdict = look_at(gate, stored, {}, pointers(images)).verdict) return verdict;
  }
  return std::nullopt;
}

/// The most false alarms in `runs` that a rate of alpha makes with probability 0.99.
double most_alarms(int runs, double alpha) { return boost::math::quantile(boost::math::binomial(runs, alpha), 0.99); }

// Were alpha not divided by the looks, five of them would alarm at about three times alpha: each next look shares half
// of its images with the one before.
TEST(gate_look, an_agreement_gate_holds_alpha_over_all_its_looks) {
  constexpr int runs = 500;
  constexpr double alpha = 0.1;
  const StoredReference stored = reference();
  const Gate g = gate(agreement_metric, 1e-9, alpha, 5);  // a bound that no look reaches: all of them are made
  Random random(1);
  int alarms = 0;
  for (int run = 0; run < runs; ++run) alarms += decide(g, stored, random, 1) == GateVerdict::fail ? 1 : 0;
  std::printf("%d false alarms in %d, alpha %g\n", alarms, runs, alpha);
  EXPECT_LE(alarms, most_alarms(runs, alpha));
}

TEST(gate_look, a_gate_on_bias_holds_alpha_over_all_its_looks) {
  // The truth is at the bound, where an interval lies outside with half of alpha, and inside with the other half.
  constexpr int runs = 500;
  constexpr double alpha = 0.2;
  const StoredReference stored = reference();
  const Gate g = gate(bias_metric, 0.05, alpha, 5);
  Random random(2);
  int failed = 0, passed = 0;
  for (int run = 0; run < runs; ++run) {
    const auto verdict = decide(g, stored, random, 1.05);
    failed += verdict == GateVerdict::fail ? 1 : 0;
    passed += verdict == GateVerdict::pass ? 1 : 0;
  }
  std::printf("%d failed and %d passed at the bound of %d, alpha %g\n", failed, passed, runs, alpha);
  EXPECT_LE(failed, most_alarms(runs, alpha / 2));
  EXPECT_LE(passed, most_alarms(runs, alpha / 2));
}

TEST(gate_look, a_gate_on_a_metric_holds_alpha_over_all_its_looks) {
  constexpr int runs = 4000;
  constexpr double alpha = 0.2;
  const Gate g = gate("relmse", 1, alpha, 5);
  Random random(3);
  std::normal_distribution<double> value(1, 0.1);
  int failed = 0, passed = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<double> values;
    std::optional<GateVerdict> verdict;
    for (int look = 0; look < g.looks && !verdict; ++look) {
      while (values.size() < static_cast<std::size_t>(g.seeds) << look) values.push_back(value(random));
      verdict = look_at_values(g, values).verdict;
    }
    failed += verdict == GateVerdict::fail ? 1 : 0;
    passed += verdict == GateVerdict::pass ? 1 : 0;
  }
  std::printf("%d failed and %d passed at the bound of %d, alpha %g\n", failed, passed, runs, alpha);
  EXPECT_LE(failed, most_alarms(runs, alpha / 2));
  EXPECT_LE(passed, most_alarms(runs, alpha / 2));
}

TEST(gate_look, finds_a_fault_in_the_corner_that_is_less_than_a_block) {
  // Columns 16 to 20 and rows 8 to 10 are what is left of a block at the right and lower edge: 15 pixels.
  const StoredReference stored = reference();
  for (const char* metric : {agreement_metric, block_bias_metric}) {
    Random random(4);
    std::vector<Image> images;
    for (int i = 0; i < 16; ++i) {
      images.push_back(draw(random));
      for (int y = 8; y < height; ++y)
        for (int x = 16; x < width; ++x) images.back().pixel(x, y)[1] *= 0.7f;
    }
    const Judgement judgement = look_at(gate(metric, 0.1, 0.001, 1), stored, {}, pointers(images));
    ASSERT_EQ(judgement.verdict, GateVerdict::fail) << metric;
    ASSERT_EQ(judgement.tiles.size(), 1u) << metric;
    const FailingTile& tile = judgement.tiles.front();
    EXPECT_EQ(tile.x, 16) << metric;
    EXPECT_EQ(tile.y, 8) << metric;
    EXPECT_EQ(tile.width, 5) << metric;
    EXPECT_EQ(tile.height, 3) << metric;
    EXPECT_NE(judgement.sentence.find("over 15 px at (16, 8), green only"), std::string::npos) << judgement.sentence;
  }
}

TEST(gate_look, finds_one_wrong_pixel_of_the_last_column_and_row) {
  const StoredReference stored = reference();
  Random random(5);
  std::vector<Image> images;
  for (int i = 0; i < 16; ++i) {
    images.push_back(draw(random));
    images.back().pixel(width - 1, height - 1)[2] *= 1.4f;
  }
  const Judgement judgement = look_at(gate(agreement_metric, 0.1, 0.001, 1), stored, {}, pointers(images));
  ASSERT_EQ(judgement.verdict, GateVerdict::fail);
  EXPECT_NE(judgement.sentence.find("(20, 10)"), std::string::npos) << judgement.sentence;
}

TEST(gate_look, says_exactly_what_an_agreement_gate_would_have_seen) {
  // Images without noise, a reference with a standard error of 1 % a pixel. A fourth of alpha = 0.001 shared by three
  // channels (and six blocks) has the two-sided normal quantile 3.9346 (4.3456), and 0.99 has 2.3263.
  StoredReference stored = reference();
  std::fill(stored.rendering.mean.rgb.begin(), stored.rendering.mean.rgb.end(), 1.0f);
  std::fill(stored.rendering.variance->rgb.begin(), stored.rendering.variance->rgb.end(), 1e-4f);
  const std::vector<Image> images(8, stored.rendering.mean);
  const Judgement judgement = look_at(gate(agreement_metric, 0.05, 0.001, 1), stored, {}, pointers(images));
  ASSERT_EQ(judgement.verdict, GateVerdict::pass) << judgement.sentence;
  EXPECT_NEAR(judgement.would_see.value(), 6.26093 * 0.01 / std::sqrt(231.0), 2e-6);
  EXPECT_NEAR(judgement.would_see_in_a_block.value(), 6.67193 * 0.01 / std::sqrt(15.0), 2e-6);
  EXPECT_EQ(judgement.sentence, "agrees; 0.41 % overall or 1.7 % in a block of 8 x 8 pixels would have been seen");
}

TEST(gate_look, blocks_cover_every_pixel_once) {
  for (const auto& [w, h] : {std::pair{21, 11}, {11, 21}, {8, 8}, {1, 9}, {64, 48}}) {
    std::vector<int> covered(static_cast<std::size_t>(w) * static_cast<std::size_t>(h));
    for (const Block& block : blocks_of(w, h)) {
      EXPECT_LE(block.x1 - block.x0, block_side);
      EXPECT_LE(block.y1 - block.y0, block_side);
      for_each_pixel(block, [&, wide = w](int x, int y) { ++covered[static_cast<std::size_t>(y * wide + x)]; });
    }
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), w * h);
  }
}

TEST(gate_look, standard_errors_are_those_of_the_noise_however_few_the_images) {
  // Of n images a pixel's squared standard error is (0.1 expected)^2 / n, in the sum over pixels: 4 images of 12 bands
  // of 231 pixels leave 2 % of doubt, and a variance divided by n instead of n - 1 would be 25 % too small.
  Random random(5);
  double claimed = 0, true_variance = 0;
  for (int band = 0; band < 12; ++band) {
    std::vector<Image> images;
    for (int i = 0; i < 4; ++i) images.push_back(draw(random));
    const Deviations found = measure_deviations(reference().rendering, pointers(images), {999});
    for (std::size_t c = 0; c < 3; ++c)
      for (const Deviation& pixel : found.pixels[c]) {
        claimed += std::pow(pixel.standard_error, 2);
        true_variance += std::pow(0.1 * pixel.expected, 2) / 4;
      }
  }
  EXPECT_NEAR(claimed / true_variance, 1, 0.06);
}

}  // namespace
}  // namespace photonproof
