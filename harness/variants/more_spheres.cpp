#include "harness/variants/more_spheres.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "harness/variants/draws.h"
#include "harness/variants/plain_objects.h"
#include "scenes/base/bounds.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline harness_variants {
namespace {

/// A shape as a box in its own space, flat for a rectangle; `round` for a sphere in it.
struct Obstacle {
  Vec3d low, high;
  Transform to_world, to_local;
  bool round = false;
};

std::optional<Obstacle> obstacle_of(const ShapeDescription& shape) {
  const std::optional<Transform> inverse = shape.to_world.inverse();
  if (!inverse) return std::nullopt;
  Obstacle obstacle{{-1, -1, 0}, {1, 1, 0}, shape.to_world, *inverse};
  const bool known = std::visit(
      Overloaded{[&](const SphereDescription& sphere) {
                   obstacle.low = sphere.center - Vec3d(sphere.radius);
                   obstacle.high = sphere.center + Vec3d(sphere.radius);
                   return obstacle.round = true;
                 },
                 [](const RectangleDescription&) { return true; }, [](const DiskDescription&) { return true; },
                 [&](const CubeDescription&) { return obstacle.low.z = -1, obstacle.high.z = 1, true; },
                 [&](const HeightfieldDescription& water) {
                   obstacle.low.z = -std::abs(water.amplitude);
                   obstacle.high.z = std::abs(water.amplitude);
                   return true;
                 },
                 [&](const CylinderDescription& cylinder) {
                   Bounds3d box;
                   for (const Vec3d& end : {cylinder.p0, cylinder.p1}) {
                     box.add(end - Vec3d(cylinder.radius));
                     box.add(end + Vec3d(cylinder.radius));
                   }
                   obstacle.low = box.low;
                   obstacle.high = box.high;
                   return true;
                 },
                 [&](const MeshDescription& mesh) {
                   Bounds3d box;
                   for (const Vec3f& p : mesh.mesh->positions) box.add(Vec3d(p));
                   obstacle.low = box.low;
                   obstacle.high = box.high;
                   return !box.empty();
                 },
                 [](const auto&) { return false; }},
      shape.geometry);
  return known ? std::optional(obstacle) : std::nullopt;
}

/// Distance from p to the box, exact as long as to_world keeps its axes at right angles.
double distance_to(const Obstacle& o, const Vec3d& p) {
  if (o.round) {
    const Vec3d middle = o.to_world.point((o.low + o.high) * 0.5);
    return length(p - middle) - (o.high.x - o.low.x) * 0.5 * length(o.to_world.vector({1, 0, 0}));
  }
  const Vec3d q = o.to_local.point(p);
  const Vec3d nearest{std::clamp(q.x, o.low.x, o.high.x), std::clamp(q.y, o.low.y, o.high.y),
                      std::clamp(q.z, o.low.z, o.high.z)};
  return length(o.to_world.point(nearest) - p);
}

struct View {
  Transform to_camera;
  double half_x, half_y, near;  ///< half sides of the image at distance 1
};

/// Whether the whole ball is in the image, behind the near plane.
bool in_view(const View& view, const Vec3d& middle, double radius) {
  const Vec3d p = view.to_camera.point(middle);
  if (p.z - radius < view.near) return false;
  return std::abs(p.x) + radius * 1.2 < view.half_x * p.z && std::abs(p.y) + radius * 1.2 < view.half_y * p.z;
}

View view_of(const SceneDescription& scene) {
  const auto* camera = std::get_if<PerspectiveDescription>(&scene.sensor.camera);
  const std::optional<Transform> to_camera = scene.sensor.to_world.inverse();
  if (!camera || !to_camera)
    throw InputError(scene.where(scene.sensor.loc), "spheres are put into the view of a perspective camera alone");
  const int w = scene.sensor.film.width, h = scene.sensor.film.height;
  const double up = vertical_tangent(*camera, w, h);
  return {*to_camera, up * w / h, up, camera->near_clip};
}

const char* add_sphere(SceneDescription& scene, const Vec3d& middle, double radius, int material, VariantDraws& draws) {
  BsdfDescription bsdf;
  const char* name = "glass";
  if (material == 0) {
    bsdf.model = DiffuseDescription{RgbD(draws.between(0.2, 0.9), draws.between(0.2, 0.9), draws.between(0.2, 0.9))};
    name = "diffuse";
  } else if (material == 1) {
    bsdf.model = ConductorDescription{.ior = {}, .specular_reflectance = RgbD(draws.between(0.6, 0.9))};
    name = "mirror";
  } else {
    bsdf.model = DielectricDescription{.int_ior = draws.between(1.4, 1.8), .ext_ior = 1};
  }
  scene.bsdfs.push_back(bsdf);
  ShapeDescription shape;
  shape.geometry = SphereDescription{middle, radius};
  shape.bsdf = {static_cast<std::uint32_t>(scene.bsdfs.size() - 1)};
  scene.shapes.push_back(shape);
  return name;
}

/// The space for spheres. A camera at an angle to the box sees only what is before it, and the water's level divides
/// the space.
struct Room {
  Bounds3d bounds;
  std::vector<Obstacle> obstacles;
  View view;
};

Room room_of(const SceneDescription& scene) {
  Room room{{}, {}, view_of(scene)};
  for (const ShapeDescription& shape : scene.shapes) {
    const std::optional<Obstacle> obstacle = obstacle_of(shape);
    if (!obstacle)
      throw InputError(scene.where(shape.loc),
                       "no spheres can be put into the scene: where this shape ends is unknown");
    room.obstacles.push_back(*obstacle);
    for (int corner = 0; corner < 8; ++corner)
      room.bounds.add(obstacle->to_world.point({corner & 1 ? obstacle->high.x : obstacle->low.x,
                                                corner & 2 ? obstacle->high.y : obstacle->low.y,
                                                corner & 4 ? obstacle->high.z : obstacle->low.z}));
  }
  if (room.bounds.empty()) throw InputError("more-spheres", "the scene has no shapes, and so no bounds");
  return room;
}

}  // namespace

std::string add_spheres(SceneDescription& scene, std::uint64_t seed) {
  VariantDraws draws(seed, 8);
  Room room = room_of(scene);
  const Vec3d size = room.bounds.high - room.bounds.low;
  const double extent = std::max({size.x, size.y, size.z});
  const int wanted = 2 + draws.below(3), first = draws.below(3);
  int added = 0;
  std::string names;
  constexpr int tries = 4000;
  for (int i = 0; i < tries && added < wanted; ++i) {
    const Vec3d middle{draws.between(room.bounds.low.x, room.bounds.high.x),
                       draws.between(room.bounds.low.y, room.bounds.high.y),
                       draws.between(room.bounds.low.z, room.bounds.high.z)};
    const double radius = extent * draws.between(0.06, 0.12), gap = extent * 0.01;
    if (!in_view(room.view, middle, radius)) continue;
    const auto touches = [&](const Obstacle& o) { return distance_to(o, middle) < radius + gap; };
    if (std::any_of(room.obstacles.begin(), room.obstacles.end(), touches)) continue;
    names += std::string(names.empty() ? "" : ", ") + add_sphere(scene, middle, radius, (first + added) % 3, draws);
    room.obstacles.push_back(*obstacle_of(scene.shapes.back()));
    ++added;
  }
  if (added < 2) throw InputError("more-spheres", "the scene has no room for two more spheres");
  return std::to_string(added) + " more spheres (" + names + ")";
}

}  // namespace photonproof::inline harness_variants
