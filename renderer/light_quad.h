// Lambertian emission from one side of a parallelogram, sampled uniformly by area.
#pragma once

#include "renderer/light_sample.h"
#include "renderer/surface.h"
#include "renderer/warp.h"

namespace photonproof {

struct QuadLight {
  Quad quad;
  Rgb radiance;  ///< W m^-2 sr^-1

  LightSample sample(const Vec3f& p, const Vec2<float>& u) const {
    const Vec3f p_light = at(u);
    return surface_light_sample(radiance, pdf(p, p_light, quad.normal), p, p_light, quad.normal);
  }
  float pdf(const Vec3f& p, const Vec3f& p_light, const Vec3f& normal_light) const {
    return area_to_solid_angle(1 / quad.area, p, p_light, normal_light);
  }
  Emission emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
    return {at(u_position), quad.normal, Frame(quad.normal).to_world(square_to_cosine_hemisphere(u_direction)), flux()};
  }
  Rgb flux() const { return radiance * (pi * quad.area); }
  Rgb emitted_radiance(float cos_emit) const { return cos_emit > 0 ? radiance : Rgb(0.0f); }

 private:
  Vec3f at(const Vec2<float>& u) const { return quad.corner + quad.edge_u * u.x + quad.edge_v * u.y; }
};

}  // namespace photonproof
