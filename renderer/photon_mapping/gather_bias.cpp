#include "renderer/photon_mapping/gather_bias.h"

#include <algorithm>
#include <cmath>

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr int most_pixels = 16384;

int stride_for(const Tile& window) {
  const double pixels = static_cast<double>(window.width()) * window.height();
  return std::max(1, static_cast<int>(std::sqrt(pixels / most_pixels)));
}

int cells(int begin, int end, int stride) { return (end - 1) / stride - begin / stride + 1; }

double dot3(const RgbD& a, const RgbD& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

}  // namespace

double GatherBias::Evidence::balance(double exponent) const {
  constexpr double smooth = 16.0 / 9, edge = 4.3;  // squared bias over D^2
  const double part = (smooth_exponent - exponent) / (smooth_exponent - edge_exponent);
  const double squared = smooth * std::pow(edge / smooth, part) * difference;
  return variance / 3 / (exponent / 2 * squared);
}

double GatherBias::Evidence::step(double exponent) const { return std::pow(balance(exponent), 1 / (exponent + 2)); }

GatherBias::GatherBias(const Tile& window)
    : window_(window),
      stride_(stride_for(window)),
      first_x_(window.x0 / stride_),
      first_y_(window.y0 / stride_),
      across_(cells(window.x0, window.x1, stride_)),
      down_(cells(window.y0, window.y1, stride_)),
      blocks_across_((across_ + block - 1) / block),
      blocks_down_((down_ + block - 1) / block),
      pixels_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(down_)),
      narrowings_(block_index(0, 0, maps), 1.0f) {}

/// Sums over the channels of one pixel.
GatherBias::Evidence GatherBias::of_pixel(const Film& film, int x, int y, int map, const PassHalves& halves) const {
  const Pixel& pixel = pixels_[index(x, y)];
  RgbD half[2];
  for (std::size_t h = 0; h < 2; ++h) {
    const RgbD total = map < 0 ? pixel.sum[0][h] + pixel.sum[1][h] : pixel.sum[static_cast<std::size_t>(map)][h];
    half[h] = total / halves.samples[h];
  }
  const RgbD scale = Film::relative_scale(film.mean(x, y));
  const RgbD apart = half[0] - half[1];
  const double all = halves.all_samples();
  return {dot3(half[0] * half[1], scale),
          dot3(apart * apart, scale) * halves.samples[0] * halves.samples[1] / (all * all)};
}

GatherBias::Evidence GatherBias::evidence(const Film& film, int map, const PassHalves& halves) const {
  Evidence sum;
  if (halves.passes[1] == 0) return sum;
  std::size_t values = 0;
  for (int y = window_.y0; y < window_.y1; ++y)
    for (int x = window_.x0; x < window_.x1; ++x) {
      if (!looks_twice(x, y)) continue;
      const Evidence one = of_pixel(film, x, y, map, halves);
      sum.difference += one.difference;
      sum.variance += one.variance;
      values += 3;
    }
  if (values > 0) {
    sum.difference /= static_cast<double>(values);
    sum.variance /= static_cast<double>(values);
  }
  return sum;
}

void GatherBias::narrow(const Film& film, const PassHalves& halves) {
  // The product of the halves' means deviates by twice the variance over the root of the number of disjoint discs.
  constexpr double doubt = 1, most_shrinking = 0.85, most_growing = 1.1, narrowest = 1.0 / 16;
  if (halves.passes[1] < 2) return;
  std::vector<Evidence> sums(narrowings_.size());
  for (int y = window_.y0; y < window_.y1; ++y)
    for (int x = window_.x0; x < window_.x1; ++x) {
      if (!looks_twice(x, y)) continue;
      for (int map = 0; map < maps; ++map) {
        const Evidence one = of_pixel(film, x, y, map, halves);
        Evidence& sum = sums[block_index((x / stride_ - first_x_) / block, (y / stride_ - first_y_) / block, map)];
        sum.difference += one.difference;
        sum.variance += one.variance;
      }
    }
  const std::size_t blocks_a_map = sums.size() / maps;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Evidence plain{sums[i].difference - doubt * sums[i].variance, sums[i].variance};
    const double p = exponents_[i / blocks_a_map], least = std::pow(most_shrinking, (smooth_exponent + 2) / (p + 2));
    const double step = plain.difference > 0 ? plain.step(p) : most_growing;
    const double next = static_cast<double>(narrowings_[i]) * std::clamp(step, least, most_growing);
    narrowings_[i] = static_cast<float>(std::clamp(next, narrowest, 1.0));
  }
}

float GatherBias::narrowing(int x, int y, int map) const {
  // Position between the middles of the blocks, in blocks.
  const auto place = [&](int at, int first, int blocks) {
    const float size = static_cast<float>(stride_ * block);
    const float where = (static_cast<float>(at - first * stride_) + 0.5f) / size - 0.5f;
    return std::clamp(where, 0.0f, static_cast<float>(blocks - 1));
  };
  const float u = place(x, first_x_, blocks_across_), v = place(y, first_y_, blocks_down_);
  const int i = static_cast<int>(u), j = static_cast<int>(v);
  const int i1 = std::min(i + 1, blocks_across_ - 1), j1 = std::min(j + 1, blocks_down_ - 1);
  const float s = u - static_cast<float>(i), t = v - static_cast<float>(j);
  const auto at = [&](int across, int down) { return narrowings_[block_index(across, down, map)]; };
  return (1 - t) * ((1 - s) * at(i, j) + s * at(i1, j)) + t * ((1 - s) * at(i, j1) + s * at(i1, j1));
}

void RadiusHistory::add_pass(double pass_samples, double photons) {
  const double r_2 = square(static_cast<double>(radius));
  const double squared_over_photons = pass_samples * pass_samples / photons;
  samples += pass_samples;
  samples_times_square += pass_samples * r_2;
  squared_samples_over_photons += squared_over_photons;
  squared_samples_over_photons_r_2 += squared_over_photons / r_2;
}

double RadiusHistory::best(const GatherBias::Evidence& evidence, double all_samples, double exponent) const {
  // Assumes that all passes had the root-mean-square radius. The bound on the difference keeps noise from deciding.
  const double mean_square = samples_times_square / samples;
  const double variance = evidence.variance * squared_samples_over_photons /
                          (mean_square * squared_samples_over_photons_r_2) * samples / all_samples;
  const GatherBias::Evidence likely{std::max(evidence.difference, 0.01 * evidence.variance), variance};
  return variance > 0 ? std::sqrt(mean_square) * likely.step(exponent) : static_cast<double>(radius);
}

}  // namespace photonproof::inline renderer_photon_mapping
