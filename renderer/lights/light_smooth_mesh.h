// A mesh that emits as in Mitsuba 3.9.1: by its interpolated normals rather than by its faces' (as_mitsuba.h). Rays
// that meet it see light on the side of that normal. Sampled points have a density by the cosine to that normal, so
// that these two estimators have different means. The density is even over the area, also from nearby, so that their
// weights are Mitsuba's as well.
#pragma once

#include <vector>

#include "renderer/lights/light_area.h"

namespace photonproof::inline renderer_lights {

class SmoothMeshLight {
 public:
  static constexpr bool is_delta = false, is_infinite = false;

  /// `normals`: one per vertex of the shape, unit, on the side of the winding; `inward` is that of the shape. The shape
  /// has no texture coordinates. Arguments are copied.
  SmoothMeshLight(MeshShape shape, std::vector<MeshShape::Triangle> triangles, std::vector<Vec3f> normals, bool inward,
                  const Rgb& radiance);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  float pdf(const Vec3f& p, const LightPoint<float>& at) const;
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux_towards(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb leaving(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux() const { return radiance_ * (pi * area_); }
  LightBounds bounds() const { return shape_.bounds(); }
  const MeshShape& shape() const { return shape_; }

 private:
  /// The interpolated normal, unit, on the emitting side.
  Vec3f normal_at(const LightPoint<float>& at) const;

  MeshShape shape_;
  std::vector<MeshShape::Triangle> triangles_;
  std::vector<Vec3f> normals_;
  float side_;
  Rgb radiance_;
  float area_;
};

}  // namespace photonproof::inline renderer_lights
