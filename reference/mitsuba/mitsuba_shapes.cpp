// Shapes for Mitsuba: planes and heightfields become meshes, and every mesh a PLY file.
#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "reference/engines/far_square.h"
#include "reference/engines/heightfield_mesh.h"
#include "reference/mitsuba/mitsuba_lowering.h"
#include "scenes/base/bounds.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_mitsuba {
namespace {

void add_box(Bounds3d& bounds, const Transform& t, const Vec3d& a, const Vec3d& b) {
  for (int i = 0; i < 8; ++i)
    bounds.add(t.point({(i & 1) != 0 ? b.x : a.x, (i & 2) != 0 ? b.y : a.y, (i & 4) != 0 ? b.z : a.z}));
}
/// Adds a box around the shape. Planes have none.
void add_shape(const SceneDescription& scene, const ShapeDescription& shape, const Transform& outer, Bounds3d& bounds) {
  const Transform t = outer * shape.to_world;
  std::visit(Overloaded{[&](const SphereDescription& s) {
                          add_box(bounds, t, s.center - Vec3d(s.radius), s.center + Vec3d(s.radius));
                        },
                        [&](const CylinderDescription& c) {
                          for (const Vec3d& end : {c.p0, c.p1})
                            add_box(bounds, t, end - Vec3d(c.radius), end + Vec3d(c.radius));
                        },
                        [&](const MeshDescription& m) {
                          for (const Vec3f& p : m.mesh->positions) bounds.add(t.point(Vec3d(p)));
                        },
                        [&](const HeightfieldDescription& f) {
                          add_box(bounds, t, {-1, -1, -f.amplitude}, {1, 1, f.amplitude});
                        },
                        [&](const InstanceDescription& i) {
                          for (const ShapeDescription& of : scene.groups[i.group.value].shapes)
                            add_shape(scene, of, t, bounds);
                        },
                        [&](const PlaneDescription&) {}, [&](const auto&) { add_box(bounds, t, Vec3d(-1), Vec3d(1)); }},
             shape.geometry);
}

MeshDescription described(std::shared_ptr<const TriangleMesh> mesh, bool face_normals) {
  MeshDescription d;
  d.mesh = std::move(mesh);
  d.face_normals = face_normals;
  return d;
}

class Shapes {
 public:
  explicit Shapes(MitsubaLowering& lowering) : lowering_(lowering), scene_(lowering.scene()) {
    for (const ShapeDescription& shape : scene_.shapes) add_shape(scene_, shape, Transform(), all_);
    all_.add(scene_.sensor.to_world.point({0, 0, 0}));
  }

  /// The shape as one or several others.
  std::vector<ShapeDescription> parts(const ShapeDescription& shape) const {
    const bool is_cube = std::holds_alternative<CubeDescription>(shape.geometry);
    if (!is_cube || !shape.radiance || !std::holds_alternative<TextureIndex>(*shape.radiance)) return {shape};
    if (shape.interior || shape.exterior)
      lowering_.refuse(shape.loc, "a cube with a medium and a texture as radiance: not written yet");
    lowering_.explain("cube of " + scene_.where(shape.loc) +
                      ": six rectangles, as Mitsuba samples one of the faces that share a place in the texture");
    // The outward normal, and the corner where uv is (1,1). Seen from outside v is clockwise of u.
    static constexpr std::pair<Vec3d, Vec3d> faces[] = {{{1, 0, 0}, {1, 1, -1}},  {{-1, 0, 0}, {-1, 1, 1}},
                                                        {{0, 1, 0}, {-1, 1, -1}}, {{0, -1, 0}, {1, -1, 1}},
                                                        {{0, 0, 1}, {1, 1, 1}},   {{0, 0, -1}, {1, -1, -1}}};
    std::vector<ShapeDescription> sides;
    for (const auto& [n, corner] : faces) {
      const Vec3d diagonal = corner - n, u = (diagonal - cross(diagonal, n)) * 0.5, v = diagonal - u;
      const bool outward = dot(cross(u, v), n) > 0;
      const Vec3d z = outward ? n : -n;
      Transform place;
      place.m = {u.x, v.x, z.x, n.x, u.y, v.y, z.y, n.y, u.z, v.z, z.z, n.z, 0, 0, 0, 1};
      ShapeDescription side = shape;
      side.id.clear();
      side.geometry = RectangleDescription{};
      side.to_world = shape.to_world * place;
      if (!outward) side.flip_normals = !side.flip_normals;
      sides.push_back(side);
    }
    return sides;
  }

  void lower(ShapeDescription& shape) {
    check_light(shape);
    std::visit([&](const auto& geometry) { lower(shape, geometry); }, ShapeDescription(shape).geometry);
    if (auto* mesh = std::get_if<MeshDescription>(&shape.geometry)) finish(shape, *mesh);
  }

