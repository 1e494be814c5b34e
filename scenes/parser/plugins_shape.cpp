// Mitsuba 3's shapes and the extensions plane and heightfield: rules that a description alone does not state.
#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/description/description.h"
#include "scenes/parser/plugin_reader.h"

namespace photonproof::scene_xml {
namespace {

using Geometry = decltype(ShapeDescription::geometry);

constexpr std::int64_t kMaxCells = std::int64_t{1} << 24;  ///< of a heightfield

Vec3d axis_of(const CylinderDescription& d) { return normalize(d.p1 - d.p0); }

/// The scale of a cylinder along its axis, in terms of that across it.
double stretch_along(const CylinderDescription& d, const Transform& to_world) {
  const double along = length(to_world.vector(axis_of(d)));
  return std::sqrt(along * along * along / std::abs(to_world.determinant()));
}

/// `to_world` with the scale across the cylinder's axis along it, too. p0 stays where it is.
Transform unstretched(const CylinderDescription& d, const Transform& to_world, double stretch) {
  const Vec3d a = axis_of(d);
  const double less = 1 / stretch - 1;
  const std::array<double, 3> axis = {a.x, a.y, a.z};
  Transform along;
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column) along.m[4 * row + column] += less * axis[row] * axis[column];
  return to_world * Transform::translate(d.p0) * along * Transform::translate(-d.p0);
}

/// A longer or shorter cylinder under a `to_world` that scales evenly.
void stretch_by_ends(CylinderDescription& d, Transform& to_world) {
  if (is_even(to_world)) return;
  const double stretch = stretch_along(d, to_world);
  to_world = unstretched(d, to_world, stretch);
  d.p1 = d.p0 + (d.p1 - d.p0) * stretch;
}

struct CompleteShape {
  Params& params;

  void operator()(SphereDescription&) const { expect_similarity(params, "a sphere"); }
  void operator()(RectangleDescription&) const {
    const Transform to_world = params.transform("to_world");
    params.expect(is_perpendicular(to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0})), "to_world",
                  "shears the rectangle, expected perpendicular sides");
  }
  void operator()(DiskDescription&) const {
    const Transform to_world = params.transform("to_world");
    params.expect(is_perpendicular(to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0})), "to_world",
                  "shears the disk, expected perpendicular axes");
  }
  void operator()(CubeDescription&) const {}
  void operator()(PlaneDescription&) const {}
  void operator()(CylinderDescription& d) const {
    params.expect(length(d.p1 - d.p0) > 0, "p1", "is the same point as p0, expected another");
    const Transform to_world = params.transform("to_world");
    const double stretch = stretch_along(d, to_world);
    params.expect(is_even(unstretched(d, to_world, stretch)), "to_world",
                  "shears a cylinder or makes it an ellipse, expected one scale across its axis");
    params.expect(to_world.determinant() > 0, "to_world", "mirrors a cylinder, expected a positive scale");
  }
  void operator()(MeshDescription& d) const {
    const auto loaded = params.objects().files().mesh(params.value_of("filename"), d.format, d.shape_index);
    d.filename = loaded.name;
    d.mesh = loaded.content;
  }
  void operator()(HeightfieldDescription& d) const {
    const std::int64_t cells = std::int64_t{d.columns} * d.rows;
    params.expect(cells <= kMaxCells, "columns",
                  "times rows is " + std::to_string(cells) + " cells, expected at most 2^24");
  }
  void operator()(CurvesDescription& d) const {
    const auto loaded = params.objects().files().curves(params.value_of("filename"), d.points_of_segment());
    d.filename = loaded.name;
    d.curves = loaded.content;
  }
  void operator()(SdfGridDescription& d) const {
    const auto loaded = params.objects().files().volume(params.value_of("filename"), VolValues::any);
    d.filename = loaded.name;
    d.grid = loaded.content;
    const VolumeGrid& grid = *d.grid;
    params.expect(grid.channels == 1, "filename", "names a grid of 3 channels, expected one of distances");
    params.expect(std::min({grid.width, grid.height, grid.depth}) >= 2, "filename",
                  "names a grid of one sample along an axis, expected at least 2");
    const auto is_inside = [](float distance) { return distance <= 0; };
    params.expect(grid.largest >= 0 && std::ranges::any_of(grid.values, is_inside), "filename",
                  "names a grid without a surface, expected distances of both signs");
  }
  void operator()(EllipsoidsDescription& d) const {
    const auto loaded = params.objects().files().ellipsoids(params.value_of("filename"));
    d.filename = loaded.name;
    d.cloud = loaded.content;
  }
  void operator()(InstanceDescription&) const {}
};

