#include "renderer/planning/area_price.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <variant>
#include <vector>

#include "renderer/photons/surface_side.h"

namespace photonproof::inline renderer_planning {
namespace {

// Measured on landscapes of 1e4 triangles at 128x128 with 8 samples, one thread: 2 microseconds a gather, and 4 by
// these.
constexpr double triangle_within = 6, triangle_on_border = 180;  // ns
// With more triangles, groups of them count by a sample: 40 microseconds on landscapes of 1e5.
constexpr double most_by_samples = 40e3;  // ns
// Flat groups of triangles an eighth of the radius wide count whole: so many are within and on the border.
constexpr double groups_within = 200, groups_on_border = 50, group_on_border = 100;  // ns

double area_of(const Mesh& mesh) {
  double twice = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3f a = mesh.corner(t, 0);
    twice += double{length(cross(mesh.corner(t, 1) - a, mesh.corner(t, 2) - a))};
  }
  return twice / 2;
}

/// Whether normals hardly turn over `length`, by the median of pairs of triangles with a common edge that follow each
/// other in the file.
bool is_smooth_over(const Mesh& mesh, double length_scale) {
  constexpr std::size_t most_pairs = 4096;
  const auto& triangles = mesh.source->triangles;
  const std::size_t step = std::max<std::size_t>(1, triangles.size() / most_pairs);
  std::vector<double> turns;  // angle a unit of length
  for (std::size_t t = 0; t + 1 < triangles.size(); t += step) {
    std::size_t common = 0;
    for (const std::uint32_t a : triangles[t])
      for (const std::uint32_t b : triangles[t + 1]) common += a == b ? 1 : 0;
    if (common < 2) continue;
    std::array<Vec3d, 2> middle, normal;
    for (const std::size_t i : {0u, 1u}) {
      const Vec3d a(mesh.corner(t + i, 0)), b(mesh.corner(t + i, 1)), c(mesh.corner(t + i, 2));
      middle[i] = (a + b + c) / 3;
      normal[i] = cross(b - a, c - a);
    }
    const double sizes = length(normal[0]) * length(normal[1]), apart = length(middle[1] - middle[0]);
    if (sizes > 0 && apart > 0)
      turns.push_back(std::acos(std::clamp(dot(normal[0], normal[1]) / sizes, -1.0, 1.0)) / apart);
  }
  if (turns.empty()) return false;
  const auto median = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), median, turns.end());
  return *median * length_scale < std::acos(double{least_side_cosine}) / 2;
}

/// Factor of areas by a placement: exact where it scales all lengths alike.
double area_factor(const MeshInstance& copy) {
  const AffineMap& m = *copy.placement;
  return std::pow(std::abs(dot(Vec3d(m.x), cross(Vec3d(m.y), Vec3d(m.z)))), 2.0 / 3);
}

}  // namespace

double AreaPrices::time_of(const std::vector<double>& gathers) const {
  double sum = 0;
  for (std::size_t i = 0; i < price_.size(); ++i) sum += gathers[i] * price_[i];
  return sum;
}

AreaPrices::AreaPrices(const Scene& scene, float radius) {
  struct Facts {
    double area;
    bool smooth;
  };
  std::map<const Mesh*, Facts> known_meshes;  // instances share meshes
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
    const Mesh* mesh = mesh_of(scene.surfaces[i].geometry);
    if (mesh == nullptr) continue;
    auto known = known_meshes.find(mesh);
    if (known == known_meshes.end())
      known = known_meshes.emplace(mesh, Facts{area_of(*mesh), is_smooth_over(*mesh, double{radius} / 8)}).first;
    const auto* copy = std::get_if<MeshInstance>(&scene.surfaces[i].geometry);
    const double area = known->second.area * (copy != nullptr ? area_factor(*copy) : 1),
                 count = static_cast<double>(mesh->triangle_count());
    const double disc = std::numbers::pi * double{radius} * double{radius};
    const double within = disc < area ? count * disc / area : count;
    const double on_border = std::min(within, std::sqrt(4 * std::numbers::pi * within));
    price_.resize(scene.surfaces.size());
    price_[i] = known->second.smooth
                    ? triangle_within * std::min(within, groups_within) +
                          group_on_border * std::min(on_border, groups_on_border)
                    : std::min(most_by_samples, triangle_within * within + triangle_on_border * on_border);
  }
}

}  // namespace photonproof::inline renderer_planning
