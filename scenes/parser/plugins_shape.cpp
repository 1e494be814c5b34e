// Mitsuba 3's shapes and the extensions plane and heightfield; defaults are Mitsuba's.
#include <cmath>

#include "scenes/parser/plugins.h"

namespace photonproof::scene_xml {
namespace {

using Geometry = decltype(ShapeDescription::geometry);
using Row = Plugin<Geometry>;

constexpr std::int64_t kMaxCells = std::int64_t{1} << 24;  ///< of a heightfield

Geometry build_sphere(Params& params) {
  SphereDescription sphere;
  sphere.center = params.point("center", sphere.center);
  sphere.radius = params.positive("radius", sphere.radius);
  expect_similarity(params, "a sphere");
  return sphere;
}

Geometry build_rectangle(Params& params) {
  const Transform to_world = params.transform("to_world");
  params.expect(is_perpendicular(to_world.vector({1, 0, 0}), to_world.vector({0, 1, 0})), "to_world",
                "shears the rectangle, expected perpendicular sides");
  return RectangleDescription{};
}

Geometry build_disk(Params& params) {
  const Transform to_world = params.transform("to_world");
  const Vec3d x = to_world.vector({1, 0, 0}), y = to_world.vector({0, 1, 0});
  params.expect(is_perpendicular(x, y) && std::abs(length(y) / length(x) - 1) <= 1e-5, "to_world",
                "makes the disk an ellipse, expected the same scale along x and y");
  return DiskDescription{};
}

Geometry build_cube(Params&) { return CubeDescription{}; }

Geometry build_plane(Params&) { return PlaneDescription{}; }

Geometry build_cylinder(Params& params) {
  CylinderDescription cylinder;
  cylinder.p0 = params.point("p0", cylinder.p0);
  cylinder.p1 = params.point("p1", cylinder.p1);
  cylinder.radius = params.positive("radius", cylinder.radius);
  params.expect(length(cylinder.p1 - cylinder.p0) > 0, "p1", "is the same point as p0, expected another");
  expect_similarity(params, "a cylinder");
  return cylinder;
}

Geometry read_mesh(Params& params, MeshDescription::Format format, bool flips_v) {
  const bool is_ply = format == MeshDescription::Format::ply;
  params.expect(params.has("filename"), "filename",
                std::string("is missing, expected the name of ") + (is_ply ? "a PLY file" : "an OBJ file"));
  params.string("filename", "");
  MeshDescription mesh;
  mesh.format = format;
  mesh.face_normals = params.boolean("face_normals", false);
  mesh.flip_tex_coords = params.boolean("flip_tex_coords", flips_v);
  const auto loaded = params.objects().files().mesh(params.value_of("filename"), format);
  mesh.filename = loaded.name;
  mesh.mesh = loaded.content;
  return mesh;
}

Geometry build_ply(Params& params) { return read_mesh(params, MeshDescription::Format::ply, false); }

Geometry build_obj(Params& params) { return read_mesh(params, MeshDescription::Format::obj, true); }

Geometry build_heightfield(Params& params) {
  HeightfieldDescription field;
  field.columns = static_cast<int>(params.integer("columns", field.columns, 1, 1 << 20));
  field.rows = static_cast<int>(params.integer("rows", field.rows, 1, 1 << 20));
  params.expect(
      std::int64_t{field.columns} * field.rows <= kMaxCells, "columns",
      "times rows is " + std::to_string(std::int64_t{field.columns} * field.rows) + " cells, expected at most 2^24");
  field.amplitude = params.number("amplitude", field.amplitude);
  field.face_normals = params.boolean("face_normals", field.face_normals);
  if (const auto height = params.texture("height")) {
    field.height = *height;
    return field;
  }
  HeightfieldDescription::Noise noise;
  noise.frequency_x = params.number_in("frequency_x", noise.frequency_x, 0, 1e6);
  noise.frequency_y = params.number_in("frequency_y", noise.frequency_y, 0, 1e6);
  noise.octaves = static_cast<int>(params.integer("octaves", noise.octaves, 1, 16));
  noise.seed = static_cast<std::uint32_t>(params.integer("seed", noise.seed, 0, 4294967295));
  field.height = noise;
  return field;
}

Geometry build_instance(Params& params) {
  const Element& group = params.only_nested("shape");
  if (group.tag != "ref")
    params.sources().fail(group.at, "a shape inside an instance, expected a <ref> to a shapegroup of the scene");
  return InstanceDescription{params.objects().shape_group(group)};
}

std::vector<ParamSpec> with_common(std::vector<ParamSpec> own) {
  own.push_back({"to_world", ParamType::transform});
  own.push_back({"flip_normals", ParamType::boolean});
  return own;
}

const std::vector<Row>& table() {
  static const std::vector<NestedSpec> inside = {{"bsdf"}, {"emitter"}, {"medium", 2}};
  const ParamSpec filename{"filename", ParamType::string}, face_normals{"face_normals", ParamType::boolean},
      flip_tex_coords{"flip_tex_coords", ParamType::boolean}, radius{"radius", ParamType::number};
  static const std::vector<Row> rows = {
      {"cube", with_common({}), inside, build_cube},
      {"cylinder", with_common({{"p0", ParamType::point}, {"p1", ParamType::point}, radius}), inside, build_cylinder},
      {"disk", with_common({}), inside, build_disk},
      {"heightfield",
       with_common({{"columns", ParamType::integer},
                    {"rows", ParamType::integer},
                    {"amplitude", ParamType::number},
                    {"height", ParamType::texture},
                    {"frequency_x", ParamType::number},
                    {"frequency_y", ParamType::number},
                    {"octaves", ParamType::integer},
                    {"seed", ParamType::integer},
                    face_normals}),
       inside, build_heightfield},
      {"instance", {{"to_world", ParamType::transform}}, {{"shape"}}, build_instance},
      {"obj", with_common({filename, face_normals, flip_tex_coords}), inside, build_obj},
      {"plane", with_common({}), inside, build_plane},
      {"ply", with_common({filename, face_normals, flip_tex_coords}), inside, build_ply},
      {"rectangle", with_common({}), inside, build_rectangle},
      {"sphere", with_common({{"center", ParamType::point}, radius}), inside, build_sphere},
  };
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

BsdfIndex read_surface(Params& params) {
  if (!params.nested("bsdf").empty()) return params.objects().bsdf(*params.nested("bsdf").front());
  return params.objects().default_bsdf(params.object());
}

}  // namespace

ShapeDescription read_shape(SceneObjects& objects, const Element& element) {
  const Sources& sources = objects.sources();
  const Row& plugin = find_plugin(sources, element, table());
  Params params(objects, element, title_of(sources, element), plugin.params, plugin.nested);
  ShapeDescription shape;
  shape.loc = sources.loc(element.at);
  shape.id = id_of(element);
  shape.to_world = params.transform("to_world");
  params.expect(shape.to_world.inverse().has_value(), "to_world", "is singular: it flattens the shape");
  shape.geometry = plugin.build(params);
  if (plugin.build != build_instance) {
    shape.flip_normals = params.boolean("flip_normals", false);
    shape.bsdf = read_surface(params);
  }
  read_media(params, shape);
  if (!params.nested("emitter").empty()) {
    const Element& emitter = *params.nested("emitter").front();
    if (plugin.build == build_plane)
      sources.fail(emitter.at, "shape 'plane' is infinite and cannot emit, expected a shape of finite area");
    shape.radiance = read_area_emitter(objects, objects.target(emitter));
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
  for (const Element& child : element.children) {
    if (child.tag == "ref") sources.fail(child.at, "a shapegroup takes shapes, not references to them");
    const Attribute* inner = child.find("type");
    if (inner && (inner->value == "instance" || inner->value == "shapegroup"))
      fail_at(sources, *inner, "shape " + in_quotes(inner->value) + " cannot stand in a shapegroup");
    group.shapes.push_back(read_shape(objects, child));
    if (group.shapes.back().radiance) sources.fail(child.at, "a shape in a shapegroup cannot emit");
  }
  return group;
}

}  // namespace photonproof::scene_xml
