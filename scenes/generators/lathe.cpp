#include "scenes/generators/lathe.h"

#include <cmath>
#include <numbers>

namespace photonproof::inline scenes_generators {
namespace {

using std::numbers::pi;

/// Barry and Goldman's pyramid between p1 and p2, at u from 0 to 1.
Vec3d spline_point(const Vec3d& p0, const Vec3d& p1, const Vec3d& p2, const Vec3d& p3, double u) {
  const double t0 = 0, t1 = t0 + std::sqrt(length(p1 - p0)), t2 = t1 + std::sqrt(length(p2 - p1)),
               t3 = t2 + std::sqrt(length(p3 - p2));
  const double t = t1 + u * (t2 - t1);
  const auto mix = [t](const Vec3d& a, const Vec3d& b, double from, double to) {
    return a * ((to - t) / (to - from)) + b * ((t - from) / (to - from));
  };
  const Vec3d a1 = mix(p0, p1, t0, t1), a2 = mix(p1, p2, t1, t2), a3 = mix(p2, p3, t2, t3);
  return mix(mix(a1, a2, t0, t2), mix(a2, a3, t1, t3), t1, t2);
}

Vec3d mirrored(const Vec3d& p) { return {-p.x, p.y, p.z}; }

/// Joins ring `a` to the next ring `b`, front on the right of the way from a to b. A ring of one vertex is a pole.
void join_rings(TriangleMesh& mesh, std::uint32_t a, bool a_is_pole, std::uint32_t b, bool b_is_pole,
                std::uint32_t segments) {
  for (std::uint32_t i = 0; i < segments; ++i) {
    const std::uint32_t next = (i + 1) % segments;
    if (a_is_pole) {
      mesh.triangles.push_back({a, b + i, b + next});
    } else if (b_is_pole) {
      mesh.triangles.push_back({a + i, b, a + next});
    } else {
      mesh.triangles.push_back({a + i, b + i, b + next});
      mesh.triangles.push_back({a + i, b + next, a + next});
    }
  }
}

/// The sum of the faces' normals at each vertex, each of its corner's angle.
void set_normals(TriangleMesh& mesh) {
  std::vector<Vec3d> sums(mesh.positions.size(), Vec3d(0.0));
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3d at(mesh.positions[triangle[i]]);
      const Vec3d a = normalize(Vec3d(mesh.positions[triangle[(i + 1) % 3]]) - at);
      const Vec3d b = normalize(Vec3d(mesh.positions[triangle[(i + 2) % 3]]) - at);
      const Vec3d normal = cross(a, b);
      sums[triangle[i]] += normal * (std::atan2(length(normal), dot(a, b)) / length(normal));
    }
  mesh.normals.clear();
  for (const Vec3d& sum : sums) mesh.normals.push_back(Vec3f(normalize(sum)));
}

/// One circle of a tube, or its tip.
struct Hoop {
  Vec3d center, side, up;  ///< side, up and the way of the tube are right-handed
  double radius;
};

/// Frames that do not turn about the curve; those of a loop turn evenly so that the last one meets the first.
std::vector<Hoop> hoops_along(const std::vector<TubePoint>& curve, const std::vector<double>& radii, Ends ends) {
  std::vector<Hoop> hoops;
  const Vec3d first = curve[0].tangent;
  const Vec3d away = std::abs(first.y) < 0.9 ? Vec3d{0, 1, 0} : Vec3d{1, 0, 0};
  Vec3d side = normalize(cross(away, first));
  const auto carried = [&](const Vec3d& tangent) { return normalize(side - tangent * dot(side, tangent)); };
  for (std::size_t i = 0; i < curve.size(); ++i) {
    side = carried(curve[i].tangent);
    hoops.push_back({curve[i].at, side, cross(curve[i].tangent, side), radii[i]});
  }
  if (ends != Ends::loop) return hoops;
  const Vec3d back = carried(first);
  const double off = std::atan2(dot(back, hoops[0].up), dot(back, hoops[0].side));
  for (std::size_t i = 0; i < hoops.size(); ++i) {
    const double turn = -off * static_cast<double>(i) / static_cast<double>(hoops.size());
    const Vec3d s = hoops[i].side, u = hoops[i].up;
    hoops[i].side = s * std::cos(turn) + u * std::sin(turn);
    hoops[i].up = u * std::cos(turn) - s * std::sin(turn);
  }
  return hoops;
}

constexpr int kRoundings = 4;  ///< hoops of a round end, its tip among them

std::vector<Hoop> rounded(const std::vector<TubePoint>& curve, const std::vector<Hoop>& hoops) {
  std::vector<Hoop> all;
  const auto add_end = [&](const Hoop& end, const Vec3d& outward, int step) {
    const double angle = pi / 2 * step / kRoundings;
    all.push_back({end.center + outward * (end.radius * std::sin(angle)), end.side, end.up,
                   step == kRoundings ? 0 : end.radius * std::cos(angle)});
  };
  for (int step = kRoundings; step > 0; --step) add_end(hoops.front(), curve.front().tangent * -1.0, step);
  all.insert(all.end(), hoops.begin(), hoops.end());
  for (int step = 1; step <= kRoundings; ++step) add_end(hoops.back(), curve.back().tangent, step);
  return all;
}

}  // namespace

