#include "renderer/limits/close_faces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

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
    std::sort(all.begin(), all.end(), [](const Face& a, const Face& b) { return a.low_x < b.low_x; });
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

}  // namespace

std::vector<CloseFaces> close_faces_of_glass(const SceneDescription& description, const SceneFrame& frame) {
  const std::vector<Face> faces = Faces(description, frame).all;
  std::vector<CloseFaces> found;
  std::set<std::pair<std::size_t, std::size_t>> known;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size() && faces[j].low_x <= faces[i].high_x + faces[i].resolved; ++j) {
      const Face &a = faces[i], &b = faces[j];
      if (a.shape == b.shape || a.is_ball != b.is_ball) continue;
      const std::optional<double> apart = a.is_ball ? apart_of_balls(a, b) : apart_of_plates(a, b);
      const double resolved = std::max(a.resolved, b.resolved);
      const std::pair pair = std::minmax(a.shape, b.shape);
      if (apart && *apart < resolved && known.insert(pair).second)
        found.push_back({pair.first, pair.second, *apart, resolved});
    }
  return found;
}

}  // namespace photonproof::inline renderer_limits
