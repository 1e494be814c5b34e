#include "reference/povray/povray_overlap.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <variant>

#include "reference/povray/unrepresentable.h"
#include "scenes/description/overloaded.h"
#include "scenes/meshes/convex_clip.h"

namespace photonproof::inline reference_povray {
namespace {

// Bodies that rest on one another touch up to rounding; an overlap must be deeper than this fraction of the object.
constexpr double kTouch = 1e-6;

/// Bodies that the overlap tests handle: the kinds of glass that lower_scene accepts.
using GlassObject = std::variant<PovSphere, PovBox>;

GlassObject glass_object(const PovSurface& glass) {
  return std::visit(
      Overloaded{[](const PovSphere& ball) -> GlassObject { return ball; },
                 [](const PovBox& box) -> GlassObject { return box; },
                 [](const PovParallelogram&) -> GlassObject { throw std::logic_error("glass without an inside"); },
                 [](const PovRound&) -> GlassObject { throw std::logic_error("glass without an inside"); },
                 // The box around the mesh: objects in the box outside the mesh are refused, too.
                 [](const PovMesh& mesh) -> GlassObject {
                   return PovBox{Transform::translate((mesh.low + mesh.high) * 0.5) *
                                     Transform::scale((mesh.high - mesh.low) * 0.5),
                                 false};
                 }},
      glass.geometry);
}

/// The half-spaces of a box slightly smaller than the object.
std::vector<HalfSpace> interior(const PovBox& box) {
  std::vector<HalfSpace> region;
  for (PovParallelogram face : PovBox{box.to_world, false}.faces()) {
    const Vec3d n = face.normal();
    const double thickness = 2 * (dot(n, face.corner) - dot(n, box.to_world.point({0, 0, 0})));
    region.push_back({n, dot(n, face.corner) - kTouch * thickness});
  }
  return region;
}

bool contains(const PovSphere& ball, const Vec3d& p) { return length(p - ball.center) < ball.radius * (1 - kTouch); }

bool contains(const PovBox& box, const Vec3d& p) {
  const auto region = interior(box);
  return std::all_of(region.begin(), region.end(),
                     [&](const HalfSpace& half) { return dot(half.normal, p) <= half.offset; });
}

bool reaches_into(const PovParallelogram& face, const PovSphere& ball) {
  return distance_to_parallelogram(ball.center, face.corner, face.edge_u, face.edge_v) < ball.radius * (1 - kTouch);
}

bool reaches_into(const PovParallelogram& face, const PovBox& box) {
  const auto vertices = face.vertices();
  return clip_polygon({vertices.begin(), vertices.end()}, interior(box)).size() >= 3;
}

/// Whether any part of the sphere's surface (not the ball) is inside the object.
bool reaches_into(const PovSphere& sphere, const PovSphere& ball) {
  const double distance = length(sphere.center - ball.center);
  const double touch = kTouch * std::min(sphere.radius, ball.radius);
  const bool apart = distance >= sphere.radius + ball.radius - touch;
  const bool around = distance + ball.radius <= sphere.radius + touch;
  return !apart && !around;
}

bool reaches_into(const PovSphere& sphere, const PovBox& box) {
  double nearest = std::numeric_limits<double>::infinity(), farthest = 0;
  for (const PovParallelogram& face : box.faces()) {
    nearest = std::min(nearest, distance_to_parallelogram(sphere.center, face.corner, face.edge_u, face.edge_v));
    for (const Vec3d& v : face.vertices()) farthest = std::max(farthest, length(v - sphere.center));
  }
  // Around the box when every corner is inside the ball.
  return (contains(box, sphere.center) || nearest < sphere.radius * (1 - kTouch)) &&
         farthest > sphere.radius * (1 + kTouch);
}

bool reaches_into(const PovMesh& mesh, const PovSphere& ball) {
  return mesh.any_triangle(
      [&](const auto& triangle) { return distance_to_triangle(ball.center, triangle) < ball.radius * (1 - kTouch); });
}

bool reaches_into(const PovMesh& mesh, const PovBox& box) {
  const auto region = interior(box);
  return mesh.any_triangle([&](const auto& triangle) {
    return clip_polygon({triangle.begin(), triangle.end()}, region).size() >= 3;
  });
}

/// Uses the object's bounding box, and so refuses a little more than necessary.
template <class Other>
bool reaches_into(const PovRound& round, const Other& object) {
  const double height = round.kind == PovRound::Kind::cylinder ? 1 : 0;
  if (height == 0) {
    const PovParallelogram square{round.to_world.point({-1, -1, 0}), round.to_world.vector({2, 0, 0}),
                                  round.to_world.vector({0, 2, 0})};
    return reaches_into(square, object);
  }
  const PovBox box{round.to_world * Transform::translate({0, 0, 0.5}) * Transform::scale({1, 1, 0.5}), false};
  const auto faces = box.faces();
  return std::any_of(faces.begin(), faces.end(),
                     [&](const PovParallelogram& face) { return reaches_into(face, object); });
}

template <class Other>
bool reaches_into(const PovBox& box, const Other& object) {
  const auto faces = box.faces();
  return std::any_of(faces.begin(), faces.end(),
                     [&](const PovParallelogram& face) { return reaches_into(face, object); });
}

}  // namespace

void refuse_overlaps_with_glass(const PovScene& scene) {
  const SceneDescription& description = *scene.description;
  for (const PovSurface& glass : scene.surfaces) {
    if (!is_glass(glass)) continue;
    const GlassObject object = glass_object(glass);
    const auto holds = [&](const Vec3d& p) {
      return std::visit([&](const auto& b) { return contains(b, p); }, object);
    };
    const auto reached_by = [&](const auto& other, const auto& b) { return reaches_into(other, b); };
    const bool mesh = std::holds_alternative<PovMesh>(glass.geometry);
    const std::string inside = std::string(" inside or across the ") + (mesh ? "box around the " : "") +
                               "dielectric of " + description.where(glass.shape->loc) +
                               ": POV-Ray does not scale radiance by the squared index of refraction";
    for (const PovSurface& other : scene.surfaces) {
      if (other.shape == glass.shape) continue;
      if (std::visit(reached_by, other.geometry, object))
        throw Unrepresentable(description.where(other.shape->loc), "a surface" + inside);
    }
    for (const EmitterDescription& emitter : description.emitters)
      if (const auto at = position_of(emitter); at && holds(*at))
        throw Unrepresentable(description.where(emitter.loc), "a light" + inside);
    if (holds(description.sensor.to_world.point({0, 0, 0})))
      throw Unrepresentable(description.where(description.sensor.loc), "a camera" + inside);
  }
}

}  // namespace photonproof::inline reference_povray
