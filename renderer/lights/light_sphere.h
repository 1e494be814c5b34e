// Lambertian emission from a sphere, outward or inward. From outside, the visible cap is sampled uniformly by solid
// angle, however close it is (Shirley, Wang, Zimmerman 1996). On a sphere that emits inward, points are sampled
// uniformly by area. From within, every other sample is uniform by solid angle instead, so that the nearby wall gets
// its share.
//
// With d the distance of p from the centre, all quantities near the surface follow from the power of p. It is d^2 - R^2
// = |p|^2 - 2 p . center + (|center|^2 - R^2). The visible scene is near the origin. For a sphere that is huge relative
// to its distance from the origin, `offset` gives the last term, as centre and radius leave no digits of it.
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_near.h"
#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

template <class F>
struct SphereLight {
  static constexpr bool is_delta = false, is_infinite = false;
  Vec3<F> center;
  F radius;
  F side;                    ///< 1: emits outward, -1: inward
  Vec3<F> radiance;          ///< W m^-2 sr^-1
  F offset{told_by_corner};  ///< the term (|center|^2 - R^2) / 2R, where centre and radius lack digits

  LightSample<F> sample(const Vec3<F>& p, const Vec2<F>& u) const {
    const Mask<F> cone = samples_cone(p);
    LightSample<F> s = all(cone) ? sample_cone(p, u) : sample_inward(p, u);
    if (any(cone) && !all(cone)) s = select(cone, sample_cone(p, u), s);
    return s;
  }
  F pdf(const Vec3<F>& p, const LightPoint<F>& at) const {
    const Mask<F> cone = samples_cone(p);
    const F by_cone = 1 / (2 * pi * cone_one_minus_cos(p));
    if (all(cone)) return by_cone;
    const F by_area = area_to_solid_angle(F(1 / area()), p, at);
    return select(cone, by_cone, select(is_within(p), 0.5f * by_area + 1 / (8 * pi), by_area));
  }
  Emission<F> emit(const Vec2<F>& u_position, const Vec2<F>& u_direction) const {
    const Vec3<F> outward = square_to_sphere(u_position);
    const Vec3<F> normal = outward * side;
    return {{advance(center, radius, outward), normal},
            Frame<F>(normal).to_world(square_to_cosine_hemisphere(u_direction)),
            flux()};
  }
  EmissionPdfs<F> emit_pdfs(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return {1 / area(), cosine_hemisphere_pdf(F(dot(at.normal, direction)))};
  }
  Vec3<F> flux_towards(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return flux() * cosine_hemisphere_pdf(F(dot(at.normal, direction)));
  }
  Vec3<F> leaving(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return select(dot(at.normal, direction) > 0, radiance, Vec3<F>(F(0.0f)));
  }
  Vec3<F> flux() const { return radiance * (pi * area()); }
  LightBounds bounds() const { return round_bounds(center - Vec3f(radius), center + Vec3f(radius)); }
  /// Height of p above the surface, on the emitting side.
  F height(const Vec3<F>& p) const {
    const F s = power(p);
    return side * s / (radius + lane_sqrt(lane_max(F(radius * radius + s), F(0.0f))));
  }

 private:
  F area() const { return 4 * pi * radius * radius; }
  Mask<F> is_told_by_offset() const { return offset < told_by_corner; }
  F power(const Vec3<F>& p) const {
    const Vec3<F> d = p - center;
    return select(is_told_by_offset(), F(dot(p, p) + 2 * (radius * offset - dot(p, center))),
                  F(dot(d, d) - radius * radius));
  }
  /// Scale of the rounding error in the power of p.
  F grain(const Vec3<F>& p) const {
    const F from_origin = length(p);
    return select(is_told_by_offset(), F(from_origin * lane_max(from_origin, radius)), F(radius * radius));
  }
  /// Excludes the surface itself, which sees nothing of its outer side: a point on it is off by about two roundings.
  Mask<F> samples_cone(const Vec3<F>& p) const { return side > 0 && power(p) > 5e-7f * grain(p); }
  /// Excludes the wall itself, where even area sampling is optimal since it is cosine-weighted. Rays that leave the
  /// wall start slightly off it, and need the same weights as the wall.
  Mask<F> is_within(const Vec3<F>& p) const { return side < 0 && power(p) < -4e-6f * grain(p); }
  F cone_one_minus_cos(const Vec3<F>& p) const {
    const Vec3<F> d = p - center;
    const F distance2 = dot(d, d), sin2 = lane_min(F(radius * radius / distance2), F(1.0f));
    return sin2 / (1 + lane_sqrt(F(lane_max(power(p), F(0.0f)) / distance2)));
  }
  LightSample<F> sample_cone(const Vec3<F>& p, const Vec2<F>& u) const {
    const Vec3<F> to_center = center - p;
    const F distance = length(to_center);
    const F one_minus_cos = cone_one_minus_cos(p);
    const Vec3<F> local = square_to_cone(u, one_minus_cos);
    const Frame<F> frame(to_center * (1 / distance));
    // The normal in that frame: differences of world coordinates leave no digits for a distant sphere.
    const F drop2 = distance * distance * (local.x * local.x + local.y * local.y);
    const F t = power(p) / (distance * local.z + lane_sqrt(lane_max(F(radius * radius - drop2), F(0.0f))));
    const F x = local.x * t / radius, y = local.y * t / radius;
    const Vec3<F> normal = frame.to_world(Vec3<F>(x, y, -lane_sqrt(lane_max(F(1 - x * x - y * y), F(0.0f)))));
    const Vec3<F> wi = frame.to_world(local);
    const Vec3<F> at = select(is_told_by_offset(), advance(p, t, wi), advance(center, radius, normal));
    return {{at, normal}, wi, radiance, 1 / (2 * pi * one_minus_cos)};
  }
  LightSample<F> sample_inward(const Vec3<F>& p, const Vec2<F>& u) const {
    const Mask<F> within = is_within(p), by_direction = within && u.x < 0.5f;
    const F twice = 2 * u.x;
    const Vec3<F> random = square_to_sphere(Vec2<F>{select(within, select(by_direction, twice, twice - 1), u.x), u.y});
    // Distance from p, on the inner side, to where the direction leaves the sphere.
    const Vec3<F> from_center = p - center;
    const F b = dot(from_center, random), c = power(p);
    const F root = lane_sqrt(lane_max(F(b * b - c), F(0.0f)));
    const F t = select(b > 0, -c / select(b > 0, b + root, F(1.0f)), root - b);
    const Vec3<F> outward = select(by_direction, Vec3<F>(advance(from_center, t, random) * (1 / radius)), random);
    const LightPoint<F> at{
        select(by_direction && is_told_by_offset(), advance(p, t, random), advance(center, radius, outward)),
        outward * side};
    return {at, select(by_direction, random, normalize(at.p - p)), radiance, pdf(p, at)};
  }
};

}  // namespace photonproof::inline renderer_lights
