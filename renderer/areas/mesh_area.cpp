#include "renderer/areas/mesh_area.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "renderer/lanes/lane_trig.h"
#include "renderer/lanes/sampler.h"
#include "renderer/photons/surface_side.h"

namespace photonproof::inline renderer_areas {
namespace {

constexpr int shared_levels = 5;  // cut level by level, their nodes in parallel; below, subtrees are
/// Shares of the radius. Triangles and flat groups of them that are smaller count by their middle; smaller groups of
/// other triangles count by a sample.
constexpr float small_share = 1.0f / 8, sampled_share = 1.0f / 6;
constexpr float margin = 1e-5f;  // of cosines, for rounding: what is within it is looked at more closely

using Corners = std::array<Vec3d, 3>;

constexpr float square(float x) { return x * x; }
float component(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// A convex polygon, counterclockwise about its normal.
struct Polygon {
  std::array<Vec3d, 5> corner;
  std::size_t count = 0;

  std::size_t after(std::size_t i) const { return i + 1 == count ? 0 : i + 1; }

  /// Leaves the part with normal . x <= limit (Sutherland and Hodgman 1974).
  void cut(const Vec3d& normal, double limit) {
    const Polygon whole = *this;
    std::array<double, 5> off{};
    for (std::size_t i = 0; i < whole.count; ++i) off[i] = dot(normal, whole.corner[i]) - limit;
    count = 0;
    for (std::size_t i = 0; i < whole.count; ++i) {
      const Vec3d& a = whole.corner[i];
      const double from = off[i], to = off[whole.after(i)];
      if (from <= 0) corner[count++] = a;
      if ((from < 0 && to > 0) || (from > 0 && to < 0))
        corner[count++] = a + (whole.corner[whole.after(i)] - a) * (from / (from - to));
    }
  }
};

/// The plane of a polygon about the origin, and the circle that the ball cuts out of it.
struct CutPlane {
  Vec3d across;    ///< along the normal
  double length;   ///< of `across`
  double above2;   ///< squared distance from the origin
  double circle2;  ///< squared radius of the circle, above 0
};

/// Area of the polygon in the circle: half the sum of two parts. One is p x q over each edge's part in the circle, from
/// p to q. The other is the sectors between where one edge leaves and the next enters.
double area_in_circle(const Polygon& polygon, const CutPlane& plane) {
  constexpr double tiny_angle = 1e-6;  // rounding decides whether it is 0 or a full turn
  const double radius2 = plane.circle2 + plane.above2, unit = 1 / (plane.circle2 * plane.length);
  std::array<double, 5> outside{};  // by how much corners are, of squared distances
  for (std::size_t i = 0; i < polygon.count; ++i) outside[i] = length_squared(polygon.corner[i]) - radius2;
  double chords = 0, angles = 0;
  bool surrounds = true, has_tiny = false;  // the polygon, the circle's centre
  Vec3d first_entry, last_exit;
  bool has_first_entry = false, has_exit = false;
  const auto add_arc = [&](const Vec3d& from, const Vec3d& to) {
    const double sine = dot(plane.across, cross(from, to)) * unit;
    const double cosine = (dot(from, to) - plane.above2) * plane.length * unit;
    if (cosine > 0 && std::abs(sine) < tiny_angle) {
      has_tiny = true;
      return;
    }
    const double least = angle_of(static_cast<float>(std::abs(sine)), static_cast<float>(cosine));
    angles += sine >= 0 ? least : 2 * std::numbers::pi - least;
  };
  for (std::size_t i = 0; i < polygon.count; ++i) {
    const std::size_t next = polygon.after(i);
    const Vec3d &a = polygon.corner[i], &b = polygon.corner[next];
    const double twice = dot(plane.across, cross(a, b)) * unit;
    surrounds = surrounds && twice >= 0;
    const bool from_outside = outside[i] > 0, to_outside = outside[next] > 0;
    if (!from_outside && !to_outside) {
      chords += twice;
      continue;
    }
    const Vec3d d = b - a;
    const double length2 = length_squared(d), half_b = dot(a, d);
    if (from_outside && to_outside && !(half_b < 0 && -half_b < length2)) continue;
    const double discriminant = half_b * half_b - length2 * outside[i];
    if (from_outside && to_outside && !(discriminant > 0)) continue;
    const double root = std::sqrt(std::max(discriminant, 0.0)), each = 1 / length2;
    const double enter = from_outside ? std::clamp((-half_b - root) * each, 0.0, 1.0) : 0;
    const double leave = to_outside ? std::clamp((-half_b + root) * each, enter, 1.0) : 1;
    chords += twice * (leave - enter);
    if (from_outside) {
      const Vec3d entry = a + d * enter;
      if (has_exit) {
        add_arc(last_exit, entry);
      } else {
        first_entry = entry;
        has_first_entry = true;
      }
    }
    if (to_outside) {
      last_exit = a + d * leave;
      has_exit = true;
    }
  }
  if (has_first_entry) add_arc(last_exit, first_entry);
  const bool is_untouched = !has_exit && outside[0] > 0;
  if (is_untouched) angles = surrounds ? 2 * std::numbers::pi : 0;
  if (has_tiny && surrounds && chords + angles < 1) angles = 2 * std::numbers::pi;
  return (chords + angles) * plane.circle2 / 2;
}

/// Area of a triangle, given relative to the ball's centre, in the ball and within `height` of the plane through the
/// centre.
double area_within(const Corners& corners, double radius, const Vec3d& plane_normal, double height) {
  double farthest2 = 0, highest = -height, lowest = height;
  for (const Vec3d& x : corners) {
    farthest2 = std::max(farthest2, length_squared(x));
    const double off = dot(plane_normal, x);
    highest = std::max(highest, off);
    lowest = std::min(lowest, off);
  }
  const Vec3d across = cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double length2 = length_squared(across);
  if (!(length2 > 0)) return 0;
  const double twice_area = std::sqrt(length2);
  if (farthest2 <= radius * radius && highest <= height && lowest >= -height) return twice_area / 2;

  const double along = dot(across, corners[0]), above2 = along * along / length2;
  const CutPlane plane{across, twice_area, above2, radius * radius - above2};
  if (plane.circle2 <= 0) return 0;
  Polygon polygon;
  for (const Vec3d& x : corners) polygon.corner[polygon.count++] = x;
  if (highest > height || lowest < -height) {
    // The circle's own reach from the plane through the centre: that of its middle, and by the planes' angle.
    const double toward = dot(plane_normal, across);
    const double room = height - std::abs(along * toward) / length2;
    const bool is_all_within = room >= 0 && room * room >= plane.circle2 * (1 - toward * toward / length2);
    if (!is_all_within) {
      if (highest > height) polygon.cut(plane_normal, height);
      if (lowest < -height) polygon.cut(-plane_normal, height);
      if (polygon.count < 3) return 0;
    }
  }
  return area_in_circle(polygon, plane);
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

struct MeshArea::Gather {
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
  /// 1 where a triangle of that front, which need not be unit, counts; else 0.
  std::int32_t is_alike(const Vec3f& front) const {
    const float cosine = dot(front, normal);
    const float least2 = length_squared(front) * (least_side_cosine * least_side_cosine);
    return (cosine > 0 ? 1 : 0) & (cosine * cosine >= least2 ? 1 : 0);
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
    items_.push_back(
        {middle, t, side_normal(side_word<float>(front, front)), static_cast<float>(twice_area / 2), reach});
  }
  if (items_.empty()) return;
  while ((items_.size() >> leaf_level_) >= most_in_leaf) ++leaf_level_;
  nodes_.resize(std::size_t{2} << leaf_level_);
  const int roots_level = std::min(shared_levels, leaf_level_);
  for (int level = 0; level < roots_level; ++level)
    threads.for_each(std::size_t{1} << level, [&](std::size_t k) { bound(level, k); });
  threads.for_each(std::size_t{1} << roots_level, [&](std::size_t k) { cut_subtree(roots_level, k); });
  leaves_.resize(std::size_t{1} << leaf_level_);
  threads.for_each(std::size_t{1} << roots_level, [&](std::size_t k) {
    const int below = leaf_level_ - roots_level;
    for (std::size_t leaf = k << below; leaf < (k + 1) << below; ++leaf) fill(leaf);
  });
  items_ = {};
}

std::size_t MeshArea::memory_bytes() const {
  return leaves_.capacity() * sizeof(Leaf) + nodes_.capacity() * sizeof(Node);
}

void MeshArea::fill(std::size_t leaf) {
  Leaf& l = leaves_[leaf];
  const std::size_t begin = begin_of(leaf_level_, leaf), end = begin_of(leaf_level_, leaf + 1);
  for (std::size_t i = begin; i < end; ++i, ++l.count) {
    const Item& item = items_[i];
    l.triangle[l.count] = item.triangle;
    l.x[l.count] = item.middle.x;
    l.y[l.count] = item.middle.y;
    l.z[l.count] = item.middle.z;
    l.front_x[l.count] = item.front.x;
    l.front_y[l.count] = item.front.y;
    l.front_z[l.count] = item.front.z;
    l.area[l.count] = item.area;
    l.reach[l.count] = item.reach;
  }
}

/// Computes the node's contents and, above the leaves, moves the lower half along its widest axis to the front.
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
    normals += Vec3d(normalize(item.front));
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
      node.cosine = std::min(node.cosine, dot(node.axis, normalize(items_[i].front)));
  }
  node.sine = std::sqrt(std::max(0.0f, 1 - node.cosine * node.cosine));
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

double MeshArea::visit(const Gather& at, int level, std::size_t k) const {
  const Node& node = nodes_[(std::size_t{1} << level) + k];
  // The node's box about the gather's point, and how far it reaches along the tangent plane's normal.
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

  const float size2 = 4 * length_squared(half);
  // A placement changes areas and angles; a scaling one is undone before, the others' nodes are only ever left out.
  if (at.placement == nullptr && node.cosine > 0) {
    const float c = dot(at.normal, node.axis);
    const float tilt = std::sqrt(std::max(0.0f, 1 - c * c));
    const bool none_alike = c < node.cosine && c * node.cosine + tilt * node.sine < least_side_cosine - margin;
    if (none_alike) return 0;
    const bool all_alike = c > 0 && c * node.cosine - tilt * node.sine > least_side_cosine + margin;
    if (all_alike) {
      const Vec3f farthest = distance + half;
      if (length_squared(farthest) <= (radius - slack) * (radius - slack) && above + reach <= height - slack)
        return node.area;
      if (size2 <= square(radius * small_share)) return at.holds(Vec3d(off)) ? node.area : 0;
    }
  }
  if (level == leaf_level_) return visit_leaf(at, leaves_[k]);
  if (at.placement == nullptr && size2 <= square(radius * sampled_share)) return sample(at, level, k);
  return visit(at, level + 1, 2 * k) + visit(at, level + 1, 2 * k + 1);
}

/// An estimate from one leaf, drawn in proportion to its area: right in the mean over points.
double MeshArea::sample(const Gather& at, int level, std::size_t k) const {
  const std::size_t node = (std::size_t{1} << level) + k;
  const std::uint32_t key = std::bit_cast<std::uint32_t>(at.p.x) ^ (std::bit_cast<std::uint32_t>(at.p.y) * 0x9e3779b1u);
  float u = draw_independent<float>(key, std::bit_cast<std::uint32_t>(at.p.z), static_cast<std::uint32_t>(node));
  std::size_t at_node = node;
  for (int l = level; l < leaf_level_; ++l) {
    const float left = nodes_[2 * at_node].area, both = left + nodes_[2 * at_node + 1].area, drawn = u * both;
    const bool is_left = drawn < left;
    u = std::clamp(is_left ? drawn / left : (drawn - left) / (both - left), 0.0f, 1.0f);
    at_node = 2 * at_node + (is_left ? 0 : 1);
  }
  const Leaf& leaf = leaves_[at_node - (std::size_t{1} << leaf_level_)];
  double within = 0, all = 0;
  for (std::size_t i = 0; i < leaf.count; ++i) {
    const double area{leaf.area[i]};
    all += area;
    if (at.is_alike({leaf.front_x[i], leaf.front_y[i], leaf.front_z[i]}) &&
        at.holds(Vec3d(Vec3f{leaf.x[i], leaf.y[i], leaf.z[i]} - at.p)))
      within += area;
  }
  return all > 0 ? double{nodes_[node].area} * within / all : 0;
}

double MeshArea::visit_leaf(const Gather& at, const Leaf& leaf) const {
  const auto radius = static_cast<float>(at.radius), height = static_cast<float>(at.height);
  const float slack = margin * radius;
  enum State : std::int32_t { outside, inside, on_border };
  std::array<std::int32_t, most_in_leaf> state;
  if (at.placement == nullptr) {
    // All at once, without branches. Most are all outside or all inside.
    for (std::size_t i = 0; i < most_in_leaf; ++i) {
      const Vec3f from = Vec3f{leaf.x[i], leaf.y[i], leaf.z[i]} - at.p;
      const float distance2 = length_squared(from), reach = leaf.reach[i], off_plane = std::abs(dot(at.normal, from));
      const float outer = radius + reach + slack, inner = radius - reach - slack;
      const std::int32_t counts = at.is_alike({leaf.front_x[i], leaf.front_y[i], leaf.front_z[i]}) &
                                  (distance2 <= outer * outer ? 1 : 0) & (off_plane - reach <= height + slack ? 1 : 0);
      const std::int32_t all =
          (inner > 0 ? 1 : 0) & (distance2 <= inner * inner ? 1 : 0) & (off_plane + reach <= height - slack ? 1 : 0);
      state[i] = counts * (on_border - all);
    }
  } else {
    for (std::size_t i = 0; i < leaf.count; ++i) {
      const Vec3f front{leaf.front_x[i], leaf.front_y[i], leaf.front_z[i]};
      state[i] = at.is_alike(at.placement->normal(front)) * on_border;
    }
  }
  double area = 0;
  std::array<std::uint32_t, most_in_leaf> border;
  std::size_t border_count = 0;
  const float small_reach = radius * small_share / 2;
  for (std::size_t i = 0; i < leaf.count; ++i) {
    if (at.placement == nullptr && state[i] == on_border && leaf.reach[i] <= small_reach)
      state[i] = at.holds(Vec3d(Vec3f{leaf.x[i], leaf.y[i], leaf.z[i]} - at.p)) ? inside : outside;
    area += state[i] == inside ? double{leaf.area[i]} : 0.0;
    border[border_count] = leaf.triangle[i];
    border_count += state[i] == on_border ? 1 : 0;
  }
  for (std::size_t i = 0; i < border_count; ++i)
    area += area_within(at.corners(mesh_, border[i]), at.radius, Vec3d(at.normal), at.height);
  return area;
}

double MeshArea::within(const Vec3f& p, const Vec3f& front_normal, float radius) const {
  if (leaves_.empty()) return 0;
  return visit({p, front_normal, radius, double{sheet_height} * radius, nullptr}, 0, 0);
}

double MeshArea::within(const AffineMap& placement, const Vec3f& p, const Vec3f& front_normal, float radius) const {
  if (leaves_.empty()) return 0;
  if (const std::optional<double> scale = scale_of(placement)) {
    const Vec3f normal{dot(placement.x, front_normal), dot(placement.y, front_normal), dot(placement.z, front_normal)};
    return *scale * *scale * within(placement.local_point(p), normalize(normal), static_cast<float>(radius / *scale));
  }
  return visit({p, front_normal, radius, double{sheet_height} * radius, &placement}, 0, 0);
}

}  // namespace photonproof::inline renderer_areas
