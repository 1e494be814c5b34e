// A cylinder that emits (light_area.h). From a point it is sampled by the angles that its lines subtend.
#pragma once

#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_sample.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline scenes_description {
struct ShapeDescription;
}

namespace photonproof::inline renderer_lights {

/// The curved side: base + radius (cos(2 pi u) start + sin(2 pi u) side) + v axis.
struct CylinderShape {
  Vec3d base, axis;   ///< `axis` is the vector to the other end; in double, as in cylinder.h
  Vec3f start, side;  ///< unit
  double radius = 1;
  float sign = 1;  ///< 1: outward, -1: inward
  LightPoint<float> sample(const Vec2<float>& u) const;
  SeenPoint sample_from(const Vec3f& p, const Vec2<float>& u) const;
  float pdf_from(const Vec3f& p, const LightPoint<float>& at) const;
  Vec2<float> uv_at(const LightPoint<float>& at) const;
  float area() const;
  LightBounds bounds() const;
};

/// Makes the light's shape from a rendered cylinder, and from the description where the surface lacks data. `to_world`
/// is that of compile_surface_light.
CylinderShape light_shape(const Cylinder& cylinder, const ShapeDescription& shape, const Transform& to_world);

}  // namespace photonproof::inline renderer_lights
