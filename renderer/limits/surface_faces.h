// The flat faces of a surface of any kind, and the surfaces near given places.
#pragma once

#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

#include "renderer/areas/box_tree.h"
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

/// Places (`at`) and the surfaces no further from them than `within`. Neither changes. A tree over the places finds the
/// few that each face is compared with.
template <class Place>
class PlaceTree {
 public:
  explicit PlaceTree(std::vector<Place>& places) {
    std::vector<BoxTree::Part> parts;
    parts.reserve(places.size());
    for (const Place& place : places)
      parts.push_back(part_of_box(padded_box(place.at - Vec3d(place.within), place.at + Vec3d(place.within))));
    std::vector<std::uint32_t> order;
    tree_ = BoxTree(parts, order);
    places_.reserve(places.size());
    for (const std::uint32_t i : order) places_.push_back(&places[i]);
  }

  bool empty() const { return places_.empty(); }

  /// Calls look(place, point, normal) where a shape's box (`around` for all) is near a place. The point is the nearest
  /// one of the shape, or of each of its flat faces. The normal has any length.
  template <class Look>
  void look_at(const Surface& surface, const ShapeBox& around, const Look& look) const {
    const Extent box{Vec3d(around.low), Vec3d(around.high)};
    const auto look_at_shape = [&]<class Shape>(const Shape& shape) {
      if constexpr (requires(const Vec3d& to) { point_on(shape, to); }) {
        const auto look_at_place = [&](Place& place) {
          const ShapePoint nearest = point_on(shape, place.at);
          look(place, Vec3d(nearest.p), Vec3d(nearest.normal));
        };
        if constexpr (std::is_same_v<Shape, Plane>)
          for (Place* place : places_) look_at_place(*place);
        else
          for_each_near(box, look_at_place);
      } else {
        if (!any_near(box)) return;
        for_each_face(surface, [&](const FlatFace& face) {
          const auto nearest = face.is_triangle ? nearest_on_triangle : nearest_on_parallelogram;
          for_each_near(extent_of_face(face), [&](Place& place) {
            look(place, nearest(place.at, face.corner, face.u, face.v), cross(face.u, face.v));
          });
        });
      }
    };
    std::visit(look_at_shape, surface.geometry);
  }

 private:
  /// Whether test(place) is true for some place near the box.
  template <class Test>
  bool any_near(const Extent& box, const Test& test) const {
    const ShapeBox around = padded_box(box.low, box.high);
    const auto meets = [&](const ShapeBox& other) { return boxes_meet(around, other); };
    return tree_.any_of(meets, [&](std::uint32_t i) {
      return comes_near(box, places_[i]->at, places_[i]->within) && test(*places_[i]);
    });
  }
  bool any_near(const Extent& box) const {
    return any_near(box, [](const Place&) { return true; });
  }
  template <class Visit>
  void for_each_near(const Extent& box, const Visit& visit) const {
    any_near(box, [&](Place& place) {
      visit(place);
      return false;
    });
  }

  std::vector<Place*> places_;  ///< in the tree's order
  BoxTree tree_;
};

}  // namespace photonproof::inline renderer_limits
