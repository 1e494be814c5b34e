#include "reference/optics/point_sets.h"

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

namespace photonproof::inline reference_optics {
namespace {

/// A permutation of 0..n-1. The engine's output is specified by the C++ standard, std::shuffle's use of it is not.
std::vector<int> permutation(int n, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

}  // namespace

std::vector<Vec2<double>> square_points(int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<int> order = permutation(n, random);
  const auto shift = [&](int i) { return (order[static_cast<std::size_t>(i)] + 0.5) / n; };
  std::vector<Vec2<double>> points;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) points.push_back({(i + 1 - shift(j)) / n, (j + shift(i)) / n});
  return points;
}

std::vector<Vec3d> sphere_points(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double turn = 2 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double r = std::sqrt(1 - z * z);
    const double phi = turn + golden_angle * i;
    points.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return points;
}

}  // namespace photonproof::inline reference_optics
