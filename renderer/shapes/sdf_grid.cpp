#include "renderer/shapes/sdf_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "renderer/photons/surface_side.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/local_geometry.h"
#include "renderer/shapes/shape_place.h"

namespace photonproof::inline renderer_shapes {
namespace {

using Cell = std::array<int, 3>;

std::array<double, 3> components(const Vec3d& v) { return {v.x, v.y, v.z}; }
Cell samples_of(const VolumeGrid& grid) { return {grid.width, grid.height, grid.depth}; }

/// Distances at the corners of a voxel; corner 1 is along x, 2 along y and 4 along z.
struct Voxel {
  std::array<double, 8> f;

  Voxel(const VolumeGrid& grid, const Cell& at) {
    const std::size_t row = static_cast<std::size_t>(grid.width), slice = row * static_cast<std::size_t>(grid.height);
    const float* low = grid.values.data() + static_cast<std::size_t>(at[2]) * slice +
                       static_cast<std::size_t>(at[1]) * row + static_cast<std::size_t>(at[0]);
    for (std::size_t i = 0; i < 8; ++i) f[i] = double{low[(i & 1) + (i >> 1 & 1) * row + (i >> 2) * slice]};
  }

  bool has_surface() const {
    return std::ranges::any_of(f, [](double x) { return x <= 0; }) &&
           std::ranges::any_of(f, [](double x) { return x >= 0; });
  }
  /// At a place from 0 to 1 along each axis.
  double value(const Vec3d& w) const {
    const auto along_x = [&](std::size_t i) { return f[i] + (f[i + 1] - f[i]) * w.x; };
    const double low = along_x(0) + (along_x(2) - along_x(0)) * w.y;
    const double high = along_x(4) + (along_x(6) - along_x(4)) * w.y;
    return low + (high - low) * w.z;
  }
  Vec3d gradient(const Vec3d& w) const {
    const auto mix = [](double a, double b, double c, double d, double s, double t) {
      const double low = a + (b - a) * s, high = c + (d - c) * s;
      return low + (high - low) * t;
    };
    return {mix(f[1] - f[0], f[3] - f[2], f[5] - f[4], f[7] - f[6], w.y, w.z),
            mix(f[2] - f[0], f[3] - f[1], f[6] - f[4], f[7] - f[5], w.x, w.z),
            mix(f[4] - f[0], f[5] - f[1], f[6] - f[2], f[7] - f[3], w.x, w.y)};
  }
};

/// The voxel around a place in the grid's coordinates, and the place in it.
struct VoxelPlace {
  Cell cell;
  Vec3d within;
  VoxelPlace(const VolumeGrid& grid, const Vec3d& q) {
    const auto x = components(q);
    std::array<double, 3> w;
    for (std::size_t a = 0; a < 3; ++a) {
      const int last = samples_of(grid)[a] - 2;
      cell[a] = static_cast<int>(std::clamp(std::floor(x[a]), 0.0, static_cast<double>(last)));
      w[a] = std::clamp(x[a] - cell[a], 0.0, 1.0);
    }
    within = {w[0], w[1], w[2]};
  }
};

/// The first zero in [0, 1] of the cubic through the values at 0, 1/3, 2/3 and 1; empty without one.
std::optional<double> first_zero(const std::array<double, 4>& at) {
  const double c0 = at[0], c1 = -5.5 * at[0] + 9 * at[1] - 4.5 * at[2] + at[3];
  const double c2 = 9 * at[0] - 22.5 * at[1] + 18 * at[2] - 4.5 * at[3];
  const double c3 = 4.5 * (at[3] - at[0]) + 13.5 * (at[1] - at[2]);
  const auto value = [&](double s) { return ((c3 * s + c2) * s + c1) * s + c0; };
  // Between the zeros of the derivative the cubic is monotonic.
  std::array<double, 4> cuts{0, 1, 1, 1};
  std::size_t count = 1;
  const double a = 3 * c3, half_b = c2, discriminant = half_b * half_b - a * c1;
  if (discriminant > 0) {
    const double q = -(half_b + std::copysign(std::sqrt(discriminant), half_b));
    std::array<double, 2> roots{q != 0 ? c1 / q : -1, a != 0 ? q / a : -1};
    if (roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    for (const double root : roots)
      if (root > 0 && root < 1) cuts[count++] = root;
  }
  cuts[count] = 1;
  double low = 0, f_low = at[0];
  for (std::size_t i = 1; i <= count; ++i) {
    double high = cuts[i];
    const double f_high = i == count ? at[3] : value(high);
    if (f_low == 0) return low;
    if ((f_low < 0) != (f_high < 0) || f_high == 0) {
      for (int step = 0; step < 60 && low < high; ++step) {  // Newton's steps, or halvings where they leave
        const double middle = (low + high) / 2, f = value(middle);
        const double slope = (3 * c3 * middle + 2 * c2) * middle + c1;
        ((f < 0) == (f_low < 0) ? low : high) = middle;
        const double next = middle - f / slope;
        if (!(next > low && next < high)) {
          if (high - low < 1e-15) break;
          continue;
        }
        const double f_next = value(next);
        ((f_next < 0) == (f_low < 0) ? low : high) = next;
        if (std::abs(next - middle) < 1e-13) return next;
      }
      return (low + high) / 2;
    }
    low = high;
    f_low = f_high;
  }
  return std::nullopt;
}

/// A ray in the grid's coordinates, and its walk from voxel to voxel (Amanatides and Woo 1987).
class Walk {
 public:
  Walk(const VolumeGrid& grid, const Vec3d& origin, const Vec3d& direction, double from, double to)
      : grid_(grid), samples_(samples_of(grid)), origin_(origin), direction_(direction), t_(from), end_(to) {
    const auto o = components(origin), d = components(direction);
    for (std::size_t a = 0; a < 3; ++a) {
      const double most = samples_[a] - 1;
      double enter = -o[a] / d[a], leave = (most - o[a]) / d[a];
      if (enter > leave) std::swap(enter, leave);
      if (d[a] == 0) {
        if (o[a] < 0 || o[a] > most) end_ = -1;
        continue;
      }
      t_ = std::max(t_, enter);
      end_ = std::min(end_, leave);
    }
  }

  /// The first zero's parameter, or shape_missed.
  double run() {
    if (!(t_ <= end_)) return shape_missed;
    const auto o = components(origin_), d = components(direction_);
    Cell cell = VoxelPlace(grid_, origin_ + direction_ * t_).cell;
    for (;;) {
      std::size_t axis = 0;
      double leave = std::numeric_limits<double>::infinity();
      for (std::size_t a = 0; a < 3; ++a) {
        if (d[a] == 0) continue;
        const double t = ((d[a] > 0 ? cell[a] + 1 : cell[a]) - o[a]) / d[a];
        if (t < leave) {
          leave = t;
          axis = a;
        }
      }
      const double until = std::min(std::max(leave, t_), end_);
      if (const double t = zero_in(cell, until); t >= 0) return t;
      cell[axis] += d[axis] > 0 ? 1 : -1;
      if (leave >= end_ || cell[axis] < 0 || cell[axis] > samples_[axis] - 2) return shape_missed;
      t_ = until;
    }
  }

 private:
  double zero_in(const Cell& cell, double until) const {
    const Voxel voxel(grid_, cell);
    if (!voxel.has_surface() || !(until > t_)) return shape_missed;
    std::array<double, 4> at;
    for (std::size_t i = 0; i < 4; ++i) {
      const double t = t_ + (until - t_) * (static_cast<double>(i) / 3);
      at[i] = voxel.value(origin_ + direction_ * t - Vec3d(cell[0], cell[1], cell[2]));
    }
    const std::optional<double> s = first_zero(at);
    return s ? t_ + (until - t_) * *s : shape_missed;
  }

  const VolumeGrid& grid_;
  Cell samples_;
  Vec3d origin_, direction_;
  double t_, end_;
};

/// The image of a gradient in the grid's coordinates: by the inverse's transpose.
Vec3d in_world(const SdfGrid& sdf, const Vec3d& g) {
  const auto& m = sdf.to_grid.m;
  return {m[0] * g.x + m[4] * g.y + m[8] * g.z, m[1] * g.x + m[5] * g.y + m[9] * g.z,
          m[2] * g.x + m[6] * g.y + m[10] * g.z};
}

struct Sheet {
  double value;
  Vec3d gradient;  ///< in the world
};
Sheet sheet_at(const SdfGrid& sdf, const Vec3d& p) {
  const VoxelPlace place(*sdf.grid, sdf.to_grid.point(p));
  const Voxel voxel(*sdf.grid, place.cell);
  return {voxel.value(place.within), in_world(sdf, voxel.gradient(place.within))};
}

Vec3d unit_or_up(const Vec3d& v) {
  const double norm = length(v);
  return norm > 0 ? v / norm : Vec3d(0, 0, 1);
}

/// Mean of the gradients' directions in the eight voxels around the nearest sample, each continued to the place.
Vec3d smooth_normal(const SdfGrid& sdf, const Vec3d& p) {
  const VolumeGrid& grid = *sdf.grid;
  const Vec3d q = sdf.to_grid.point(p);
  const auto x = components(q);
  const VoxelPlace place(grid, q);
  std::array<int, 3> low;       // the lower of the two voxels along each axis
  std::array<double, 3> share;  // of the upper one
  for (std::size_t a = 0; a < 3; ++a) {
    const int last = samples_of(grid)[a] - 2;
    low[a] = static_cast<int>(std::nearbyint(std::clamp(x[a], 0.0, static_cast<double>(last + 1)))) - 1;
    share[a] = low[a] < 0 ? 1 : low[a] >= last ? 0 : x[a] - low[a] - 0.5;
  }
  Vec3d sum(0.0);
  for (std::size_t i = 0; i < 8; ++i) {
    double weight = 1;
    std::array<double, 3> slope{};
    for (std::size_t a = 0; a < 3; ++a) weight *= (i >> a & 1) != 0 ? share[a] : 1 - share[a];
    if (weight == 0) continue;
    for (std::size_t a = 0; a < 3; ++a) {
      Cell cell = place.cell;
      cell[a] = low[a] + static_cast<int>(i >> a & 1);
      slope[a] = components(Voxel(grid, cell).gradient(place.within))[a];
    }
    // The grid's own space is the unit cube: steps along axes of fewer samples are longer.
    const Cell n = samples_of(grid);
    const Vec3d gradient{slope[0] * (n[0] - 1), slope[1] * (n[1] - 1), slope[2] * (n[2] - 1)};
    sum += unit_or_up(gradient) * weight;
  }
  const Cell n = samples_of(grid);
  return unit_or_up(in_world(sdf, {sum.x / (n[0] - 1), sum.y / (n[1] - 1), sum.z / (n[2] - 1)}));
}

}  // namespace

double hit_distance(const SdfGrid& sdf, const ShapeRay& ray) {
  const double from = std::max(ray.t_near, grain_of_ray(ray, sdf.largest));
  return Walk(*sdf.grid, sdf.to_grid.point(ray.origin), sdf.to_grid.vector(ray.direction), from, ray.t_far).run();
}

ShapePoint point_on(const SdfGrid& sdf, const Vec3d& near) {
  Vec3d p = near;
  Sheet sheet = sheet_at(sdf, p);
  for (int step = 0; step < 2; ++step) {
    const double steep = dot(sheet.gradient, sheet.gradient);
    if (!(steep > 0)) break;
    p = p - sheet.gradient * (sheet.value / steep);
    sheet = sheet_at(sdf, p);
  }
  const Vec3d normal = unit_or_up(sheet.gradient);
  return {Vec3f(p), Vec3f(sdf.inward ? -normal : normal)};
}

ShapeBox box_around(const SdfGrid& sdf) {
  Extent extent;
  const Cell n = samples_of(*sdf.grid);
  extent.add_box(sdf.to_world, Vec3d(0.0), {n[0] - 1.0, n[1] - 1.0, n[2] - 1.0});
  return padded_box(extent.low, extent.high);
}

LocalGeometry local_geometry(const SdfGrid& sdf, const AffineMap&, const Vec3f& p, const Vec3f& normal) {
  const Vec3d smooth = sdf.smooth ? smooth_normal(sdf, Vec3d(p)) * (sdf.inward ? -1.0 : 1.0) : Vec3d(normal);
  const Tangents around = any_tangents(Vec3f(smooth));
  return {{0, 0}, around.s, around.t, Vec3f(smooth)};
}

// The sheet is a height over the tangent plane. Polar coordinates there: along each direction the distance at which
// the sheet leaves the ball is found first, then the area element 1 / cos is integrated over the squared distance.
float disc_area(const SdfGrid& sdf, const Vec3f& p_world, float radius) {
  constexpr int directions = 16;
  constexpr std::array<double, 4> nodes{0.0694318442029737, 0.3300094782075719, 0.6699905217924281, 0.9305681557970263};
  constexpr std::array<double, 4> weights{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                          0.1739274225687269};
  const Vec3d p(p_world), n = unit_or_up(sheet_at(sdf, p).gradient);
  const Tangents plane = any_tangents(Vec3f(n));
  const double r = radius, highest = double{sheet_height} * r;
  struct Found {
    Vec3d offset;
    double cosine;
  };
  const auto on_sheet = [&](const Vec3d& foot) -> std::optional<Found> {
    double height = 0;
    for (int step = 0; step < 6; ++step) {
      const Sheet sheet = sheet_at(sdf, p + foot + n * height);
      const double slope = dot(sheet.gradient, n);
      if (!(slope > 0)) return std::nullopt;
      const double by = sheet.value / slope;
      height -= by;
      if (!(std::abs(height) <= 2 * highest)) return std::nullopt;
      if (std::abs(by) < 1e-6 * r) {
        const double cosine = slope / length(sheet.gradient);
        if (std::abs(height) > highest || cosine < double{least_side_cosine}) return std::nullopt;
        return Found{foot + n * height, cosine};
      }
    }
    return std::nullopt;
  };
  double area = 0;
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / directions;
    const Vec3d along = Vec3d(plane.s) * std::cos(angle) + Vec3d(plane.t) * std::sin(angle);
    double reach = r;
    for (int step = 0; step < 3; ++step)
      if (const std::optional<Found> found = on_sheet(along * reach)) reach *= r / length(found->offset);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::optional<Found> found = on_sheet(along * (reach * std::sqrt(nodes[k])));
      if (found) area += weights[k] * reach * reach / found->cosine;
    }
  }
  return static_cast<float>(area * std::numbers::pi / directions);
}

