// Shapes of the description, compiled to surfaces. A cube becomes six of them. An instance has a surface of its own for
// every shape of its group, but shares the group's meshes with the other instances.
#pragma once

#include <map>
#include <vector>

#include "renderer/shapes/shape_place.h"
#include "renderer/shapes/surface.h"
#include "renderer/textures/texture.h"
#include "scenes/description/description.h"

namespace photonproof::inline renderer_scene {

class SceneShapes {
 public:
  /// `moved` is added to the description's coordinates; faces with edges above `long_edge` are long ones. Throws
  /// InputError at a shape that cannot be represented.
  SceneShapes(const SceneDescription& description, const Textures& textures, const Vec3d& moved, double long_edge);

  std::vector<Surface> surfaces;
  std::vector<const ShapeDescription*> shape_of;  ///< Each surface's shape in the description.
  std::vector<std::size_t> cubes;                 ///< The first of the six surfaces of each.
  std::vector<AffineMap> uv_frames;               ///< By Surface::uv_frame.
  std::size_t primitives = 0;                     ///< A group's triangles count once, and each instance as one.
  bool simple = true;                             ///< BruteForceTables can hold all shapes.

 private:
  /// The meshes of a group, around their middle and in a unit of length of their own where the group's is extreme.
  struct GroupMeshes {
    std::uint32_t number = 0;
    Vec3d middle{0.0};
    double scale = 1;
    std::size_t triangles = 0;
    double longest_edge = 0;  ///< in the group's own unit of length
    std::vector<std::shared_ptr<const Mesh>> parts;
  };

  void add(const ShapeDescription& shape, const Transform& to_world);
  void add(const RectangleDescription&, const ShapeDescription& shape, const Transform& to_world);
  void add(const CubeDescription&, const ShapeDescription& shape, const Transform& to_world);
  void add(const MeshDescription&, const ShapeDescription& shape, const Transform& to_world);
  void add(const HeightfieldDescription&, const ShapeDescription& shape, const Transform& to_world);
  void add(const CurvesDescription& curves, const ShapeDescription& shape, const Transform& to_world);
  void add(const EllipsoidsDescription& ellipsoids, const ShapeDescription& shape, const Transform& to_world);
  void add(const InstanceDescription& instance, const ShapeDescription& shape, const Transform& to_world);
  /// Adds a description that `placed` turns into one primitive.
  template <class Primitive>
  void add(const Primitive& primitive, const ShapeDescription& shape, const Transform& to_world);
  /// uv is (0, 0) at the corner and grows to 1 along the edges. The front is where cross(edge_u, edge_v) points, or the
  /// other side when `turned`; flip_normals turns it again.
  void add_quad(const ShapeDescription& shape, const Vec3d& corner, const Vec3d& edge_u, const Vec3d& edge_v,
                bool turned);
  const GroupMeshes& meshes_of(ShapeGroupIndex group);
  void add_mesh(const ShapeDescription& shape, const Transform& to_world);
  /// Marks those of the last surface, a mesh.
  void mark_long_faces(const Transform& to_world);
  /// Sets those of the last surface.
  void set_long_faces(std::vector<LongFace> faces);
  Mesh compile_mesh(const ShapeDescription& shape, const Transform& to_world) const;
  void add_surface(Geometry geometry, const ShapeDescription& shape);
  template <class Shape>
  void add_primitive(const PlacedShape<Shape>& made, const ShapeDescription& shape);

  const SceneDescription& description_;
  const Textures& textures_;
  const double long_edge_;
  std::map<ShapeGroupIndex, GroupMeshes> groups_;
  std::uint32_t instances_ = 0;
};

}  // namespace photonproof::inline renderer_scene
