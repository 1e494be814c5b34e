#include "reference/povray/povray_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

#include "reference/povray/sdl_text.h"
#include "reference/povray/unrepresentable.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"
#include "scenes/meshes/convex_clip.h"

namespace photonproof::inline reference_povray {
namespace {

/// Region that may be visible between two distances along `forward`: a pyramid, wider where there is a lens. It is a
/// box for an orthographic camera, and a cube for a fisheye, whose rays start and end at these distances from it.
std::vector<HalfSpace> frustum(const PovCamera& camera, double nearest, double farthest) {
  const double at_eye = dot(camera.forward, camera.origin);
  std::vector<HalfSpace> region{{-camera.forward, -(at_eye + nearest)}, {camera.forward, at_eye + farthest}};
  if (camera.kind == PovCamera::Kind::fisheye) {
    for (const Vec3d& axis : {camera.right, -camera.right, camera.up, -camera.up})
      region.push_back({axis, dot(axis, camera.origin) + farthest});
    return region;
  }
  const bool parallel = camera.kind == PovCamera::Kind::orthographic;
  const double spread = camera.lens_radius / camera.focus_distance;
  const auto side = [&](const Vec3d& axis, double half, double middle) {
    const double slope = parallel ? 0 : half * (1 + middle) + spread;
    const Vec3d n = axis - camera.forward * slope;
    region.push_back({n, dot(n, camera.origin) + camera.lens_radius + (parallel ? half : 0)});
  };
  side(camera.right, camera.tan_x, camera.middle_x);
  side(-camera.right, camera.tan_x, -camera.middle_x);
  side(camera.up, camera.tan_y, camera.middle_y);
  side(-camera.up, camera.tan_y, -camera.middle_y);
  return region;
}

/// Image of a point in pixels across and down; empty behind the camera.
std::optional<Vec2<double>> pixel_of(const PovCamera& camera, const Vec3d& p, int width, int height) {
  const Vec3d d = p - camera.origin;
  const bool parallel = camera.kind == PovCamera::Kind::orthographic;
  const double depth = parallel ? 1 : dot(d, camera.forward);
  if (depth <= 0 || camera.kind == PovCamera::Kind::fisheye) return std::nullopt;
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
  if (camera.kind == PovCamera::Kind::fisheye) return INFINITY;
  const bool parallel = camera.kind == PovCamera::Kind::orthographic;
  const double depth = parallel ? 1 : dot(sphere.center - camera.origin, camera.forward);
  return depth <= 0 ? INFINITY : sphere.radius / (depth * camera.tan_y) * height;
}

template <class Other>
double thickness(const PovCamera&, const Other&, int, int) {
  return INFINITY;  // no small light
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
  if (camera.kind != PovCamera::Kind::perspective) return true;
  // Otherwise the whole piece of the frustum may be inside the ball: it is the convex hull of its corners.
  double reach = 0;
  for (const double distance : {nearest, farthest})
    for (const double x : {-1.0, 1.0})
      for (const double y : {-1.0, 1.0}) {
        const Vec3d corner = camera.origin + (camera.forward + camera.right * ((x + camera.middle_x) * camera.tan_x) +
                                              camera.up * ((y + camera.middle_y) * camera.tan_y)) *
                                                 distance;
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
                 [&](const PovRound&) {
                   const PovExtent of = extent(surface);
                   return std::none_of(region.begin(), region.end(), [&](const HalfSpace& half) {
                     return std::all_of(of.points.begin(), of.points.end(),
                                        [&](const Vec3d& p) { return dot(half.normal, p) >= half.offset; });
                   });
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
        Overloaded{
            [&](const PovSphere& sphere) { return in_front(sphere.center, sphere.radius); }, face_in_front,
            [&](const PovMesh& mesh) {
              return !mesh.any_triangle([&](const auto& triangle) {
                return std::any_of(triangle.begin(), triangle.end(), [&](const Vec3d& v) { return !in_front(v, 0); });
              });
            },
            [&](const PovRound&) {
              const PovExtent of = extent(surface);
              return std::all_of(of.points.begin(), of.points.end(), [&](const Vec3d& p) { return in_front(p, 0); });
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
    const auto at = position_of(emitter);
    return at && in_front(*at, 0);
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

double thinnest_light(const PovCamera& camera, const PovScene& scene, int width, int height) {
  double thinnest = INFINITY;
  for (const PovSurface& surface : scene.surfaces) {
    if (surface.emission != PovSurface::Emission::spots) continue;
    const double across =
        std::visit([&](const auto& geometry) { return thickness(camera, geometry, width, height); }, surface.geometry);
    if (across > 0) thinnest = std::min(thinnest, across);  // 0: seen from its edge, that is not at all
  }
  return thinnest;
}

std::string camera_sdl(const PovCamera& camera, double scale, int samples) {
  const std::string place = " location " + sdl_vector(camera.origin * scale);
  if (camera.kind == PovCamera::Kind::fisheye)
    return "camera{fisheye" + place + " direction " + sdl_vector(camera.forward) + " right " +
           sdl_vector(camera.right) + " up " + sdl_vector(camera.up) + " angle " +
           format_number(camera.angle * 180 / std::numbers::pi) + "}";
  const bool parallel = camera.kind == PovCamera::Kind::orthographic;
  const double unit = 2 * (parallel ? scale : 1);
  const Vec3d direction =
      camera.forward + camera.right * (camera.middle_x * camera.tan_x) + camera.up * (camera.middle_y * camera.tan_y);
  std::string text = std::string("camera{") + (parallel ? "orthographic" : "perspective") + place + " direction " +
                     sdl_vector(direction) + " right " + sdl_vector(camera.right * (unit * camera.tan_x)) + " up " +
                     sdl_vector(camera.up * (unit * camera.tan_y));
  if (camera.kind == PovCamera::Kind::thin_lens)
    text += " aperture " + format_number(4 * camera.lens_radius * scale) + " focal_point " +
            sdl_vector((camera.origin + direction * camera.focus_distance) * scale) + " blur_samples " +
            std::to_string(samples) + " variance 0 confidence 0.999999";
  return text + "}";
}

std::string clip_sdl(const PovCamera& camera, double scale) {
  const double at_eye = dot(camera.forward, camera.origin);
  return " clipped_by{intersection{plane{" + sdl_vector(camera.forward) + ", " +
         format_number((at_eye + camera.far_clip) * scale) + "} plane{" + sdl_vector(-camera.forward) + ", " +
         format_number(-(at_eye + camera.near_clip) * scale) + "}}}";
}

void apply_clip_planes(const PovCamera& camera, PovScene& scene) {
  const SceneDescription& description = *scene.description;
  double end = length(scene.center - camera.origin) + 2 * scene.radius;  // beyond everything
  bool lit = false;
  for (const PovSurface& surface : scene.surfaces) lit |= is_diffuse(surface) || is_specular(surface);
  for (PovSurface& surface : scene.surfaces) {
    if (surface.endless) continue;  // so far that what a plane cuts of it is next to the horizon
    const bool beyond = camera.far_clip < end && may_meet(surface, camera, camera.far_clip, end);
    const bool before = may_meet(surface, camera, 0, camera.near_clip);
    if (!beyond && !before) continue;
    if (!lit) {
      surface.clipped = true;
      continue;
    }
    if (beyond)
      throw Unrepresentable(description.where(surface.shape->loc),
                            "part of this surface lies beyond the camera's far_clip of " + rounded(camera.far_clip) +
                                ", and POV-Ray has no clip planes");
    if (camera.kind != PovCamera::Kind::perspective || !can_be_clear_from_behind(surface, camera, scene, end))
      throw Unrepresentable(description.where(surface.shape->loc),
                            "part of this surface lies before the camera's near_clip of " + rounded(camera.near_clip) +
                                ". POV-Ray has no clip planes, and leaving it out would change the light");
    surface.clear_back = true;
  }
}

}  // namespace photonproof::inline reference_povray
