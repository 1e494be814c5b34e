// Surfaces sorted by the form that Embree needs.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_rays {

/// Shapes of one kind, each with the index of its surface. A light also has its face as rays name it (ray.h).
template <class Shape>
struct ShapeTable {
  std::vector<const Shape*> shapes;
  std::vector<std::uint32_t> surface, light;
  void add(const Shape& shape, std::uint32_t index, std::uint32_t face = no_index) {
    shapes.push_back(&shape);
    surface.push_back(index);
    light.push_back(face);
  }
};

template <class... Shape>
using ShapeTables = std::tuple<ShapeTable<Shape>...>;

/// The meshes of a shape group, which all its instances share.
struct MeshGroup {
  std::vector<const Mesh*> parts;
};

struct PlacedGroup {
  std::uint32_t group = 0;
  const AffineMap* placement = nullptr;
  std::vector<std::uint32_t> surface;  ///< of each part
};

/// All curves of one basis, as Embree needs them.
struct CurveTable {
  struct Owner {
    const Curves* curves;
    std::uint32_t surface, first;  ///< index of its surface, and the number of its first segment here
  };
  std::vector<CurvePoint> points;
  std::vector<std::uint32_t> segments;  ///< the first control point of each
  std::vector<Owner> owners;            ///< by their first segments

  void add(const Curves& curves, std::uint32_t surface);
  const Owner& owner_of(std::uint32_t segment) const;
};

/// All ellipsoids that are solved, numbered through.
struct EllipsoidTable {
  struct Owner {
    const Ellipsoids* ellipsoids;
    std::uint32_t surface, first;  ///< index of its surface, and the number of its first ellipsoid here
  };
  std::uint32_t count = 0;
  std::vector<Owner> owners;  ///< by their first ellipsoids

  void add(const Ellipsoids& ellipsoids, std::uint32_t surface);
  const Owner& owner_of(std::uint32_t ellipsoid) const;
};

/// The surface of a mesh of shells, and the size of a shell.
struct ShellMesh {
  std::uint32_t surface = 0;
  std::uint32_t faces = 0;  ///< triangles of a shell; 0 where the mesh has none
};

struct TraceTables {
  ShapeTable<Quad> quads;
  SolvedShapes<ShapeTables, LongFace> solved;  ///< shapes that Embree does not have
  ShapeTable<Plane> planes;                    ///< tested one after the other: boxes around them would be of no use
  std::array<CurveTable, 2> curves;            ///< B-splines, then linear ones
  EllipsoidTable ellipsoids;
  ShapeTable<Mesh> meshes;                                       ///< each its own geometry
  std::vector<const std::vector<LongFace>*> long_faces_of_mesh;  ///< null where there are none
  std::vector<ShellMesh> shells_of_mesh;
  std::vector<MeshGroup> groups;
  std::vector<PlacedGroup> instances;

  explicit TraceTables(const std::vector<Surface>& surfaces);
  void add(const MeshInstance& copy, std::uint32_t surface);
  /// Whether there are no curves, and at least ten flat faces for each shape that Embree does not have.
  bool is_flat() const;
};

}  // namespace photonproof::inline renderer_rays
