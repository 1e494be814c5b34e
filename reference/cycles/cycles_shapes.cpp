#include "reference/cycles/cycles_shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "reference/cycles/cycles_shaders.h"
#include "reference/cycles/python_text.h"
#include "reference/engines/far_square.h"
#include "reference/engines/heightfield_mesh.h"
#include "scenes/base/bounds.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_cycles {
namespace {

/// A shape at its place: itself, or placed by an instance.
struct Placed {
  const ShapeDescription* shape;
  Transform to_world;
};

void flatten(const SceneDescription& scene, const ShapeDescription& shape, const Transform& outer,
             std::vector<Placed>& placed) {
  const Transform to_world = outer * shape.to_world;
  if (const auto* instance = std::get_if<InstanceDescription>(&shape.geometry)) {
    for (const ShapeDescription& of : scene.groups[instance->group.value].shapes) flatten(scene, of, to_world, placed);
    return;
  }
  placed.push_back({&shape, to_world});
}

/// From the unit ball, or the unit cylinder along z from 0 to 1, to the shape's local space.
Transform frame_of(const SphereDescription& sphere) {
  return Transform::translate(sphere.center) * Transform::scale(Vec3d(sphere.radius));
}
Transform frame_of(const CylinderDescription& cylinder) {
  const Vec3d axis = cylinder.p1 - cylinder.p0, z = normalize(axis);
  // Origin of the angle in uv: the frame of Duff et al. 2017.
  const double sign = std::copysign(1.0, z.z), a = -1 / (sign + z.z), b = z.x * z.y * a, r = cylinder.radius;
  const Vec3d x = Vec3d{1 + sign * z.x * z.x * a, sign * b, -sign * z.x} * r;
  const Vec3d y = Vec3d{b, sign + z.y * z.y * a, -z.y} * r;
  Transform t;
  t.m = {x.x, y.x, axis.x, cylinder.p0.x, x.y, y.y, axis.y, cylinder.p0.y, x.z, y.z, axis.z, cylinder.p0.z, 0, 0, 0, 1};
  return t;
}

/// The mesh with the uv of docs/formats/scene.md, which are the square's.
std::shared_ptr<const TriangleMesh> with_uv(const TriangleMesh& heights) {
  auto mesh = std::make_shared<TriangleMesh>(heights);
  mesh->uvs.clear();
  for (const Vec3f& p : mesh->positions) mesh->uvs.push_back({(p.x + 1) / 2, (p.y + 1) / 2});
  return mesh;
}

class Shapes {
 public:
  explicit Shapes(CyclesScript& script) : script_(script), scene_(script.scene()) {}

  void write() {
    for (const ShapeDescription& shape : scene_.shapes) flatten(scene_, shape, Transform(), placed_);
    for (const Placed& placed : placed_) {
      if (!std::holds_alternative<HeightfieldDescription>(placed.shape->geometry)) continue;
      const auto& field = std::get<HeightfieldDescription>(placed.shape->geometry);
      heights_[placed.shape] = with_uv(*heightfield_mesh(scene_, field, "Cycles"));
    }
    for (const Placed& placed : placed_) check_media(placed);
    bound();
    count_balls();
    for (const Placed& placed : placed_) write(placed);
  }

 private:
  Bounds3d bounds_of(const Placed& placed) const {
    Bounds3d bounds;
    const auto corners = [&](const Transform& t, const Vec3d& low, const Vec3d& high) {
      for (int i = 0; i < 8; ++i)
        bounds.add(
            t.point({(i & 1) != 0 ? high.x : low.x, (i & 2) != 0 ? high.y : low.y, (i & 4) != 0 ? high.z : low.z}));
    };
    const auto vertices = [&](const TriangleMesh& mesh) {
      for (const Vec3f& p : mesh.positions) bounds.add(placed.to_world.point(Vec3d(p)));
    };
    std::visit(Overloaded{[&](const SphereDescription& s) {
                            const Vec3d center = placed.to_world.point(s.center);
                            const Vec3d reach(s.radius * placed.to_world.similarity_scale());
                            bounds.add(center - reach);
                            bounds.add(center + reach);
                          },
                          [&](const CylinderDescription& c) {
                            corners(placed.to_world * frame_of(c), {-1, -1, 0}, {1, 1, 1});
                          },
                          [&](const CubeDescription&) { corners(placed.to_world, Vec3d(-1.0), Vec3d(1.0)); },
                          [&](const MeshDescription& m) { vertices(*m.mesh); },
                          [&](const HeightfieldDescription&) { vertices(*heights_.at(placed.shape)); },
                          [&](const PlaneDescription&) {},
                          [&](const auto&) {
                            corners(placed.to_world, {-1, -1, 0}, {1, 1, 0});
                          }},
               placed.shape->geometry);
    return bounds;
  }

