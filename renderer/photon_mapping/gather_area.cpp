#include "renderer/photon_mapping/gather_area.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>

#include "renderer/core/radix_sort.h"
#include "renderer/photons/surface_side.h"
#include "renderer/rays/rays.h"
#include "renderer/scene/surface_detail.h"
#include "scenes/base/faults.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

/// Whether all of the surface within a ball of the radius has nearly one normal and one tangent plane.
bool is_one_sheet(const Geometry& geometry, float radius) {
  const float surface_radius = std::visit([](const auto& shape) { return shape.curvature_radius(); }, geometry);
  return radius < 0.99f * 2 * sheet_height * surface_radius;
}
// At the distance r from p, a surface of curvature radius R lies r^2 / 2R off the tangent plane. The versine of the
// normals' angle is r^2 / 2R^2. Both are below the limits for r < 2 sheet_height R.
static_assert(2 * sheet_height * sheet_height < 1 - least_side_cosine);

/// Probability that a hit of the BSDF chooses a leaf that `stores` photons; `weight` gives the numbers of masks and
/// blends.
template <class Stores, class Weight>
float chance_of_leaf(const Scene& scene, std::uint32_t bsdf, bool behind, const Stores& stores, const Weight& weight) {
  const BsdfNode& node = scene.bsdfs.tree[bsdf];
  const auto of = [&](std::uint32_t nested) { return chance_of_leaf(scene, nested, behind, stores, weight); };
  switch (node.kind) {
    case BsdfNode::Kind::leaf:
      return stores(scene.bsdfs.records[bsdf]) ? 1.0f : 0.0f;
    case BsdfNode::Kind::two_sided:
      return of(behind ? node.second : node.first);
    case BsdfNode::Kind::mask:
      return weight(node.number) * of(node.first);
    case BsdfNode::Kind::blend: {
      const float second = weight(node.number);
      return (1 - second) * of(node.first) + second * of(node.second);
    }
    default:
      return of(node.first);
  }
}

/// Areas of meshes with more triangles are measured once for neighbouring points.
constexpr std::size_t most_measured_each = 64;

/// A number for the cell of a point. Points of one cell lie on the same surface, within an eighth of the radius along
/// each axis. Their normals are within some 12 degrees and their radii within 6 %. On a flat surface with a straight
/// border an eighth of the radius changes the area by 8 % at most.
std::uint64_t area_cell(const GatherPoint& point, float radius) {
  constexpr float radius_steps = 12, cells_a_radius = 8;  // steps a factor of 2
  constexpr std::uint32_t normal_step_bits = 6;           // of SurfaceSide::normal_bits
  const float step = std::floor(std::log2(radius) * radius_steps);
  const float scale = cells_a_radius * std::exp2(-step / radius_steps);
  const auto cell = [&](float x) { return std::bit_cast<std::uint64_t>(std::floor(double{x} * double{scale})); };
  const std::uint32_t u = (point.surface_side >> SurfaceSide::normal_bits) & ((1u << SurfaceSide::normal_bits) - 1),
                      v = point.surface_side & ((1u << SurfaceSide::normal_bits) - 1);
  std::uint64_t hash = point.surface;
  const auto add = [&hash](std::uint64_t number) {
    // The finaliser of SplitMix64 (Steele et al. 2014).
    hash = (hash ^ number) + 0x9e3779b97f4a7c15u;
    hash = (hash ^ (hash >> 30)) * 0xbf58476d1ce4e5b9u;
    hash = (hash ^ (hash >> 27)) * 0x94d049bb133111ebu;
    hash ^= hash >> 31;
  };
  add(static_cast<std::uint64_t>(static_cast<std::int64_t>(step)));
  for (const float x : {point.p.x, point.p.y, point.p.z}) add(cell(x));
  add((std::uint64_t{u >> normal_step_bits} << 32) | (v >> normal_step_bits));
  return hash;
}

}  // namespace

GatherAreas::GatherAreas(const Scene& scene, const Threads& threads)
    : scene_(scene), may_miss_(scene.surfaces.size()), mesh_of_(scene.surfaces.size()), covered_(scene) {
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    bool any_stored = false;
    scene.bsdfs.for_each_leaf(scene.surfaces[i].bsdf, [&](const Bsdf& leaf, bool) {
      may_miss_[i].lambertian = may_miss_[i].lambertian || !is_lambertian(leaf);
      may_miss_[i].rough = may_miss_[i].rough || !can_be_rough(leaf);
      any_stored = any_stored || is_lambertian(leaf) || can_be_rough(leaf);
    });
    if (!any_stored) continue;
    if (const auto* curves = std::get_if<Curves>(&scene.surfaces[i].geometry))
      curves_.emplace(static_cast<std::uint32_t>(i), *curves);
    if (const auto* ellipsoids = std::get_if<Ellipsoids>(&scene.surfaces[i].geometry))
      ellipsoids_.emplace(static_cast<std::uint32_t>(i), *ellipsoids);
    const Mesh* mesh = mesh_of(scene.surfaces[i].geometry);
    if (mesh == nullptr) continue;
    std::unique_ptr<const MeshArea>& made = meshes_[mesh];
    if (!made) made = std::make_unique<MeshArea>(*mesh, threads);
    mesh_of_[i] = made.get();
  }
}

