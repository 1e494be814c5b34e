#include "renderer/limits/close_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "renderer/areas/box_tree.h"

namespace photonproof::inline renderer_limits {
namespace {

/// A ball, or a parallelogram with one corner and two edges, in the description's world.
struct Face {
  std::size_t shape;
  bool is_ball;
  Vec3d at;  ///< centre or corner
  Vec3d edge_u{0.0}, edge_v{0.0};
  double radius = 0;
  double low_x = 0, high_x = 0;
  double resolved = 0;
};

std::array<Vec3d, 4> corners(const Face& face) {
  return {face.at, face.at + face.edge_u, face.at + face.edge_v, face.at + face.edge_u + face.edge_v};
}

class Faces {
 public:
  Faces(const SceneDescription& description, const SceneFrame& frame) : frame_(frame) {
    for (std::size_t i = 0; i < description.shapes.size(); ++i) {
      const ShapeDescription& shape = description.shapes[i];
      if (!traits_of(description.bsdfs[shape.bsdf.value]).refracts) continue;
      const Transform& to_world = shape.to_world;
      if (const auto* ball = std::get_if<SphereDescription>(&shape.geometry))
        add({i, true, to_world.point(ball->center), {}, {}, ball->radius * to_world.similarity_scale()});
      else if (std::holds_alternative<RectangleDescription>(shape.geometry))
        add({i, false, to_world.point({-1, -1, 0}), to_world.vector({2, 0, 0}), to_world.vector({0, 2, 0})});
      else if (std::holds_alternative<CubeDescription>(shape.geometry))
        add_cube(i, to_world);
    }
    std::ranges::stable_sort(all, {}, &Face::low_x);  // so that a pair is found in one order among any other shapes
  }

  std::vector<Face> all;  ///< by low_x

 private:
  void add_cube(std::size_t i, const Transform& to_world) {
    const std::array<Vec3d, 3> axes{Vec3d{2, 0, 0}, Vec3d{0, 2, 0}, Vec3d{0, 0, 2}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const Vec3d u = to_world.vector(axes[(axis + 1) % 3]), v = to_world.vector(axes[(axis + 2) % 3]);
      const Vec3d corner = to_world.point({-1, -1, -1});
      add({i, false, corner, u, v});
      add({i, false, corner + to_world.vector(axes[axis]), u, v});
    }
  }

  void add(Face face) {
    double largest = double{frame_.coordinate_floor};
    const auto reach = [&](const Vec3d& p) {
      const Vec3d at = p * frame_.scale + frame_.moved;
      largest = std::max({largest, std::abs(at.x), std::abs(at.y), std::abs(at.z)});
    };
    if (face.is_ball) {
      reach(face.at - Vec3d(face.radius));
      reach(face.at + Vec3d(face.radius));
      face.low_x = face.at.x - face.radius;
      face.high_x = face.at.x + face.radius;
    } else {
      const std::array<Vec3d, 4> at = corners(face);
      face.low_x = face.high_x = at[0].x;
      for (const Vec3d& p : at) {
        reach(p);
        face.low_x = std::min(face.low_x, p.x);
        face.high_x = std::max(face.high_x, p.x);
      }
    }
    face.resolved = steps_resolved * largest / frame_.scale;
    all.push_back(face);
  }