/// Mitsuba turns the v of an OBJ over, but not that of a PLY, which has the kind's own row. So have B-splines.
std::vector<Plugin<Geometry>> shape_plugins() {
  std::vector<Plugin<Geometry>> rows = described_plugins<Geometry, CompleteShape>();
  MeshDescription obj;
  obj.format = MeshDescription::Format::obj;
  obj.flip_tex_coords = true;
  rows.push_back(described_plugin<Geometry, CompleteShape>(obj));
  MeshDescription serialized;
  serialized.format = MeshDescription::Format::serialized;
  rows.push_back(described_plugin<Geometry, CompleteShape>(serialized));
  CurvesDescription linear;
  linear.basis = CurvesDescription::Basis::linear;
  rows.push_back(described_plugin<Geometry, CompleteShape>(linear));
  EllipsoidsDescription shells;
  shells.triangles = true;
  rows.push_back(described_plugin<Geometry, CompleteShape>(shells));
  sort_by_name(rows);
  return rows;
}

void read_media(Params& params, ShapeDescription& shape) {
  for (const Element* element : params.nested("medium")) {
    const Attribute& name = require(params.sources(), *element, "name");
    const bool interior = name.value == "interior";
    if (!interior && name.value != "exterior")
      fail_at(params.sources(), name,
              "the medium's name is " + in_quotes(name.value) + did_you_mean(name.value, {"interior", "exterior"}) +
                  ", expected interior or exterior");
    std::optional<MediumIndex>& medium = interior ? shape.interior : shape.exterior;
    if (medium) fail_at(params.sources(), name, params.title() + " has a second medium " + in_quotes(name.value));
    medium = params.objects().medium(*element);
  }
}

bool is_flat(const ShapeDescription& shape) {
  return std::holds_alternative<RectangleDescription>(shape.geometry) ||
         std::holds_alternative<DiskDescription>(shape.geometry);
}

BsdfIndex read_surface(Params& params) {
  if (!params.nested("bsdf").empty()) return params.objects().bsdf(*params.nested("bsdf").front());
  return params.objects().default_bsdf(params.object(), !params.nested("emitter").empty());
}

}  // namespace

ShapeDescription read_shape(SceneObjects& objects, const Element& element) {
  const Sources& sources = objects.sources();
  static const std::vector<Plugin<Geometry>> table = shape_plugins();
  const Plugin<Geometry>& plugin = find_plugin(sources, element, table);
  Params params(objects, element, title_of(sources, element), plugin.params, plugin.nested);
  ShapeDescription shape;
  shape.loc = sources.loc(element.at);
  shape.id = id_of(element);
  shape.to_world = params.transform("to_world");
  params.expect(shape.to_world.inverse().has_value(), "to_world", "is singular: it flattens the shape");
  shape.geometry = plugin.build(params);
  if (auto* cylinder = std::get_if<CylinderDescription>(&shape.geometry)) stretch_by_ends(*cylinder, shape.to_world);
  if (!std::holds_alternative<InstanceDescription>(shape.geometry)) {
    shape.flip_normals = params.boolean("flip_normals", false);
    shape.bsdf = read_surface(params);
  }
  read_media(params, shape);
  if (!params.nested("emitter").empty()) {
    const Element& emitter = *params.nested("emitter").front();
    if (!std::visit([]<class Kind>(const Kind&) { return Kind::finite; }, shape.geometry))
      sources.fail(emitter.at, params.title() + " is infinite and cannot emit, expected a shape of finite area");
    const ShapeEmission emission = read_shape_emitter(objects, objects.target(emitter));
    if (emission.along_normal && !is_flat(shape))
      sources.fail(emitter.at,
                   "emitter 'directionalarea' stands in a " + plugin.type + ", expected it in a rectangle or disk");
    shape.radiance = emission.radiance;
    shape.emits_along_normal = emission.along_normal;
  }
  params.finish();
  return shape;
}

ShapeGroupDescription read_shape_group(SceneObjects& objects, const Element& element) {
  const Sources& sources = objects.sources();
  const Attribute& type = require(sources, element, "type");
  if (type.value != "shapegroup")
    fail_at(sources, type, "shape " + in_quotes(type.value) + " cannot be instanced, expected a shapegroup");
  check_attributes(sources, element, {"type", "id", "name"});
  const Params params(objects, element, title_of(sources, element), {}, {{"shape", kMaxElements}});
  ShapeGroupDescription group{sources.loc(element.at), id_of(element), {}};
  const auto read_member = [&](const Element& child) {
    if (child.tag == "ref") sources.fail(child.at, "a shapegroup takes shapes, not references to them");
    const Attribute* inner = child.find("type");
    if (inner && (inner->value == "instance" || inner->value == "shapegroup"))
      fail_at(sources, *inner, "shape " + in_quotes(inner->value) + " cannot stand in a shapegroup");
    ShapeDescription shape = read_shape(objects, child);
    if (shape.radiance) sources.fail(child.at, "a shape in a shapegroup cannot emit");
    if (std::ranges::any_of(child.children, [](const Element& inside) { return inside.tag == "sensor"; }))
      sources.fail(child.at, "a shape in a shapegroup cannot measure");
    group.shapes.push_back(std::move(shape));
  };
  for (const Element& child : element.children) objects.obstacles().attempt([&] { read_member(child); });
  return group;
}

}  // namespace photonproof::scene_xml
