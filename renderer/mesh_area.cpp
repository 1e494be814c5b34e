#include "renderer/mesh_area.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "renderer/disc_area.h"

namespace photonproof {
namespace {

constexpr std::size_t most_in_leaf = 8;
constexpr int shared_levels = 5;  // cut level by level, their nodes in parallel; below, subtrees are
constexpr double small_share = 1.0 / 16;
constexpr float margin = 1e-5f;  // of cosines, for rounding: what is within it is looked at more closely

using Corners = std::array<Vec3d, 3>;

float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// The part of a polygon with normal . x <= limit (Sutherland and Hodgman 1974).
struct Polygon {
  std::array<Vec3d, 5> corner;
  std::size_t count = 0;

  void cut(const Vec3d& normal, double limit) {
    const Polygon whole = *this;
    count = 0;
    for (std::size_t i = 0; i < whole.count; ++i) {
      const Vec3d& a = whole.corner[i];
      const Vec3d& b = whole.corner[(i + 1) % whole.count];
      const double from = dot(normal, a) - limit, to = dot(normal, b) - limit;
      if (from <= 0) corner[count++] = a;
      if ((from < 0 && to > 0) || (from > 0 && to < 0)) corner[count++] = a + (b - a) * (from / (from - to));
    }
  }
};

/// Of a triangle, given relative to the ball's centre, what is in the ball and within `height` of the plane through the
/// centre.
double area_within(const Corners& corners, double radius, const Vec3d& plane_normal, double height) {
  double farthest2 = 0, highest = 0;
  for (const Vec3d& x : corners) {
    farthest2 = std::max(farthest2, length_squared(x));
    highest = std::max(highest, std::abs(dot(plane_normal, x)));
  }
  const Vec3d edge = corners[1] - corners[0];
  const Vec3d across = cross(edge, corners[2] - corners[0]);
  const double twice_area = length(across);
  if (!(twice_area > 0)) return 0;
  if (farthest2 <= radius * radius && highest <= height) return twice_area / 2;

  const Vec3d normal = across / twice_area;
  const double above = dot(normal, corners[0]);
  const double circle2 = radius * radius - above * above;
  if (circle2 <= 0) return 0;
  Polygon polygon;
  for (const Vec3d& x : corners) polygon.corner[polygon.count++] = x;
  if (highest > height) {
    polygon.cut(plane_normal, height);
    polygon.cut(-plane_normal, height);
  }
  const Vec3d x_axis = normalize(edge), y_axis = cross(normal, x_axis);
  std::array<Vec2<double>, 5> flat;
  for (std::size_t i = 0; i < polygon.count; ++i)
    flat[i] = {dot(polygon.corner[i], x_axis), dot(polygon.corner[i], y_axis)};
  return polygon_in_circle(std::span(flat).first(polygon.count), std::sqrt(circle2));
}

/// The factor by which a placement scales all lengths, where it does.
std::optional<double> scale_of(const AffineMap& m) {
  const Vec3d x(m.x), y(m.y), z(m.z);
  const double scale2 = dot(x, x);
  for (const double off : {dot(y, y) - scale2, dot(z, z) - scale2, dot(x, y), dot(x, z), dot(y, z)})
    if (std::abs(off) > 1e-5 * scale2) return std::nullopt;
  return std::sqrt(scale2);
}

}  // namespace

struct MeshArea::LookUp {
  Vec3f p, normal;
  double radius, height;
  const AffineMap* placement;  ///< null: p is in the mesh's space

  Corners corners(const Mesh& mesh, std::uint32_t triangle) const {
    Corners x;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3f corner = mesh.corner(triangle, k);
      x[k] = Vec3d(placement == nullptr ? corner : placement->point(corner)) - Vec3d(p);
    }
    return x;
  }
  bool is_alike(const Vec3f& sheet) const {
    const float cosine = dot(sheet, normal);
    return cosine > 0 && cosine * cosine >= length_squared(sheet) * (least_sheet_cosine * least_sheet_cosine);
  }
  bool holds(const Vec3d& x) const {
    return length_squared(x) <= radius * radius && std::abs(dot(Vec3d(normal), x)) <= height;
  }
};

