// Sharing and learning between passes of the photon mapper, on numbers with known answers.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "renderer/photon_mapping/adaptive_sample_map.h"
#include "renderer/photon_mapping/gather_bias.h"
#include "renderer/photon_mapping/shared_gathers.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Irradiance at a place, as discs of photons would measure it.
Rgb light_at(const Vec3f& p) { return {1 + p.x, 2 + p.x * p.x, 0.5f + p.y}; }

/// Points of `paths` paths of every pixel of a tile of 4 x 4, on two surfaces; weights and places differ.
GatherQueue points_of(std::uint32_t paths, std::vector<std::uint32_t>& pixel_of) {
  GatherQueue queue(16 * paths);
  pixel_of.clear();
  for (std::uint32_t i = 0; i < 16 * paths; ++i) {
    const std::uint32_t pixel = i / paths;
    pixel_of.push_back(pixel);
    const float u = std::fmod(0.618f * static_cast<float>(i), 1.0f);
    const float v = std::fmod(0.414f * static_cast<float>(i), 1.0f);
    if (i % 5 == 0) continue;  // a path that met no surface
    queue.push_back({.p = {0.01f * (static_cast<float>(pixel % 4) + u), 0.01f * (static_cast<float>(pixel / 4) + v), 0},
                     .weight = {u, 0.5f + v, 0.25f},
                     .path = i,
                     .surface = i % 3 == 0 ? 7u : 8u,
                     .edges = 1,
                     .surface_side = 0});
  }
  return queue;
}

std::vector<Rgb> expected_sums(GatherQueue& queue, const std::vector<std::uint32_t>& pixel_of) {
  std::vector<Rgb> sums(16, Rgb(0.0f));
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const GatherPoint point = queue[i];
    sums[pixel_of[point.path]] += point.weight * light_at(point.p);
  }
  return sums;
}

/// Mean of each pixel's sum over many random choices, and its standard error, red channel.
struct Shared {
  std::vector<double> sum = std::vector<double>(16), squares = sum;
  int draws;

  Shared(const BlockGrid& wanted, float most_apart, float radius, int of_draws) : draws(of_draws) {
    std::vector<std::uint32_t> pixel_of;
    for (int draw = 0; draw < draws; ++draw) {
      GatherQueue queue = points_of(6, pixel_of);
      const auto key = static_cast<std::uint32_t>(draw);
      const std::vector<PixelPoint> points = points_of_pixels(queue, pixel_of, most_apart, key);
      BlockGrid grid = wanted;
      if (grid.size > 1) grid = block_grid(3.0 * grid.size, key);
      const SharedGathers shared(points, std::vector<float>(points.size(), radius), {0, 0, 4, 4}, grid, key);
      std::vector<double> of_draw(16);
      for (std::size_t i = 0; i < points.size(); ++i)
        of_draw[points[i].pixel] += double{points[i].point.weight.x * light_at(shared.queue[shared.gather_of[i]].p).x};
      for (std::size_t pixel = 0; pixel < 16; ++pixel) {
        sum[pixel] += of_draw[pixel] / draws;
        squares[pixel] += of_draw[pixel] * of_draw[pixel] / draws;
      }
    }
  }
  double error(std::size_t pixel) const {
    return std::sqrt(std::max(0.0, squares[pixel] - sum[pixel] * sum[pixel]) / draws);
  }
};

TEST(shared_gathers, of_a_pixel_bring_the_sum_over_its_points_in_expectation) {
  std::vector<std::uint32_t> pixel_of;
  GatherQueue all = points_of(6, pixel_of);
  const std::vector<Rgb> expected = expected_sums(all, pixel_of);
  for (const float most_apart : {1.0f, 0.005f, 0.0f}) {
    const Shared shared({}, most_apart, 0.001f, 20000);
    for (std::size_t pixel = 0; pixel < 16; ++pixel) {
      EXPECT_NEAR(shared.sum[pixel], double{expected[pixel].x}, 5 * shared.error(pixel) + 1e-5) << pixel;
      EXPECT_LT(shared.error(pixel), most_apart == 0 ? 1e-6 : 0.01 * double{expected[pixel].x}) << pixel;
    }
  }
}

TEST(shared_gathers, of_a_pixel_are_one_for_each_surface) {
  std::vector<std::uint32_t> pixel_of;
  GatherQueue queue = points_of(6, pixel_of);
  EXPECT_EQ(points_of_pixels(queue, pixel_of, 1.0f, 1).size(), 32u);
}

TEST(shared_gathers, of_blocks_blur_by_no_more_than_half_a_block) {
  std::vector<std::uint32_t> pixel_of;
  GatherQueue all = points_of(6, pixel_of);
  const std::vector<Rgb> expected = expected_sums(all, pixel_of);
  const Shared shared({2, 0, 0}, 1, 1, 20000);
  // light_at changes by at most 1 % over a pixel's width.
  for (std::size_t pixel = 0; pixel < 16; ++pixel)
    EXPECT_NEAR(shared.sum[pixel], double{expected[pixel].x},
                0.01 * double{expected[pixel].x} + 5 * shared.error(pixel));
}

