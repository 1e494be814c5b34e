#include "reference/optics/coat.h"

#include <cmath>
#include <utility>

namespace photonproof::inline reference_optics {
namespace {

/// Midpoint-rule steps over the cosine. The integrands are smooth except for a square root at grazing.
constexpr int steps = 4096;

RgbD exp_of(const RgbD& x) { return {std::exp(x.x), std::exp(x.y), std::exp(x.z)}; }

/// The share of a diffuse base's light that its coat's surface reflects back, with absorption on both ways.
RgbD returned(double index, const RgbD& depth) {
  RgbD sum(0.0);
  for (int i = 0; i < steps; ++i) {
    const double inside = (i + 0.5) / steps, sine2 = (1 - inside * inside) * index * index;
    const double reflected = sine2 >= 1 ? 1 : fresnel_reflectance(std::sqrt(1 - sine2), index);
    sum += exp_of(depth * (-2 / inside)) * (2 * inside * reflected / steps);
  }
  return sum;
}

using Row = std::array<double, coat_powers + 2>;

/// Gauss's elimination with pivoting; the right side is the last column.
std::array<double, coat_powers + 1> solve(std::array<Row, coat_powers + 1> rows) {
  constexpr std::size_t n = coat_powers + 1;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t best = k;
    for (std::size_t i = k + 1; i < n; ++i)
      if (std::abs(rows[i][k]) > std::abs(rows[best][k])) best = i;
    std::swap(rows[k], rows[best]);
    for (std::size_t i = 0; i < n; ++i) {
      if (i == k) continue;
      const double by = rows[i][k] / rows[k][k];
      for (std::size_t j = k; j <= n; ++j) rows[i][j] -= by * rows[k][j];
    }
  }
  std::array<double, n> x{};
  for (std::size_t k = 0; k < n; ++k) x[k] = rows[k][n] / rows[k][k];
  return x;
}

/// Least squares of the sum of c_k cos^k with the weight 2 cos, under the condition that the mean is kept: normal
/// equations with a multiplier. The integral of 2 cos cos^m is 2 / (m + 2).
std::array<double, coat_powers> fit(const std::array<double, coat_powers>& moments, double mean) {
  std::array<Row, coat_powers + 1> rows{};
  for (std::size_t k = 0; k < coat_powers; ++k) {
    for (std::size_t j = 0; j < coat_powers; ++j) rows[k][j] = 2.0 / static_cast<double>(k + j + 4);
    rows[k][coat_powers] = rows[coat_powers][k] = 2.0 / static_cast<double>(k + 3);
    rows[k][coat_powers + 1] = moments[k];
  }
  rows[coat_powers][coat_powers + 1] = mean;
  const auto x = solve(rows);
  std::array<double, coat_powers> c{};
  for (std::size_t k = 0; k < coat_powers; ++k) c[k] = x[k];
  return c;
}

Coat coat_with(double index, const RgbD& depth, const RgbD& specular, const RgbD& diffuse, const RgbD& coming_back) {
  Coat coat;
  coat.index = index;
  coat.depth = depth;
  coat.specular = specular;
  coat.base = diffuse / ((RgbD(1.0) - coming_back) * (index * index));
  return coat;
}

}  // namespace

double fresnel_reflectance(double cosine, const std::complex<double>& index) {
  const std::complex<double> inside = std::sqrt(index * index - (1 - cosine * cosine));
  const std::complex<double> across = (cosine - inside) / (cosine + inside);
  const std::complex<double> along = (index * index * cosine - inside) / (index * index * cosine + inside);
  return (std::norm(across) + std::norm(along)) / 2;
}

RgbD Coat::crossing(double cosine) const {
  const double inside = std::sqrt(1 - (1 - cosine * cosine) / (index * index));
  return exp_of(depth * (-1 / inside)) * (1 - fresnel_reflectance(cosine, index));
}

RgbD Coat::mean_crossing() const {
  RgbD sum(0.0);
  for (int i = 0; i < steps; ++i) {
    const double cosine = (i + 0.5) / steps;
    sum += crossing(cosine) * (2 * cosine / steps);
  }
  return sum;
}

Coat coat_of(const PlasticDescription& plastic, const RgbD& diffuse, const RgbD& specular) {
  const double index = plastic.int_ior / plastic.ext_ior;
  const RgbD inside = returned(index, RgbD(0.0));
  return coat_with(index, RgbD(0.0), specular, diffuse, plastic.nonlinear ? inside * diffuse : inside);
}

Coat coat_of(const LayeredDescription& lacquer, const RgbD& diffuse, const RgbD& specular) {
  const double index = lacquer.int_ior / lacquer.ext_ior;
  const RgbD depth = lacquer.sigma_a * lacquer.thickness;
  return coat_with(index, depth, specular, diffuse, returned(index, depth) * diffuse);
}

std::array<RgbD, coat_powers> crossing_by_powers(const Coat& coat) {
  std::array<RgbD, coat_powers> moments{};
  for (int i = 0; i < steps; ++i) {
    const double cosine = (i + 0.5) / steps;
    RgbD part = coat.crossing(cosine) * (2 * cosine / steps);
    for (RgbD& moment : moments) moment += (part = part * cosine);
  }
  const RgbD mean = coat.mean_crossing();
  std::array<RgbD, coat_powers> result{};
  const auto channel = [&](double RgbD::*c) {
    std::array<double, coat_powers> of{};
    for (std::size_t k = 0; k < coat_powers; ++k) of[k] = moments[k].*c;
    const auto found = fit(of, mean.*c);
    for (std::size_t k = 0; k < coat_powers; ++k) result[k].*c = found[k];
  };
  for (double RgbD::*c : {&RgbD::x, &RgbD::y, &RgbD::z}) channel(c);
  return result;
}

}  // namespace photonproof::inline reference_optics