MeshArea::MeshArea(const Mesh& mesh, const Threads& threads) : mesh_(mesh) {
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const Vec3f a = mesh.corner(t, 0), b = mesh.corner(t, 1), c = mesh.corner(t, 2);
    const Vec3d across = cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
    const double twice_area = length(across);
    if (!(twice_area > 0)) continue;
    const Vec3f front(across * ((mesh.inward ? -1 : 1) / twice_area));
    const Vec3f middle = (a + b + c) * (1.0f / 3);
    const float reach = std::sqrt(
        max_component(Vec3f{length_squared(a - middle), length_squared(b - middle), length_squared(c - middle)}));
    items_.push_back({middle, t, sheet_word<float>(front, front), static_cast<float>(twice_area / 2), reach});
  }
  if (items_.empty()) return;
  while ((items_.size() >> leaf_level_) >= most_in_leaf) ++leaf_level_;
  nodes_.resize(std::size_t{2} << leaf_level_);
  const int roots_level = std::min(shared_levels, leaf_level_);
  for (int level = 0; level < roots_level; ++level)
    threads.for_each(std::size_t{1} << level, [&](std::size_t k) { bound(level, k); });
  threads.for_each(std::size_t{1} << roots_level, [&](std::size_t k) { cut_subtree(roots_level, k); });
}

std::size_t MeshArea::memory_bytes() const {
  return items_.capacity() * sizeof(Item) + nodes_.capacity() * sizeof(Node);
}

/// Finds what the node holds and, above the leaves, moves the lower half along its widest axis to the front.
void MeshArea::bound(int level, std::size_t k) {
  const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  const std::size_t begin = begin_of(level, k), end = begin_of(level, k + 1);
  constexpr float most = std::numeric_limits<float>::max();
  Vec3f low(most), high(-most), middle_low(most), middle_high(-most);
  const auto widen = [](Vec3f& l, Vec3f& h, const Vec3f& x) {
    l = {std::min(l.x, x.x), std::min(l.y, x.y), std::min(l.z, x.z)};
    h = {std::max(h.x, x.x), std::max(h.y, x.y), std::max(h.z, x.z)};
  };
  double area = 0;
  Vec3d normals(0.0);
  for (std::size_t i = begin; i < end; ++i) {
    const Item& item = items_[i];
    const Vec3f a = mesh_.corner(item.triangle, 0), b = mesh_.corner(item.triangle, 1),
                c = mesh_.corner(item.triangle, 2);
    widen(low, high, a);
    widen(low, high, b);
    widen(low, high, c);
    widen(middle_low, middle_high, item.middle);
    area += double{item.area};
    normals += Vec3d(unit_sheet_normal(item.sheet));
  }
  Node& node = nodes_[(std::size_t{1} << level) + k];
  node.low = low;
  node.high = high;
  node.area = static_cast<float>(area);
  node.cosine = -1;
  if (length(normals) > 0) {
    node.axis = Vec3f(normalize(normals));
    node.cosine = 1;
    for (std::size_t i = begin; i < end; ++i)
      node.cosine = std::min(node.cosine, dot(node.axis, unit_sheet_normal(items_[i].sheet)));
  }
  if (level == leaf_level_) return;
  const Vec3f extent = middle_high - middle_low;
  const int axis = extent.x >= extent.y ? (extent.x >= extent.z ? 0 : 2) : (extent.y >= extent.z ? 1 : 2);
  std::nth_element(at(begin), at(begin_of(level + 1, 2 * k + 1)), at(end), [axis](const Item& a, const Item& b) {
    return component(a.middle, axis) < component(b.middle, axis);
  });
}

void MeshArea::cut_subtree(int level, std::size_t k) {
  bound(level, k);
  if (level == leaf_level_) return;
  cut_subtree(level + 1, 2 * k);
  cut_subtree(level + 1, 2 * k + 1);
}