TEST(shared_gathers, of_blocks_are_few_and_never_of_points_that_are_far_apart) {
  std::vector<std::uint32_t> pixel_of;
  GatherQueue queue = points_of(6, pixel_of);
  const std::vector<PixelPoint> points = points_of_pixels(queue, pixel_of, 1.0f, 1);
  const auto gathers = [&](const BlockGrid& grid, float radius) {
    return SharedGathers(points, std::vector<float>(points.size(), radius), {0, 0, 4, 4}, grid, 1).queue.size();
  };
  EXPECT_EQ(gathers({4, 0, 0}, 1), 2u);
  EXPECT_EQ(gathers({2, 1, 1}, 1), 18u);
  EXPECT_GE(gathers({4, 0, 0}, 0.01f), 20u);  // half a radius is less than a pixel
}

/// A render of so many passes whose gathers have the bias b r^2 and the variance c/(n r^2), in every channel.
struct MadeRender {
  static constexpr int size = 64;
  double b, c, radius;
  Film film{size, size};
  GatherBias bias{Tile{0, 0, size, size}};
  PassHalves halves;
  RadiusHistory radii;

  MadeRender(double of_bias, double of_noise, double r) : b(of_bias), c(of_noise), radius(r) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    for (int pass = 0; pass < 20; ++pass) {
      const double n = 1 + pass / 4;
      radii.radius = static_cast<float>(radius);
      for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
          // sqrt(0.99) and the relmse's 0.01 make a scale of 1.
          film.add(x, y, RgbD(std::sqrt(0.99)), n);
          // Three quarters of the bias, and three times the variance of L(r), as of nested discs.
          const double lost = b * radius * radius * 3 / 4 + std::sqrt(3 * c / (1000 * n)) / radius * normal(random);
          bias.add(x, y, 1, pass, RgbD(lost), n);
        }
      radii.add_pass(n, 1000 * n);
      halves.add_pass(n);
    }
  }
};

TEST(gather_bias, is_seen_through_noise) {
  // Noise of a pixel's mean of D: sqrt(3c/(1000 x 60))/r = 0.22, thirty times the expected D.
  const MadeRender made(1, 10, 0.1);
  const GatherBias::Evidence evidence = made.bias.evidence(made.film, 1, made.halves);
  EXPECT_NEAR(evidence.variance / (3 * 0.01 / made.halves.all_samples() / 0.01), 1, 0.05);
  const MadeRender clear(1, 1e-3, 0.1);
  EXPECT_NEAR(clear.bias.evidence(clear.film, 1, clear.halves).squared_bias() / 1e-4, 4.3 * 9 / 16, 0.03);
  EXPECT_EQ(clear.bias.evidence(clear.film, 0, clear.halves).squared_bias(), 0);  // the other map's
  EXPECT_NEAR(clear.bias.evidence(clear.film, GatherBias::all_maps, clear.halves).squared_bias() / 1e-4, 4.3 * 9 / 16,
              0.03);
}

TEST(gather_bias, says_nothing_before_both_halves_have_a_pass) {
  GatherBias bias(Tile{0, 0, 4, 4});
  PassHalves halves;
  halves.add_pass(3);
  bias.add(0, 0, 0, 0, RgbD(1.0), 3);
  EXPECT_EQ(bias.evidence(Film(4, 4), 0, halves).difference, 0);
}

TEST(radius_history, finds_the_radius_that_makes_bias_and_variance_least) {
  // Reference: v/(n r^2) + b^2 r^4 over finely spaced radii, whatever radius the evidence is from.
  for (const double radius : {0.05, 0.1, 0.2}) {
    const double b = 3, c = 0.001;
    const MadeRender made(b, c, radius);
    const double n = 100;
    double best = 0, least = 1e300;
    for (double r = 0.01; r < 1; r *= 1.001) {
      const double error = c / (1000 * n * r * r) + b * b * r * r * r * r;
      if (error < least) least = error, best = r;
    }
    EXPECT_NEAR(made.radii.best(made.bias.evidence(made.film, 1, made.halves), n) / best, 1, 0.03) << radius;
  }
}

TEST(gather_bias, steps_to_the_least_error_for_any_exponent_of_the_bias) {
  // Reference: c/r^2 + b r^p over finely spaced radii. At a radius of 1 the variance of D is 3c. D^2 is 9/16 of the
  // squared bias of smooth light and 1/4.3 of that of edges; any other exponent has the geometric mean of the two.
  for (const double p : {1.0, 2.5, 4.0})
    for (const double c : {0.01, 1.0}) {
      double best = 0, least = 1e300;
      for (double r = 0.05; r < 5; r *= 1.0005)
        if (const double error = c / (r * r) + std::pow(r, p); error < least) least = error, best = r;
      const double part = p == 4 ? 9.0 / 16 : p == 1 ? 1 / 4.3 : std::sqrt(9.0 / 16 / 4.3);
      EXPECT_NEAR((GatherBias::Evidence{part, 3 * c}.step(p)) / best, 1, 1e-3) << p << ' ' << c;
    }
}

