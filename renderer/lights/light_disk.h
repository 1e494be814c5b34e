// Lambertian emission from one side of an ellipse (a disc under an affine map). It is sampled uniformly by area, and
// from nearby by the angles that it subtends (light_near.h).
#pragma once

#include "renderer/lanes/warp.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_near.h"
#include "renderer/lights/light_sample.h"

namespace photonproof::inline renderer_lights {

template <class F>
struct DiskLight {
  static constexpr bool is_delta = false, is_infinite = false;
  Vec3<F> center, half_axis_u, half_axis_v;  ///< points: center + a half_axis_u + b half_axis_v, a^2 + b^2 <= 1
  Vec3<F> normal;
  F area;
  Vec3<F> radiance;  ///< W m^-2 sr^-1
  F offset;          ///< normal . x of its points, where the centre is too distant (light_near.h)

  LightSample<F> sample(const Vec3<F>& p, const Vec2<F>& u) const {
    const Vec3<F> p_light = point(u);
    const Vec3<F> d = p_light - p;
    const F distance2 = dot(d, d);
    const Vec3<F> wi = d * (1 / lane_sqrt(distance2));
    const F cos_light = -dot(normal, wi);
    LightSample<F> s{{p_light, normal}, wi, radiance, select(cos_light > 0, distance2 / (area * cos_light), F(0.0f))};
    if (some_may_be_close(distance2, most_half_extent2())) sample_close(*this, p, u, s);
    return s;
  }
  F pdf(const Vec3<F>& p, const LightPoint<F>& at) const {
    F density = area_to_solid_angle(F(1 / area), p, at);
    const Vec3<F> d = p - at.p;
    if (some_may_be_close(F(dot(d, d)), most_half_extent2())) pdf_close(*this, p, at.p, density);
    return density;
  }
  Mask<F> is_close_to(const Vec3<F>& p) const { return is_close(p, center, most_half_extent2()); }
  /// The longest half axis is at most the root of the sum of both squares.
  F most_half_extent2() const { return dot(half_axis_u, half_axis_u) + dot(half_axis_v, half_axis_v); }
  F height(const Vec3<F>& p) const { return height_above(p, center, normal, offset); }
  CloseEllipse<F> shape_from(const Vec3<F>& p) const {
    return {Vec3<F>(p - center), height(p), half_axis_u, half_axis_v, normal};
  }
  Emission<F> emit(const Vec2<F>& u_position, const Vec2<F>& u_direction) const {
    return {{point(u_position), normal}, Frame<F>(normal).to_world(square_to_cosine_hemisphere(u_direction)), flux()};
  }
  EmissionPdfs<F> emit_pdfs(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return {1 / area, cosine_hemisphere_pdf(F(dot(at.normal, direction)))};
  }
  Vec3<F> flux_towards(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return flux() * cosine_hemisphere_pdf(F(dot(at.normal, direction)));
  }
  Vec3<F> flux() const { return radiance * (pi * area); }
  LightBounds bounds() const { return ellipse_bounds(center, half_axis_u, half_axis_v, normal); }
  Vec3<F> leaving(const LightPoint<F>& at, const Vec3<F>& direction) const {
    return select(dot(at.normal, direction) > 0, radiance, Vec3<F>(F(0.0f)));
  }

 private:
  Vec3<F> point(const Vec2<F>& u) const {
    const Vec2<F> d = square_to_disc(u);  // an affine map keeps the density uniform
    return advance(advance(center, d.x, half_axis_u), d.y, half_axis_v);
  }
};

}  // namespace photonproof::inline renderer_lights
