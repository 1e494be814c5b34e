#include "reference/povray/povray_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "reference/povray/sdl_text.h"
#include "reference/povray/unrepresentable.h"
#include "scenes/description/overloaded.h"
#include "scenes/meshes/convex_clip.h"
#include "scenes/text/text_numbers.h"

namespace photonproof {
namespace {

/// The pyramid of view between two distances along `forward`.
std::vector<HalfSpace> frustum(const PovCamera& camera, double nearest, double farthest) {
  const auto through_eye = [&](const Vec3d& n) { return HalfSpace{n, dot(n, camera.origin)}; };
  const double at_eye = dot(camera.forward, camera.origin);
  return {through_eye(camera.right - camera.forward * camera.tan_x),
          through_eye(-camera.right - camera.forward * camera.tan_x),
          through_eye(camera.up - camera.forward * camera.tan_y),
          through_eye(-camera.up - camera.forward * camera.tan_y),
          {-camera.forward, -(at_eye + nearest)},
          {camera.forward, at_eye + farthest}};
}

/// In pixels across and down; empty behind the camera.
std::optional<Vec2<double>> pixel_of(const PovCamera& camera, const Vec3d& p, int width, int height) {
  const Vec3d d = p - camera.origin;
  const double depth = dot(d, camera.forward);
  if (depth <= 0) return std::nullopt;
  return Vec2<double>{dot(d, camera.right) / (depth * camera.tan_x) * width / 2,
                      dot(d, camera.up) / (depth * camera.tan_y) * height / 2};
}

double thickness(const PovCamera& camera, const PovParallelogram& face, int width, int height) {
  std::vector<Vec2<double>> corners;
  for (const Vec3d& v : face.vertices()) {
    const auto pixel = pixel_of(camera, v, width, height);
    if (!pixel) return INFINITY;
    corners.push_back(*pixel);
  }
  double twice_area = 0, longest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec2<double>&a = corners[i], &b = corners[(i + 1) % corners.size()];
    twice_area += a.x * b.y - a.y * b.x;
    for (const Vec2<double>& other : corners) longest = std::max(longest, std::hypot(a.x - other.x, a.y - other.y));
  }
  return std::abs(twice_area) / 2 / longest;
}

double thickness(const PovCamera& camera, const PovSphere& sphere, int, int height) {
  const double depth = dot(sphere.center - camera.origin, camera.forward);
  return depth <= 0 ? INFINITY : sphere.radius / (depth * camera.tan_y) * height;
}

template <class Other>
double thickness(const PovCamera&, const Other&, int, int) {
  return INFINITY;  // no small lamp
}

/// Whether some of a polygon, and not only an edge of it, is in the region.
bool meets(std::span<const Vec3d> vertices, double area, const std::vector<HalfSpace>& region) {
  const auto outside = [&](const HalfSpace& half) {
    return std::all_of(vertices.begin(), vertices.end(),
                       [&](const Vec3d& v) { return dot(half.normal, v) >= half.offset; });
  };
  if (std::any_of(region.begin(), region.end(), outside)) return false;
  return polygon_area(clip_polygon({vertices.begin(), vertices.end()}, region)) > 1e-12 * area;
}

bool meets(const PovParallelogram& face, const std::vector<HalfSpace>& region) {
  return meets(face.vertices(), face.area(), region);
}

/// Conservative: false only when the sphere's surface is provably outside the frustum between the two distances.
bool may_meet(const PovSphere& sphere, const PovCamera& camera, double nearest, double farthest) {
  for (const HalfSpace& half : frustum(camera, nearest, farthest))
    if (dot(half.normal, sphere.center) - half.offset >= sphere.radius * length(half.normal)) return false;
  // Or the whole piece of the frustum is inside the ball: it is the convex hull of its corners.
  double reach = 0;
  for (const double distance : {nearest, farthest})
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const Vec3d corner =
            camera.origin +
            (camera.forward + camera.right * (x * camera.tan_x) + camera.up * (y * camera.tan_y)) * distance;
        reach = std::max(reach, length(corner - sphere.center));
      }
  return reach >= sphere.radius;
}

bool may_meet(const PovSurface& surface, const PovCamera& camera, double nearest, double farthest) {
  const std::vector<HalfSpace> region = frustum(camera, nearest, farthest);
  const auto face_meets = [&](const PovParallelogram& face) { return meets(face, region); };
  return std::visit(
      Overloaded{[&](const PovSphere& sphere) { return may_meet(sphere, camera, nearest, farthest); }, face_meets,
                 [&](const PovMesh& mesh) {
                   return mesh.any_triangle(
                       [&](const auto& triangle) { return meets(triangle, polygon_area(triangle), region); });
                 },
                 [&](const PovBox& box) {
                   const auto faces = box.faces();
                   return std::any_of(faces.begin(), faces.end(), face_meets);
                 }},
      surface.geometry);
}