 private:
  void check_light(const ShapeDescription& shape) const {
    if (!shape.radiance) return;
    if (shape.emits_along_normal)
      lowering_.refuse(shape.loc, "a light that shines along its normal: Mitsuba's path tracers do not sample it");
    const bool of_triangles = std::holds_alternative<MeshDescription>(shape.geometry) ||
                              std::holds_alternative<HeightfieldDescription>(shape.geometry);
    if (of_triangles && std::holds_alternative<TextureIndex>(*shape.radiance))
      lowering_.refuse(shape.loc,
                       "a mesh with a texture as radiance: Mitsuba samples one of the faces that share a place in the "
                       "texture");
  }

  /// A square far beyond everything, in the plane's own uv.
  void lower(ShapeDescription& shape, const PlaneDescription&) const {
    const auto mesh = far_square(shape.to_world, all_);
    if (!mesh) lowering_.refuse(shape.loc, "a plane whose to_world has no inverse");
    lowering_.explain("plane of " + scene_.where(shape.loc) + ": a square, 1000 times the scene's size around it");
    shape.geometry = described(mesh, true);
  }

  void lower(ShapeDescription& shape, const HeightfieldDescription& field) {
    lowering_.explain("heightfield of " + scene_.where(shape.loc) + ": a mesh");
    auto mesh = std::make_shared<TriangleMesh>(*heightfield_mesh(scene_, field, "Mitsuba"));
    for (const Vec3f& p : mesh->positions) mesh->uvs.push_back({(p.x + 1) / 2, (p.y + 1) / 2});
    shape.geometry = described(mesh, field.face_normals);
  }

  /// The mesh as a file of its own, with its front and its light where ours are.
  void finish(ShapeDescription& shape, MeshDescription& d) {
    std::shared_ptr<const TriangleMesh> mesh = d.mesh;
    if (d.flip_tex_coords && !mesh->uvs.empty())
      mesh = changed(mesh, "flipped", [](TriangleMesh& copy) {
        for (auto& uv : copy.uvs) uv.y = 1 - uv.y;
      });
    d.flip_tex_coords = false;
    if (shape.radiance && !d.face_normals) {
      if (!is_black(shape.bsdf) && !mesh->normals.empty())
        lowering_.refuse(shape.loc,
                         "a mesh with normals that emits and reflects: Mitsuba emits by the normals of shading");
      d.face_normals = true;
      lowering_.explain("light of " + scene_.where(shape.loc) + ": flat, as Mitsuba emits by the normals of shading");
    }
    if (shape.to_world.determinant() < 0 && (d.face_normals || mesh->normals.empty())) {
      lowering_.explain("mesh of " + scene_.where(shape.loc) +
                        ": mirrored in its file, as Mitsuba would turn its front");
      mesh = changed(mesh, "mirrored", [](TriangleMesh& copy) {
        for (Vec3f& p : copy.positions) p.x = -p.x;
        for (Vec3f& n : copy.normals) n.x = -n.x;
        for (auto& [a, b, c] : copy.triangles) std::swap(b, c);
      });
      shape.to_world = shape.to_world * Transform::scale({-1, 1, 1});
    }
    d.format = MeshDescription::Format::ply;
    d.shape_index = 0;
    d.mesh = mesh;
    d.filename = lowering_.file_of(mesh);
  }

  bool is_black(BsdfIndex index) const {
    const auto* diffuse = std::get_if<DiffuseDescription>(&scene_.bsdfs[index.value].model);
    return diffuse && diffuse->reflectance == Colour(RgbD(0.0));
  }

  /// A changed copy, the same for shapes that share the mesh.
  template <class Change>
  std::shared_ptr<const TriangleMesh> changed(const std::shared_ptr<const TriangleMesh>& mesh, const std::string& how,
                                              const Change& change) {
    auto& known = copies_[{mesh, how}];
    if (!known) {
      auto copy = std::make_shared<TriangleMesh>(*mesh);
      change(*copy);
      known = copy;
    }
    return known;
  }

  void lower(ShapeDescription& shape, const CurvesDescription&) const {
    lowering_.refuse(shape.loc, "curves: not written yet");
  }
  void lower(ShapeDescription& shape, const SdfGridDescription&) const {
    lowering_.refuse(shape.loc, "a grid of signed distances: not written yet");
  }
  void lower(ShapeDescription& shape, const EllipsoidsDescription&) const {
    lowering_.refuse(shape.loc, "ellipsoids of a file: not written yet");
  }
  template <class Other>
  void lower(ShapeDescription&, const Other&) const {}

  MitsubaLowering& lowering_;
  const SceneDescription& scene_;
  Bounds3d all_;
  std::map<std::pair<std::shared_ptr<const TriangleMesh>, std::string>, std::shared_ptr<const TriangleMesh>> copies_;
};

}  // namespace

void lower_shapes(MitsubaLowering& lowering) {
  Shapes shapes(lowering);
  for (ShapeGroupDescription& group : lowering.lowered().groups)
    for (ShapeDescription& shape : group.shapes) shapes.lower(shape);
  std::vector<ShapeDescription> all;
  for (const ShapeDescription& shape : lowering.scene().shapes)
    for (ShapeDescription& part : shapes.parts(shape)) {
      shapes.lower(part);
      all.push_back(std::move(part));
    }
  lowering.lowered().shapes = std::move(all);
}

}  // namespace photonproof::inline reference_mitsuba
