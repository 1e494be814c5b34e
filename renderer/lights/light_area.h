// Lambertian emission from one side of a shape that light_kinds.h cannot sample in lanes: cylinders, meshes, and every
// shape whose radiance is a texture. Photons start uniformly by area. From a point, quads, disks and spheres are
// sampled like their kinds in lanes. Cylinders are sampled by the angles that their lines subtend. Meshes are sampled
// uniformly by area. From nearby, the triangles' importance and subtended angles are used instead (light_near.h).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "renderer/core/discrete_distribution.h"
#include "renderer/lights/light_area_cylinder.h"
#include "renderer/lights/light_bounds.h"
#include "renderer/lights/light_disk.h"
#include "renderer/lights/light_quad.h"
#include "renderer/lights/light_sample.h"
#include "renderer/lights/light_sphere.h"
#include "renderer/shapes/long_face.h"
#include "renderer/textures/light_texture.h"

namespace photonproof::inline renderer_lights {

class LightTree;

/// Shapes sample points uniformly by area, with their texture coordinates (`sample`), and from p (`sample_from`, with
/// the density `pdf_from`). `uv_at` gives the coordinates of a point, and `bounds` the directions of emission.

/// A face's plane, with `offset` as in light_near.h.
struct FacePlane {
  Vec3f normal;
  float offset = told_by_corner;
};

/// The points corner + u edge_u + v edge_v, with uv = (u, v). `offset` as in FacePlane.
struct QuadShape {
  Vec3f corner, edge_u, edge_v, normal;
  float offset = told_by_corner;
  LightPoint<float> sample(const Vec2<float>& u) const { return {corner + edge_u * u.x + edge_v * u.y, normal, u}; }
  SeenPoint sample_from(const Vec3f& p, const Vec2<float>& u) const;
  float pdf_from(const Vec3f& p, const LightPoint<float>& at) const;
  Vec2<float> uv_at(const LightPoint<float>& at) const;
  float area() const { return length(cross(edge_u, edge_v)); }
  LightBounds bounds() const { return parallelogram_bounds(corner, edge_u, edge_v, normal); }
};

/// The points center + a half_axis_u + b half_axis_v, a^2 + b^2 <= 1, with uv = (radius, angle / 2 pi) as in Mitsuba's
/// disk.
struct DiskShape {
  Vec3f center, half_axis_u, half_axis_v, normal;
  float offset = told_by_corner;
  LightPoint<float> sample(const Vec2<float>& u) const;
  SeenPoint sample_from(const Vec3f& p, const Vec2<float>& u) const;
  float pdf_from(const Vec3f& p, const LightPoint<float>& at) const;
  Vec2<float> uv_at(const LightPoint<float>& at) const;
  float area() const;
  LightBounds bounds() const { return ellipse_bounds(center, half_axis_u, half_axis_v, normal); }
};

/// Texture coordinates: (azimuth about `up` from `start`, polar angle from `up`), in turns and half turns.
struct SphereShape {
  Vec3f center;
  float radius = 1;
  Vec3f start{1, 0, 0}, side{0, 1, 0}, up{0, 0, 1};  ///< unit
  float sign = 1;                                    ///< 1: outward, -1: inward
  float offset = told_by_corner;                     ///< as in SphereLight
  LightPoint<float> sample(const Vec2<float>& u) const;
  SeenPoint sample_from(const Vec3f& p, const Vec2<float>& u) const;
  float pdf_from(const Vec3f& p, const LightPoint<float>& at) const;
  Vec2<float> uv_at(const LightPoint<float>& at) const;
  float area() const;
  LightBounds bounds() const { return round_bounds(center - Vec3f(radius), center + Vec3f(radius)); }
};

/// Triangles in world coordinates. Sampling chooses a triangle by its area; normals are geometric.
class MeshShape {
 public:
  using Triangle = std::array<std::uint32_t, 3>;
  /// The `uvs` are per vertex or empty, when uv are the triangle's barycentric coordinates. `flipped` reverses the
  /// normals of the winding. Arguments are copied. `long_faces` lists faces whose positions are not exact enough; may
  /// be null.
  MeshShape(std::vector<Vec3f> positions, std::vector<Triangle> triangles, std::vector<Vec2<float>> uvs, bool flipped,
            LongFaces long_faces = nullptr);
  LightPoint<float> sample(const Vec2<float>& u) const;
  SeenPoint sample_from(const Vec3f& p, const Vec2<float>& u) const;
  float pdf_from(const Vec3f& p, const LightPoint<float>& at) const;
  Vec2<float> uv_at(const LightPoint<float>& at) const;
  float area() const { return area_; }
  LightBounds bounds() const { return round_bounds(positions_); }

 private:
  Vec2<float> uv_of(const Triangle& t, float weight_b, float weight_c) const;
  LightPoint<float> point_on(std::uint32_t triangle, const Vec2<float>& u) const;
  /// The face as rays meet it, or null where positions are exact enough.
  const LongFace* long_face(std::uint32_t triangle) const;
  /// The triangle of a point that a ray met on `at.triangle`. Near an edge of a long face the point may lie on a
  /// neighbour.
  std::uint32_t triangle_at(const LightPoint<float>& at) const;
  /// Data for sampling a triangle that p is close to.
  std::optional<CloseTriangle> close_triangle(std::uint32_t triangle, const Vec3f& p) const;
  /// Density per solid angle at p of the point at this offset on the chosen triangle.
  float pdf_on(std::uint32_t triangle, const Vec3f& p, const Vec3f& offset) const;

  std::vector<Vec3f> positions_;
  std::vector<Triangle> triangles_;
  std::vector<Vec2<float>> uvs_;
  std::vector<FacePlane> planes_;  ///< plane of each triangle
  LongFaces long_faces_;
  float area_;
  DiscreteDistribution by_area_;
  Vec3f center_;            ///< centre of the box around it
  float half_extent2_ = 0;  ///< squared half of its diagonal
  std::shared_ptr<const LightTree> by_importance_;
};

/// One row a shape.
using LightShape = std::variant<QuadShape, DiskShape, SphereShape, CylinderShape, MeshShape>;

class AreaLight {
 public:
  static constexpr bool is_delta = false, is_infinite = false;

  AreaLight(LightShape shape, const Rgb& radiance);
  /// The flux is that of the texture's mean over the shape, on a lattice of samples.
  AreaLight(LightShape shape, LightTexture texture);

  LightSample<float> sample(const Vec3f& p, const Vec2<float>& u) const;
  float pdf(const Vec3f& p, const LightPoint<float>& at) const;
  Emission<float> emit(const Vec2<float>& u_position, const Vec2<float>& u_direction) const;
  EmissionPdfs<float> emit_pdfs(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux_towards(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb leaving(const LightPoint<float>& at, const Vec3f& direction) const;
  Rgb flux() const { return flux_; }
  LightBounds bounds() const {
    return std::visit([](const auto& shape) { return shape.bounds(); }, shape_);
  }
  const LightShape& shape() const { return shape_; }
  /// Texture coordinates of a point on the shape; for a mesh, on its triangle. Constant radiance needs none: 0.
  Vec2<float> uv_at(const LightPoint<float>& at) const;

 private:
  Rgb radiance_at(const Vec2<float>& uv) const { return texture_ ? texture_(uv) : radiance_; }

  LightShape shape_;
  float area_;
  Rgb radiance_{0.0f};
  LightTexture texture_;  ///< empty for a constant `radiance_`
  Rgb flux_{0.0f};
};

}  // namespace photonproof::inline renderer_lights
