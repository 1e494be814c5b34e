#include "harness/conclusions/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "harness/conclusions/error_curve.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_conclusions {
namespace {

ConvergencePoint point(double spp, double seconds, double relmse) {
  ConvergencePoint p;
  p.budget = {"spp", spp};
  p.seeds = 2;
  p.seconds = Estimate{seconds, Interval{seconds, seconds}};
  p.relmse = Estimate{relmse, Interval{relmse / 1.1, relmse * 1.1}};
  return p;
}

// relmse = 0.02 / seconds: slope -1 exactly, efficiency 1 / 0.02 everywhere.
Convergence exact_curve() {
  Convergence curve;
  for (const double seconds : {1.0, 2.0, 4.0, 8.0}) curve.points.push_back(point(seconds, seconds, 0.02 / seconds));
  return curve;
}

// The time at which errors at these seconds come down to `relmse`.
std::optional<double> seconds_to(double relmse, const std::vector<std::pair<double, double>>& seconds_and_errors) {
  std::vector<ConvergencePoint> points;
  for (const auto& [seconds, error] : seconds_and_errors) points.push_back(point(seconds, seconds, error));
  KnownPoints curve;
  for (const ConvergencePoint& p : points) curve.points.push_back(&p);
  const auto target = time_to_target(curve, relmse).seconds;
  return target ? std::optional(target->value) : std::nullopt;
}

TEST(Convergence, error_that_halves_with_twice_the_time_has_slope_minus_one) {
  Convergence curve = exact_curve();
  conclude(curve);
  EXPECT_NEAR(curve.slope->value, -1, 1e-12);
  EXPECT_NEAR(curve.slope->interval->low, -1, 1e-6);
  EXPECT_NEAR(curve.efficiency->value, 50, 1e-9);
  EXPECT_NEAR(curve.efficiency->interval->low, 50 / 1.1, 1e-9);
  EXPECT_NEAR(curve.efficiency->interval->high, 50 * 1.1, 1e-9);
}

// 0.02 / t = 0.008 at t = 2.5; the interval's ends (10 % up and down) at 2.5 / 1.1 and 2.5 * 1.1.
TEST(Convergence, time_to_target_is_interpolated_in_logarithms) {
  Convergence curve = exact_curve();
  curve.targets = {{0.008}, {0.016}};
  conclude(curve);
  EXPECT_NEAR(curve.targets[0].seconds->value, 2.5, 1e-9);
  EXPECT_NEAR(curve.targets[0].seconds->interval->low, 2.5 / 1.1, 1e-9);
  EXPECT_NEAR(curve.targets[0].seconds->interval->high, 2.5 * 1.1, 1e-9);
  EXPECT_NEAR(curve.targets[1].seconds->value, 1.25, 1e-9);
}

TEST(Convergence, target_outside_what_was_measured_is_never_extrapolated) {
  Convergence curve = exact_curve();
  curve.targets = {{0.1}, {0.0001}};
  conclude(curve);
  EXPECT_EQ(curve.targets, (std::vector<TargetTime>{{0.1, {}, {}, 1.0}, {0.0001, {}, 8.0, {}}}));
  EXPECT_EQ(seconds_to(0.02, {{1, 0.02}, {2, 0.01}}), 1);
  EXPECT_EQ(seconds_to(0.01, {{1, 0.02}, {2, 0.01}}), 2);
}

// Errors of 0.018, 0.006 and 1.25 were measured. Without this rule the table says that 0.01 is reached in 0.0196 s.
TEST(Convergence, budget_above_the_target_refutes_the_smaller_ones_below_it) {
  Convergence curve;
  curve.points = {point(4, 0.016, 0.018), point(16, 0.022, 0.006), point(64, 0.08, 1.25)};
  curve.targets = {{0.01}};
  conclude(curve);
  const std::string why = "error grows from 0.006 at spp=16 to 1.2 at spp=64";
  EXPECT_EQ(curve.targets, (std::vector<TargetTime>{{0.01, {}, {}, {}, why}}));
  EXPECT_EQ(curve.undefined.at("efficiency"), why);
  EXPECT_EQ(curve.undefined.at("slope"), why);
  EXPECT_EQ(curve.caveats,
            std::vector<std::string>{why + ": the smaller budgets met too few rare bright samples, or it is a fault"});
}

// Twice the error is within what seeds differ by; two and a half times is not.
TEST(Convergence, error_may_grow_by_a_factor_of_two) {
  for (const auto& [factor, is_refuted] : {std::pair{1.9, false}, std::pair{2.5, true}}) {
    Convergence curve;
    curve.points = {point(1, 1, 0.02), point(4, 4, 0.005), point(16, 16, 0.005 * factor)};
    curve.targets = {{0.01}};
    conclude(curve);
    EXPECT_EQ(!curve.targets[0].undefined.empty(), is_refuted) << factor;
  }
}

// One budget behind a leap may be as lucky as those before it. Two behind it show where the curve is, and then they
// alone count. 0.02 / t = 0.003 at t = 6.667.
TEST(Convergence, budgets_behind_a_leap_count_from_two_on) {
  Convergence curve;
  curve.points = {point(1, 1, 0.001), point(2, 2, 0.01), point(4, 4, 0.005)};
  curve.targets = {{0.007}};
  conclude(curve);
  EXPECT_EQ(curve.targets[0].undefined, "error grows from 0.001 at spp=1 to 0.01 at spp=2");
  curve.points.push_back(point(8, 8, 0.0025));
  curve.targets = {{0.003}, {0.007}};
  conclude(curve);
  EXPECT_NEAR(curve.targets[0].seconds->value, 0.02 / 0.003, 1e-9);
  EXPECT_EQ(curve.targets[1].at_most, 4);
  EXPECT_NEAR(curve.efficiency->value, 50, 1e-9);
  EXPECT_FALSE(curve.slope);
}

// The error may grow a little by chance: the target is reached from the point on where it stays below.
TEST(Convergence, target_counts_as_reached_where_no_larger_budget_is_above_it) {
  EXPECT_FALSE(seconds_to(0.01, {{1, 0.018}, {4, 0.006}, {16, 0.011}}));
  Convergence curve;
  curve.points = {point(4, 1, 0.018), point(16, 4, 0.006), point(64, 16, 0.011)};
  curve.targets = {{0.01}};
  conclude(curve);
  EXPECT_EQ(curve.targets, (std::vector<TargetTime>{{0.01, {}, 16.0}}));
  // Down at 2 s, up at 8 s, down again between 16 s and 64 s, at sqrt(16 64) s.
  EXPECT_NEAR(seconds_to(0.01, {{1, 0.02}, {4, 0.005}, {16, 0.0125}, {64, 0.008}}).value(), 32, 1e-9);
}

// Errors known to 10 % and times to 20 %: sqrt(log(1.1)^2 + log(1.2)^2) = 0.205731 on the logarithm, a factor of
// 1.228423. A curve of slope -1 carries both over to times one to one.
TEST(Convergence, uncertainty_of_errors_and_of_times_is_in_that_of_the_time_to_a_target) {
  Convergence curve = exact_curve();
  for (ConvergencePoint& p : curve.points) p.seconds.interval = Interval{p.seconds.value / 1.2, p.seconds.value * 1.2};
  curve.targets = {{0.008}};
  conclude(curve);
  EXPECT_NEAR(curve.targets[0].seconds->interval->low, 2.5 / 1.228423, 1e-5);
  EXPECT_NEAR(curve.targets[0].seconds->interval->high, 2.5 * 1.228423, 1e-5);
  EXPECT_NEAR(curve.efficiency->interval->low, 50 / 1.228423, 1e-4);
  EXPECT_NEAR(curve.efficiency->interval->high, 50 * 1.228423, 1e-4);
  for (ConvergencePoint& p : curve.points) p.seconds.interval.reset();
  conclude(curve);
  EXPECT_FALSE(curve.targets[0].seconds->interval);
  EXPECT_FALSE(curve.efficiency->interval);
}

// 1 / (relmse s): the error's upper end gives the efficiency's lower end.
TEST(Convergence, ends_of_the_efficiency_are_those_of_the_error_turned_round) {
  Convergence curve = exact_curve();
  for (ConvergencePoint& p : curve.points) p.relmse->interval = Interval{p.relmse->value / 1.1, p.relmse->value * 1.3};
  conclude(curve);
  EXPECT_NEAR(curve.efficiency->interval->low, 50 / 1.3, 1e-9);
  EXPECT_NEAR(curve.efficiency->interval->high, 50 * 1.1, 1e-9);
}

// Statistics without meaning are not printed, and the record gives the reason.
TEST(Convergence, slope_of_two_budgets_is_undefined_as_its_error_is_unknown) {
  Convergence curve = exact_curve();
  curve.points.resize(2);
  conclude(curve);
  EXPECT_FALSE(curve.slope);
  EXPECT_EQ(curve.undefined.at("slope"), "two budgets");
  curve.undefined.clear();
  curve.points.resize(1);
  conclude(curve);
  EXPECT_EQ(curve.undefined.at("slope"), "one budget");
}

// At log seconds 0, 1 and 2 log relmse is 0, 0.6 and 0: slope 0, residuals -0.2, 0.4 and -0.2. The slope's standard
// error is sqrt(.24 / 1 / 2) = 0.3464, and its margin t(0.975, 1) = 12.71 times that, 4.4.
TEST(Convergence, slope_that_is_not_known_to_one_is_undefined) {
  Convergence curve;
  for (int i = 0; i < 3; ++i) curve.points.push_back(point(i + 1, std::exp(i), std::exp(i == 1 ? 0.6 : 0)));
  conclude(curve);
  EXPECT_FALSE(curve.slope);
  EXPECT_EQ(curve.undefined.at("slope"), "known to ±4.4 only");
}

TEST(Convergence, error_that_is_rounding_or_the_references_has_no_efficiency) {
  Convergence curve = exact_curve();
  for (ConvergencePoint& p : curve.points) p.undefined[own_error_key] = "it is rounding";
  conclude(curve);
  EXPECT_FALSE(curve.efficiency);
  EXPECT_EQ(curve.undefined.at("efficiency"), "error: it is rounding");
  EXPECT_EQ(curve.undefined.at("slope"), "no budget has an error of its own");
}

// A results folder with a black reference of no variance and cells of constant error.
class ConvergenceOfImages : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    results_.scenes.push_back({"s", "s.xml", "", 16, 16, 0, "s/ref/spp=1000/seed=0", {}});
    add({"s", "ref", {"spp", 1000}, 0}, 0, 1);
  }
  // Red, green and blue are `value` everywhere: against black, relmse = value^2 / 0.01.
  void add(const Cell& cell, float value, double seconds) {
    Rendering rendering;
    rendering.mean = Image(16, 16);
    for (float& v : rendering.mean.rgb) v = value;
    Result result;
    result.cell = cell;
    result.image = std::to_string(results_.results.size()) + ".exr";
    result.wall_seconds = seconds;
    write_exr((folder_ / result.image).string(), rendering);
    results_.results.push_back(result);
  }
  Results results_;
};

