#include "renderer/passes/look_up_bias.h"

#include <algorithm>
#include <cmath>

namespace photonproof {
namespace {

constexpr int most_pixels = 16384;

int stride_for(const Tile& window) {
  const double pixels = static_cast<double>(window.width()) * window.height();
  return std::max(1, static_cast<int>(std::sqrt(pixels / most_pixels)));
}

int cells(int begin, int end, int stride) { return (end - 1) / stride - begin / stride + 1; }

RgbD inverse_scale(const RgbD& mean) {
  constexpr double epsilon = 0.01;  // as relmse has it
  const auto of = [](double v) { return 1 / (v * v + epsilon); };
  return {of(mean.x), of(mean.y), of(mean.z)};
}

double dot3(const RgbD& a, const RgbD& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

LookUpBias::LookUpBias(const Tile& window)
    : window_(window),
      stride_(stride_for(window)),
      first_x_(window.x0 / stride_),
      first_y_(window.y0 / stride_),
      across_(cells(window.x0, window.x1, stride_)) {
  pixels_.resize(static_cast<std::size_t>(across_) * static_cast<std::size_t>(cells(window.y0, window.y1, stride_)));
}

LookUpBias::Evidence LookUpBias::evidence(const Film& film, int map, const PassHalves& halves) const {
  const std::array<double, 2>& samples = halves.samples;
  Evidence sum;
  if (samples[0] == 0 || samples[1] == 0) return sum;
  std::size_t values = 0;
  const double all = halves.all_samples();
  for (int y = window_.y0; y < window_.y1; ++y)
    for (int x = window_.x0; x < window_.x1; ++x) {
      if (!looks_twice(x, y)) continue;
      const Pixel& pixel = pixels_[index(x, y)];
      RgbD half[2];
      for (std::size_t h = 0; h < 2; ++h) {
        const RgbD total = map < 0 ? pixel.sum[0][h] + pixel.sum[1][h] : pixel.sum[static_cast<std::size_t>(map)][h];
        half[h] = total / samples[h];
      }
      const RgbD scale = inverse_scale(film.mean(x, y));
      const RgbD apart = half[0] - half[1];
      sum.difference += dot3(half[0] * half[1], scale);
      sum.variance += dot3(apart * apart, scale) * samples[0] * samples[1] / (all * all);
      values += 3;
    }
  if (values > 0) {
    sum.difference /= static_cast<double>(values);
    sum.variance /= static_cast<double>(values);
  }
  return sum;
}

void RadiusHistory::add_pass(double pass_samples, double photons) {
  const double square = static_cast<double>(radius) * static_cast<double>(radius);
  const double squared_over_photons = pass_samples * pass_samples / photons;
  samples += pass_samples;
  samples_times_square += pass_samples * square;
  squared_samples_over_photons += squared_over_photons;
  squared_samples_over_photons_r_2 += squared_over_photons / square;
}

double RadiusHistory::best(const LookUpBias::Evidence& evidence, double all_samples) const {
  const double c = evidence.variance * samples * samples / squared_samples_over_photons_r_2;
  // Of less than this, noise would decide.
  const double difference = std::max(evidence.difference, 0.02 * evidence.variance);
  const double mean_square = samples_times_square / samples;
  const double photons = worth() * all_samples / samples;
  const double shape = photons * difference / (mean_square * mean_square);
  return c > 0 && shape > 0 ? std::pow(c / (8 * shape), 1.0 / 6) : static_cast<double>(radius);
}

}  // namespace photonproof