/// Whether every surface and light is on the front side of the face's plane, so that only the camera looks at its back.
bool nothing_behind(const PovParallelogram& plane, const PovScene& scene) {
  const Vec3d n = plane.normal();
  const double touch = 1e-6 * scene.radius;
  const auto in_front = [&](const Vec3d& p, double reach) { return dot(n, p - plane.corner) - reach >= -touch; };
  const auto face_in_front = [&](const PovParallelogram& face) {
    const auto vertices = face.vertices();
    return std::all_of(vertices.begin(), vertices.end(), [&](const Vec3d& v) { return in_front(v, 0); });
  };
  for (const PovSurface& surface : scene.surfaces) {
    const bool clear = std::visit(
        Overloaded{[&](const PovSphere& sphere) { return in_front(sphere.center, sphere.radius); }, face_in_front,
                   [&](const PovMesh& mesh) {
                     return !mesh.any_triangle([&](const auto& triangle) {
                       return std::any_of(triangle.begin(), triangle.end(),
                                          [&](const Vec3d& v) { return !in_front(v, 0); });
                     });
                   },
                   [&](const PovBox& box) {
                     const auto faces = box.faces();
                     return std::all_of(faces.begin(), faces.end(), face_in_front);
                   }},
        surface.geometry);
    if (!clear) return false;
  }
  const auto& emitters = scene.description->emitters;
  return std::all_of(emitters.begin(), emitters.end(), [&](const EmitterDescription& emitter) {
    return in_front(std::get<PointLightDescription>(emitter.light).position, 0);
  });
}

bool can_be_clear_from_behind(const PovSurface& surface, const PovCamera& camera, const PovScene& scene,
                              double farthest) {
  const auto* face = std::get_if<PovParallelogram>(&surface.geometry);
  if (!face || is_specular(surface)) return false;
  const bool camera_behind = dot(face->normal(), camera.origin - face->corner) < 0;
  return camera_behind && !may_meet(surface, camera, camera.near_clip, farthest) && nothing_behind(*face, scene);
}

}  // namespace

PovCamera lower_camera(const SceneDescription& scene, int width, int height) {
  const SensorDescription& sensor = scene.sensor;
  const auto& perspective = std::get<PerspectiveDescription>(sensor.camera);
  PovCamera camera;
  camera.origin = sensor.to_world.point({0, 0, 0});
  camera.forward = normalize(sensor.to_world.vector({0, 0, 1}));
  camera.right = normalize(sensor.to_world.vector({-1, 0, 0}));
  camera.up = normalize(sensor.to_world.vector({0, 1, 0}));
  camera.near_clip = perspective.near_clip;
  camera.far_clip = perspective.far_clip;
  const double skew = std::max({std::abs(dot(camera.forward, camera.right)), std::abs(dot(camera.forward, camera.up)),
                                std::abs(dot(camera.right, camera.up))});
  if (!(skew < 1e-9)) throw Unrepresentable(scene.where(sensor.loc), "a camera whose axes are not perpendicular");

  const double tangent = std::tan(perspective.fov_degrees * std::numbers::pi / 360);
  const double diagonal = std::hypot(width, height);
  double per_pixel = tangent / width;  // of half the image, per pixel of it
  switch (perspective.fov_axis) {
    case FovAxis::x:
      break;
    case FovAxis::y:
      per_pixel = tangent / height;
      break;
    case FovAxis::diagonal:
      per_pixel = tangent / diagonal;
      break;
    case FovAxis::smaller:
      per_pixel = tangent / std::min(width, height);
      break;
    case FovAxis::larger:
      per_pixel = tangent / std::max(width, height);
      break;
  }
  camera.tan_x = per_pixel * width;
  camera.tan_y = per_pixel * height;
  return camera;
}

double thinnest_lamp(const PovCamera& camera, const PovScene& scene, int width, int height) {
  double thinnest = INFINITY;
  for (const PovSurface& surface : scene.surfaces) {
    if (surface.emission != PovSurface::Emission::spots) continue;
    const double across =
        std::visit([&](const auto& geometry) { return thickness(camera, geometry, width, height); }, surface.geometry);
    if (across > 0) thinnest = std::min(thinnest, across);  // 0: seen from its edge, that is not at all
  }
  return thinnest;
}

std::string camera_sdl(const PovCamera& camera, double scale) {
  return "camera{perspective location " + sdl_vector(camera.origin * scale) + " direction " +
         sdl_vector(camera.forward) + " right " + sdl_vector(camera.right * (2 * camera.tan_x)) + " up " +
         sdl_vector(camera.up * (2 * camera.tan_y)) + "}";
}

void apply_clip_planes(const PovCamera& camera, PovScene& scene) {
  const SceneDescription& description = *scene.description;
  const double end = length(scene.center - camera.origin) + 2 * scene.radius;  // beyond everything
  for (PovSurface& surface : scene.surfaces) {
    if (camera.far_clip < end && may_meet(surface, camera, camera.far_clip, end))
      throw Unrepresentable(description.where(surface.shape->loc),
                            "part of this surface lies beyond the camera's far_clip of " + rounded(camera.far_clip) +
                                ", and POV-Ray has no clip planes");
    if (!may_meet(surface, camera, 0, camera.near_clip)) continue;
    if (!can_be_clear_from_behind(surface, camera, scene, end))
      throw Unrepresentable(description.where(surface.shape->loc),
                            "part of this surface lies before the camera's near_clip of " + rounded(camera.near_clip) +
                                ", POV-Ray has no clip planes, and it cannot be left out without changing the light");
    surface.clear_back = true;
  }
}

}  // namespace photonproof
