#include "harness/bench/correctness.h"

#include <gtest/gtest.h>

#include <random>

namespace photonproof::inline harness_bench {
namespace {

constexpr int side = 32;

/// A grey reference by `estimator` in 64 batches, with a relative noise of 0.001 a pixel.
StoredReference reference_by(const std::string& estimator) {
  StoredReference reference;
  reference.rendering.mean = Image(side, side);
  reference.rendering.variance = Image(side, side);
  for (float& value : reference.rendering.mean.rgb) value = 0.5f;
  for (float& value : reference.rendering.variance->rgb) value = 0.25e-6f;
  reference.provenance.estimator = estimator;
  reference.provenance.samples = 4096;
  reference.provenance.seeds.resize(64);
  return reference;
}

/// Images of independent normal pixels with mean 0.5 (1 + off).
std::vector<Image> images(int count, double noise, double off = 0) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal(0, noise);
  std::vector<Image> all(static_cast<std::size_t>(count), Image(side, side));
  for (Image& image : all)
    for (float& value : image.rgb) value = static_cast<float>(0.5 * (1 + off) * (1 + normal(random)));
  return all;
}

Engine engine(const std::string& integrator, Trust trust = Trust::unbiased) {
  Engine out;
  out.name = integrator;
  out.command = {"{photonproof}", "render", "{scene}", "--integrator", integrator};
  out.trust = trust;
  return out;
}

CorrectnessRecord judge(const StoredReference& reference, const std::vector<Image>& all,
                        const std::string& integrator = "path") {
  return judge_correctness({&reference, "", nullptr}, engine(integrator), {"spp", 64}, all);
}

// One look has 3 072 values. Their mean over four images is known to 2 % / 32, so an error of 1.5 % of the whole is far
// beyond noise.
TEST(Correctness, is_right_where_a_small_error_would_have_been_seen) {
  const CorrectnessRecord record = judge(reference_by("bdpt"), images(4, 0.02));
  EXPECT_EQ(record.verdict, Correctness::right) << record.sentence;
  EXPECT_LT(*record.would_see, right_within);
  EXPECT_EQ(record.regression_only, "");
}

TEST(Correctness, is_biased_where_the_mean_is_off_by_more_than_noise_and_says_by_how_much) {
  for (const double off : {-0.015, 0.015}) {
    const CorrectnessRecord record = judge(reference_by("bdpt"), images(4, 0.02, off));
    EXPECT_EQ(record.verdict, Correctness::biased) << record.sentence;
    EXPECT_NEAR(record.whole->value, off, 0.003);
  }
}

TEST(Correctness, is_biased_where_a_block_is_off_by_a_fifth_and_the_image_is_not) {
  std::vector<Image> all = images(4, 0.02);
  for (Image& image : all)
    for (int y = 8; y < 16; ++y)
      for (int x = 8; x < 16; ++x)
        for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] *= x < 12 ? 1.2f : 0.8f;
  EXPECT_EQ(judge(reference_by("bdpt"), all).verdict, Correctness::biased);
}

// Three seeds of 50 % noise a pixel: the mean is known to 1 %, but with two degrees of freedom.
TEST(Correctness, is_noisy_where_a_large_error_could_hide) {
  const CorrectnessRecord record = judge(reference_by("bdpt"), images(3, 0.5));
  EXPECT_EQ(record.verdict, Correctness::noisy) << record.sentence;
  EXPECT_FALSE(record.would_see);
}

TEST(Correctness, of_one_seed_is_unknown_however_far_it_is_off) {
  const CorrectnessRecord record = judge(reference_by("bdpt"), images(1, 0, -0.5));
  EXPECT_EQ(record.verdict, Correctness::unknown);
  EXPECT_NEAR(record.whole->value, -0.5, 1e-6);
  EXPECT_EQ(record.sentence, "one seed: its noise cannot be separated from an error; it is -50 % overall");
}