  /// Refuses overlapping media: Cycles adds them up, where a scene's surface ends one and begins the other.
  void check_media(const Placed& placed) {
    const ShapeDescription& shape = *placed.shape;
    if (shape.exterior && shape.exterior != shape.interior)
      script_.refuse(shape.loc, "a medium before a surface: Cycles' volumes are inside of bodies");
    if (!shape.interior) return;
    const Bounds3d bounds = bounds_of(placed);
    for (const Bounds3d& other : media_)
      if (bounds.overlaps(other))
        script_.refuse(shape.loc, "a medium where another is: Cycles adds up media that overlap");
    media_.push_back(bounds);
  }

  void bound() {
    for (const Placed& placed : placed_) {
      const Bounds3d bounds = bounds_of(placed);
      if (!bounds.empty()) all_.add(bounds.low), all_.add(bounds.high);
    }
    if (all_.empty()) all_ = {Vec3d(-1.0), Vec3d(1.0)};
    all_.add(scene_.sensor.to_world.point({0, 0, 0}));
  }

  void count_balls() {
    for (const Placed& placed : placed_)
      if (std::holds_alternative<SphereDescription>(placed.shape->geometry))
        ++(placed.shape->radiance ? glowing_ : balls_);
  }

  void write(const Placed& placed) {
    const ShapeDescription& shape = *placed.shape;
    if (is_nothing(scene_, shape.bsdf) && !shape.interior && !shape.radiance) return;
    if (shape.emits_along_normal) script_.refuse(shape.loc, "a light that shines along its normal: not written yet");
    const std::string name = "shape_" + std::to_string(written_++);
    script_.explain(name + " of " + scene_.where(shape.loc));
    const auto [form, frame] =
        std::visit([&](const auto& geometry) { return form_of(placed, geometry); }, shape.geometry);
    const bool hidden = shape.radiance && scene_.integrator.limits().hide_emitters;
    script_.line("shape(" + py_string(name) + ", " + form + ", " + py_columns(frame) + ", " + material_of(placed) +
                 (hidden ? ", hidden=True)" : ")"));
  }

  /// The name of the variable that holds the shape's material, which is written at its first use.
  std::string material_of(const Placed& placed) {
    const ShapeDescription& shape = *placed.shape;
    const CyclesMaterial material{shape.bsdf, shape.radiance, shape.interior, has_leaning_normals(shape),
                                  can_be_aimed_at(placed)};
    for (const auto& [known, name] : materials_)
      if (known == material) return name;
    const BsdfDescription& bsdf = scene_.bsdfs[shape.bsdf.value];
    const std::string name = "material_" + std::to_string(materials_.size());
    script_.explain(name + ": bsdf '" + bsdf.id + "' of " + scene_.where(bsdf.loc));
    script_.line(name + " = " + material_py(script_, name, material));
    materials_.emplace_back(material, name);
    return name;
  }

  static bool has_leaning_normals(const ShapeDescription& shape) {
    const auto* mesh = std::get_if<MeshDescription>(&shape.geometry);
    const auto* field = std::get_if<HeightfieldDescription>(&shape.geometry);
    return (mesh && !mesh->face_normals) || (field && !field->face_normals);
  }

  const auto& model_of(const Placed& placed) const { return scene_.bsdfs[placed.shape->bsdf.value].model; }

  /// Blender 3.4 samples a triangle by solid angle where its longest edge exceeds (distance from its plane / twice its
  /// area), and loses light. The light of `roughness` loses 0.75 % as two triangles, 0.2 % as 4 x 4 squares, and
  /// nothing visible as 16 x 16. Squares of edge a are sampled by area from a distance of a^3 sqrt(2) on; that distance
  /// is a hundredth of the scene's diagonal here.
  int cells_of(const Transform& to_world) const {
    const double edge = std::cbrt(length(all_.high - all_.low) / 100 / std::sqrt(2.0));
    const double side = 2 * std::max(length(to_world.vector({1, 0, 0})), length(to_world.vector({0, 1, 0})));
    return static_cast<int>(std::clamp(std::ceil(side / edge), 1.0, 64.0));
  }

  /// Cycles' direction sampling loses light where a triangle is wide and near. A light of `parallel-planes` loses 0.1 %
  /// where it is 200 times as wide as it is far, 1 % at 2000 times. Rays easily hit such a light by chance.
  bool can_be_aimed_at(const Placed& placed) const {
    if (!placed.shape->radiance) return true;
    constexpr double too_wide = 30;
    double thinnest = std::numeric_limits<double>::infinity();
    for (const double side : {all_.high.x - all_.low.x, all_.high.y - all_.low.y, all_.high.z - all_.low.z})
      if (side > 0) thinnest = std::min(thinnest, side);
    const Bounds3d bounds = bounds_of(placed);
    const Vec3d size = bounds.high - bounds.low;
    return std::max({size.x, size.y, size.z}) <= too_wide * thinnest;
  }