TEST_F(ConvergenceOfImages, cells_become_curves_by_engine_and_kind_of_budget) {
  add({"s", "path", {"spp", 16}, 1}, 0.01f, 4);
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
  add({"s", "path", {"spp", 4}, 2}, 0.04f, 3);
  add({"s", "path", {"seconds", 2}, 1}, 0.02f, 2);
  add({"s", "other", {"spp", 4}, 1}, 0.02f, 1);
  const std::vector<Convergence> curves = convergence_of(results_, folder_, {{"s", {0.05}}});
  ASSERT_EQ(curves.size(), 3u);
  EXPECT_EQ(curves[0].engine, "path");
  ASSERT_EQ(curves[0].points.size(), 2u);
  const ConvergencePoint& four = curves[0].points[0];
  EXPECT_EQ(four.budget, (Budget{"spp", 4}));
  EXPECT_EQ(four.seeds, 2);
  EXPECT_NEAR(four.relmse->value, (0.04 + 0.16) / 2, 1e-7);
  EXPECT_EQ(four.seconds.value, 2);
  // The sample variance of 0.02 and 0.04 is 0.0002, which is 0.02 relative to 0.01. The mean is off by 0.3 with noise
  // sqrt(0.02 / 2) = 0.1, times Student's t = 12.706. So the squared bias is at most (0.3 + 1.2706)^2.
  EXPECT_NEAR(four.variance->value, 0.02, 1e-7);
  EXPECT_FALSE(four.variance->interval);
  EXPECT_EQ(four.undefined.at("bias2"), "none seen above 2.5");
  EXPECT_FALSE(curves[0].points[1].bias2);
  // From 0.1 at 2 s to 0.01 at 4 s: 0.05 after log 2 / log 10 of the way.
  EXPECT_NEAR(curves[0].targets.at(0).seconds->value, 2 * std::pow(2.0, std::log10(2.0)), 1e-6);
  EXPECT_EQ(curves[1].points[0].budget.kind, "seconds");
  EXPECT_EQ(curves[2].engine, "other");
}