/// Factor of the radius in the middle after one choice. D is 1 + apart in even passes and 1 - apart in odd ones.
float narrowed(double exponent, double apart) {
  constexpr int size = 16;
  Film film(size, size);
  GatherBias bias(Tile{0, 0, size, size});
  bias.set_exponent(0, exponent);
  PassHalves halves;
  for (int pass = 0; pass < 4; ++pass) {
    for (int y = 0; y < size; ++y)
      for (int x = 0; x < size; ++x) {
        film.add(x, y, RgbD(1.0), 1);
        bias.add(x, y, 0, pass, RgbD(pass % 2 == 0 ? 1 + apart : 1 - apart), 1);
        bias.add(x, y, 1, pass, RgbD(1.0), 1);
      }
    halves.add_pass(1);
  }
  bias.narrow(film, halves);
  EXPECT_NEAR(double{bias.narrowing(8, 8, 1)}, 0.85, 1e-6) << "the other map";
  return bias.narrowing(8, 8, 0);
}

TEST(gather_bias, narrows_faster_at_edges) {
  EXPECT_NEAR(double{narrowed(smooth_exponent, 0)}, 0.85, 1e-6);
  EXPECT_NEAR(double{narrowed(edge_exponent, 0)}, 0.85 * 0.85, 1e-6);
  // The square of D, 1 - 0.45, exceeds D's variance 0.45 by 0.1. V is 0.15 and the squared bias 4.3 x 0.1 at edges,
  // 16/9 x 0.1 in smooth light.
  const double apart = std::sqrt(0.45);
  EXPECT_NEAR(double{narrowed(edge_exponent, apart)}, std::cbrt(0.15 / (0.5 * 0.43)), 1e-5);
  EXPECT_NEAR(double{narrowed(smooth_exponent, apart)}, std::pow(0.15 / (2 * 1.6 / 9), 1.0 / 6), 1e-5);
}

TEST(adaptive_sample_map, goes_where_passes_disagree_and_around_it) {
  AdaptiveSampleMap effort(Tile{0, 0, 16, 16});
  std::mt19937_64 random(3);
  std::normal_distribution<double> normal;
  for (int pass = 0; pass < 8; ++pass)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) effort.add(x, y, RgbD(1 + (x == 5 && y == 9 ? 1.0 : 0.01) * normal(random)), 1);
  effort.choose();
  // The deviation of 9 among 256 pixels is about 70 times the others': 1 / (9/256 + 1/70) = 20 times the mean.
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) {
      const bool near = std::abs(x - 5) <= 1 && std::abs(y - 9) <= 1;
      if (near)
        EXPECT_GE(effort.extra(x, y), 7u) << x << ' ' << y;
      else
        EXPECT_EQ(effort.extra(x, y), 0u) << x << ' ' << y;
    }
}

TEST(adaptive_sample_map, leaves_a_render_without_noise_alone) {
  AdaptiveSampleMap effort(Tile{0, 0, 4, 4});
  for (int pass = 0; pass < 4; ++pass)
    for (int i = 0; i < 16; ++i) effort.add(i % 4, i / 4, RgbD(2.0), 1);
  effort.choose();
  for (int i = 0; i < 16; ++i) EXPECT_EQ(effort.extra(i % 4, i / 4), 0u);
}

// The mean over renders must be 1, whatever sample counts the map chooses. The pixel is 100 with probability 0.01 and 0
// otherwise; a pass takes one sample. With passes weighted by their number of samples, renders whose first passes see
// light would take more samples afterwards. Their mean would be 10 % too low here.
TEST(adaptive_sample_map, does_not_bias_what_it_steers) {
  std::mt19937_64 random(11);
  std::bernoulli_distribution bright(0.01);
  constexpr int renders = 20000, passes = 8;
  double sum = 0, squares = 0, pooled = 0;
  for (int render = 0; render < renders; ++render) {
    AdaptiveSampleMap effort(Tile{0, 0, 4, 4});
    Film film(4, 4);
    double samples = 0, hits = 0;
    for (int pass = 0; pass < passes; ++pass) {
      for (int i = 0; i < 16; ++i) {
        const auto count = static_cast<int>(1 + effort.extra(i % 4, i / 4));
        double mean = 1;
        if (i == 5) {
          mean = 0;
          for (int s = 0; s < count; ++s) mean += bright(random) ? 100.0 / count : 0.0;
          samples += count, hits += mean * count;
        }
        film.add(i % 4, i / 4, RgbD(mean), 1);
        effort.add(i % 4, i / 4, RgbD(mean), count);
      }
      effort.choose();
    }
    const double mean = film.mean(1, 1).x;
    sum += mean / renders, squares += mean * mean / renders, pooled += hits / samples / renders;
  }
  const double error = std::sqrt((squares - sum * sum) / renders);
  std::printf("mean %.4f +- %.4f, of pooled samples %.4f\n", sum, error, pooled);
  EXPECT_NEAR(sum, 1, 4 * error);
  EXPECT_LT(std::abs(error), 0.03);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
