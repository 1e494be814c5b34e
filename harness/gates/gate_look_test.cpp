// Gates as a run decides them: the division of alpha over looks, and images whose sides are neither equal nor multiples
// of a block's.
#include "harness/gates/gate_look.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>

#include "harness/metrics/metrics.h"

namespace photonproof::inline harness_gates {
namespace {

using Random = std::mt19937_64;

constexpr int width = 21, height = 11;  // blocks are 8 and 5 columns wide, 8 and 3 rows high

double expected(int x, int y, int c) { return 0.3 + 0.05 * c + 0.02 * x + 0.07 * y; }

/// An image of value 1 with normal noise of 10 %, times `factor`.
Image draw(Random& random, double factor = 1) {
  std::normal_distribution<double> noise(1, 0.1);
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<float>(factor * expected(x, y, c) * noise(random));
  return image;
}

/// The expectation, with a hundredth of an image's noise.
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
  gate.budget = {"photons", 1};  // so that edges do not count as those of stratified samples
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

/// The verdict of a run of the gate; empty if no look decides.
std::optional<GateVerdict> decide(const Gate& gate, const StoredReference& stored, Random& random, double factor) {
  std::vector<Image> images;
  for (int look = 0; look < gate.looks; ++look) {
    while (images.size() < static_cast<std::size_t>(gate.seeds) << look) images.push_back(draw(random, factor));
    if (const auto verdict = look_at(gate, stored, {}, pointers(images)).verdict) return verdict;
  }
  return std::nullopt;
}

/// The 99 % quantile of the false alarms in `runs` at a rate of alpha.
double most_alarms(int runs, double alpha) { return boost::math::quantile(boost::math::binomial(runs, alpha), 0.99); }

// If alpha were not divided by the looks, five of them would alarm at about three times alpha. Each look shares half of
// its images with the one before.
TEST(gate_look, an_agreement_gate_holds_alpha_over_all_its_looks) {
  constexpr int runs = 500;
  constexpr double alpha = 0.1;
  const StoredReference stored = reference();
  const Gate g = gate(agreement_metric, 1e-9, alpha, 5);  // no look reaches this bound: all of them are made
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

// A light smaller than a pixel: 0.6 of 64 samples meet it. So one pixel in 120 misses it in all of eight images, and
// then looks dark and certain. The samples of the reference give the pixel's variance, for any engine.
TEST(gate_look, a_light_smaller_than_a_pixel_that_no_image_met_alarms_no_more_often_than_alpha) {
  constexpr int runs = 2000;
  constexpr double alpha = 0.001, met = 0.6, light = 0.2, noise = 0.01, batches = 256;
  const auto has_light = [](int x, int y) { return x == 9 && y == 4; };
  StoredReference stored = reference();
  stored.provenance.samples = static_cast<std::uint64_t>(batches) * 64;
  for (int c = 0; c < 3; ++c)
    stored.rendering.variance->pixel(9, 4)[c] =
        static_cast<float>(std::pow(expected(9, 4, c), 2) * (met * light * light + noise * noise) / batches);
  stored.provenance.seeds.resize(static_cast<std::size_t>(batches));
  Gate one = gate("agreement", 1e-9, alpha, 1);
  one.budget = {"spp", 64};
  Random random(11);
  int alarms = 0;
  for (int run = 0; run < runs; ++run) {
    std::vector<Image> images;
    for (int i = 0; i < 8; ++i) {
      Image image(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const double area_light = has_light(x, y) ? light * (std::poisson_distribution<int>(met)(random) - met) : 0;
          for (int c = 0; c < 3; ++c)
            image.pixel(x, y)[c] = static_cast<float>(
                expected(x, y, c) * (1 + area_light + noise * std::normal_distribution<double>()(random)));
        }
      images.push_back(std::move(image));
    }
    if (look_at(one, stored, {}, pointers(images)).verdict == GateVerdict::fail) ++alarms;
  }
  std::printf("%d false alarms in %d, alpha %g\n", alarms, runs, alpha);
  EXPECT_LE(alarms, most_alarms(runs, alpha));
}

TEST(gate_look, finds_a_fault_in_the_corner_that_is_less_than_a_block) {
  // Columns 16 to 20 and rows 8 to 10 are the rest of a block at the right and lower edge: 15 pixels.
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
  // The images have no noise; the reference has an exact standard error of 1 % a pixel. A fourth of alpha = 0.001,
  // shared by three channels (and six blocks), has the two-sided normal quantile 3.9346 (4.3456), and 0.99 has 2.3263.
  Rendering exact{Image(width, height), Image(width, height), {}};
  std::fill(exact.mean.rgb.begin(), exact.mean.rgb.end(), 1.0f);
  std::fill(exact.variance->rgb.begin(), exact.variance->rgb.end(), 1e-4f);
  const std::vector<Image> images(8, exact.mean);
  const Judgement judgement = judge_agreement(measure_deviations(exact, pointers(images), {1e9}), {0.05, 0.05}, 0.001);
  ASSERT_EQ(judgement.verdict, GateVerdict::pass) << judgement.sentence;
  EXPECT_NEAR(judgement.would_see.value(), 6.26093 * 0.01 / std::sqrt(231.0), 2e-6);
  EXPECT_NEAR(judgement.would_see_in_a_block.value(), 6.67193 * 0.01 / std::sqrt(15.0), 2e-6);
  EXPECT_EQ(judgement.sentence, "agrees; 0.41 % overall or 1.7 % in a block of 8 x 8 pixels would have been seen");
}

TEST(gate_look, the_reference_itself_fails_every_gate_also_as_one_image_of_eight) {
  const StoredReference stored = reference();
  Random random(6);
  std::vector<Image> images;
  for (int i = 0; i < 7; ++i) images.push_back(draw(random));
  images.push_back(stored.rendering.mean);
  for (const char* metric : {agreement_metric, bias_metric, block_bias_metric, "relmse", "flip"}) {
    const Judgement judgement = look_at(gate(metric, 0.9, 0.001, 1), stored, {}, pointers(images));
    EXPECT_EQ(judgement.verdict, GateVerdict::fail) << metric;
    EXPECT_EQ(judgement.sentence, "an image is the reference itself, bit for bit, and not a rendering") << metric;
  }
  images.back().rgb[100] = std::nextafter(images.back().rgb[100], 1.0f);  // one bit off: proves nothing
  EXPECT_EQ(look_at(gate(bias_metric, 0.9, 0.001, 1), stored, {}, pointers(images)).verdict, GateVerdict::pass);
}

TEST(gate_look, an_exact_image_is_no_copy_of_a_reference_that_is_exact_or_rounds_to_it) {
  // An engine that writes half floats draws 1. The truth is 1, or so near 1 that hardly any value of the reference is
  // rounded to the other half float. At a distance of 1e-3 of the way, 0.7 of 693 values are expected to be.
  StoredReference stored = reference();
  std::fill(stored.rendering.mean.rgb.begin(), stored.rendering.mean.rgb.end(), 1.0f);
  const std::vector<Image> images(8, stored.rendering.mean);
  for (const double away : {0.0, 1e-3}) {
    const auto variance = static_cast<float>(away * (1 - away) * std::ldexp(1.0, -20));
    std::fill(stored.rendering.variance->rgb.begin(), stored.rendering.variance->rgb.end(), variance);
    for (const char* metric : {agreement_metric, bias_metric, "relmse"})
      EXPECT_EQ(look_at(gate(metric, 0.05, 0.001, 1), stored, {}, pointers(images)).verdict, GateVerdict::pass)
          << metric << " " << away;
  }
}

TEST(gate_look, one_image_for_all_seeds_is_named_and_passes_nothing_that_weighs_noise) {
  const StoredReference stored = reference();
  Random random(7);
  const std::vector<Image> images(8, draw(random));
  Gate tested = gate(agreement_metric, 0.9, 0.001, 1);
  for (const char* metric : {agreement_metric, bias_metric, block_bias_metric}) {
    tested.metric = metric;
    tested.takes_seed = true;
    const Judgement ignores = look_at(tested, stored, {}, pointers(images));
    EXPECT_EQ(ignores.verdict, GateVerdict::fail) << metric;
    EXPECT_EQ(ignores.sentence, "All 8 images are identical. The command probably ignores {seed}");
    EXPECT_NEAR(ignores.observed.value, 0, 0.03);  // 10 % of noise in 231 values a channel leaves 0.7 %
    EXPECT_TRUE(ignores.tiles.empty());            // the fault has no place
    // An engine that does not claim noise, like POV-Ray where nothing is random.
    tested.unbiased = false;
    const Judgement smooth = look_at(tested, stored, {}, pointers(images));
    EXPECT_EQ(smooth.verdict, GateVerdict::inconclusive) << metric;
    EXPECT_EQ(smooth.sentence.rfind("all 8 seeds gave the same image: " + std::string(metric) + " needs noise", 0), 0u)
        << smooth.sentence;
    tested.unbiased = true;
    tested.takes_seed = false;  // deterministic, without {seed}
    const Judgement deterministic = look_at(tested, stored, {}, pointers(images));
    EXPECT_EQ(deterministic.verdict, GateVerdict::inconclusive) << metric;
    EXPECT_EQ(deterministic.sentence.rfind("all 8 images are the same and the engine's command has no {seed}: " +
                                               std::string(metric) + " needs noise",
                                           0),
              0u)
        << deterministic.sentence;
  }
  // The metric of a single image still holds.
  tested.metric = "relmse";
  tested.bound = 0.1;
  EXPECT_EQ(look_at(tested, stored, {}, pointers(images)).verdict, GateVerdict::pass);
  tested.takes_seed = true;
  const Judgement relmse = look_at(tested, stored, {}, pointers(images));
  EXPECT_EQ(relmse.verdict, GateVerdict::pass);
  EXPECT_EQ(relmse.sentence.rfind("all 8 seeds gave the same image: relmse is 0.0", 0), 0u) << relmse.sentence;
}

// A black image is 100 % too dark: with or without a seed, from an unbiased or a biased engine.
TEST(gate_look, a_black_image_is_off_by_minus_100_per_cent) {
  const StoredReference stored = reference();
  const std::vector<Image> images(8, Image(width, height));
  for (const char* metric : {agreement_metric, bias_metric, block_bias_metric})
    for (const bool takes_seed : {true, false})
      for (const bool unbiased : {true, false}) {
        Gate tested = gate(metric, 0.9, 0.001, 1);
        tested.takes_seed = takes_seed;
        tested.unbiased = unbiased;
        const Judgement judgement = look_at(tested, stored, {}, pointers(images));
        EXPECT_EQ(judgement.verdict, GateVerdict::fail) << metric;
        EXPECT_EQ(judgement.sentence, "All 8 images are black: -100 % everywhere");
        EXPECT_EQ(judgement.observed.value, -1);
      }
}

TEST(gate_look, identical_images_show_what_they_are_off_by) {
  const StoredReference stored = reference();
  Image half = stored.rendering.mean;
  for (float& value : half.rgb) value *= 0.5f;
  const std::vector<Image> images(8, half);
  EXPECT_NEAR(look_at(gate(agreement_metric, 0.9, 0.001, 1), stored, {}, pointers(images)).observed.value, -0.5, 1e-6);
}

TEST(gate_look, an_image_that_comes_twice_among_others_is_found) {
  const StoredReference stored = reference();
  Random random(8);
  std::vector<Image> images;
  for (int i = 0; i < 7; ++i) images.push_back(draw(random));
  images.push_back(images[2]);
  for (const char* metric : {agreement_metric, "relmse"}) {
    const Judgement judgement = look_at(gate(metric, 0.9, 0.001, 1), stored, {}, pointers(images));
    EXPECT_EQ(judgement.verdict, GateVerdict::fail) << metric;
    EXPECT_EQ(judgement.sentence,
              "8 images, only 7 of them different: repeated images count their noise more than once");
  }
  // Two kinds of image that differ in one value may be chance: one sample in a thousand saw a light.
  for (std::size_t i = 1; i < images.size(); ++i) images[i] = images[0];
  for (std::size_t i = 4; i < images.size(); ++i) images[i].rgb[7] += 0.01f;
  EXPECT_EQ(look_at(gate("relmse", 0.9, 0.001, 1), stored, {}, pointers(images)).verdict, GateVerdict::pass);
}

TEST(gate_look, a_metric_that_fails_names_the_tile_with_most_of_the_error) {
  const StoredReference stored = reference();
  Random random(9);
  std::vector<Image> images;
  for (int i = 0; i < 8; ++i) {
    images.push_back(draw(random));
    for (int y = 0; y < 8; ++y)
      for (int x = 8; x < 16; ++x)
        for (int c = 0; c < 3; ++c) images.back().pixel(x, y)[c] *= 0.5f;
  }
  // The tile's relative squared error is near 0.25, that of the other 167 pixels 0.01: the share is 64/(64 + 6.7) =
  // 0.9.
  for (const auto& [metric, bound] : {std::pair{"relmse", 1e-3},
                                      {"ssim", 0.999},
                                      {"flip", 1e-3},
                                      {"psnr", 90.0},
                                      {"rmse", 1e-3},
                                      {"relmse_trimmed", 1e-3},
                                      {"flip_weighted_median", 1e-3},
                                      {"flip_max", 1e-3},
                                      {"hdr_flip", 1e-3},
                                      {"max_abs", 1e-3}}) {
    const ParameterValues viewing{.hdr_exposures = ExposureRange{-1, 1, 2}};
    const Judgement judgement = look_at(gate(metric, bound, 0.001, 1), stored, viewing, pointers(images));
    ASSERT_EQ(judgement.verdict, GateVerdict::fail) << metric;
    ASSERT_FALSE(judgement.tiles.empty()) << metric;
    const FailingTile& tile = judgement.tiles.front();
    EXPECT_EQ((std::array{tile.x, tile.y, tile.width, tile.height}), (std::array{8, 0, 8, 8})) << metric;
    EXPECT_NE(judgement.sentence.find("in 8 x 8 px at (8, 0), where the image is -50 %"), std::string::npos)
        << judgement.sentence;
    if (metric == std::string("relmse")) {
      EXPECT_NEAR(tile.score, 0.9, 0.03);
    }
  }
}

TEST(gate_look, a_parameter_that_the_gate_gives_is_what_it_judges_by_and_is_in_its_sentence) {
  const StoredReference stored = reference();
  Random random(11);
  std::vector<Image> images;
  for (int i = 0; i < 8; ++i) images.push_back(draw(random));
  const ParameterValues scene{.exposure = -6};
  const Gate asked = gate("flip", 0.9, 0.001, 1);
  Gate own = asked;
  own.parameters = {{&metric_parameters[0], {-2}}};
  double mean = 0;
  for (const Image& image : images)
    mean += compute_metrics(stored.rendering.mean, image, {.parameters = {.exposure = -2}, .only = {"flip"}})[0].value /
            static_cast<double>(images.size());
  const Judgement judgement = look_at(own, stored, scene, pointers(images));
  EXPECT_NEAR(judgement.observed.value, mean, 1e-12);
  EXPECT_EQ(judgement.sentence.rfind("flip (exposure=-2) is ", 0), 0u) << judgement.sentence;
  const Judgement of_scene = look_at(asked, stored, scene, pointers(images));
  EXPECT_LT(of_scene.observed.value, 0.9 * mean);  // darker by four stops
  EXPECT_EQ(of_scene.sentence.rfind("flip is ", 0), 0u) << of_scene.sentence;
}

TEST(gate_look, what_only_all_blocks_together_show_has_its_worst_blocks_and_their_sign) {
  // Every block of the right half is a little darker, none of them beyond its own bound.
  const int side = 64;
  StoredReference stored;
  stored.rendering = {Image(side, side), Image(side, side), {}};
  std::fill(stored.rendering.mean.rgb.begin(), stored.rendering.mean.rgb.end(), 1.0f);
  std::fill(stored.rendering.variance->rgb.begin(), stored.rendering.variance->rgb.end(), 1e-8f);
  stored.provenance.seeds.resize(1000);
  Random random(10);
  std::vector<Image> images(64, Image(side, side));
  // A block's mean over 64 images has a standard error of 0.1/sqrt(64 64) = 0.16 %. 0.35 % is 2.2 of these, under the
  // bound of about 4.7. But 32 blocks add 32 2.2^2 = 150 to a chi^2 of 64. The other half compensates the mean.
  for (Image& image : images)
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x)
        for (int c = 0; c < 3; ++c)
          image.pixel(x, y)[c] = static_cast<float>((c == 0 ? (x < side / 2 ? 1.0035 : 0.9965) : 1) *
                                                    std::normal_distribution<double>(1, 0.1)(random));
  const Judgement judgement = look_at(gate(agreement_metric, 0.1, 0.001, 1), stored, {}, pointers(images));
  ASSERT_EQ(judgement.verdict, GateVerdict::fail);
  ASSERT_EQ(judgement.sentence.rfind("blocks of 8 x 8 pixels are off by more than noise in R: ", 0), 0u)
      << judgement.sentence;
  ASSERT_EQ(judgement.tiles.size(), 3u);
  for (const FailingTile& tile : judgement.tiles)
    EXPECT_EQ(tile.sentence.front(), tile.x < side / 2 ? '+' : '-') << tile.sentence;
  EXPECT_NE(judgement.sentence.find(judgement.tiles.front().sentence.substr(0, 16)), std::string::npos)
      << judgement.sentence;
  EXPECT_NE(judgement.sentence.find(" darker, "), std::string::npos) << judgement.sentence;
}

TEST(gate_look, a_whole_image_that_is_off_says_whether_by_a_factor_an_amount_or_unevenly) {
  const StoredReference stored = reference();
  const auto sentence_of = [&](const std::function<double(int x, int y, int c)>& truth) {
    Random random(11);
    std::vector<Image> images(32, Image(width, height));
    for (Image& image : images)
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
          for (int c = 0; c < 3; ++c)
            image.pixel(x, y)[c] =
                static_cast<float>(truth(x, y, c) * std::normal_distribution<double>(1, 0.1)(random));
    return look_at(gate(agreement_metric, 0.1, 0.001, 1), stored, {}, pointers(images)).sentence;
  };
  const std::string factor = sentence_of([](int x, int y, int c) { return 0.9 * expected(x, y, c); });
  EXPECT_EQ(factor.rfind("the whole image is off: R -10 % G -", 0), 0u) << factor;
  EXPECT_NE(factor.find("; one factor everywhere"), std::string::npos) << factor;
  const std::string amount = sentence_of([](int x, int y, int c) { return 0.1 + expected(x, y, c); });
  EXPECT_NE(amount.find("; one amount everywhere, +0.1 in "), std::string::npos) << amount;
  const std::string uneven = sentence_of([](int x, int y, int c) { return (0.95 - 0.02 * x) * expected(x, y, c); });
  EXPECT_NE(uneven.find("; unevenly, from -"), std::string::npos) << uneven;
  EXPECT_NE(uneven.find(" at (16, "), std::string::npos) << uneven;
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
  // A pixel's squared standard error over n images is (0.1 expected)^2 / n, summed over pixels. The sum of 4 images of
  // 12 bands of 231 pixels is known to 2 %. A variance divided by n instead of n - 1 would be 25 % too small.
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
}  // namespace photonproof::inline harness_gates