// relmse = (5e-7)^2 / 0.01 = 2.5e-11, under the square of a relative 1e-5.
TEST_F(ConvergenceOfImages, error_of_rounding_is_named) {
  add({"s", "path", {"spp", 4}, 1}, 5e-7f, 1);
  const Convergence curve = convergence_of(results_, folder_, {})[0];
  EXPECT_EQ(curve.points[0].undefined.at(own_error_key), "it is rounding");
  EXPECT_FALSE(curve.efficiency);
}

// The mean of +-0.02 is the reference: `bias2` is 0 - 0.0004 * 2 / 2 / 0.01 = -0.04 exactly, in every block. Two images
// that may share noise bound it by 12.706^2 0.04 = 6.5.
TEST_F(ConvergenceOfImages, bias_that_is_not_seen_is_a_bound_and_no_negative_square) {
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
  add({"s", "path", {"spp", 4}, 2}, -0.02f, 1);
  const Convergence curve = convergence_of(results_, folder_, {})[0];
  EXPECT_FALSE(curve.points[0].bias2);
  EXPECT_EQ(curve.points[0].undefined.at("bias2"), "none seen above 6.5");
}

TEST_F(ConvergenceOfImages, of_one_seed_neither_bias_nor_variance_is_known_and_the_record_says_why) {
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
  const ConvergencePoint one = convergence_of(results_, folder_, {})[0].points[0];
  EXPECT_EQ(one.undefined, (Reasons{{"bias2", "one seed"}, {"variance", "one seed"}}));
}

