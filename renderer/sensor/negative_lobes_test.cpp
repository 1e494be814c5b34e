// Filters with negative lobes: their values, the samples of both parts, and the film's sum, against published formulas.
#include "renderer/sensor/negative_lobes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/lanes/test_random.h"
#include "renderer/sensor/camera_ray.h"
#include "renderer/sensor/film.h"
#include "renderer/sensor/test_published_filters.h"

namespace photonproof::inline renderer_sensor {
namespace {

using test::integral_of;
using test::PublishedFilter;

/// The part of [-radius, radius] around the pixel `at` that lies within the film.
struct Within {
  double left, right;
  Within(const PublishedFilter& f, int at, int size, bool border)
      : left(border ? -f.radius : std::max(-f.radius, -(at + 0.5))),
        right(border ? f.radius : std::min(f.radius, size - at - 0.5)) {}
};

TEST(negative_lobes, kernels_have_the_published_values) {
  for (const PublishedFilter& published : test::published_filters()) {
    const FilterKernel kernel(published.filter);
    EXPECT_EQ(kernel.radius(), published.radius);
    const double whole = integral_of(-published.radius, published.radius, published.value);
    for (int i = 0; i <= 200; ++i) {
      const double x = 1.1 * published.radius * i / 200;
      EXPECT_NEAR(kernel(x), published.value(x) / whole, 1e-7) << published.name << " " << x;
      EXPECT_EQ(kernel(x), kernel(-x));
      const double reached = std::min(x, published.radius);
      EXPECT_NEAR(kernel.half_integral(x), integral_of(0, reached, published.value) / whole, 2e-7) << published.name;
    }
  }
}

TEST(negative_lobes, their_integral_is_that_of_the_product_of_both_axes_below_zero) {
  // Over the film around pixel (x, y), m is the integral of max(-f(x) f(y), 0) over that of f(x) f(y).
  for (const PublishedFilter& published : test::published_filters())
    for (const bool border : {false, true})
      for (const auto& [x, y] : {std::pair{0, 0}, {1, 4}, {10, 19}, {10, 10}}) {
        constexpr int size = 20;
        const NegativeLobes lobes(published.filter, border, size, size);
        const auto part = [&](int at, double sign) {
          const Within within(published, at, size, border);
          return integral_of(within.left, within.right,
                             [&](double d) { return std::max(0.0, sign * published.value(d)); });
        };
        const double negative = part(x, 1) * part(y, -1) + part(x, -1) * part(y, 1);
        const double positive = part(x, 1) * part(y, 1) + part(x, -1) * part(y, -1);
        EXPECT_NEAR(lobes.subtracted(x, y), negative / (positive - negative), 1e-5) << published.name << x << y;
        if (x == y && x == 10) {
          EXPECT_NEAR(lobes.subtracted(), lobes.subtracted(x, y), 1e-12);
        }
        EXPECT_TRUE(lobes.any());
      }
  using Kind = ReconstructionFilter::Kind;
  for (const ReconstructionFilter& filter : {ReconstructionFilter{.kind = Kind::gaussian},
                                             {.kind = Kind::mitchell, .b = 1, .c = 0},
                                             {.kind = Kind::lanczos, .lobes = 1}}) {
    EXPECT_FALSE(NegativeLobes(filter, false, 20, 20).any());
  }
}

TEST(negative_lobes, samples_of_both_parts_are_drawn_as_the_filter_weighs) {
  // Expected counts are integrals of max(f(x) f(y), 0) or max(-f(x) f(y), 0) over cells of the film, over their sum.
  constexpr int size = 9, across = 24, samples = 400'000;
  int kinds = 0;
  for (const PublishedFilter& published : test::published_filters())
    for (const FilterPart part : {FilterPart::positive, FilterPart::negative})
      for (const auto& [px, py, border] : {std::tuple{4, 4, true}, {0, 4, false}, {7, 8, false}}) {
        CameraView camera;
        camera.width = camera.height = size;
        camera.filter = compile_filter(published.filter, border);
        const Within x(published, px, size, border), y(published, py, size, border);
        const auto shares = [&](const Within& within) {
          std::vector<std::array<double, 2>> lobes;  // above and below 0
          for (int i = 0; i < across; ++i) {
            const double a = within.left + (within.right - within.left) * i / across;
            const double b = within.left + (within.right - within.left) * (i + 1) / across;
            lobes.push_back({integral_of(a, b, [&](double d) { return std::max(0.0, published.value(d)); }),
                             integral_of(a, b, [&](double d) { return std::max(0.0, -published.value(d)); })});
          }
          return lobes;
        };
        const auto lobes_x = shares(x), lobes_y = shares(y);
        std::vector<double> observed(across * across), expected(across * across);
        double sum = 0;
        for (std::size_t j = 0; j < across; ++j)
          for (std::size_t i = 0; i < across; ++i) {
            const std::size_t other = part == FilterPart::positive ? 0 : 1;
            expected[j * across + i] = lobes_x[i][0] * lobes_y[j][other] + lobes_x[i][1] * lobes_y[j][1 - other];
            sum += expected[j * across + i];
          }
        for (double& e : expected) e *= samples / sum;
        for (int s = 0; s < samples; ++s) {
          test::Random random(460, static_cast<std::uint64_t>(s));
          const float u = random.next(), v = random.next();
          const Vec2<float> d = lobe_offsets<float>(camera, std::uint32_t(px), std::uint32_t(py), part, {u, v});
          const double i = (double{d.x} - x.left) / (x.right - x.left), j = (double{d.y} - y.left) / (y.right - y.left);
          ASSERT_TRUE(i > -1e-5 && i < 1 + 1e-5 && j > -1e-5 && j < 1 + 1e-5) << published.name << d.x << " " << d.y;
          const auto cell = [](double at) { return std::size_t(std::clamp(int(at * across), 0, across - 1)); };
          observed[cell(j) * across + cell(i)] += 1;
        }
        EXPECT_GT(test::chi_square_p_value(observed, expected), test::sidak_level(36))
            << published.name << " at " << px << " " << py;
        ++kinds;
      }
  EXPECT_EQ(kinds, 36);
}

TEST(negative_lobes, every_number_gives_an_offset_within_the_film) {
  for (const PublishedFilter& published : test::published_filters())
    for (const int size : {1, 2, 9}) {
      CameraView camera;
      camera.width = camera.height = static_cast<float>(size);
      camera.filter = compile_filter(published.filter, false);
      for (const FilterPart part : {FilterPart::positive, FilterPart::negative})
        for (const float u : {0.0f, 0x1p-24f, 1e-4f, 0.25f, 0.4f, 0.9999f, 0x1.fffffep-1f})
          for (const float v : {0.0f, 1e-4f, 0.5f, 0.9999f, 0x1.fffffep-1f})
            for (std::uint32_t at = 0; at < static_cast<std::uint32_t>(size); ++at) {
              const Vec2<float> d = lobe_offsets<float>(camera, at, at, part, {u, v});
              EXPECT_TRUE(std::isfinite(d.x) && std::isfinite(d.y)) << published.name << u << v;
              // A gap between lobes at the border has no share, but rounded numbers at the ends may reach its far side.
              if (part == FilterPart::negative && size == 1) continue;  // without a negative part
              if (std::min({u, v, 1 - u, 1 - v}) < 1e-5f) continue;
              EXPECT_GE(d.x + 0.5 + at, -1e-3);
              EXPECT_LE(d.y + 0.5 + at, size + 1e-3);
            }
    }
}

TEST(negative_lobes, two_samples_show_their_spread_and_many_are_in_proportion) {
  EXPECT_EQ(negative_samples(0, 64), 0);
  EXPECT_EQ(negative_samples(0.25, 1), 1);
  EXPECT_EQ(negative_samples(0.25, 2), 2);
  EXPECT_EQ(negative_samples(0.25, 10), 2);
  EXPECT_EQ(negative_samples(0.25, 1000), 200);
  EXPECT_EQ(negative_samples(1e-9, 1000), 2);
}

TEST(negative_lobes, a_film_subtracts_their_mean_and_adds_their_variance) {
  // Positive samples 1 and 3: mean 2, variance of the mean 1. Negative samples 0, 0 and 3: mean 1, spread 2, variance
  // of the mean 2 / 2 = 1. So the pixel is 2 (1 + m) - m, its variance (1 + m)^2 + m^2.
  const ReconstructionFilter filter{.kind = ReconstructionFilter::Kind::lanczos};
  const NegativeLobes lobes(filter, false, 8, 8);
  Film film(Tile{0, 2, 2, 3});
  film.separate(lobes);
  for (int x = 0; x < 2; ++x) {
    film.add(x, 2, RgbD(4.0), RgbD(10.0), 2);
    EXPECT_FALSE(film.relative_standard_error());
    film.add_negative(x, 2, RgbD(3.0), RgbD(9.0), 3);
  }
  const Rendering image = film.develop();
  double error = 0, square = 0;
  for (int x = 0; x < 2; ++x) {
    const double m = lobes.subtracted(x, 2), mean = 2 + m, variance = (1 + m) * (1 + m) + m * m;
    EXPECT_NEAR(double{image.mean.pixel(x, 0)[0]}, mean, 1e-6);
    EXPECT_NEAR(film.mean(x, 2).x, mean, 1e-12);
    EXPECT_NEAR(double{image.variance->pixel(x, 0)[0]}, variance, 1e-6);
    error += variance / (mean * mean + 0.01) / 2;
    square += mean * mean / 2;
  }
  EXPECT_NE(lobes.subtracted(0, 2), lobes.subtracted(1, 2));
  EXPECT_NEAR(film.relative_standard_error().value(), std::sqrt(error), 1e-12);
  EXPECT_NEAR(film.mean_square(), square, 1e-12);
}

}  // namespace
}  // namespace photonproof::inline renderer_sensor