  using Form = std::pair<std::string, Transform>;

  static std::string form_py(const std::string& kind, bool flip, const std::string& more = "") {
    return "form(" + py_string(kind) + ", " + (flip ? "True" : "False") + more + ")";
  }

  Form form_of(const Placed& placed, const SphereDescription& sphere) const {
    // Each facet of a light is a light of its own; a scene may have many of them.
    const std::optional<Colour>& radiance = placed.shape->radiance;
    if (radiance && std::holds_alternative<RgbD>(*radiance) &&
        std::holds_alternative<DiffuseDescription>(model_of(placed)))
      return {form_py("icosphere", placed.shape->flip_normals, glowing_ > 16 ? ", 4" : ", 6"),
              placed.to_world * frame_of(sphere)};
    const int segments = radiance ? 128 : balls_ > 64 ? 128 : 512;
    return {form_py("sphere", placed.shape->flip_normals, ", " + std::to_string(segments)),
            placed.to_world * frame_of(sphere)};
  }
  Form form_of(const Placed& placed, const CylinderDescription& cylinder) const {
    return {form_py("cylinder", placed.shape->flip_normals), placed.to_world * frame_of(cylinder)};
  }
  Form form_of(const Placed& placed, const RectangleDescription&) const {
    const int cells = placed.shape->radiance ? cells_of(placed.to_world) : 1;
    return {form_py("rectangle", placed.shape->flip_normals, cells > 1 ? ", " + std::to_string(cells) : ""),
            placed.to_world};
  }
  Form form_of(const Placed& placed, const CubeDescription&) const {
    return {form_py("cube", placed.shape->flip_normals), placed.to_world};
  }
  Form form_of(const Placed& placed, const DiskDescription&) const {
    return {form_py("disk", placed.shape->flip_normals), placed.to_world};
  }
  Form form_of(const Placed& placed, const MeshDescription& mesh) {
    return {mesh_py(mesh.mesh, placed.shape->flip_normals, mesh.flip_tex_coords, !mesh.face_normals), placed.to_world};
  }
  Form form_of(const Placed& placed, const HeightfieldDescription& field) {
    return {mesh_py(heights_.at(placed.shape), placed.shape->flip_normals, false, !field.face_normals),
            placed.to_world};
  }
  /// A square far beyond everything, in the plane's own uv.
  Form form_of(const Placed& placed, const PlaneDescription&) {
    const auto mesh = far_square(placed.to_world, all_);
    if (!mesh) script_.refuse(placed.shape->loc, "a plane whose to_world has no inverse");
    return {mesh_py(mesh, placed.shape->flip_normals, false, false), placed.to_world};
  }
  Form form_of(const Placed& placed, const CurvesDescription&) const {
    script_.refuse(placed.shape->loc, "curves: Cycles draws its own kinds of them, and sees their inside");
  }
  Form form_of(const Placed& placed, const SdfGridDescription&) const {
    script_.refuse(placed.shape->loc, "a grid of signed distances: Cycles has none");
  }
  Form form_of(const Placed& placed, const EllipsoidsDescription&) const {
    script_.refuse(placed.shape->loc, "ellipsoids of a file: Cycles would see their inside");
  }
  Form form_of(const Placed&, const InstanceDescription&) { throw std::logic_error("instances are flattened"); }

  std::string mesh_py(const std::shared_ptr<const TriangleMesh>& mesh, bool turned, bool flip_v, bool smooth) {
    CyclesFile file;
    file.mesh = mesh;
    file.turned = turned;
    file.flip_v = flip_v;
    const auto flag = [](bool value) { return value ? ", True" : ", False"; };
    const bool normals = smooth && !mesh->normals.empty();
    // The file has its triangles in the right order already.
    return form_py("file", false,
                   ", " + py_string(script_.file_of(file)) + ", " + std::to_string(mesh->positions.size()) + ", " +
                       std::to_string(mesh->triangles.size()) + flag(!mesh->uvs.empty()) + flag(normals) +
                       flag(smooth));
  }

  CyclesScript& script_;
  const SceneDescription& scene_;
  std::vector<Placed> placed_;
  std::map<const ShapeDescription*, std::shared_ptr<const TriangleMesh>> heights_;
  std::vector<std::pair<CyclesMaterial, std::string>> materials_;
  std::vector<Bounds3d> media_;
  Bounds3d all_;
  int balls_ = 0, glowing_ = 0, written_ = 0;
};

}  // namespace

void write_shapes(CyclesScript& script) { Shapes(script).write(); }

}  // namespace photonproof::inline reference_cycles
