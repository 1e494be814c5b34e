// The chi^2 of gates and of `agreement`: its p-values are uniform for right images, for few images as for many.
#include "harness/statistics/deviation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <string>

#include "harness/statistics/agreement.h"
#include "harness/statistics/deviations.h"

namespace photonproof::inline harness_statistics {
namespace {

using Random = std::mt19937_64;

double p_value(double chi_square, std::size_t degrees) {
  return boost::math::cdf(boost::math::complement(boost::math::chi_squared(static_cast<double>(degrees)), chi_square));
}

/// Distance of the values' distribution from the uniform one, times sqrt(n) (Kolmogorov and Smirnov). For n uniform
/// values either distance exceeds 1.95 with probability exp(-2 1.95^2) = 0.0005.
struct Distance {
  double more_small = 0;  ///< than uniform ones
  double fewer_small = 0;
};
Distance from_uniform(std::vector<double> p) {
  std::sort(p.begin(), p.end());
  const auto n = static_cast<double>(p.size());
  Distance most;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto below = static_cast<double>(i);
    most.fewer_small = std::max(most.fewer_small, (p[i] - below / n) * std::sqrt(n));
    most.more_small = std::max(most.more_small, ((below + 1) / n - p[i]) * std::sqrt(n));
  }
  return most;
}
constexpr double most_by_chance = 1.95;

double share_below(const std::vector<double>& p, double level) {
  return static_cast<double>(std::count_if(p.begin(), p.end(), [&](double v) { return v < level; })) /
         static_cast<double>(p.size());
}

void expect_uniform(const std::vector<double>& p, const std::string& what, bool may_be_cautious = false) {
  const Distance distance = from_uniform(p);
  std::printf("%s: %.3g and %.3g from uniform, %.3g below 0.05\n", what.c_str(), distance.more_small,
              distance.fewer_small, share_below(p, 0.05));
  EXPECT_LT(distance.more_small, most_by_chance) << what;
  if (!may_be_cautious) {
    EXPECT_LT(distance.fewer_small, most_by_chance) << what;
  }
}

std::vector<double> p_values(int runs, const std::function<double(Random&)>& p) {
  Random random(19);
  std::vector<double> values;
  for (int run = 0; run < runs; ++run) values.push_back(p(random));
  return values;
}

TEST(deviation, chi_square_is_uniform_whatever_the_standard_errors_are_worth) {
  // 16 differences of deviation 1 over standard errors estimated with f degrees of freedom. A plain sum of the squares
  // has the mean 16 f/(f - 2): for f = 3 that is 48, which chi^2 with 16 degrees exceeds with probability 5e-5.
  for (const double freedom : {2.0, 3.0, 7.0, 63.0}) {
    const std::vector<double> p = p_values(4000, [&](Random& random) {
      std::vector<Deviation> blocks(16);
      for (Deviation& block : blocks) {
        block.difference = std::normal_distribution<double>()(random);
        block.standard_error = std::sqrt(std::chi_squared_distribution<double>(freedom)(random) / freedom);
        block.freedom = freedom;
      }
      return p_value(chi_square(blocks), blocks.size());
    });
    expect_uniform(p, "freedom " + std::to_string(freedom));
  }
}

constexpr int width = 32, height = 32;

/// Noise around 1, of the same law in all channels; `uneven`: eight times the variance in every third column.
Image draw(Random& random, bool uneven) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const double deviation = uneven && x % 3 == 0 ? 0.28 : 0.1;
      const auto value = static_cast<float>(1 + deviation * std::normal_distribution<double>()(random));
      std::fill_n(image.pixel(x, y), 3, value);
    }
  return image;
}

Rendering exact_reference() {
  Rendering reference{Image(width, height), Image(width, height), {}};
  std::fill(reference.mean.rgb.begin(), reference.mean.rgb.end(), 1.0f);
  return reference;
}

Rendering mean_with_variance(Random& random, int images, bool uneven) {
  std::vector<Image> drawn;
  for (int i = 0; i < images; ++i) drawn.push_back(draw(random, uneven));
  Rendering mean{Image(width, height), Image(width, height), {}};
  for (std::size_t i = 0; i < mean.mean.rgb.size(); ++i) {
    double sum = 0, squares = 0;
    for (const Image& image : drawn) sum += double{image.rgb[i]};
    for (const Image& image : drawn) squares += std::pow(double{image.rgb[i]} - sum / images, 2);
    mean.mean.rgb[i] = static_cast<float>(sum / images);
    mean.variance->rgb[i] = static_cast<float>(squares / (images - 1.0) / images);
  }
  return mean;
}

std::string text(int images, bool uneven) { return std::to_string(images) + (uneven ? " images, uneven" : " images"); }

TEST(deviation, the_chi_square_of_a_gates_blocks_rejects_no_more_for_few_images_than_for_many) {
  // The test is cautious with few images. Pixels may share light, so a block's noise is at least theirs, and the factor
  // above that is an estimate. With 32 images this effect is gone.
  const Rendering reference = exact_reference();
  for (const bool uneven : {false, true})
    for (const int images : {3, 8, 32}) {
      const std::vector<double> p = p_values(400, [&](Random& random) {
        std::vector<Image> drawn;
        std::vector<const Image*> pointers;
        for (int i = 0; i < images; ++i) drawn.push_back(draw(random, uneven));
        for (const Image& image : drawn) pointers.push_back(&image);
        const Deviations d = measure_deviations(reference, pointers, {});
        return p_value(chi_square(d.blocks[0]), d.places.size());
      });
      expect_uniform(p, text(images, uneven), images < 32);
    }
}

TEST(deviation, the_chi_square_of_agreements_blocks_is_uniform_for_few_estimates_as_for_many) {
  const Rendering reference = exact_reference();
  for (const bool uneven : {false, true})
    for (const int images : {3, 8, 32}) {
      const std::vector<double> p = p_values(400, [&](Random& random) {
        const Agreement agreement = test_agreement(reference, mean_with_variance(random, images, uneven));
        return p_value(agreement.blocks.observed, agreement.blocks.n);
      });
      expect_uniform(p, text(images, uneven));
    }
}

// 3 / sqrt(1 + 2 * 3 / 2) = 1.5 where either side may lack one of the brightest samples.
TEST(deviation, of_two_sides_with_noise_is_explained_alike_above_and_below) {
  Deviation d{3, 1};
  d.sample = 2;
  EXPECT_DOUBLE_EQ(d.errors(), 3);
  d.two_sided = true;
  EXPECT_DOUBLE_EQ(d.errors(), 1.5);
  d.skewness = 1;
  const double above = d.errors();
  EXPECT_LT(above, 1.5);
  d.difference = -3;
  EXPECT_DOUBLE_EQ(d.errors(), -above);
}

}  // namespace
}  // namespace photonproof::inline harness_statistics
