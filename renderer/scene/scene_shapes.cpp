#include "renderer/scene/scene_shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/rays/brute_force_intersector.h"
#include "renderer/rays/brute_force_tables.h"
#include "renderer/scene/ellipsoid_shells.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/shapes/heightfield.h"
#include "renderer/shapes/mesh_normals.h"

namespace photonproof::inline renderer_scene {
namespace {

/// The sides of a cube as Mitsuba parametrises them, each from its corner of uv (0, 0) along the edges where u and v
/// grow to 1. Seen from outside they are mirrored: the cross product of the edges points into the cube.
struct CubeFace {
  Vec3d corner, along_u, along_v;
};
const std::array<CubeFace, 6> cube_faces{{{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
                                          {{-1, 1, -1}, {0, -2, 0}, {2, 0, 0}},
                                          {{1, -1, 1}, {0, 2, 0}, {0, 0, -2}},
                                          {{-1, -1, -1}, {0, 2, 0}, {0, 0, 2}},
                                          {{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}},
                                          {{1, 1, 1}, {-2, 0, 0}, {0, 0, -2}}}};

bool is_mesh(const ShapeDescription& shape) {
  return std::holds_alternative<MeshDescription>(shape.geometry) ||
         std::holds_alternative<HeightfieldDescription>(shape.geometry);
}

/// An instance of at most this many triangles may be copied for the sake of its long faces.
constexpr std::size_t triangles_to_copy = 0x10000;

double edge_of_triangle(const Mesh& mesh, std::size_t triangle) {
  const Vec3d a(mesh.corner(triangle, 0)), b(mesh.corner(triangle, 1)), c(mesh.corner(triangle, 2));
  return std::sqrt(std::max({length_squared(b - a), length_squared(c - a), length_squared(c - b)}));
}

/// Longest edge, or the diagonal of the mesh's box where that is not above `least`: quicker.
double longest_edge(const Mesh& mesh, double least) {
  Extent box;
  for (std::size_t i = 0; i + 1 < mesh.positions.size(); ++i) box.add(Vec3d(mesh.positions[i]));
  const double diagonal = length(box.high - box.low);
  if (!(diagonal > least)) return diagonal;
  double longest = 0;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) longest = std::max(longest, edge_of_triangle(mesh, t));
  return longest;
}

/// A ball's radius in long edges at which single precision errs by a ten-thousandth of a scene's reach.
constexpr double large_balls = 64;

/// BruteForceTables err by a part of a face's length at its edges: at most this part of the distance of the edges.
constexpr double part_of_rim = 1e-5;

}  // namespace

SceneShapes::SceneShapes(const SceneDescription& description, const Textures& textures, const Vec3d& moved,
                         double long_edge)
    : description_(description), textures_(textures), long_edge_(long_edge) {
  for (const ShapeDescription& shape : description.shapes) add(shape, Transform::translate(moved) * shape.to_world);
}

void SceneShapes::add(const ShapeDescription& shape, const Transform& to_world) {
  std::visit([&](const auto& kind) { add(kind, shape, to_world); }, shape.geometry);
}

template <class Primitive>
void SceneShapes::add(const Primitive& primitive, const ShapeDescription& shape, const Transform& to_world) {
  add_primitive(placed(primitive, ShapePlace{description_, shape, to_world}), shape);
}

void SceneShapes::add(const RectangleDescription&, const ShapeDescription& shape, const Transform& to_world) {
  add_quad(shape, to_world.point({-1, -1, 0}), to_world.vector({2, 0, 0}), to_world.vector({0, 2, 0}),
           to_world.determinant() < 0);
}

void SceneShapes::add(const CubeDescription&, const ShapeDescription& shape, const Transform& to_world) {
  cubes.push_back(surfaces.size());
  for (const CubeFace& face : cube_faces)
    add_quad(shape, to_world.point(face.corner), to_world.vector(face.along_u), to_world.vector(face.along_v),
             to_world.determinant() > 0);
}

void SceneShapes::add_quad(const ShapeDescription& shape, const Vec3d& corner, const Vec3d& edge_u, const Vec3d& edge_v,
                           bool turned) {
  const Vec3d n = cross(edge_u, edge_v);
  const double area = length(n);
  // A mirrored transform turns the winding round but not the side Mitsuba's normal (inverse transpose) points to.
  const Vec3d normal = n / area * (shape.flip_normals != turned ? -1.0 : 1.0);
  const Quad quad{Vec3f(corner), Vec3f(edge_u), Vec3f(edge_v), Vec3f(normal), static_cast<float>(area)};
  add_primitive(PlacedShape<Quad>{quad, flat_frame(corner, edge_u, edge_v), area}, shape);
  if (length(edge_u) > long_edge_ || length(edge_v) > long_edge_)
    set_long_faces({{corner, edge_u, edge_v, normal, dot(normal, corner), false, 0}});
}

void SceneShapes::add(const MeshDescription&, const ShapeDescription& shape, const Transform& to_world) {
  add_mesh(shape, to_world);
}

void SceneShapes::add(const HeightfieldDescription&, const ShapeDescription& shape, const Transform& to_world) {
  add_mesh(shape, to_world);
}

// The shape's own to_world leaves radii as they are; that of an instance scales them.
void SceneShapes::add(const CurvesDescription& curves, const ShapeDescription& shape, const Transform& to_world) {
  const std::optional<Transform> to_local = shape.to_world.inverse();
  if (!to_local) throw InputError(description_.where(shape.loc), "the curves' to_world has no inverse");
  const Transform of_instance = to_world * *to_local;
  ShapePlace{description_, shape, of_instance}.require_similarity();
  Curves made = compiled_curves(curves, to_world, of_instance, shape.flip_normals);
  primitives += made.segments.size();
  add_surface(std::move(made), shape);
}

// The shape's own to_world turns ellipsoids and scales them evenly; that of an instance may also stretch them.
void SceneShapes::add(const EllipsoidsDescription& ellipsoids, const ShapeDescription& shape,
                      const Transform& to_world) {
  const std::optional<Transform> to_local = shape.to_world.inverse();
  if (!to_local) throw InputError(description_.where(shape.loc), "the ellipsoids' to_world has no inverse");
  const PlacedEllipsoids places(ellipsoids, shape.to_world, to_world * *to_local);
  Ellipsoids made = compiled_ellipsoids(ellipsoids, places, shape.flip_normals);
  if (!ellipsoids.triangles) {
    primitives += made.places.size();
    return add_surface(std::move(made), shape);
  }
  Mesh shells = mesh_of_shells(ellipsoids.shell, places, std::move(made));
  primitives += shells.triangle_count();
  add_surface(std::move(shells), shape);
}

void SceneShapes::add_mesh(const ShapeDescription& shape, const Transform& to_world) {
  Mesh mesh = compile_mesh(shape, to_world);
  primitives += mesh.triangle_count();
  add_surface(std::move(mesh), shape);
  mark_long_faces(to_world);
}

void SceneShapes::mark_long_faces(const Transform& to_world) {
  const Mesh& mesh = std::get<Mesh>(surfaces.back().geometry);
  if (!(longest_edge(mesh, long_edge_) > long_edge_)) return;
  std::vector<LongFace> faces;
  for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
    if (!(edge_of_triangle(mesh, t) > long_edge_)) continue;
    const auto& corners = mesh.source->triangles[t];
    const auto at = [&](std::size_t k) { return to_world.point(Vec3d(mesh.source->positions[corners[k]])); };
    const Vec3d corner = at(0), edge_u = at(1) - corner, edge_v = at(2) - corner, n = cross(edge_u, edge_v);
    if (!(dot(n, n) > 0)) continue;
    const Vec3d normal = normalize(n) * (mesh.inward ? -1.0 : 1.0);
    faces.push_back({corner, edge_u, edge_v, normal, dot(normal, corner), true, static_cast<std::uint32_t>(t)});
  }
  if (!faces.empty()) set_long_faces(std::move(faces));
}