// The three different images have relMSEs 0.04, 0.16 and 0.36; the second counts once, however often it occurs.
TEST_F(ConvergenceOfImages, image_that_two_seeds_gave_counts_once) {
  std::uint64_t seed = 0;
  for (const float value : {0.02f, 0.04f, 0.04f, 0.06f, 0.04f}) add({"s", "path", {"spp", 4}, ++seed}, value, 1);
  const JudgeImages judge = [](const Cell&, std::span<const Image> images) {
    CorrectnessRecord record;
    record.sentence = std::to_string(images.size());
    return record;
  };
  const ConvergencePoint point = convergence_of(results_, folder_, {}, judge)[0].points[0];
  EXPECT_NEAR(point.relmse->value, 0.56 / 3, 1e-7);
  EXPECT_EQ(point.correctness->sentence, "3");
  results_.results.resize(1);
  for (seed = 1; seed < 4; ++seed) add({"s", "path", {"spp", 4}, seed}, 0.04f, 1);
  const ConvergencePoint same = convergence_of(results_, folder_, {}, judge)[0].points[0];
  EXPECT_FALSE(same.relmse->interval);
  EXPECT_EQ(same.undefined.at("bias2"), "one image for all seeds");
  EXPECT_EQ(same.correctness->sentence, "3") << "the judge knows what it means that all are the same";
}

TEST_F(ConvergenceOfImages, every_budget_is_judged_by_the_images_of_all_its_seeds) {
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
  add({"s", "path", {"spp", 4}, 2}, 0.04f, 1);
  const JudgeImages judge = [](const Cell& like, std::span<const Image> images) {
    CorrectnessRecord record;
    record.sentence = like.budget.label() + ": " + std::to_string(images.size());
    return record;
  };
  EXPECT_EQ(convergence_of(results_, folder_, {}, judge)[0].points[0].correctness->sentence, "spp=4: 2");
}

