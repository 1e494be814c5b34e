// Random solids for tests: nested, touching, overlapping, mirrored and sheared ones, and flat shapes that cut them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "renderer/areas/footprint.h"
#include "renderer/lanes/test_random.h"

namespace photonproof::test {

inline Vec3d random_place(Random& random, double reach) {
  return Vec3d(2 * random.next() - 1, 2 * random.next() - 1, 2 * random.next() - 1) * reach;
}

inline Solid random_solid(Random& random) {
  const Vec3d middle = random_place(random, 4);
  const double size = 0.05 + double{random.next()} * double{random.next()};
  if (random.next() < 0.4f) return {middle, {}, size};
  // Edges along any directions, with lengths from slabs to rods; half of them are left-handed.
  std::array<Vec3d, 3> half;
  for (Vec3d& edge : half) edge = random_place(random, size * (random.next() < 0.2f ? 3 : 1));
  return {middle, half, 0};
}

/// Each third solid is a copy of an earlier one: smaller inside it, beside it, or mirrored.
inline std::vector<Solid> random_solids(Random& random, std::size_t count) {
  std::vector<Solid> solids;
  while (solids.size() < count) {
    if (solids.empty() || random.next() > 0.33f) {
      solids.push_back(random_solid(random));
      continue;
    }
    Solid copy = solids[static_cast<std::size_t>(random.next() * static_cast<float>(solids.size()))];
    const float kind = random.next();
    if (kind < 0.33f) {
      copy.radius *= 0.5;
      for (Vec3d& edge : copy.half_edges) edge = edge * 0.5;
    } else if (kind < 0.66f) {
      copy.middle += copy.radius > 0 ? Vec3d(2 * copy.radius, 0, 0) : copy.half_edges[0] * 2;
    } else {
      copy.middle.x = -copy.middle.x;
      for (Vec3d& edge : copy.half_edges) edge.x = -edge.x;
    }
    solids.push_back(copy);
  }
  return solids;
}

/// A parallelogram at random, or through a solid's middle, or under a ball.
inline Quad random_quad(Random& random, const std::vector<Solid>& solids) {
  const Solid& solid = solids[static_cast<std::size_t>(random.next() * static_cast<float>(solids.size()))];
  Vec3d u = random_place(random, 3), v = random_place(random, 3);
  if (random.next() < 0.4f) u.y = v.y = 0;
  const Vec3d at = solid.middle - Vec3d(0, random.next() < 0.5f ? solid.radius * 0.999 : 0, 0);
  const Vec3f corner(at - u * double{random.next()} - v * double{random.next()});
  const Vec3d across = cross(Vec3d(Vec3f(u)), Vec3d(Vec3f(v)));
  return {corner, Vec3f(u), Vec3f(v), Vec3f(normalize(across)), static_cast<float>(length(across))};
}

}  // namespace photonproof::test