std::vector<TubePoint> smooth_curve(const std::vector<Vec3d>& controls, int per_span, Ends ends) {
  const std::size_t count = controls.size(), spans = ends == Ends::loop ? count : count - 1;
  const auto control = [&](std::ptrdiff_t i) {
    const auto n = static_cast<std::ptrdiff_t>(count);
    if (ends == Ends::loop) return controls[static_cast<std::size_t>((i + n) % n)];
    if (i < 0) return ends == Ends::axis ? mirrored(controls[1]) : controls[0] * 2.0 - controls[1];
    if (i >= n)
      return ends == Ends::axis ? mirrored(controls[count - 2]) : controls[count - 1] * 2.0 - controls[count - 2];
    return controls[static_cast<std::size_t>(i)];
  };
  const auto at = [&](std::size_t span, double u) {
    const auto i = static_cast<std::ptrdiff_t>(span);
    return spline_point(control(i - 1), control(i), control(i + 1), control(i + 2), u);
  };
  constexpr double near = 1e-4;  // of a span, for its derivative
  std::vector<TubePoint> curve;
  for (std::size_t span = 0; span < spans; ++span)
    for (int k = 0; k < per_span; ++k) {
      const double u = static_cast<double>(k) / per_span;
      curve.push_back({at(span, u), normalize(at(span, u + near) - at(span, u - (k == 0 ? 0 : near)))});
    }
  if (ends != Ends::loop) curve.push_back({controls.back(), normalize(controls.back() - at(spans - 1, 1 - near))});
  if (ends == Ends::axis) {
    curve.front().tangent = {1, 0, 0};
    curve.back().tangent = {-1, 0, 0};
  }
  return curve;
}

TriangleMesh lathe(const std::vector<TubePoint>& profile, Ends ends, std::uint32_t segments) {
  std::vector<std::uint32_t> firsts;
  std::vector<Vec3d> positions;
  TriangleMesh mesh;
  for (const auto& [at, tangent] : profile) {
    firsts.push_back(static_cast<std::uint32_t>(positions.size()));
    const std::uint32_t copies = at.x == 0 ? 1 : segments;
    for (std::uint32_t i = 0; i < copies; ++i) {
      const double angle = 2 * pi * i / segments, c = std::cos(angle), s = std::sin(angle);
      positions.push_back({at.x * c, at.y, -at.x * s});
      mesh.normals.push_back(Vec3f(Vec3d{tangent.y * c, -tangent.x, -tangent.y * s}));
    }
  }
  mesh.resize_positions(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) mesh.positions[i] = Vec3f(positions[i]);
  const std::size_t joints = ends == Ends::loop ? profile.size() : profile.size() - 1;
  for (std::size_t i = 0; i < joints; ++i) {
    const std::size_t next = (i + 1) % profile.size();
    join_rings(mesh, firsts[next], profile[next].at.x == 0, firsts[i], profile[i].at.x == 0, segments);
  }
  return mesh;
}

TriangleMesh tube(const std::vector<TubePoint>& curve, const std::vector<double>& radii, Ends ends,
                  std::uint32_t segments) {
  std::vector<Hoop> hoops = hoops_along(curve, radii, ends);
  if (ends != Ends::loop) hoops = rounded(curve, hoops);
  std::vector<std::uint32_t> firsts;
  std::vector<Vec3d> positions;
  for (const Hoop& hoop : hoops) {
    firsts.push_back(static_cast<std::uint32_t>(positions.size()));
    const std::uint32_t copies = hoop.radius == 0 ? 1 : segments;
    for (std::uint32_t i = 0; i < copies; ++i) {
      const double angle = 2 * pi * i / segments;
      positions.push_back(hoop.center + (hoop.side * std::cos(angle) + hoop.up * std::sin(angle)) * hoop.radius);
    }
  }
  TriangleMesh mesh;
  mesh.resize_positions(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) mesh.positions[i] = Vec3f(positions[i]);
  const std::size_t joints = ends == Ends::loop ? hoops.size() : hoops.size() - 1;
  for (std::size_t i = 0; i < joints; ++i) {
    const std::size_t next = (i + 1) % hoops.size();
    join_rings(mesh, firsts[next], hoops[next].radius == 0, firsts[i], hoops[i].radius == 0, segments);
  }
  set_normals(mesh);
  return mesh;
}

TriangleMesh torus(double major, double minor, std::uint32_t around, std::uint32_t across) {
  std::vector<TubePoint> circle;
  for (std::uint32_t i = 0; i < across; ++i) {
    const double angle = 2 * pi * i / across, c = std::cos(angle), s = std::sin(angle);
    circle.push_back({{major + minor * c, minor * s, 0}, {-s, c, 0}});
  }
  return lathe(circle, Ends::loop, around);
}

void add_part(TriangleMesh& whole, const TriangleMesh& part, double degrees, const Vec3d& offset) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  const auto turned = [&](const Vec3f& v) { return Vec3d{c * v.x + s * v.z, v.y, c * v.z - s * v.x}; };
  const std::size_t first = whole.positions.size();
  whole.resize_positions(first + part.positions.size());
  for (std::size_t i = 0; i < part.positions.size(); ++i)
    whole.positions[first + i] = Vec3f(turned(part.positions[i]) + offset);
  for (const Vec3f& normal : part.normals) whole.normals.push_back(Vec3f(turned(normal)));
  for (const auto& [a, b, d] : part.triangles) {
    const auto base = static_cast<std::uint32_t>(first);
    whole.triangles.push_back({base + a, base + b, base + d});
  }
}

}  // namespace photonproof::inline scenes_generators