// A reference whose variance is `share` of the relMSE of 0.04: 0.04 share times the 0.01 that errors are relative to.
TEST_F(ConvergenceOfImages, error_that_is_in_part_the_references_noise_is_said_from_a_tenth_on) {
  const auto curve_of = [&](double share) {
    results_.results.resize(1);
    Rendering reference{Image(16, 16), Image(16, 16), {}};
    for (float& v : reference.variance->rgb) v = static_cast<float>(0.04 * share * 0.01);
    write_exr((folder_ / results_.results[0].image).string(), reference);
    add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
    return convergence_of(results_, folder_, {})[0];
  };
  const auto says = [](const Convergence& curve) {
    return !curve.caveats.empty() && curve.caveats[0] == "spp=4: 10 % of the error is the reference's own noise";
  };
  EXPECT_FALSE(says(curve_of(0.095)));
  EXPECT_TRUE(says(curve_of(0.104)));
  EXPECT_FALSE(curve_of(0.48).points[0].undefined.contains(own_error_key));
  EXPECT_EQ(curve_of(0.52).points[0].undefined.at(own_error_key), "it is the reference's noise");
}

// Eight noisy images whose reference states ten times their variance: bias^2 less that is far below 0. A cell's
// variance is an upper bound, so the interval's end has it added again. A stored reference's variance is exact.
TEST_F(ConvergenceOfImages, variance_of_a_reference_that_is_a_cell_is_an_upper_bound) {
  Rendering reference{Image(32, 32), Image(32, 32), {}};
  for (float& v : reference.variance->rgb) v = 1e-5f;
  std::mt19937_64 random(3);
  std::normal_distribution<float> noise(0, 1e-3f);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    add({"s", "path", {"spp", 4}, seed}, 0, 1);
    Rendering image;
    image.mean = Image(32, 32);
    for (float& v : image.mean.rgb) v = noise(random);
    write_exr((folder_ / results_.results.back().image).string(), image);
  }
  write_exr((folder_ / results_.results[0].image).string(), reference);
  const auto end = [&] { return convergence_of(results_, folder_, {})[0].points[0].undefined.at("bias2"); };
  EXPECT_NE(end(), "none seen above 0");
  results_.scenes[0].reference.emplace().image = results_.results[0].image;
  EXPECT_EQ(end(), "none seen above 0");
}

TEST_F(ConvergenceOfImages, lost_image_leaves_the_recorded_metric) {
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
  results_.results.back().image = "gone.exr";
  results_.results.back().metrics = {{"relmse", 0.04, ""}};
  EXPECT_EQ(convergence_of(results_, folder_, {})[0].points[0].relmse, (Estimate{0.04, {}}));
}

// Rendering takes 0.1 of 1 s, 0.4 of 1 s and 3.9 of 4 s.
TEST_F(ConvergenceOfImages, budgets_that_are_mostly_start_up_are_named) {
  add({"s", "path", {"spp", 1}, 1}, 0.02f, 1);
  results_.results.back().phases = {{"load", 0.5}, {"render", 0.1}};
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 1);
  results_.results.back().phases = {{"load", 0.4}, {"render", 0.4}, {"write", 0.2}};
  add({"s", "path", {"spp", 64}, 1}, 0.02f, 4);
  results_.results.back().phases = {{"load", 0.1}, {"render", 3.9}};
  EXPECT_EQ(convergence_of(results_, folder_, {})[0].caveats,
            (std::vector<std::string>{"up to spp=4 most of the time is start-up (at that budget 40 % is rendering)",
                                      "one seed: neither spread nor bias is known"}));
}

TEST_F(ConvergenceOfImages, seconds_are_those_of_the_clock_that_is_asked_for) {
  add({"s", "path", {"spp", 4}, 1}, 0.02f, 2);
  results_.results.back().cpu_seconds = 3.5;
  EXPECT_EQ(convergence_of(results_, folder_, {})[0].points[0].seconds.value, 2);
  const Convergence by_processor = convergence_of(results_, folder_, {}, {}, Clock::processor)[0];
  EXPECT_EQ(by_processor.clock, Clock::processor);
  EXPECT_EQ(by_processor.points[0].seconds.value, 3.5);
}

TEST_F(ConvergenceOfImages, slow_seed_is_named_as_an_outlier) {
  for (std::uint64_t seed = 0; seed < 6; ++seed)
    add({"s", "path", {"spp", 4}, seed}, 0.02f, seed == 4 ? 3 : 1 + 0.02 * static_cast<double>(seed));
  EXPECT_EQ(convergence_of(results_, folder_, {})[0].caveats,
            std::vector<std::string>{"spp=4: seed 4 took 3 s, the median 1.05 s: an outlier"});
}

}  // namespace
}  // namespace photonproof::inline harness_conclusions
