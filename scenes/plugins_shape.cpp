// Mitsuba 3's sphere, rectangle, cube and ply; defaults are its.
#include <cmath>

#include "scenes/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Geometry = decltype(ShapeDescription::geometry);

constexpr double kShearTolerance = 1e-5;  // what six printed digits of a matrix leave

/// The images of the local x, y and z axes.
std::vector<Vec3d> axes_of(const Transform& t) {
  return {t.vector({1, 0, 0}), t.vector({0, 1, 0}), t.vector({0, 0, 1})};
}

bool perpendicular(const Vec3d& a, const Vec3d& b) {
  return std::abs(dot(normalize(a), normalize(b))) <= kShearTolerance;
}

Geometry build_sphere(Params& params) {
  SphereDescription sphere;
  sphere.center = params.point("center", sphere.center);
  sphere.radius = params.positive("radius", sphere.radius);
  const auto axes = axes_of(params.transform("to_world"));
  const double size = length(axes[0]);
  const bool uniform = std::abs(length(axes[1]) / size - 1) <= kShearTolerance &&
                       std::abs(length(axes[2]) / size - 1) <= kShearTolerance;
  params.expect(
      uniform && perpendicular(axes[0], axes[1]) && perpendicular(axes[1], axes[2]) && perpendicular(axes[2], axes[0]),
      "to_world", "scales unevenly or shears, which a sphere cannot, expected a uniform scale");
  params.expect(dot(cross(axes[0], axes[1]), axes[2]) > 0, "to_world",
                "mirrors a sphere, expected a positive scale (flip_normals turns it inside out)");
  return sphere;
}

Geometry build_rectangle(Params& params) {
  const auto axes = axes_of(params.transform("to_world"));
  params.expect(perpendicular(axes[0], axes[1]), "to_world", "shears the rectangle, expected perpendicular sides");
  return RectangleDescription{};
}

Geometry build_cube(Params&) { return CubeDescription{}; }

/// All but the mesh, which read_shape loads.
Geometry build_ply(Params& params) {
  params.expect(params.has("filename"), "filename", "is missing, expected the name of a PLY file");
  return MeshDescription{MeshDescription::Format::ply, params.string("filename", ""),
                         params.boolean("face_normals", false), false, nullptr};
}

std::vector<ParamSpec> with_common(std::vector<ParamSpec> own) {
  own.push_back({"to_world", ParamType::transform});
  own.push_back({"flip_normals", ParamType::boolean});
  return own;
}

const std::vector<Plugin<Geometry>>& table() {
  static const std::vector<std::string> nested = {"bsdf", "ref", "emitter"};
  static const std::vector<Plugin<Geometry>> rows = {
      {"cube", with_common({}), nested, build_cube},
      {"ply", with_common({{"filename", ParamType::string}, {"face_normals", ParamType::boolean}}), nested, build_ply},
      {"rectangle", with_common({}), nested, build_rectangle},
      {"sphere", with_common({{"center", ParamType::point}, {"radius", ParamType::number}}), nested, build_sphere},
  };
  return rows;
}

}  // namespace

ShapeDescription read_shape(const Sources& sources, const Element& element, MeshFiles& meshes) {
  const Plugin<Geometry>& plugin = find_plugin(sources, element, table());
  Params params(sources, element, title_of(sources, element), plugin.params);
  ShapeDescription shape;
  shape.loc = sources.loc(element.at);
  shape.id = id_of(element);
  shape.to_world = params.transform("to_world");
  params.expect(shape.to_world.inverse().has_value(), "to_world", "is singular: it flattens the shape");
  shape.geometry = plugin.build(params);
  shape.flip_normals = params.boolean("flip_normals", false);
  params.finish();
  if (auto* ply = std::get_if<MeshDescription>(&shape.geometry)) ply->mesh = meshes.load(params.value_of("filename"));
  if (const Element* emitter = find_nested(element, "emitter")) shape.radiance = read_area_emitter(sources, *emitter);
  return shape;
}

}  // namespace photonproof::scene_xml
