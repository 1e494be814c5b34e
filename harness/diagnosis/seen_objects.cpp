#include "harness/diagnosis/seen_objects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <variant>

#include "harness/variants/plain_objects.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline harness_diagnosis {
namespace {

struct LocalRay {
  Vec3d origin, direction;
};

std::optional<double> hit_sphere(const SphereDescription& sphere, const LocalRay& ray) {
  const Vec3d to = ray.origin - sphere.center;
  const double a = dot(ray.direction, ray.direction), b = dot(to, ray.direction),
               c = dot(to, to) - sphere.radius * sphere.radius;
  const double root = b * b - a * c;
  if (root < 0) return std::nullopt;
  for (const double t : {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a})
    if (t > 1e-9) return t;
  return std::nullopt;
}

std::optional<double> hit_square(const LocalRay& ray, bool disc) {
  const double t = -ray.origin.z / ray.direction.z;
  if (!(t > 1e-9)) return std::nullopt;
  const double x = ray.origin.x + t * ray.direction.x, y = ray.origin.y + t * ray.direction.y;
  const bool inside = disc ? x * x + y * y <= 1 : std::abs(x) <= 1 && std::abs(y) <= 1;
  return inside ? std::optional(t) : std::nullopt;
}

std::optional<double> hit_box(const LocalRay& ray, const Vec3d& low, const Vec3d& high) {
  const std::array<std::array<double, 4>, 3> slabs{{{ray.origin.x, ray.direction.x, low.x, high.x},
                                                    {ray.origin.y, ray.direction.y, low.y, high.y},
                                                    {ray.origin.z, ray.direction.z, low.z, high.z}}};
  double enters = 1e-9, leaves = std::numeric_limits<double>::infinity();
  for (const auto& [origin, direction, from, to] : slabs) {
    const double a = (from - origin) / direction, b = (to - origin) / direction;
    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  }
  return enters <= leaves ? std::optional(enters) : std::nullopt;
}

std::optional<double> hit_mesh(const MeshDescription& mesh, const LocalRay& ray) {
  Vec3d low(std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3f& p : mesh.mesh->positions) {
    low = {std::min<double>(low.x, p.x), std::min<double>(low.y, p.y), std::min<double>(low.z, p.z)};
    high = {std::max<double>(high.x, p.x), std::max<double>(high.y, p.y), std::max<double>(high.z, p.z)};
  }
  return hit_box(ray, low, high);
}

struct Hit {
  double t;
  Vec3d normal_local;
};

std::optional<Hit> hit_shape(const ShapeDescription& shape, const LocalRay& ray) {
  const auto flat = [](std::optional<double> t) { return t ? std::optional(Hit{*t, {0, 0, 1}}) : std::nullopt; };
  return std::visit(
      Overloaded{[&](const SphereDescription& sphere) -> std::optional<Hit> {
                   const std::optional<double> t = hit_sphere(sphere, ray);
                   if (!t) return std::nullopt;
                   return Hit{*t, ray.origin + *t * ray.direction - sphere.center};
                 },
                 [&](const RectangleDescription&) { return flat(hit_square(ray, false)); },
                 [&](const DiskDescription&) { return flat(hit_square(ray, true)); },
                 [&](const HeightfieldDescription&) { return flat(hit_square(ray, false)); },
                 [&](const CubeDescription&) -> std::optional<Hit> {
                   const std::optional<double> t = hit_box(ray, Vec3d(-1.0), Vec3d(1.0));
                   if (!t) return std::nullopt;
                   const Vec3d p = ray.origin + *t * ray.direction, a{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
                   if (a.x >= a.y && a.x >= a.z) return Hit{*t, {p.x, 0, 0}};
                   return a.y >= a.z ? Hit{*t, {0, p.y, 0}} : Hit{*t, {0, 0, p.z}};
                 },
                 [&](const MeshDescription& mesh) { return flat(hit_mesh(mesh, ray)); },
                 [](const auto&) -> std::optional<Hit> { return std::nullopt; }},
      shape.geometry);
}

/// Normals transform by the inverse transpose.
Vec3d normal_of(const Transform& inverse, const Vec3d& n) {
  const auto& m = inverse.m;
  return normalize(Vec3d{m[0] * n.x + m[4] * n.y + m[8] * n.z, m[1] * n.x + m[5] * n.y + m[9] * n.z,
                         m[2] * n.x + m[6] * n.y + m[10] * n.z});
}

SeenPlace first_seen(const SceneDescription& scene, const std::vector<Transform>& to_local, const Vec3d& origin,
                     const Vec3d& direction) {
  SeenPlace seen;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const LocalRay ray{to_local[i].point(origin), to_local[i].vector(direction)};
    const std::optional<Hit> hit = hit_shape(scene.shapes[i], ray);
    if (!hit || hit->t >= nearest) continue;
    nearest = hit->t;
    seen.object = static_cast<std::uint16_t>(i + 1);
    seen.position_world = origin + nearest * direction;
    seen.normal_world = normal_of(to_local[i], hit->normal_local);
    if (dot(seen.normal_world, direction) > 0) seen.normal_world = -seen.normal_world;
  }
  return seen;
}

/// The wall's name in the camera's view, whose x points left.
std::string wall_name(const SceneDescription& scene, const ShapeDescription& shape) {
  const std::optional<Transform> to_camera = scene.sensor.to_world.inverse();
  if (!to_camera) return "wall";
  const Vec3d n = to_camera->vector(normalize(shape.to_world.vector({0, 0, 1})));
  const Vec3d middle = to_camera->point(shape.to_world.point({0, 0, 0}));
  const Vec3d a{std::abs(n.x), std::abs(n.y), std::abs(n.z)};
  if (a.y >= a.x && a.y >= a.z) return middle.y < 0 ? "floor" : "ceiling";
  if (a.x >= a.z) return middle.x > 0 ? "left wall" : "right wall";
  return n.z < 0 ? "back wall" : "front wall";  // by whether its front faces the camera
}

std::string plain_object_name(const SceneDescription& scene, const ShapeDescription& shape) {
  if (shape.radiance) return "lamp";
  const Look look = look_of(scene, shape);
  if (std::holds_alternative<RectangleDescription>(shape.geometry) && look == Look::diffuse)
    return wall_name(scene, shape);
  const bool field = std::holds_alternative<HeightfieldDescription>(shape.geometry);
  if (field) return look == Look::glass ? "water" : "ground";
  const std::string material = look == Look::mirror ? "mirror " : look == Look::glass ? "glass " : "";
  if (std::holds_alternative<SphereDescription>(shape.geometry)) return material + "sphere";
  if (std::holds_alternative<CubeDescription>(shape.geometry)) return material + "box";
  if (std::holds_alternative<RectangleDescription>(shape.geometry)) return material + "pane";
  return material + "object";
}

}  // namespace

