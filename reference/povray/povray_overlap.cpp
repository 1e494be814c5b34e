#include "reference/povray/povray_overlap.h"

#include <algorithm>
#include <limits>

#include "reference/povray/unrepresentable.h"
#include "scenes/meshes/convex_clip.h"

namespace photonproof {
namespace {

// Bodies that rest on one another touch up to rounding; an overlap must be deeper than this fraction of the body.
constexpr double kTouch = 1e-6;

using Geometry = decltype(PovSurface::geometry);

/// The half-spaces of a box slightly smaller than the body.
std::vector<HalfSpace> interior(const PovBox& box) {
  std::vector<HalfSpace> region;
  for (PovParallelogram face : PovBox{box.to_world, false}.faces()) {
    const Vec3d n = face.normal();
    const double thickness = 2 * (dot(n, face.corner) - dot(n, box.to_world.point({0, 0, 0})));
    region.push_back({n, dot(n, face.corner) - kTouch * thickness});
  }
  return region;
}

bool contains(const Geometry& body, const Vec3d& p) {
  if (const auto* ball = std::get_if<PovSphere>(&body)) return length(p - ball->center) < ball->radius * (1 - kTouch);
  const auto region = interior(std::get<PovBox>(body));
  return std::all_of(region.begin(), region.end(),
                     [&](const HalfSpace& half) { return dot(half.normal, p) <= half.offset; });
}

bool reaches_into(const PovParallelogram& face, const Geometry& body) {
  if (const auto* ball = std::get_if<PovSphere>(&body))
    return distance_to_parallelogram(ball->center, face.corner, face.edge_u, face.edge_v) < ball->radius * (1 - kTouch);
  const auto vertices = face.vertices();
  const std::vector<Vec3d> inside = clip_polygon({vertices.begin(), vertices.end()}, interior(std::get<PovBox>(body)));
  return inside.size() >= 3;
}

/// Whether any part of the sphere's surface (not the ball) is inside the body.
bool reaches_into(const PovSphere& sphere, const Geometry& body) {
  if (const auto* ball = std::get_if<PovSphere>(&body)) {
    const double distance = length(sphere.center - ball->center);
    const double touch = kTouch * std::min(sphere.radius, ball->radius);
    const bool apart = distance >= sphere.radius + ball->radius - touch;
    const bool around = distance + ball->radius <= sphere.radius + touch;
    return !apart && !around;
  }
  const PovBox& box = std::get<PovBox>(body);
  if (contains(body, sphere.center)) {
    // Around the box when every corner is inside the ball.
    double farthest = 0;
    for (const PovParallelogram& face : box.faces())
      for (const Vec3d& v : face.vertices()) farthest = std::max(farthest, length(v - sphere.center));
    return farthest > sphere.radius * (1 + kTouch);
  }
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const PovParallelogram& face : box.faces()) {
    nearest = std::min(nearest, distance_to_parallelogram(sphere.center, face.corner, face.edge_u, face.edge_v));
    for (const Vec3d& v : face.vertices()) farthest = std::max(farthest, length(v - sphere.center));
  }
  return nearest < sphere.radius * (1 - kTouch) && farthest > sphere.radius * (1 + kTouch);
}

bool reaches_into(const PovBox& box, const Geometry& body) {
  const auto faces = box.faces();
  return std::any_of(faces.begin(), faces.end(),
                     [&](const PovParallelogram& face) { return reaches_into(face, body); });
}

bool reaches_into(const PovMesh& mesh, const Geometry& body) {
  if (const auto* ball = std::get_if<PovSphere>(&body))
    return mesh.any_triangle([&](const auto& triangle) {
      return distance_to_triangle(ball->center, triangle) < ball->radius * (1 - kTouch);
    });
  const auto region = interior(std::get<PovBox>(body));
  return mesh.any_triangle([&](const auto& triangle) {
    return clip_polygon({triangle.begin(), triangle.end()}, region).size() >= 3;
  });
}

}  // namespace

void refuse_overlaps_with_glass(const PovScene& scene) {
  const SceneDescription& description = *scene.description;
  for (const PovSurface& glass : scene.surfaces) {
    if (!std::holds_alternative<DielectricDescription>(glass.bsdf->model)) continue;
    const std::string inside = " inside or across the dielectric of " + description.where(glass.shape->loc) +
                               ": POV-Ray does not scale radiance by the squared index of refraction";
    for (const PovSurface& other : scene.surfaces) {
      if (other.shape == glass.shape) continue;
      if (std::visit([&](const auto& geometry) { return reaches_into(geometry, glass.geometry); }, other.geometry))
        throw Unrepresentable(description.where(other.shape->loc), "a surface" + inside);
    }
    for (const EmitterDescription& emitter : description.emitters)
      if (contains(glass.geometry, std::get<PointLightDescription>(emitter.light).position))
        throw Unrepresentable(description.where(emitter.loc), "a light" + inside);
    if (contains(glass.geometry, description.sensor.to_world.point({0, 0, 0})))
      throw Unrepresentable(description.where(description.sensor.loc), "a camera" + inside);
  }
}

}  // namespace photonproof