std::vector<SheetTest> GatherAreas::tests(float radius) const {
  std::vector<SheetTest> tests;
  tests.reserve(scene_.surfaces.size());
  for (const Surface& surface : scene_.surfaces) {
    // A BSDF that wraps another may be the same on both sides of the surface.
    const SheetTest of_flat = scene_.bsdfs.is_leaf(surface.bsdf) ? SheetTest::none : SheetTest::side;
    tests.push_back(is_one_sheet(surface.geometry, radius) ? of_flat : SheetTest::side_and_normal);
  }
  return tests;
}

void GatherAreas::fill(GatherQueue& points) const {
  const GatherPoints view = points.view();
  const float wrong = has_fault(Fault::density_radius) ? 1.1f : 1.0f;
  RadixSort shared;
  for (std::size_t i = 0; i < view.count; ++i) {
    view.area[i] = 0;
    if (view.found[i] == 0) continue;
    if (shares_area(view.surface[i]))
      shared.items.push_back({area_cell(points[i], view.radius[i]), static_cast<std::uint32_t>(i)});
    else
      view.area[i] = divisor(points[i], wrong * view.radius[i]);
  }
  shared.sort();  // keeps the order of points of one cell
  const auto& items = shared.items;
  double relative = 0;  // area over the square of the radius, at the cell's first point
  for (std::size_t k = 0; k < items.size(); ++k) {
    const std::uint32_t i = items[k].index;
    const double radius = double{wrong} * double{view.radius[i]};
    const GatherPoint point = points[i];
    if (k == 0 || items[k].key != items[k - 1].key)
      relative = double{area(point, static_cast<float>(radius))} / (radius * radius);
    view.area[i] = static_cast<float>(relative * radius * radius) * stored_share(point);
  }
}

bool GatherAreas::shares_area(std::uint32_t surface) const {
  const MeshArea* mesh = mesh_of_[surface_number(surface)];
  const auto* ellipsoids = std::get_if<Ellipsoids>(&scene_.surfaces[surface_number(surface)].geometry);
  return (mesh != nullptr && mesh->triangle_count() > most_measured_each) ||
         (ellipsoids != nullptr && ellipsoids->places.size() > most_measured_each);
}

GatherAreas::TexturePoint GatherAreas::texture_point(const GatherPoint& point) const {
  const Vec3f front = unit_side_normal(point.surface_side);
  std::uint32_t primitive = 0;
  const Geometry& geometry = scene_.surfaces[surface_number(point.surface)].geometry;
  if (mesh_of(geometry) != nullptr || std::holds_alternative<Curves>(geometry)) {
    // A ray from just above finds the triangle or the segment.
    const Vec3f up = facing_side_normal(point.surface_side);
    const Vec3f above = offset_from(point.p, up, up, scene_.view().coordinate_floor);
    primitive = closest_hit<float>(scene_.view(), above, -up, no_index, true, false).primitive;
  }
  const DetailTables& detail = *scene_.view().detail;
  const std::uint32_t surface = surface_number(point.surface);
  TexturePoint at{detail.local(surface, primitive, point.p, front).uv, std::nullopt};
  if (scene_.textures->need_place()) at.placed = detail.placed_point(surface, primitive, point.p);
  return at;
}

float GatherAreas::stored_share(const GatherPoint& point) const {
  const bool is_rough = (point.surface & PhotonSurface::rough) != 0;
  const MayMiss& may_miss = may_miss_[surface_number(point.surface)];
  if (!(is_rough ? may_miss.rough : may_miss.lambertian)) return 1;
  const Surface& surface = scene_.surfaces[surface_number(point.surface)];
  std::optional<TexturePoint> at;
  const auto weight = [&](const TexturedNumber& n) {
    if (n.texture == no_index) return std::clamp(n.value, 0.0f, 1.0f);
    if (!at) at = texture_point(point);
    return std::clamp(scene_.textures->number(n.texture, at->uv, at->placed ? &*at->placed : nullptr), 0.0f, 1.0f);
  };
  const bool behind = (point.surface_side & SurfaceSide::from_behind) != 0;
  const float share = chance_of_leaf(scene_, surface.bsdf, behind, is_rough ? can_be_rough : is_lambertian, weight);
  return share > 0 ? share : 1;
}

float GatherAreas::area(const GatherPoint& point, float radius) const {
  const Geometry& geometry = scene_.surfaces[surface_number(point.surface)].geometry;
  const MeshArea* mesh = mesh_of_[surface_number(point.surface)];
  return std::visit(
      Overloaded{[&](const Mesh&) {
                   return static_cast<float>(mesh->within(point.p, unit_side_normal(point.surface_side), radius));
                 },
                 [&](const MeshInstance& copy) {
                   return static_cast<float>(
                       mesh->within(*copy.placement, point.p, unit_side_normal(point.surface_side), radius));
                 },
                 [&](const Curves& curves) {
                   const Vec3f front = unit_side_normal(point.surface_side);
                   const CurveArea& tubes = curves_.at(surface_number(point.surface));
                   return static_cast<float>(tubes.within(point.p, curves.inward ? -front : front, radius));
                 },
                 [&](const Ellipsoids& e) {
                   const Vec3f front = unit_side_normal(point.surface_side);
                   const EllipsoidArea& all = ellipsoids_.at(surface_number(point.surface));
                   return static_cast<float>(all.within(point.p, e.inward ? -front : front, radius));
                 },
                 [&](const auto& shape) { return covered_.left_of(disc_area(shape, point.p, radius), point, radius); }},
      geometry);
}

}  // namespace photonproof::inline renderer_photon_mapping