PlacedShape<SdfGrid> placed(const SdfGridDescription& description, const ShapePlace& place) {
  SdfGrid sdf;
  sdf.grid = description.grid;
  const Cell n = samples_of(*sdf.grid);
  sdf.to_world = place.to_world * Transform::scale({1.0 / (n[0] - 1), 1.0 / (n[1] - 1), 1.0 / (n[2] - 1)});
  const std::optional<Transform> inverse = sdf.to_world.inverse();
  if (!inverse) place.refuse("to_world has no inverse");
  sdf.to_grid = *inverse;
  sdf.smooth = description.normals == SdfGridDescription::Normals::smooth;
  sdf.inward = place.shape.flip_normals;
  const ShapeBox box = box_around(sdf);
  sdf.largest = std::max(largest_coordinate(Vec3d(box.low)), largest_coordinate(Vec3d(box.high)));
  return {sdf, AffineMap(place.to_world), std::nullopt};
}

Extent extent_of(const SdfGridDescription&, const Transform& to_world) {
  Extent extent;
  extent.add_box(to_world, Vec3d(0.0), Vec3d(1.0));
  return extent;
}

Vec3d nearest_on(const SdfGridDescription&, const Transform& to_world, const Vec3d& to) {
  const std::optional<Transform> to_local = to_world.inverse();
  const Vec3d local = to_local ? to_local->point(to) : Vec3d(0.0);
  return to_world.point({std::clamp(local.x, 0.0, 1.0), std::clamp(local.y, 0.0, 1.0), std::clamp(local.z, 0.0, 1.0)});
}

}  // namespace photonproof::inline renderer_shapes
