#include "renderer/scene/scene_focus.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "renderer/scene/nearest_point.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/shapes/surface.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_scene {
namespace {

/// Adds a point of a local square, disc or heightfield, or of a box with a third axis. It is not exactly the nearest
/// one where to_world stretches.
void add_box(NearestPoint& nearest, const Transform& to_world, bool solid) {
  const auto clamped = [](double x) { return std::clamp(x, -1.0, 1.0); };
  Vec3d local{0, 0, 0};
  if (solid) {
    const std::optional<Transform> to_local = to_world.inverse();
    if (to_local) local = to_local->point(nearest.to);
    for (double Vec3d::*axis : {&Vec3d::x, &Vec3d::y, &Vec3d::z}) {
      for (const double side : {-1.0, 1.0}) {
        Vec3d on_face{clamped(local.x), clamped(local.y), clamped(local.z)};
        on_face.*axis = side;
        nearest.add(to_world.point(on_face));
      }
    }
    return;
  }
  const Vec3d u = to_world.vector({2, 0, 0}), v = to_world.vector({0, 2, 0}), corner = to_world.point({-1, -1, 0});
  nearest.add(nearest_on_parallelogram(nearest.to, corner, u, v));
}

/// Finds the nearest points of shapes; a mesh is prepared once for all its copies.
class Nearness {
 public:
  explicit Nearness(const SceneDescription& scene) : scene_(scene) {}

  void add(NearestPoint& nearest, const ShapeDescription& shape, const Transform& to_world) {
    std::visit(Overloaded{[&](const RectangleDescription&) { add_box(nearest, to_world, false); },
                          [&](const HeightfieldDescription&) { add_box(nearest, to_world, false); },
                          [&](const DiskDescription&) { add_box(nearest, to_world, false); },
                          [&](const CubeDescription&) { add_box(nearest, to_world, true); },
                          [&](const MeshDescription& mesh) {
                            meshes_.try_emplace(mesh.mesh.get(), *mesh.mesh).first->second.add_to(nearest, to_world);
                          },
                          [&](const InstanceDescription& instance) {
                            for (const ShapeDescription& member : scene_.groups[instance.group.value].shapes)
                              if (!std::holds_alternative<InstanceDescription>(member.geometry))
                                add(nearest, member, to_world * member.to_world);
                          },
                          [&](const auto& primitive) { nearest.add(nearest_on(primitive, to_world, nearest.to)); }},
               shape.geometry);
  }

 private:
  const SceneDescription& scene_;
  std::map<const TriangleMesh*, NearestOnMesh> meshes_;
};

/// Region that encloses the camera's view: a cone, or a cylinder for an orthographic camera.
struct Aov {
  Vec3d origin, axis;
  double near = 0, half_angle = 0, half_width = 0;  ///< nothing is seen nearer than `near`

  explicit Aov(const SensorDescription& sensor)
      : origin(sensor.to_world.point({0, 0, 0})), axis(normalize(sensor.to_world.vector({0, 0, 1}))) {
    const double film = std::max(sensor.film.width, sensor.film.height), other = sensor.film.width + sensor.film.height;
    const auto see_cone = [&](double near_clip, double degrees) {
      near = near_clip;
      // Up to the corners, whichever axis the angle is along.
      const double longest = std::numbers::sqrt2 * film / (other - film);
      half_angle = degrees >= 180 ? std::numbers::pi : std::atan(std::tan(degrees * std::numbers::pi / 360) * longest);
    };
    std::visit(
        Overloaded{[&](const PerspectiveDescription& pinhole) { see_cone(pinhole.near_clip, pinhole.fov_degrees); },
                   [&](const ThinLensDescription& lens) {
                     see_cone(lens.perspective.near_clip, lens.perspective.fov_degrees);
                   },
                   [&](const FisheyeDescription& fisheye) { see_cone(fisheye.near_clip, fisheye.fov_degrees); },
                   [&](const OrthographicDescription& parallel) {
                     near = parallel.near_clip;
                     half_width = length(sensor.to_world.vector({1, 0, 0})) * other / sensor.film.width;
                   },
                   [&](const RadianceMeterDescription&) { see_cone(0, 1); },
                   // scene_focus() does without those that are nowhere or in several places.
                   [](const auto&) {}},
        sensor.camera);
  }

  bool shows(const Vec3d& center, double radius) const {
    const Vec3d to_center = center - origin;
    const double along = dot(to_center, axis), distance = length(to_center);
    if (!(distance > radius)) return true;
    if (half_width > 0) return length(to_center - axis * along) <= half_width + radius;
    return std::acos(std::clamp(along / distance, -1.0, 1.0)) <= half_angle + std::asin(radius / distance);
  }
};

struct Part {
  Vec3d point;
  double near, size;
  bool in_view;
};

/// The least value up to which values of half the weight lie; weights are 1 / near.
template <class Value>
double weighted_median(std::vector<Part>& parts, Value&& value) {
  std::sort(parts.begin(), parts.end(), [&](const Part& a, const Part& b) { return value(a) < value(b); });
  double total = 0, below = 0;
  for (const Part& part : parts) total += 1 / part.near;
  for (const Part& part : parts)
    if ((below += 1 / part.near) >= 0.5 * total) return value(part);
  return value(parts.back());
}

}  // namespace

std::optional<SceneFocus> scene_focus(const SceneDescription& description) {
  const auto& camera = description.sensor.camera;
  if (std::holds_alternative<DistantDescription>(camera) || std::holds_alternative<BatchDescription>(camera) ||
      std::holds_alternative<IrradianceMeterDescription>(camera))
    return std::nullopt;
  const Aov view(description.sensor);
  const ShapeExtents extents(description);
  Nearness nearness(description);
  std::vector<Part> parts;
  for (const ShapeDescription& shape : description.shapes) {
    NearestPoint nearest{view.origin};
    nearness.add(nearest, shape, shape.to_world);
    if (!std::isfinite(nearest.distance)) continue;
    const Extent extent = extents.of(shape);
    const bool ends = extent.is_usable();
    const double radius = ends ? length(extent.high - extent.low) * 0.5 : std::numeric_limits<double>::infinity();
    const double near = std::max({nearest.distance, view.near, view.half_width});
    const double size = std::min(near, radius);
    if (!(size > 0) || !std::isfinite(size)) continue;
    parts.push_back({nearest.point, near, size, !ends || view.shows(extent.middle(), radius)});
  }
  const auto unseen = std::partition(parts.begin(), parts.end(), [](const Part& part) { return part.in_view; });
  if (unseen != parts.begin()) parts.erase(unseen, parts.end());
  if (parts.empty()) return std::nullopt;
  const Vec3d point{weighted_median(parts, [](const Part& part) { return part.point.x; }),
                    weighted_median(parts, [](const Part& part) { return part.point.y; }),
                    weighted_median(parts, [](const Part& part) { return part.point.z; })};
  if (!is_finite(point)) return std::nullopt;
  return SceneFocus{point, weighted_median(parts, [](const Part& part) { return part.size; })};
}

}  // namespace photonproof::inline renderer_scene
