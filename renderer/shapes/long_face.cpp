#include "renderer/shapes/long_face.h"

#include <algorithm>

namespace photonproof::inline renderer_shapes {

const LongFace* find_long_face(const LongFaces& faces, std::size_t primitive) {
  if (faces == nullptr) return nullptr;
  const auto found = std::lower_bound(faces->begin(), faces->end(), primitive,
                                      [](const LongFace& face, std::size_t p) { return face.primitive < p; });
  return found != faces->end() && found->primitive == primitive ? &*found : nullptr;
}

namespace {

/// Distance from the origin to the segment from `start` along `edge`.
double segment_distance(const Vec3d& start, const Vec3d& edge) {
  const double along = std::clamp(-dot(start, edge) / dot(edge, edge), 0.0, 1.0);
  return length(start + edge * along);
}

}  // namespace

double rim_distance(const LongFace& face) {
  const Vec3d &corner = face.corner, &u = face.edge_u, &v = face.edge_v;
  const double near = std::min(segment_distance(corner, u), segment_distance(corner, v));
  if (face.is_triangle) return std::min(near, segment_distance(corner + u, v - u));
  return std::min({near, segment_distance(corner + v, u), segment_distance(corner + u, v)});
}

bool holds(const LongFace& face, const Vec3d& p, double margin) {
  const Vec3d q = p - face.corner, n = cross(face.edge_u, face.edge_v);
  // Volumes replace in_basis, whose determinant cancels where the edges are nearly parallel.
  const double nn = dot(n, n), u = dot(n, cross(q, face.edge_v)) / nn, v = dot(n, cross(face.edge_u, q)) / nn;
  const double low = -margin, high = 1 + margin;
  return u >= low && v >= low && (face.is_triangle ? u + v <= high : u <= high && v <= high);
}

double hit_distance(const LongFace& face, const ShapeRay& ray) {
  if (ray.on_light != OnLight::no) return shape_missed;
  const double t = (face.offset - dot(face.normal, ray.origin)) / dot(face.normal, ray.direction);
  if (!(t > 0 && t >= ray.t_near && t <= ray.t_far)) return shape_missed;
  return holds(face, ray.origin + ray.direction * t, long_face_margin) ? t : shape_missed;
}

ShapePoint point_on(const LongFace& face, const Vec3d& near) {
  return {Vec3f(near + face.normal * (face.offset - dot(face.normal, near))), Vec3f(face.normal)};
}

ShapeBox box_around(const LongFace& face) {
  const Vec3d& corner = face.corner;
  Vec3d low = corner, high = corner;
  for (const Vec3d& p : {corner + face.edge_u, corner + face.edge_v, corner + face.edge_u + face.edge_v}) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  static constexpr double most = 1e18;  // Embree leaves out what reaches further
  const auto held = [](double x) { return std::clamp(x, -most, most); };
  return padded_box({held(low.x), held(low.y), held(low.z)}, {held(high.x), held(high.y), held(high.z)});
}

}  // namespace photonproof::inline renderer_shapes
