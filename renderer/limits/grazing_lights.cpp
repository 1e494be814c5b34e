#include "renderer/limits/grazing_lights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "renderer/lights/light.h"
#include "renderer/limits/surface_faces.h"

namespace photonproof::inline renderer_limits {
namespace {

/// Largest relative rounding error of a number in single precision.
constexpr double half_step = 0x1p-24;
/// Relative error of a cosine that needs no warning.
constexpr double least_loss = 1e-3;

Extent extent_of_light(const LightBounds& bounds) { return {Vec3d(bounds.low), Vec3d(bounds.high)}; }

/// A light that is small, and how it grazes the surfaces near it.
struct LowLight {
  Vec3d at;
  double within;  ///< largest distance of a surface
  LightBounds bounds;
  GrazingLight worst;
};

class LowLights {
 public:
  /// `reach`: distance of most lit surfaces from the origin.
  explicit LowLights(double reach) : reach_(reach) {}

  /// Before any surface is looked at.
  void add(std::size_t light, const LightBounds& bounds) {
    const Extent area_light = extent_of_light(bounds);
    const Vec3d at = area_light.middle();
    const double size = largest_coordinate(area_light.high - area_light.low) * 0.5;
    const double within = half_step * std::numbers::sqrt3 * std::max(largest_coordinate(at), reach_) / least_loss;
    if (size < within) lights_.push_back({at, within, bounds, {light, false, 0, 0}});
  }

  bool empty() const { return lights_.empty(); }

  PlaceTree<LowLight> places() { return PlaceTree<LowLight>(lights_); }

  void tell(std::vector<GrazingLight>& found) const {
    for (const LowLight& area_light : lights_)
      if (area_light.worst.rounding > 0) found.push_back(area_light.worst);
  }

  void compare(LowLight& area_light, const Vec3d& point, Vec3d normal) const {
    const Vec3d apart = area_light.at - point;
    const double height = length(apart), lost = rounding(point, normal);
    if (!(height > 0) || !(lost > least_loss * height)) return;
    if (height > lost ? dot(apart, normal) < 0 : dot(Vec3d(area_light.bounds.axis), normal) < 0) normal = -normal;
    if (!shines_below(area_light.bounds, normal)) return;
    if (lost / height <= area_light.worst.loss()) return;
    area_light.worst.height = height;
    area_light.worst.rounding = lost;
  }

 private:
  /// Largest change by rounding both of the height of `at` above the plane through `point`. It is 0 along axes that are
  /// normal to the plane if the plane goes through the origin.
  double rounding(const Vec3d& point, const Vec3d& normal) const {
    const auto along = [&](double n, double other, double another, double p) {
      return std::abs(n) * std::max(std::abs(p), std::hypot(other, another) * reach_);
    };
    return half_step * (along(normal.x, normal.y, normal.z, point.x) + along(normal.y, normal.z, normal.x, point.y) +
                        along(normal.z, normal.x, normal.y, point.z));
  }

  static bool shines_below(const LightBounds& bounds, const Vec3d& up) {
    constexpr double slack = 2e-3;
    return angle_between(bounds.axis, Vec3f(-up)) < pi / 2 + bounds.spread + bounds.emission - slack;
  }

  double reach_;
  std::vector<LowLight> lights_;
};

/// Beams, and lights so far away that theirs is a beam.
class GrazingBeams {
 public:
  explicit GrazingBeams(double reach) : reach_(reach) {}

  /// Lights this many times as far away as most lit surfaces count as beams.
  static constexpr double far_away = 256;

  /// Before any surface is looked at.
  void add(std::size_t light, const Vec3d& direction) { beams_.push_back({direction, 0, {light, true, 0, 0}}); }
  void arrange() {
    std::vector<BoxTree::Part> parts;
    parts.reserve(beams_.size());
    for (const Beam& beam : beams_) parts.push_back(part_of_box(padded_box(beam.direction, beam.direction)));
    tree_ = BoxTree(parts, order_);
  }
  bool empty() const { return beams_.empty(); }

  void look_at(const Surface& surface) {
    const double most_area = far_away * reach_ * reach_;
    if (const auto* plane = std::get_if<Plane>(&surface.geometry)) compare(plane->normal, most_area);
    if (const auto* disk = std::get_if<Disk>(&surface.geometry))
      compare(Vec3d(disk->normal), double{pi} * length(Vec3d(cross(disk->axis_x, disk->axis_y))));
    constexpr std::size_t most_triangles = 4096;
    const bool is_copy = std::holds_alternative<MeshInstance>(surface.geometry);
    if (is_copy && mesh_of(surface.geometry)->triangle_count() > most_triangles) return;
    for_each_face(surface, [&](const FlatFace& face) {
      const Vec3d across = cross(face.u, face.v);
      const double area = length(across);
      if (area > 0) compare(across * (1 / area), std::min(face.is_triangle ? 0.5 * area : area, most_area));
    });
  }

