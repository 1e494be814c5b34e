#include "renderer/limits/near_lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/lights/light.h"
#include "renderer/limits/close_faces.h"
#include "renderer/limits/surface_faces.h"

namespace photonproof::inline renderer_limits {
namespace {

/// A light's middle, and the nearest of the surfaces that it may be near to.
struct LightPlace {
  Vec3d at;
  double within;
  double size;         ///< half of the light's size; the least height that counts
  LightBounds bounds;  ///< the directions it shines to
  bool is_flat;        ///< only parallel surfaces count, on either side
  NearLight nearest;

  void look_at(const Vec3d& point, const Vec3d& normal) {
    const Vec3d down = point - at;
    const double apart = length(down), height = std::max(apart, size);
    if (!(height <= within) || height >= nearest.height) return;
    // A light that lies in a surface lights it where it shines to both sides of the surface.
    if (is_flat ? lies_along(normal) : apart > 0 ? shines(down) : shines(normal) && shines(-normal))
      nearest.height = height;
  }

 private:
  bool shines(const Vec3d& direction) const {
    return angle_between(bounds.axis, Vec3f(normalize(direction))) < bounds.spread + bounds.emission;
  }
  bool lies_along(const Vec3d& normal) const { return std::abs(dot(normalize(normal), Vec3d(bounds.axis))) > 0.9; }
};

/// Nearest surfaces to each light, among those for which `counts` is true.
template <class Counts>
std::vector<NearLight> nearest_surfaces(const SceneParts& scene, std::vector<LightPlace> area_lights,
                                        const Counts& counts) {
  for (LightPlace& area_light : area_lights) area_light.nearest.height = std::numeric_limits<double>::infinity();
  const PlaceTree<LightPlace> places(area_lights);
  for (std::size_t i = 0; i < scene.surfaces.size() && !places.empty(); ++i) {
    const Surface& surface = scene.surfaces[i];
    if (counts(surface))
      places.look_at(surface, scene.boxes[i], [&](LightPlace& area_light, const Vec3d& point, const Vec3d& normal) {
        if (surface.light != area_light.nearest.light) area_light.look_at(point, normal);
      });
  }
  std::vector<NearLight> found;
  for (const LightPlace& area_light : area_lights)
    if (std::isfinite(area_light.nearest.height))
      found.push_back({area_light.nearest.light, area_light.nearest.height / scene.frame.scale,
                       area_light.within / scene.frame.scale});
  std::sort(found.begin(), found.end(), [](const NearLight& a, const NearLight& b) { return a.light < b.light; });
  return found;
}

}  // namespace

std::vector<NearLight> lights_above_spots(const SceneParts& scene, double within) {
  std::vector<LightPlace> area_lights;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const std::optional<LightBounds> bounds = light_bounds(scene.lights[i]);
    if (!bounds) continue;
    const Vec3d low(bounds->low), high(bounds->high);
    const double size = 0.5 * length(high - low);
    if (size <= within * scene.frame.scale)
      area_lights.push_back({(low + high) * 0.5, within * scene.frame.scale, size, *bounds, false, {i, 0, 0}});
  }
  return nearest_surfaces(scene, std::move(area_lights), [&](const Surface& surface) {
    return surface.light == no_index &&
           scene.bsdfs.any_leaf(surface.bsdf, [](const Bsdf& leaf, bool) { return has_smooth(leaf); });
  });
}

std::vector<NearLight> lights_on_surfaces(const SceneParts& scene) {
  std::vector<LightPlace> area_lights;
  for (const Surface& surface : scene.surfaces) {
    if (surface.light == no_index) continue;
    const auto* quad = std::get_if<Quad>(&surface.geometry);
    const auto* disk = std::get_if<Disk>(&surface.geometry);
    if (quad == nullptr && disk == nullptr) continue;
    const Vec3d at = disk != nullptr ? Vec3d(disk->center)
                                     : Vec3d(quad->corner) + Vec3d(quad->edge_u) * 0.5 + Vec3d(quad->edge_v) * 0.5;
    const double reach = std::max(largest_coordinate(at), double{scene.frame.coordinate_floor});
    LightBounds bounds;
    bounds.axis = disk != nullptr ? disk->normal : quad->normal;
    area_lights.push_back({at, steps_resolved * reach, 0, bounds, true, {surface.light, 0, 0}});
  }
  return nearest_surfaces(scene, std::move(area_lights), [&](const Surface& surface) {
    return scene.bsdfs.any_leaf(surface.bsdf,
                                [](const Bsdf& leaf, bool) { return !std::holds_alternative<NullBsdf<float>>(leaf); });
  });
}

}  // namespace photonproof::inline renderer_limits
