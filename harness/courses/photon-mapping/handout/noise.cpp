#include "noise.h"

#include <cmath>
#include <cstdint>
#include <vector>

// The slope at a corner of the lattice, from the corner's own random number, times the way from it.
static double corner(int64_t x, int64_t y, unsigned seed, double dx, double dy) {
  uint64_t h =
      static_cast<uint32_t>(x) * 0x9e3779b97f4a7c15ull + static_cast<uint32_t>(y) * 0xc2b2ae3d27d4eb4full + seed;
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ull;
  h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ull;
  const std::vector<double> slope_x{1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0, 1, 0, -1, 0};
  const std::vector<double> slope_y{1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1};
  unsigned which = (h >> 32) & 15;
  return slope_x[which] * dx + slope_y[which] * dy;
}

static double smooth(double t) { return 6 * std::pow(t, 5) - 15 * std::pow(t, 4) + 10 * std::pow(t, 3); }

double noise(double x, double y, unsigned seed) {
  double left = std::floor(x), low = std::floor(y);
  double fx = x - left, fy = y - low;
  int64_t ix = static_cast<int64_t>(left), iy = static_cast<int64_t>(low);
  double a = corner(ix, iy, seed, fx, fy), b = corner(ix + 1, iy, seed, fx - 1, fy);
  double c = corner(ix, iy + 1, seed, fx, fy - 1), d = corner(ix + 1, iy + 1, seed, fx - 1, fy - 1);
  double u = smooth(fx), v = smooth(fy);
  return (a * (1 - u) + b * u) * (1 - v) + (c * (1 - u) + d * u) * v;
}
