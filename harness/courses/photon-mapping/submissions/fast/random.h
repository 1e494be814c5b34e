// Random numbers: every photon and every pixel has a sequence of its own, so that threads change nothing.
#pragma once

#include <cstdint>

#include "vec.h"

void seed_random(unsigned long long seed);
uint64_t random_seed();

inline uint64_t stirred(uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

class Random {
 public:
  Random(uint64_t stream, uint64_t index) : state_(stirred(stirred(random_seed() + stream) + index)) {}
  double operator()() {
    state_ += 0x9e3779b97f4a7c15ull;
    return static_cast<double>(stirred(state_) >> 11) * 0x1p-53;
  }

 private:
  uint64_t state_;
};

/// Two directions at right angles to a normal and to each other.
inline void frame(Vec3 n, Vec3* s, Vec3* t) {
  Vec3 helper = std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  *s = normalized(cross(n, helper));
  *t = cross(n, *s);
}

inline Vec3 cosine_direction(Vec3 n, Vec3 s, Vec3 t, double u, double v) {
  double r = std::sqrt(u), phi = 2 * PI * v;
  return s * (r * std::cos(phi)) + t * (r * std::sin(phi)) + n * std::sqrt(1 - u);
}