Look look_of(const SceneDescription& scene, const ShapeDescription& shape) {
  if (shape.bsdf.value >= scene.bsdfs.size()) return Look::other;
  return std::visit(Overloaded{[](const DiffuseDescription&) { return Look::diffuse; },
                               [](const ConductorDescription&) { return Look::mirror; },
                               [](const DielectricDescription&) { return Look::glass; },
                               [&](const TwoSidedDescription& sides) {
                                 ShapeDescription front = shape;
                                 front.bsdf = sides.front;
                                 return look_of(scene, front);
                               },
                               [](const RoughConductorDescription&) { return Look::other; },
                               [](const ThinDielectricDescription&) { return Look::other; },
                               [](const RoughDielectricDescription&) { return Look::other; },
                               [](const PlasticDescription&) { return Look::other; },
                               [](const RoughPlasticDescription&) { return Look::other; },
                               [](const PhongDescription&) { return Look::other; },
                               [](const PrincipledDescription&) { return Look::other; },
                               [](const PrincipledThinDescription&) { return Look::other; },
                               [](const LayeredDescription&) { return Look::other; },
                               [](const NullDescription&) { return Look::other; },
                               [](const DiffuseTransmitterDescription&) { return Look::other; },
                               [](const WrappingBsdf auto&) { return Look::other; }},
                    scene.bsdfs[shape.bsdf.value].model);
}

std::vector<SeenPlace> seen_points(const SceneDescription& scene, int width, int height) {
  std::vector<SeenPlace> points(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  const auto* camera = std::get_if<PerspectiveDescription>(&scene.sensor.camera);
  if (!camera) return points;
  std::vector<Transform> to_local;
  for (const ShapeDescription& shape : scene.shapes) to_local.push_back(shape.to_world.inverse().value_or(Transform{}));
  const double up = vertical_tangent(*camera, width, height), across = up * width / height;
  std::size_t i = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x, ++i) {
      const Vec3d local{(1 - 2 * (x + 0.5) / width) * across, (1 - 2 * (y + 0.5) / height) * up, 1};
      points[i] = first_seen(scene, to_local, scene.sensor.to_world.point(local * camera->near_clip),
                             normalize(scene.sensor.to_world.vector(local)));
    }
  return points;
}

std::vector<std::string> object_names(const SceneDescription& scene) {
  std::vector<std::string> names;
  std::map<std::string, std::vector<std::pair<double, std::size_t>>> alike;
  const Transform to_camera = scene.sensor.to_world.inverse().value_or(Transform{});
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) {
    const ShapeDescription& shape = scene.shapes[i];
    names.push_back(plain_object_name(scene, shape));
    const auto* sphere = std::get_if<SphereDescription>(&shape.geometry);
    const Vec3d middle = to_camera.point(shape.to_world.point(sphere ? sphere->center : Vec3d(0.0)));
    alike[names.back()].emplace_back(-middle.x / std::max(1e-9, middle.z), i);
  }
  for (auto& [name, places] : alike) {
    if (places.size() < 2) continue;
    std::sort(places.begin(), places.end());
    for (std::size_t k = 0; k < places.size(); ++k) {
      const char* ending = k == 0 ? "st " : k == 1 ? "nd " : k == 2 ? "rd " : "th ";
      names[places[k].second] = std::to_string(k + 1) + ending + name;
    }
  }
  return names;
}

void set_landmarks(SceneKnowledge& knowledge, const SceneDescription& scene, const std::vector<SeenPlace>& points,
                   int width, int height) {
  const std::vector<std::string> names = object_names(scene);
  struct Sum {
    double x = 0, y = 0, count = 0;
  };
  std::vector<Sum> sums(scene.shapes.size());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint16_t object =
          points[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)].object;
      if (object == 0) continue;
      Sum& sum = sums[object - 1u];
      sum.x += x + 0.5;
      sum.y += y + 0.5;
      sum.count += 1;
    }
  std::vector<std::uint16_t> landmark_of(scene.shapes.size() + 1, 0);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (sums[i].count < 4) continue;
    knowledge.landmarks.push_back(
        {names[i], sums[i].x / sums[i].count, sums[i].y / sums[i].count, std::sqrt(sums[i].count / M_PI)});
    landmark_of[i + 1] = static_cast<std::uint16_t>(knowledge.landmarks.size());
  }
  knowledge.seen.clear();
  for (const SeenPlace& point : points) knowledge.seen.push_back(landmark_of[point.object]);
}

}  // namespace photonproof::inline harness_diagnosis
