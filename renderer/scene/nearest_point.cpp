#include "renderer/scene/nearest_point.h"

#include <algorithm>

namespace photonproof {

void NearestPoint::add(const Vec3d& p) {
  const double d = length(p - to);
  if (!(d < distance)) return;
  distance = d;
  point = p;
}

Vec3d nearest_on_triangle(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v) {
  const Vec3d q = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), qu = dot(q, u), qv = dot(q, v);
  const double determinant = uu * vv - uv * uv;
  const double s = (qu * vv - qv * uv) / determinant, t = (qv * uu - qu * uv) / determinant;
  if (s >= 0 && t >= 0 && s + t <= 1) return a + u * s + v * t;
  NearestPoint nearest{p};
  const auto on_edge = [&](const Vec3d& from, const Vec3d& along) {
    const double share = dot(p - from, along) / dot(along, along);
    nearest.add(from + along * (share > 0 ? std::min(share, 1.0) : 0.0));
  };
  on_edge(a, u);
  on_edge(a, v);
  on_edge(a + u, v - u);
  return nearest.point;
}

Vec3d nearest_on_parallelogram(const Vec3d& p, const Vec3d& a, const Vec3d& u, const Vec3d& v) {
  NearestPoint nearest{p};
  nearest.add(nearest_on_triangle(p, a, u, v));
  nearest.add(nearest_on_triangle(p, a + u + v, -u, -v));
  return nearest.point;
}

}  // namespace photonproof