  SceneFrame frame_;
};

double apart_of_balls(const Face& a, const Face& b) { return length(a.at - b.at) + std::abs(a.radius - b.radius); }

/// The greatest distance of b's corners from a's plane, where b lies over a part of a.
std::optional<double> apart_of_plates(const Face& a, const Face& b) {
  const Vec3d across = cross(a.edge_u, a.edge_v);
  const double area = length(across);
  if (!(area > 0)) return std::nullopt;
  const Vec3d normal = across * (1 / area);
  double apart = 0;
  Vec2<double> low{1e300, 1e300}, high{-1e300, -1e300};
  for (const Vec3d& p : corners(b)) {
    const Vec3d to = p - a.at;
    apart = std::max(apart, std::abs(dot(to, normal)));
    const double u = dot(cross(to, a.edge_v), normal) / area, v = dot(cross(a.edge_u, to), normal) / area;
    low = {std::min(low.x, u), std::min(low.y, v)};
    high = {std::max(high.x, u), std::max(high.y, v)};
  }
  constexpr double edge = 1e-6;  // plates that share an edge do not overlap
  const bool overlap = low.x < 1 - edge && low.y < 1 - edge && high.x > edge && high.y > edge;
  return overlap ? std::optional(apart) : std::nullopt;
}

/// Boxes in which close faces meet. Those of plates are the boxes around them. Those of balls are points that depend on
/// middle and radius. Two such points are no further apart along an axis than `apart_of_balls`, and along all three
/// only concentric balls of one radius have the same. `scale` brings the description's lengths to those of the scene,
/// which single precision holds.
ShapeBox box_of(const Face& face, double scale) {
  Vec3d low, high;
  if (face.is_ball) {
    low = high = face.at + Vec3d(0.3712, 0.4871, 0.7906) * face.radius;
  } else {
    low = high = face.at;
    for (const Vec3d& p : corners(face)) {
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  return padded_box((low - Vec3d(face.resolved)) * scale, (high + Vec3d(face.resolved)) * scale);
}

/// Whether a face in a box may be close to a plate, as in `apart_of_plates`: the box reaches its plane, and lies over a
/// part of it.
class OverPlate {
 public:
  OverPlate(const Face& plate, double scale) : at_(plate.at * scale), slack_(plate.resolved * scale) {
    const Vec3d u = plate.edge_u * scale, v = plate.edge_v * scale, across = cross(u, v);
    const double area = length(across);
    if (!(area > 0)) return;
    has_area_ = true;
    normal_ = across * (1 / area);
    // u = dot(cross(p - at, edge_v), normal) / area, and v with the other edge.
    along_u_ = cross(v, normal_) * (1 / area);
    along_v_ = cross(normal_, u) * (1 / area);
  }

  bool operator()(const ShapeBox& box) const {
    const Vec3d middle = (Vec3d(box.low) + Vec3d(box.high)) / 2, half = Vec3d(box.high) - middle;
    const auto reach = [&](const Vec3d& axis) {
      return std::abs(axis.x) * half.x + std::abs(axis.y) * half.y + std::abs(axis.z) * half.z;
    };
    const double u = dot(middle - at_, along_u_), v = dot(middle - at_, along_v_);
    const double reach_u = reach(along_u_) + room, reach_v = reach(along_v_) + room;
    return has_area_ && std::abs(dot(middle - at_, normal_)) <= reach(normal_) + slack_ && u - reach_u < 1 &&
           v - reach_v < 1 && u + reach_u > 0 && v + reach_v > 0;
  }

 private:
  static constexpr double room = 1e-9;  ///< for rounding
  Vec3d at_, normal_{0.0}, along_u_{0.0}, along_v_{0.0};
  double slack_;
  bool has_area_ = false;
};

/// Finds the faces that may be close to one.
class CloseSearch {
 public:
  CloseSearch(const std::vector<Face>& faces, double scale) : faces_(faces), scale_(scale) {
    for (const bool balls : {false, true}) {
      Kind& kind = balls ? balls_ : plates_;
      std::vector<BoxTree::Part> parts;
      for (std::uint32_t i = 0; i < faces.size(); ++i) {
        if (faces[i].is_ball != balls) continue;
        kind.faces.push_back(i);
        parts.push_back(part_of_box(box_of(faces[i], scale)));
      }
      std::vector<std::uint32_t> order;
      kind.tree = BoxTree(parts, order);
      for (std::uint32_t& place : order) place = kind.faces[place];
      kind.faces = std::move(order);
    }
  }

  /// Numbers above i, in ascending order.
  std::vector<std::uint32_t> after(std::uint32_t i) const {
    std::vector<std::uint32_t> found;
    const Kind& kind = faces_[i].is_ball ? balls_ : plates_;
    const auto visit = [&](std::uint32_t place) {
      if (kind.faces[place] > i) found.push_back(kind.faces[place]);
    };
    if (faces_[i].is_ball)
      kind.tree.visit([here = box_of(faces_[i], scale_)](const ShapeBox& box) { return boxes_meet(here, box); }, visit);
    else
      kind.tree.visit(OverPlate(faces_[i], scale_), visit);
    std::ranges::sort(found);
    return found;
  }

 private:
  struct Kind {
    std::vector<std::uint32_t> faces;  ///< by place in the tree
    BoxTree tree;
  };
  const std::vector<Face>& faces_;
  double scale_;
  Kind plates_, balls_;
};

}  // namespace

std::vector<CloseFaces> close_faces_of_glass(const SceneDescription& description, const SceneFrame& frame,
                                             std::size_t* compared) {
  const std::vector<Face> faces = Faces(description, frame).all;
  std::vector<CloseFaces> found;
  std::set<std::pair<std::size_t, std::size_t>> known;
  const CloseSearch search(faces, frame.scale);
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (const std::uint32_t j : search.after(i)) {
      const Face &a = faces[i], &b = faces[j];
      if (compared != nullptr) ++*compared;
      if (a.shape == b.shape || b.low_x > a.high_x + a.resolved) continue;
      const std::optional<double> apart = a.is_ball ? apart_of_balls(a, b) : apart_of_plates(a, b);
      const double resolved = std::max(a.resolved, b.resolved);
      const std::pair pair = std::minmax(a.shape, b.shape);
      if (apart && *apart < resolved && known.insert(pair).second)
        found.push_back({pair.first, pair.second, *apart, resolved});
    }
  return found;
}

}  // namespace photonproof::inline renderer_limits
