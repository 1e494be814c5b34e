// The geometry that rays meet, as the kernels see it: a few primitives in one list, or a tracer with all of them.
#pragma once

#include <cstdint>

#include "renderer/core/ray.h"

namespace photonproof::inline renderer_rays {

class Tracer;

/// A flat primitive on the plane n.x = k, with n unit, on the side that counts as front. A point x of it has
/// u = edge_u . x + u0 and v likewise, which run from 0 to 1 along the edges.
struct Plate {
  Vec3f normal;
  float k = 0;
  Vec3f edge_u;
  float u0 = 0;
  Vec3f edge_v;
  float v0 = 0;
  static constexpr std::uint32_t stride = 12;
};

struct Ball {
  Vec3f center;
  float radius = 0;
  float side = 1;  ///< 1: the normal points outward, -1: to the centre
  static constexpr std::uint32_t stride = 5;
};

/// Primitives in one list: parallelograms, then triangles, then spheres; `surface` maps them to surfaces.
struct BruteForceView {
  const Plate* plates = nullptr;
  const Ball* balls = nullptr;
  const std::uint32_t* surface = nullptr;
  std::uint32_t parallelograms = 0, triangles = 0, spheres = 0;
};

struct RayScene {
  bool small = false;  ///< `primitives` holds everything, `tracer` is not needed
  BruteForceView primitives;
  const Tracer* tracer = nullptr;
};

}  // namespace photonproof::inline renderer_rays
