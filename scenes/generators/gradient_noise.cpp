#include "scenes/generators/gradient_noise.h"

#include <array>
#include <cmath>

namespace photonproof::inline scenes_generators {
namespace {

/// 6 t^5 - 15 t^4 + 10 t^3: zero slope and curvature at both ends.
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double mix(double a, double b, double t) { return a + t * (b - a); }

/// The directions to the twelve edges of a cube, four of them twice to make a power of two.
constexpr std::array<std::array<double, 3>, 16> kGradients{{{1, 1, 0},
                                                            {-1, 1, 0},
                                                            {1, -1, 0},
                                                            {-1, -1, 0},
                                                            {1, 0, 1},
                                                            {-1, 0, 1},
                                                            {1, 0, -1},
                                                            {-1, 0, -1},
                                                            {0, 1, 1},
                                                            {0, -1, 1},
                                                            {0, 1, -1},
                                                            {0, -1, -1},
                                                            {1, 1, 0},
                                                            {0, -1, 1},
                                                            {-1, 1, 0},
                                                            {0, -1, -1}}};

double slope(std::uint32_t hash, double x, double y, double z) {
  const auto& g = kGradients[hash & 15];
  return g[0] * x + g[1] * y + g[2] * z;
}

/// Point of an octave, shifted: lattices that coincide would all be 0 in the same places.
Vec3d shifted(const Vec3d& p, int octave) {
  const double scale = std::ldexp(1.0, octave);
  return p * scale + Vec3d{0.31, 0.57, 0.73} * static_cast<double>(octave);
}

}  // namespace

std::uint32_t hash_of(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  std::uint64_t state = a * 0x9e3779b97f4a7c15u + b * 0xc2b2ae3d27d4eb4fu + c * 0x165667b19e3779f9u + d;
  state = (state ^ (state >> 32)) * 0xd6e8feb86659fd93u;
  state = (state ^ (state >> 32)) * 0xd6e8feb86659fd93u;
  return static_cast<std::uint32_t>(state >> 32);
}

double unit_hash(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return hash_of(a, b, c, d) * 0x1p-32;
}

double gradient_noise(const Vec3d& p, std::uint32_t seed) {
  const Vec3d cell{std::floor(p.x), std::floor(p.y), std::floor(p.z)};
  const Vec3d f = p - cell;
  const auto lattice = [](double v) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(v)); };
  const std::uint32_t ix = lattice(cell.x), iy = lattice(cell.y), iz = lattice(cell.z);
  std::array<double, 8> corner{};
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
    corner[i] = slope(hash_of(ix + dx, iy + dy, iz + dz, seed), f.x - dx, f.y - dy, f.z - dz);
  }
  const double u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const double low = mix(mix(corner[0], corner[1], u), mix(corner[2], corner[3], u), v);
  const double high = mix(mix(corner[4], corner[5], u), mix(corner[6], corner[7], u), v);
  return mix(low, high, w);
}

double fractal_noise(const Vec3d& p, int octaves, std::uint32_t seed) {
  double sum = 0, amplitude = 1;
  for (int i = 0; i < octaves; ++i, amplitude /= 2)
    sum += amplitude * gradient_noise(shifted(p, i), seed + static_cast<std::uint32_t>(i));
  return sum;
}

double ridged_noise(const Vec3d& p, int octaves, std::uint32_t seed) {
  double sum = 0, amplitude = 1, weight = 1;
  for (int i = 0; i < octaves; ++i, amplitude /= 2) {
    const double ridge = 1 - std::abs(gradient_noise(shifted(p, i), seed + static_cast<std::uint32_t>(i)));
    weight *= ridge * ridge;
    sum += amplitude * weight;
  }
  return sum;
}

}  // namespace photonproof::inline scenes_generators