void SceneShapes::set_long_faces(std::vector<LongFace> faces) {
  const auto ends_near = [&](const LongFace& face) {
    const double longest = std::max(length(face.edge_u), length(face.edge_v));
    return double{plate_margin} * longest > part_of_rim * (rim_distance(face) + long_edge_);
  };
  simple = simple && std::none_of(faces.begin(), faces.end(), ends_near);
  surfaces.back().long_faces = std::make_shared<const std::vector<LongFace>>(std::move(faces));
}

Mesh SceneShapes::compile_mesh(const ShapeDescription& shape, const Transform& to_world) const {
  Mesh mesh;
  bool flat = false;
  if (const auto* file = std::get_if<MeshDescription>(&shape.geometry)) {
    mesh.source = file->mesh;
    mesh.flip_v = file->flip_tex_coords;
    flat = file->face_normals;
  } else {
    const auto& field = std::get<HeightfieldDescription>(shape.geometry);
    mesh.source = std::make_shared<const TriangleMesh>(make_heightfield(field, textures_));
    flat = field.face_normals;
  }
  const TriangleMesh& source = *mesh.source;
  mesh.positions.reserve(source.positions.size() + 1);
  for (const Vec3f& p : source.positions) mesh.positions.push_back(Vec3f(to_world.point(Vec3d(p))));
  mesh.positions.emplace_back();
  // A mirroring transform turns the winding round, but not the side that is the front.
  const bool mirrored = to_world.determinant() < 0;
  mesh.inward = shape.flip_normals != mirrored;
  if (!flat && !source.normals.empty()) {
    const AffineMap map(to_world);
    mesh.normals.reserve(source.normals.size());
    for (const Vec3f& n : source.normals) mesh.normals.push_back(normalize(map.normal(n)) * (mirrored ? -1.0f : 1.0f));
  } else if (!flat) {
    mesh.normals = vertex_normals(source.triangles, mesh.positions, source.positions.size());
  }
  return mesh;
}

