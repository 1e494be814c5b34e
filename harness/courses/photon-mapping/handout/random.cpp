#include "random.h"

static unsigned long long state = 1;

// Mixes 64 bits well (Steele, Lea and Flood 2014).
static unsigned long long stirred(unsigned long long z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
  return z ^ (z >> 31);
}

// Stirred, or the sequences of neighbouring seeds would be the same ones, a step apart.
void seed_random(unsigned long long seed) { state = stirred(seed + 0x6a09e667f3bcc909ull); }

double random_unit() {
  state += 0x9e3779b97f4a7c15ull;
  return static_cast<double>(stirred(state) >> 11) * (1.0 / 9007199254740992.0);
}

Vec3 cosine_direction(Vec3 normal, double u, double v) {
  // Angles from the normal and around it, as in the lecture.
  double theta = std::acos(std::sqrt(1 - u)), phi = 2 * PI * v;
  Vec3 helper = std::fabs(normal.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  Vec3 s = normalized(cross(normal, helper)), t = cross(normal, s);
  return normalized(s * (std::sin(theta) * std::cos(phi)) + t * (std::sin(theta) * std::sin(phi)) +
                    normal * std::cos(theta));
}
