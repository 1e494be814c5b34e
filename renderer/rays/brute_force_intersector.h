// Rays against all primitives of a small scene, one after the other, a pack of rays at a time. No acceleration
// structure is faster below a few dozen primitives; planner.h has the threshold and its measurement. Plates are tested
// without a division: with t = num / den everything is compared after multiplying by |den|.
#pragma once

#include <limits>

#include "renderer/rays/ray_scene.h"
#include "renderer/rays/surface_hit.h"

namespace photonproof::inline renderer_rays {

/// Edges are widened by this part of their length, so that no ray slips between two plates that share one.
inline constexpr float plate_margin = 0x1p-21f;

template <class F>
struct PlateCrossing {
  F distance, speed;  ///< t = distance / speed, speed >= 0
  Mask<F> inside;     ///< ahead, and within the plate's edges
};

template <bool is_triangle, class F>
PlateCrossing<F> cross_plate(const Plate& plate, const Vec3<F>& origin, const Vec3<F>& direction) {
  const auto apply = [](const Vec3f& row, const Vec3<F>& v) {
    return mul_add(F(row.z), v.z, mul_add(F(row.y), v.y, F(row.x) * v.x));
  };
  const F toward = apply(plate.normal, direction);
  const F speed = lane_abs(toward);
  const F distance = lane_copysign(F(1.0f), toward) * (plate.k - apply(plate.normal, origin));
  const F u = mul_add(F(apply(plate.edge_u, origin) + plate.u0), speed, apply(plate.edge_u, direction) * distance);
  const F v = mul_add(F(apply(plate.edge_v, origin) + plate.v0), speed, apply(plate.edge_v, direction) * distance);
  const F low = -plate_margin * speed;
  const F high = speed - low;
  // A ray that starts on the plane meets it where it goes from front to back. Its origin is there by rounding, on the
  // edge of a neighbour, and it must not get out.
  const F least = lane_copysign(F(std::numeric_limits<float>::min()), toward);
  const Mask<F> inside = distance > least && u >= low && v >= low;
  if constexpr (is_triangle)
    return {distance, speed, inside && u + v <= high};
  else
    return {distance, speed, inside && u <= high && v <= high};
}

/// The parameters where |origin + t direction - center| = radius, nearest first; `meets` where they exist. Robust for
/// distant balls: the discriminant comes from the vector to the nearest point (Haines et al. 2019).
template <class F>
struct BallCrossing {
  F middle, half;
  Mask<F> meets;
};
template <class F>
BallCrossing<F> cross_ball(const Ball& ball, const Vec3<F>& origin, const Vec3<F>& direction,
                           const F& inverse_length2) {
  const Vec3<F> to_center = broadcast<F>(ball.center) - origin;
  const F middle = dot(to_center, direction) * inverse_length2;
  const Vec3<F> nearest = advance(to_center, F(-middle), direction);
  const F discriminant = (ball.radius * ball.radius - dot(nearest, nearest)) * inverse_length2;
  return {middle, lane_sqrt(lane_max(discriminant, F(0.0f))), discriminant > 0};
}

/// Closest hits of rays with unit directions. `from` is the primitive that a ray leaves. The ray meets it again only
/// where that is a sphere it crosses.
template <class F>
SurfaceHit<F> closest_small(const BruteForceView& scene, const Vec3<F>& origin, const Vec3<F>& direction,
                            const UInt<F>& from) {
  using U = UInt<F>;
  F best_distance(std::numeric_limits<float>::infinity());
  F best_speed(1.0f);
  U best(no_index);
  const auto keep_plate = [&](const PlateCrossing<F>& c, std::uint32_t id) {
    const Mask<F> closer = c.inside && c.distance * best_speed < best_distance * c.speed && !equal<F>(from, U(id));
    best_distance = select(closer, c.distance, best_distance);
    best_speed = select(closer, c.speed, best_speed);
    best = select(closer, U(id), best);
  };
  std::uint32_t id = 0;
  for (; id < scene.parallelograms; ++id) keep_plate(cross_plate<false>(scene.plates[id], origin, direction), id);
  for (; id < scene.parallelograms + scene.triangles; ++id)
    keep_plate(cross_plate<true>(scene.plates[id], origin, direction), id);
  for (std::uint32_t s = 0; s < scene.spheres; ++s, ++id) {
    const BallCrossing<F> c = cross_ball(scene.balls[s], origin, direction, F(1.0f));
    const F enter = c.middle - c.half;
    const F elsewhere = select(enter > 0, enter, c.middle + c.half);
    const F t = select(equal<F>(from, U(id)), 2 * c.middle, elsewhere);
    const Mask<F> closer = c.meets && t > 0 && t * best_speed < best_distance;
    best_distance = select(closer, t, best_distance);
    best_speed = select(closer, F(1.0f), best_speed);
    best = select(closer, U(id), best);
  }

  SurfaceHit<F> hit;
  hit.valid = !equal<F>(best, U(no_index));
  hit.primitive = select(hit.valid, best, U(0u));
  hit.surface = gather(scene.surface, hit.primitive);
  const Vec3<F> p = advance(origin, F(best_distance / best_speed), direction);
  hit.p = p;
  hit.normal = -direction;
  const std::uint32_t plates = scene.parallelograms + scene.triangles;
  const Mask<F> on_ball = hit.valid && as_mask<F>(hit.primitive >= U(plates));
  if (plates > 0) {
    const U plate = select(on_ball, U(0u), hit.primitive) * Plate::stride;
    const float* base = &scene.plates->normal.x;
    hit.normal = {gather(base, plate), gather(base + 1, plate), gather(base + 2, plate)};
    hit.p = advance(p, F(gather(base + 3, plate) - dot(hit.normal, p)), hit.normal);
  }
  if (any(on_ball)) {
    const Ball* balls = scene.balls;
    const U ball = select(on_ball, hit.primitive - U(plates), U(0u)) * Ball::stride;
    const float* base = &balls->center.x;
    const Vec3<F> center{gather(base, ball), gather(base + 1, ball), gather(base + 2, ball)};
    const Vec3<F> outward = normalize(p - center);
    hit.p = select(on_ball, advance(center, gather(base + 3, ball), outward), hit.p);
    hit.normal = select(on_ball, outward * gather(base + 4, ball), hit.normal);
  }
  return hit;
}

/// Whether a primitive lies on the open segment from `origin` to origin + segment. `from` as above. `target` is a
/// primitive that the segment ends on, seen from its front; it occludes only where that is the far side of a sphere.
template <class F>
Mask<F> occluded_small(const BruteForceView& scene, const Vec3<F>& origin, const Vec3<F>& segment, const UInt<F>& from,
                       const UInt<F>& target) {
  using U = UInt<F>;
  Mask<F> blocked = as_mask<F>(false);
  const auto block_by_plate = [&](const PlateCrossing<F>& c, std::uint32_t id) {
    blocked = blocked ||
              (c.inside && c.distance < segment_end * c.speed && !equal<F>(from, U(id)) && !equal<F>(target, U(id)));
  };
  std::uint32_t id = 0;
  for (; id < scene.parallelograms; ++id) block_by_plate(cross_plate<false>(scene.plates[id], origin, segment), id);
  for (; id < scene.parallelograms + scene.triangles; ++id)
    block_by_plate(cross_plate<true>(scene.plates[id], origin, segment), id);
  if (scene.spheres == 0) return blocked;
  const F inverse_length2 = 1 / dot(segment, segment);
  for (std::uint32_t s = 0; s < scene.spheres; ++s, ++id) {
    const BallCrossing<F> c = cross_ball(scene.balls[s], origin, segment, inverse_length2);
    const F enter = c.middle - c.half;
    const F elsewhere = select(enter > 0, enter, c.middle + c.half);
    const F t = select(equal<F>(from, U(id)), 2 * c.middle, elsewhere);
    // The segment passes a target on the way from outside to where it emits inward.
    const Mask<F> is_target = equal<F>(target, U(id));
    const Mask<F> passed = enter > 1 - segment_end && c.middle < segment_end && !equal<F>(from, U(id));
    const Mask<F> between = t > 0 && t < segment_end;
    blocked = blocked || (c.meets && ((is_target && passed) || (!is_target && between)));
  }
  return blocked;
}

}  // namespace photonproof::inline renderer_rays