const SceneShapes::GroupMeshes& SceneShapes::meshes_of(ShapeGroupIndex index) {
  const auto known = groups_.find(index);
  if (known != groups_.end()) return known->second;
  const ShapeGroupDescription& group = description_.groups[index.value];
  GroupMeshes made;
  made.number = static_cast<std::uint32_t>(groups_.size());
  Extent extent;
  for (const ShapeDescription& shape : group.shapes)
    if (is_mesh(shape)) extent.add(extent_of(shape));
  if (extent.is_usable()) {
    made.middle = Vec3d(Vec3f(extent.middle()));
    const double size = length(extent.high - extent.low);
    if (size > 0 && (size < 1 / ordinary_size || size > ordinary_size)) made.scale = power_of_two_below(1 / size);
  }
  const Transform to_unit = Transform::scale(Vec3d(made.scale)) * Transform::translate(-made.middle);
  for (const ShapeDescription& shape : group.shapes) {
    if (!is_mesh(shape)) continue;
    made.parts.push_back(std::make_shared<const Mesh>(compile_mesh(shape, to_unit * shape.to_world)));
    primitives += made.parts.back()->triangle_count();
    made.triangles += made.parts.back()->triangle_count();
    made.longest_edge = std::max(made.longest_edge, longest_edge(*made.parts.back(), 0));
  }
  return groups_.emplace(index, std::move(made)).first->second;
}

void SceneShapes::add(const InstanceDescription& instance, const ShapeDescription& shape, const Transform& to_world) {
  if (!to_world.inverse()) throw InputError(description_.where(shape.loc), "the instance's to_world has no inverse");
  const GroupMeshes& meshes = meshes_of(instance.group);
  const auto placement = std::make_shared<const AffineMap>(to_world * Transform::translate(meshes.middle) *
                                                           Transform::scale(Vec3d(1 / meshes.scale)));
  // Embree meets an instance's faces in the group's coordinates, which are too coarse where the faces are long. Copies
  // of large groups take memory: they are made where faces are so long that not making them would show everywhere.
  const double stretch = std::sqrt(length_squared(Vec3d(placement->x)) + length_squared(Vec3d(placement->y)) +
                                   length_squared(Vec3d(placement->z)));
  const double very_long = meshes.triangles <= triangles_to_copy ? long_edge_ : 32 * long_edge_;
  const bool too_long = meshes.longest_edge * stretch > very_long;
  std::uint32_t part = 0;
  for (const ShapeDescription& member : description_.groups[instance.group.value].shapes) {
    if (member.radiance) throw InputError(description_.where(member.loc), "a shape of a group cannot emit");
    if (std::holds_alternative<InstanceDescription>(member.geometry))
      throw InputError(description_.where(member.loc), "a shape group cannot hold instances");
    if (is_mesh(member) && too_long) {
      add_mesh(member, to_world * member.to_world);
    } else if (is_mesh(member)) {
      add_surface(MeshInstance{meshes.parts[part], placement, instances_, meshes.number, part}, member);
      ++part;
    } else {
      add(member, to_world * member.to_world);
    }
  }
  if (part == 0) return;
  ++instances_;
  ++primitives;
}

void SceneShapes::add_surface(Geometry geometry, const ShapeDescription& shape) {
  Surface surface;
  surface.geometry = std::move(geometry);
  surface.bsdf = shape.bsdf.value;
  if (shape.interior) surface.interior = shape.interior->value;
  if (shape.exterior) surface.exterior = shape.exterior->value;
  simple = simple && BruteForceTables::can_hold(surface.geometry, large_balls * long_edge_);
  surfaces.push_back(std::move(surface));
  shape_of.push_back(&shape);
}

template <class Shape>
void SceneShapes::add_primitive(const PlacedShape<Shape>& made, const ShapeDescription& shape) {
  // Estimators divide by areas and normalise by them: both must stay finite with room to spare.
  if (made.area && !(*made.area > 1e-30 && *made.area < 1e30))
    throw InputError(description_.where(shape.loc), "the shape's area is outside what single precision can hold");
  ++primitives;
  add_surface(made.shape, shape);
  surfaces.back().uv_frame = static_cast<std::uint32_t>(uv_frames.size());
  uv_frames.push_back(made.uv_frame);
}

}  // namespace photonproof::inline renderer_scene