TEST(Correctness, of_two_seeds_is_unknown_however_far_it_is_off) {
  const CorrectnessRecord record = judge(reference_by("bdpt"), images(2, 0.01, -0.5));
  EXPECT_EQ(record.verdict, Correctness::unknown);
  EXPECT_NEAR(record.whole->value, -0.5, 1e-3);
  EXPECT_EQ(record.sentence,
            "two seeds: skewed noise cannot be separated from an error; three seeds suffice; they are -50 % overall");
  EXPECT_EQ(judge(reference_by("bdpt"), images(3, 0.01, -0.5)).verdict, Correctness::biased);
}

TEST(Correctness, is_unknown_without_a_reference_that_may_be_believed) {
  const StoredReference reference = reference_by("bdpt");
  const Engine biased = engine("photonmapper", Trust::biased);
  const std::string doubt = doubt_of(biased);
  EXPECT_EQ(doubt, "the reference is by photonmapper, which is biased");
  const auto with = [&](const Judge& by, const std::vector<Image>& all) {
    return judge_correctness(by, biased, {"spp", 64}, all);
  };
  EXPECT_EQ(with({&reference, doubt, nullptr}, images(4, 0.02)).verdict, Correctness::unknown);
  EXPECT_EQ(with({&reference, doubt, nullptr}, images(4, 0.02)).sentence, doubt);
  EXPECT_EQ(with({nullptr, "", nullptr}, images(4, 0.02)).verdict, Correctness::unknown);
  StoredReference certain = reference;
  certain.rendering.variance.reset();
  EXPECT_EQ(with({&certain, "", nullptr}, images(4, 0.02)).verdict, Correctness::unknown);
  EXPECT_EQ(with({&reference, "", nullptr}, std::vector<Image>(4, reference.rendering.mean)).sentence,
            "an image equals the reference to the bit");
}

TEST(Correctness, judged_by_the_engines_own_sampling_shows_changes_only) {
  EXPECT_EQ(judge(reference_by("path"), images(4, 0.02)).regression_only,
            "the reference is by path, whose sampling is the engine's");
}

TEST(Correctness, of_images_that_no_seed_changes_says_so) {
  const CorrectnessRecord record = judge(reference_by("bdpt"), std::vector<Image>(3, images(1, 0, 0.02).front()));
  EXPECT_EQ(record.verdict, Correctness::biased);
  EXPECT_TRUE(record.sentence.starts_with("all seeds gave the same image; ")) << record.sentence;
}

// One sample in 2^20 is 1e4 times as bright as the others and brings 1 % of the light. Then 4 x 64 samples of 1,024
// pixels contain it in every fourth image. Images without it are 1 % too dark and look certain.
TEST(Correctness, of_images_that_missed_rare_bright_samples_is_noisy_where_others_met_one) {
  std::vector<Image> all = images(4, 0.001, -0.01);
  EXPECT_EQ(judge(reference_by("bdpt"), all).verdict, Correctness::biased) << "nothing shows that there are any";
  for (int c = 0; c < 3; ++c) all[2].pixel(5, 9)[c] += 5e3f / 64;
  const CorrectnessRecord record = judge(reference_by("bdpt"), all);
  EXPECT_EQ(record.verdict, Correctness::noisy) << record.sentence;
  // A deficit of a fifth is more than a few such samples would have brought.
  all = images(4, 0.001, -0.2);
  for (int c = 0; c < 3; ++c) all[2].pixel(5, 9)[c] += 500.f / 64;
  EXPECT_EQ(judge(reference_by("bdpt"), all).verdict, Correctness::biased);
}

// An unbiased engine's expectation is the same at every budget.
TEST(Correctness, of_an_unbiased_engines_small_budget_is_not_biased_where_a_larger_one_is_right) {
  std::vector<ConvergencePoint> points(3);
  for (ConvergencePoint& point : points) point.correctness = CorrectnessRecord{};
  points[0].correctness->verdict = Correctness::biased;
  points[1].correctness->verdict = Correctness::right;
  points[2].correctness->verdict = Correctness::biased;
  reconcile(points);
  EXPECT_EQ(points[0].correctness->verdict, Correctness::noisy);
  EXPECT_EQ(points[1].correctness->verdict, Correctness::right);
  EXPECT_EQ(points[2].correctness->verdict, Correctness::biased) << "nothing acquits the largest budget";
}

}  // namespace
}  // namespace photonproof::inline harness_bench