double MeshArea::visit(const LookUp& at, int level, std::size_t k) const {
  const Node& node = nodes_[(std::size_t{1} << level) + k];
  // The node's box about the look-up's point, and how far it reaches along the tangent plane's normal.
  Vec3f middle = (node.low + node.high) * 0.5f, half = (node.high - node.low) * 0.5f;
  if (at.placement != nullptr) {
    const AffineMap& m = *at.placement;
    middle = m.point(middle);
    const auto along = [&](float x, float y, float z) {
      return std::abs(x) * half.x + std::abs(y) * half.y + std::abs(z) * half.z;
    };
    half = {along(m.x.x, m.y.x, m.z.x), along(m.x.y, m.y.y, m.z.y), along(m.x.z, m.y.z, m.z.z)};
  }
  const Vec3f off = middle - at.p;
  const Vec3f distance{std::abs(off.x), std::abs(off.y), std::abs(off.z)};
  const Vec3f nearest{std::max(0.0f, distance.x - half.x), std::max(0.0f, distance.y - half.y),
                      std::max(0.0f, distance.z - half.z)};
  const auto radius = static_cast<float>(at.radius), height = static_cast<float>(at.height);
  const float slack = margin * radius;
  if (length_squared(nearest) > (radius + slack) * (radius + slack)) return 0;
  const float above = std::abs(dot(at.normal, off));
  const float reach = std::abs(at.normal.x) * half.x + std::abs(at.normal.y) * half.y + std::abs(at.normal.z) * half.z;
  if (above - reach > height + slack) return 0;

  // A placement changes areas and angles; a scaling one is undone before, the others' nodes are only ever left out.
  if (at.placement == nullptr && node.cosine > 0) {
    const float c = dot(at.normal, node.axis);
    const float spread = std::sqrt(std::max(0.0f, 1 - node.cosine * node.cosine));
    const float tilt = std::sqrt(std::max(0.0f, 1 - c * c));
    const bool none_alike = c < node.cosine && c * node.cosine + tilt * spread < least_sheet_cosine - margin;
    if (none_alike) return 0;
    const bool all_alike = c > 0 && c * node.cosine - tilt * spread > least_sheet_cosine + margin;
    if (all_alike) {
      const Vec3f farthest = distance + half;
      if (length_squared(farthest) <= (radius - slack) * (radius - slack) && above + reach <= height - slack)
        return node.area;
      if (length_squared(half) * 4 <= radius * radius * static_cast<float>(small_share * small_share))
        return at.holds(Vec3d(off)) ? node.area : 0;
    }
  }
  if (level < leaf_level_) return visit(at, level + 1, 2 * k) + visit(at, level + 1, 2 * k + 1);

  double area = 0;
  for (std::size_t i = begin_of(level, k); i < begin_of(level, k + 1); ++i) {
    const Item& item = items_[i];
    const Vec3f sheet = sheet_normal(item.sheet);
    if (at.placement == nullptr) {  // most are all outside or all inside
      const Vec3f from = item.middle - at.p;
      const float distance2 = length_squared(from), outer = radius + item.reach + slack;
      if (distance2 > outer * outer || !at.is_alike(sheet)) continue;
      const float off_plane = std::abs(dot(at.normal, from)), inner = radius - item.reach - slack;
      if (off_plane - item.reach > height + slack) continue;
      if (inner > 0 && distance2 <= inner * inner && off_plane + item.reach <= height - slack) {
        area += double{item.area};
        continue;
      }
    } else if (!at.is_alike(at.placement->normal(sheet))) {
      continue;
    }
    area += area_within(at.corners(mesh_, item.triangle), at.radius, Vec3d(at.normal), at.height);
  }
  return area;
}

double MeshArea::within(const Vec3f& p, const Vec3f& front_normal, float radius) const {
  if (items_.empty()) return 0;
  return visit({p, front_normal, radius, double{sheet_height} * radius, nullptr}, 0, 0);
}

double MeshArea::within(const AffineMap& placement, const Vec3f& p, const Vec3f& front_normal, float radius) const {
  if (items_.empty()) return 0;
  if (const std::optional<double> scale = scale_of(placement)) {
    const Vec3f normal{dot(placement.x, front_normal), dot(placement.y, front_normal), dot(placement.z, front_normal)};
    return *scale * *scale * within(placement.local_point(p), normalize(normal), static_cast<float>(radius / *scale));
  }
  return visit({p, front_normal, radius, double{sheet_height} * radius, &placement}, 0, 0);
}

}  // namespace photonproof
