// Lambertian emission from a sphere, outward or inward. From outside, the visible cap is sampled uniformly by solid
// angle (Shirley, Wang, Zimmerman 1996); from inside, or where it emits inward, uniformly by area.
#pragma once

#include "renderer/light_sample.h"
#include "renderer/surface.h"
#include "renderer/warp.h"

namespace photonproof {

struct SphereLight {
  Sphere sphere;
  Rgb radiance;  ///< W m^-2 sr^-1

  LightSample sample(const Vec3f& p, const Vec2<float>& u) const {
    if (!samples_cone(p)) {
      const Vec3f outward = square_to_sphere(u);
      const Vec3f p_light = sphere.center + outward * sphere.radius;
      const Vec3f normal = sphere.inward ? -outward : outward;
      return surface_light_sample(radiance, area_to_solid_angle(1 / sphere.area(), p, p_light, normal), p, p_light,
                                  normal);
    }
    const Vec3f to_center = sphere.center - p;
    const float distance = length(to_center);
    const float one_minus_cos = cone_one_minus_cos(p);
    const Vec3f local = square_to_cone(u, one_minus_cos);
    const Vec3f wi = Frame(to_center / distance).to_world(local);
    const float sin2 = std::max(0.0f, 1 - local.z * local.z);
    const float t =
        distance * local.z - std::sqrt(std::max(0.0f, sphere.radius * sphere.radius - distance * distance * sin2));
    const Vec3f normal = normalize(p + wi * t - sphere.center);
    return {sphere.center + normal * sphere.radius, normal, wi, radiance, 1 / (2 * pi * one_minus_cos)};
  }
  float pdf(const Vec3f& p, const Vec3f& p_light, const Vec3f& normal_light) const {
    if (samples_cone(p)) return 1 / (2 * pi * cone_one_minus_cos(p));
    return area_to_solid_angle(1 / sphere.area(), p, p_light, normal_light);
  }
  Emission emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const {
    const Vec3f outward = square_to_sphere(u_position);
    const Vec3f normal = sphere.inward ? -outward : outward;
    return {sphere.center + outward * sphere.radius, normal,
            Frame(normal).to_world(square_to_cosine_hemisphere(u_direction)), flux()};
  }
  Rgb flux() const { return radiance * (pi * sphere.area()); }
  Rgb emitted_radiance(float cos_emit) const { return cos_emit > 0 ? radiance : Rgb(0.0f); }

 private:
  /// Close to the surface the cone fills the hemisphere and its arithmetic degenerates: sampled by area there.
  bool samples_cone(const Vec3f& p) const {
    return !sphere.inward && length_squared(p - sphere.center) > 1.0001f * sphere.radius * sphere.radius;
  }
  float cone_one_minus_cos(const Vec3f& p) const {
    const float sin2 = sphere.radius * sphere.radius / length_squared(p - sphere.center);
    return sin2 / (1 + std::sqrt(std::max(0.0f, 1 - sin2)));
  }
};

}  // namespace photonproof