  void tell(std::vector<GrazingLight>& found) const {
    // A smaller share does not show beside surfaces lit at larger angles.
    constexpr double least_share = 0.5;
    for (const Beam& beam : beams_)
      if (beam.grazed > 0 && beam.grazed >= least_share * area_) found.push_back(beam.worst);
  }

 private:
  struct Beam {
    Vec3d direction;
    double grazed;  ///< area of faces
    GrazingLight worst;
  };

  /// A tree over the directions leaves out beams that meet the face at larger angles. The rest lie around a great
  /// circle, so that the search visits some square root of their number.
  void compare(const Vec3d& n, double area) {
    area_ += area;
    constexpr double largest_sine = 2 * half_step / least_loss;
    const auto grazes = [&](const ShapeBox& directions) {
      const Vec3d middle = (Vec3d(directions.low) + Vec3d(directions.high)) / 2;
      const Vec3d half = Vec3d(directions.high) - middle;
      const double reach = std::abs(n.x) * half.x + std::abs(n.y) * half.y + std::abs(n.z) * half.z;
      return std::abs(dot(n, middle)) <= reach + 1.01 * largest_sine;
    };
    tree_.visit(grazes, [&](std::uint32_t place) { compare(beams_[order_[place]], n, area); });
  }

  static void compare(Beam& beam, const Vec3d& n, double area) {
    const Vec3d& d = beam.direction;
    const double sine = std::abs(dot(n, d));
    if (!(sine > 0)) return;
    const double lost = 2 * half_step * (std::abs(n.x * d.x) + std::abs(n.y * d.y) + std::abs(n.z * d.z));
    if (!(lost > least_loss * sine)) return;
    beam.grazed += area;
    if (lost / sine <= beam.worst.loss()) return;
    beam.worst.height = sine;
    beam.worst.rounding = lost;
  }

  double reach_, area_ = 0;
  std::vector<Beam> beams_;
  std::vector<std::uint32_t> order_;  ///< the beam at each place of the tree
  BoxTree tree_;                      ///< over points on the unit sphere
};

}  // namespace

std::vector<GrazingLight> grazing_lights(const SceneParts& scene) {
  // Lit and visible points are about as far from the origin as the shapes or the camera are.
  const double reach =
      std::max(2 * double{scene.frame.coordinate_floor}, largest_coordinate(Vec3d(scene.camera.origin)));
  LowLights area_lights(reach);
  GrazingBeams beams(reach);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (const auto* beam = std::get_if<DirectionalLight<float>>(&scene.lights[i])) beams.add(i, Vec3d(beam->direction));
    const std::optional<LightBounds> bounds = light_bounds(scene.lights[i]);
    if (!bounds) continue;
    const Extent area_light = extent_of_light(*bounds);
    const Vec3d at = area_light.middle();
    const double away = length(at);
    if (away > GrazingBeams::far_away * reach && length(area_light.high - area_light.low) < least_loss * away)
      beams.add(i, at * (1 / away));
    else
      area_lights.add(i, *bounds);
  }
  std::vector<GrazingLight> found;
  if (area_lights.empty() && beams.empty()) return found;
  const PlaceTree<LowLight> places = area_lights.places();
  beams.arrange();
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (surface.light != no_index) continue;  // what it is lit by does not show beside its own light
    if (!scene.bsdfs.any_leaf(surface.bsdf, [](const Bsdf& leaf, bool) { return has_smooth(leaf); })) continue;
    places.look_at(surface, scene.boxes[i], [&](LowLight& area_light, const Vec3d& point, const Vec3d& normal) {
      area_lights.compare(area_light, point, normalize(normal));
    });
    if (!beams.empty()) beams.look_at(surface);
  }
  area_lights.tell(found);
  beams.tell(found);
  std::sort(found.begin(), found.end(), [](const GrazingLight& a, const GrazingLight& b) { return a.light < b.light; });
  for (GrazingLight& light : found) {
    if (light.from_one_side) continue;
    light.height /= scene.frame.scale;
    light.rounding /= scene.frame.scale;
  }
  return found;
}

}  // namespace photonproof::inline renderer_limits
