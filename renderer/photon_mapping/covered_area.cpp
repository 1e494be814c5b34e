#include "renderer/photon_mapping/covered_area.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Smallest uncovered area, in squared radii: a disc with less left is a rounding error.
constexpr double least_left = 1e-4;
/// Limit of pairs, as every flat surface is tested with every solid. Larger scenes are seen from so far that footprints
/// are small.
constexpr std::size_t pairs_worth_testing = 1'000'000;

struct PlacedSolid {
  Solid solid;
  std::size_t first = 0, count = 1;  ///< its surfaces

  bool has(std::size_t surface) const { return surface >= first && surface < first + count; }
};

bool is_opaque(const SceneParts& scene, std::size_t surface) {
  return !scene.bsdfs.any_leaf(scene.surfaces[surface].bsdf,
                               [](const Bsdf& leaf, bool) { return lets_light_through(leaf); });
}

/// Whether the solid contains a light, in box tests. True where it contains a corner or the middle of the box around a
/// light, or that box contains the solid's middle.
bool holds_light(const SceneParts& scene, const Solid& solid) {
  return std::ranges::any_of(scene.lights, [&](const Light& light) {
    const std::optional<LightBounds> box = light_bounds(light);
    if (!box) return false;
    const Vec3d low(box->low), high(box->high), m = solid.middle;
    const bool around = m.x > low.x && m.x < high.x && m.y > low.y && m.y < high.y && m.z > low.z && m.z < high.z;
    if (around || solid.holds((low + high) / 2)) return true;
    for (int i = 0; i < 8; ++i)
      if (solid.holds({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z})) return true;
    return false;
  });
}

/// The solid of a single shape. Cubes are made of six surfaces.
std::optional<Solid> solid_of(const Geometry& geometry) {
  using MaybeSolid = std::optional<Solid>;
  return std::visit(
      Overloaded{[](const Sphere& ball) -> MaybeSolid { return Solid::of_ball(ball); },
                 [](const Quad&) { return MaybeSolid(); }, [](const renderer_shapes::Plane&) { return MaybeSolid(); },
                 [](const Disk&) { return MaybeSolid(); }, [](const Cylinder&) { return MaybeSolid(); },
                 [](const Mesh&) { return MaybeSolid(); }, [](const MeshInstance&) { return MaybeSolid(); },
                 [](const Curves&) { return MaybeSolid(); }, [](const SdfGrid&) { return MaybeSolid(); },
                 [](const Ellipsoids&) { return MaybeSolid(); }},
      geometry);
}

std::vector<PlacedSolid> solids_of(const SceneParts& scene) {
  std::vector<PlacedSolid> solids;
  const auto add = [&](const std::optional<Solid>& solid, std::size_t first, std::size_t count) {
    if (solid && is_opaque(scene, first) && !holds_light(scene, *solid)) solids.push_back({*solid, first, count});
  };
  for (const std::size_t first : scene.cubes) {
    std::array<const Quad*, 6> sides{};
    for (std::size_t i = 0; i < 6; ++i) sides[i] = std::get_if<Quad>(&scene.surfaces[first + i].geometry);
    add(Solid::of_cube(sides), first, 6);
  }
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) add(solid_of(scene.surfaces[i].geometry), i, 1);
  return solids;
}

/// The solid's footprint on a flat surface; empty for other shapes, whose gathers use their whole discs.
std::optional<Footprint> footprint(const Solid& solid, const Geometry& geometry) {
  using MaybeFootprint = std::optional<Footprint>;
  return std::visit(
      Overloaded{[&](const Quad& quad) { return Footprint::of(solid, quad); },
                 [&](const renderer_shapes::Plane& plane) { return Footprint::of(solid, plane); },
                 [](const Disk&) { return MaybeFootprint(); }, [](const Sphere&) { return MaybeFootprint(); },
                 [](const Cylinder&) { return MaybeFootprint(); }, [](const Mesh&) { return MaybeFootprint(); },
                 [](const MeshInstance&) { return MaybeFootprint(); }, [](const Curves&) { return MaybeFootprint(); },
                 [](const SdfGrid&) { return MaybeFootprint(); }, [](const Ellipsoids&) { return MaybeFootprint(); }},
      geometry);
}

/// Area that two footprints cover must count once: of overlapping footprints only the largest stays.
void keep_apart(std::vector<Footprint>& footprints) {
  std::ranges::stable_sort(footprints, std::ranges::greater{}, [](const Footprint& f) { return f.area(); });
  std::vector<Footprint> apart;
  for (const Footprint& f : footprints)
    if (std::ranges::none_of(apart, [&](const Footprint& larger) { return f.overlaps(larger); })) apart.push_back(f);
  footprints = std::move(apart);
}

}  // namespace

CoveredAreas::CoveredAreas(const SceneParts& scene) : front_(scene.surfaces.size()), back_(scene.surfaces.size()) {
  const std::vector<PlacedSolid> solids = solids_of(scene);
  if (solids.size() * scene.surfaces.size() > pairs_worth_testing) return;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    for (const PlacedSolid& placed : solids) {
      if (placed.has(i)) continue;
      const std::optional<Footprint> found = footprint(placed.solid, scene.surfaces[i].geometry);
      if (!found) continue;
      if (found->covers(false)) front_[i].push_back(*found);
      if (found->covers(true)) back_[i].push_back(*found);
    }
    keep_apart(front_[i]);
    keep_apart(back_[i]);
  }
}

float CoveredAreas::left_of(const std::vector<Footprint>& covered, float area, const GatherPoint& point, float radius) {
  double left = static_cast<double>(area);
  const double least = least_left * static_cast<double>(radius) * static_cast<double>(radius);
  for (const Footprint& f : covered) left -= f.in_disc(Vec3d(point.p), static_cast<double>(radius));
  return left > least ? static_cast<float>(left) : 0.0f;
}

}  // namespace photonproof::inline renderer_photon_mapping
