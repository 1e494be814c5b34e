// The flat faces of a surface of any kind, and the surfaces near given places.
#pragma once

#include <algorithm>
#include <vector>

#include "renderer/scene/nearest_point.h"
#include "renderer/shapes/extent.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_limits {

struct FlatFace {
  Vec3d corner, u, v;  ///< corner + s u + t v
  bool is_triangle = false;
};

inline Extent extent_of_face(const FlatFace& face) {
  Extent box;
  for (const Vec3d& p : {face.corner, face.corner + face.u, face.corner + face.v}) box.add(p);
  if (!face.is_triangle) box.add(face.corner + face.u + face.v);
  return box;
}

/// Whether p is in the box, or so near to it along every axis.
inline bool comes_near(const Extent& box, const Vec3d& p, double distance) {
  const auto along = [&](double Vec3d::*axis) {
    return p.*axis >= box.low.*axis - distance && p.*axis <= box.high.*axis + distance;
  };
  return along(&Vec3d::x) && along(&Vec3d::y) && along(&Vec3d::z);
}

/// Calls visit(const FlatFace&) for all of a parallelogram, a mesh or an instance.
template <class Visit>
void for_each_face(const Surface& surface, Visit&& visit) {
  const auto tell = [&](std::size_t primitive, const FlatFace& face) {
    if (const LongFace* exact = surface.long_face(primitive))
      visit(FlatFace{exact->corner, exact->edge_u, exact->edge_v, exact->is_triangle});
    else
      visit(face);
  };
  if (const auto* quad = std::get_if<Quad>(&surface.geometry))
    tell(0, {Vec3d(quad->corner), Vec3d(quad->edge_u), Vec3d(quad->edge_v)});
  const Mesh* mesh = mesh_of(surface.geometry);
  if (mesh == nullptr) return;
  const auto* copy = std::get_if<MeshInstance>(&surface.geometry);
  for (std::size_t i = 0; i < mesh->triangle_count(); ++i) {
    const auto corner = [&](std::size_t k) {
      const Vec3f p = mesh->corner(i, k);
      return Vec3d(copy != nullptr ? copy->placement->point(p) : p);
    };
    const Vec3d a = corner(0);
    tell(i, {a, corner(1) - a, corner(2) - a, true});
  }
}

/// Places (`at`) and the surfaces no further from them than `within`, which does not change. Sorted by x, so that each
/// face is compared with only a few of many places.
template <class Place>
class PlacesByX {
 public:
  PlacesByX() = default;
  explicit PlacesByX(std::vector<Place>& places) {
    for (Place& place : places) {
      furthest_ = std::max(furthest_, place.within);
      by_x_.push_back(&place);
    }
    std::sort(by_x_.begin(), by_x_.end(), [](const Place* a, const Place* b) { return a->at.x < b->at.x; });
  }

  bool empty() const { return by_x_.empty(); }

  /// Calls look(place, point, normal) where a shape's box (`around` for all) is near a place. The point is the nearest
  /// one of the shape, or of each of its flat faces. The normal has any length.
  template <class Look>
  void look_at(const Surface& surface, const ShapeBox& around, const Look& look) const {
    PlacesByX near;
    near.furthest_ = furthest_;
    if (std::holds_alternative<Plane>(surface.geometry))
      near.by_x_ = by_x_;
    else
      for_each_near({Vec3d(around.low), Vec3d(around.high)}, [&](Place& place) { near.by_x_.push_back(&place); });
    if (near.empty()) return;
    const auto look_at_shape = [&](const auto& shape) {
      if constexpr (requires(const Vec3d& to) { point_on(shape, to); }) {
        for (Place* place : near.by_x_) {
          const ShapePoint nearest = point_on(shape, place->at);
          look(*place, Vec3d(nearest.p), Vec3d(nearest.normal));
        }
      } else {
        for_each_face(surface, [&](const FlatFace& face) {
          const auto nearest = face.is_triangle ? nearest_on_triangle : nearest_on_parallelogram;
          near.for_each_near(extent_of_face(face), [&](Place& place) {
            look(place, nearest(place.at, face.corner, face.u, face.v), cross(face.u, face.v));
          });
        });
      }
    };
    std::visit(look_at_shape, surface.geometry);
  }

 private:
  template <class Visit>
  void for_each_near(const Extent& box, const Visit& visit) const {
    auto place = std::lower_bound(by_x_.begin(), by_x_.end(), box.low.x - furthest_,
                                  [](const Place* p, double x) { return p->at.x < x; });
    for (; place != by_x_.end() && (*place)->at.x <= box.high.x + furthest_; ++place)
      if (comes_near(box, (*place)->at, (*place)->within)) visit(**place);
  }

  std::vector<Place*> by_x_;
  double furthest_ = 0;
};

}  // namespace photonproof::inline renderer_limits
