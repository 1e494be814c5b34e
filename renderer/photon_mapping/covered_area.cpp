#include "renderer/photon_mapping/covered_area.h"

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "renderer/areas/solid_search.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Smallest uncovered area, in squared radii: a disc with less left is a rounding error.
constexpr double least_left = 1e-4;
/// Limit of a scene's footprints, each of up to 3 kB. Scenes with more are seen from so far that footprints are small.
constexpr std::size_t most_footprints = 100'000;

struct PlacedSolid {
  Solid solid;
  std::size_t first = 0, count = 1;  ///< its surfaces

  bool has(std::size_t surface) const { return surface >= first && surface < first + count; }
};

bool is_opaque(const SceneParts& scene, std::size_t surface) {
  return !scene.bsdfs.any_leaf(scene.surfaces[surface].bsdf,
                               [](const Bsdf& leaf, bool) { return lets_light_through(leaf); });
}

std::vector<ShapeBox> boxes_of(const std::vector<Light>& lights) {
  std::vector<ShapeBox> boxes;
  for (const Light& light : lights)
    if (const std::optional<LightBounds> bounds = light_bounds(light)) boxes.push_back({bounds->low, bounds->high});
  return boxes;
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
  const HeldBoxes lights(boxes_of(scene.lights));
  const auto add = [&](const std::optional<Solid>& solid, std::size_t first, std::size_t count) {
    if (solid && is_opaque(scene, first) && !lights.any_in(*solid)) solids.push_back({*solid, first, count});
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

std::optional<FlatBounds> flat_bounds(const Geometry& geometry) {
  if (const auto* quad = std::get_if<Quad>(&geometry)) return FlatBounds(*quad);
  if (const auto* plane = std::get_if<renderer_shapes::Plane>(&geometry)) return FlatBounds(*plane);
  return std::nullopt;
}

SolidTree tree_of(const std::vector<PlacedSolid>& placed) {
  std::vector<Solid> solids;
  solids.reserve(placed.size());
  for (const PlacedSolid& p : placed) solids.push_back(p.solid);
  return SolidTree(solids);
}

}  // namespace

CoveredAreas::CoveredAreas(const SceneParts& scene) {
  const std::vector<PlacedSolid> solids = solids_of(scene);
  if (solids.empty()) return;
  const SolidTree tree = tree_of(solids);
  part_of_.assign(scene.surfaces.size(), {no_index, no_index});
  std::size_t total = 0;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const std::optional<FlatBounds> flat = flat_bounds(scene.surfaces[i].geometry);
    if (!flat) continue;
    std::array<std::vector<Footprint>, 2> sides;
    for (const std::uint32_t number : tree.near_flat(*flat)) {
      if (solids[number].has(i)) continue;
      const std::optional<Footprint> found = footprint(solids[number].solid, scene.surfaces[i].geometry);
      if (!found) continue;
      for (const bool behind : {false, true})
        if (found->covers(behind)) sides[behind ? 1 : 0].push_back(*found);
      if (++total <= most_footprints) continue;
      part_of_.clear();
      parts_.clear();
      return;
    }
    for (std::size_t side = 0; side < sides.size(); ++side) {
      if (sides[side].empty()) continue;
      part_of_[i][side] = static_cast<std::uint32_t>(parts_.size());
      parts_.emplace_back(std::move(sides[side]));
    }
  }
}

float CoveredAreas::left_of(const CoveredPart& part, float area, const GatherPoint& point, float radius) {
  const double least = least_left * static_cast<double>(radius) * static_cast<double>(radius);
  const double left = part.left_of(static_cast<double>(area), Vec3d(point.p), static_cast<double>(radius));
  return left > least ? static_cast<float>(left) : 0.0f;
}

}  // namespace photonproof::inline renderer_photon_mapping
