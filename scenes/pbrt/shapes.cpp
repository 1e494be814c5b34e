#include "scenes/pbrt/shapes.h"

#include <cmath>
#include <numbers>

#include "scenes/base/text_numbers.h"
#include "scenes/pbrt/mesh_data.h"

namespace photonproof::inline scenes_pbrt {
namespace {

constexpr std::size_t kMostEdges = 1024;

Vec3d edge(const TriangleMesh& mesh, const TriangleMesh::Triangle& t, std::size_t k) {
  return Vec3d(mesh.positions[t[k]]) - Vec3d(mesh.positions[t[0]]);
}

}  // namespace

bool is_similarity(const Transform& t) {
  const Vec3d x = t.vector({1, 0, 0}), y = t.vector({0, 1, 0}), z = t.vector({0, 0, 1});
  const double s = length(x), tolerance = 3e-6;
  return s > 0 && std::abs(length(y) / s - 1) < tolerance && std::abs(length(z) / s - 1) < tolerance &&
         std::abs(dot(x, y)) < tolerance * s * s && std::abs(dot(y, z)) < tolerance * s * s &&
         std::abs(dot(z, x)) < tolerance * s * s;
}

void PbrtShapes::add(const std::string& type, const PbrtParameters& p, const PbrtState& state, int group) {
  Placed placed;
  PbrtMaterials::Made material = materials_.masked(materials_.made(state, p), p);
  const bool emits_image = state.area_light && state.area_light->parameters.has("filename");
  const bool in_group = group >= 0;
  placed.shape.to_world = in_group ? state.ctm : context_.to_ours * state.ctm;
  if (!placed.shape.to_world.inverse()) p.fail("is flattened by its transform");
  if (type == "curve") return add_curve(p, state, placed.shape.to_world, material.bsdf, group);
  place(type, p, material.textured || emits_image, in_group, placed);
  placed.shape.flip_normals = state.reverse;
  placed.shape.bsdf = material.bsdf;
  placed.shape.interior = medium(state.inside, p);
  placed.shape.exterior = medium(state.outside, p);
  p.finish();
  if (state.area_light) {
    if (!in_group) return add_light(*state.area_light, placed);
    context_.log.note(state.area_light->parameters.at(),
                      "shapes of objects that are instanced do not emit, as in pbrt");
  }
  (in_group ? context_.scene.groups[static_cast<std::size_t>(group)].shapes : context_.scene.shapes)
      .push_back(placed.shape);
}

void PbrtShapes::add_curve(const PbrtParameters& p, const PbrtState& state, const Transform& to_world, BsdfIndex bsdf,
                           int group) {
  if (state.area_light) p.fail("has an AreaLightSource, but curves do not emit here");
  if (!state.inside.empty() || !state.outside.empty())
    context_.log.note(p.at(), "curves have no media within: those of a 'curve' are left out");
  curves_.add(p, to_world, bsdf, group);
}

void PbrtShapes::place(const std::string& type, const PbrtParameters& p, bool textured, bool in_group, Placed& placed) {
  if (type == "trianglemesh" || type == "loopsubdiv") {
    if (type == "loopsubdiv") {
      p.ignore({"levels"});
      context_.log.note(p.at(), "shape 'loopsubdiv' is rendered as its control mesh: its surface is not smoothed");
    }
    return use(files_[{"#" + std::to_string(files_.size()), textured}] = written(triangle_mesh_of(p), textured),
               placed);
  }
  if (type == "bilinearmesh") {
    bool is_bent = false;
    TriangleMesh mesh = bilinear_mesh_of(p, is_bent);
    if (is_bent)
      context_.log.note(p.at(), "patches of a 'bilinearmesh' that are bent are rendered as two triangles each");
    return use(files_[{"#" + std::to_string(files_.size()), textured}] = written(std::move(mesh), textured), placed);
  }
  if (type == "plymesh") return use(file_mesh(p, textured), placed);
  if (type != "sphere" && type != "disk" && type != "cylinder")
    p.fail(
        "is not supported, expected trianglemesh, plymesh, bilinearmesh, loopsubdiv, curve, sphere, disk or cylinder");
  const PbrtQuadric q = quadric(type, p);
  if (!textured && !in_group && q.is_whole() && place_whole(q, placed)) return;
  context_.log.note(p.at(),
                    "spheres, disks and cylinders that are textured, cut, stretched or instanced are rendered as "
                    "triangles");
  use(quadric_mesh(q), placed);
}

PbrtQuadric PbrtShapes::quadric(const std::string& type, const PbrtParameters& p) const {
  PbrtQuadric q;
  q.radius = p.number("radius", 1, 1e-30, 1e30);
  q.sweep_degrees = p.number("phimax", 360, 1e-3, 360);
  if (type == "disk") {
    q.kind = PbrtQuadric::Kind::disk;
    q.inner = p.number("innerradius", 0, 0, q.radius);
    q.bottom = q.top = p.number("height", 0);
    return q;
  }
  if (type == "cylinder") q.kind = PbrtQuadric::Kind::cylinder;
  const double end = type == "cylinder" ? 1 : q.radius;
  const double a = p.number("zmin", -end), b = p.number("zmax", end);
  q.bottom = std::min(a, b);
  q.top = std::max(a, b);
  if (type == "sphere") q.bottom = std::max(q.bottom, -q.radius), q.top = std::min(q.top, q.radius);
  if (!(q.top > q.bottom)) p.fail("has no height between zmin and zmax");
  return q;
}

bool PbrtShapes::place_whole(const PbrtQuadric& q, Placed& placed) const {
  if (!is_similarity(placed.shape.to_world)) return false;
  // These shapes stay themselves when mirrored in y, and ours are not placed by a mirror.
  Transform own;
  if (placed.shape.to_world.determinant() < 0) own = Transform::scale({1, -1, 1});
  if (q.kind == PbrtQuadric::Kind::sphere) {
    placed.shape.geometry = SphereDescription{{0, 0, 0}, q.radius};
    placed.area = 4 * std::numbers::pi * q.radius * q.radius;
  } else if (q.kind == PbrtQuadric::Kind::cylinder) {
    placed.shape.geometry = CylinderDescription{{0, 0, q.bottom}, {0, 0, q.top}, q.radius};
    placed.area = 2 * std::numbers::pi * q.radius * (q.top - q.bottom);
  } else {
    placed.shape.geometry = DiskDescription{};
    placed.area = std::numbers::pi * q.radius * q.radius;
    own = own * Transform::translate({0, 0, q.bottom}) * Transform::scale(Vec3d(q.radius));
  }
  placed.shape.to_world = placed.shape.to_world * own;
  return true;
}

const PbrtShapes::Mesh& PbrtShapes::quadric_mesh(const PbrtQuadric& q) {
  auto known = quadrics_.find(q);
  if (known != quadrics_.end()) return known->second;
  Mesh mesh;
  const TriangleMesh triangles = triangles_of(q);
  mesh.file = context_.files.write(triangles);
  mesh.has_normals = true;
  return quadrics_[q] = mesh;
}

const PbrtShapes::Mesh& PbrtShapes::file_mesh(const PbrtParameters& p, bool textured) {
  p.ignore({"edgelength"});
  if (p.has("displacement")) {
    p.find("displacement", {"texture", "float"});
    context_.log.note(p.at(), "the displacement of a 'plymesh' is left out");
  }
  const PbrtParameter* name = p.find("filename", {"string"});
  if (name == nullptr || name->strings.size() != 1) p.fail("expected a \"string filename\"");
  const auto key = std::pair(name->strings[0], textured);
  const auto known = files_.find(key);
  if (known != files_.end()) return known->second;
  const std::filesystem::path file = context_.files.find(name->strings[0], name->at);
  TriangleMesh mesh;
  try {
    mesh = read_plain_or_packed_ply(file);
  } catch (const InputError& error) {
    p.fail(*name, "cannot be used: " + error.summary());
  }
  mesh.attributes.clear();
  return files_[key] = written(std::move(mesh), textured);
}

PbrtShapes::Mesh PbrtShapes::written(TriangleMesh mesh, bool textured) {
  turn_to_normals(mesh);
  if (textured || !mesh.uvs.empty()) complete_coordinates(mesh);
  Mesh result;
  result.has_normals = !mesh.normals.empty();
  result.is_flat = !mesh.triangles.empty();
  for (const TriangleMesh::Triangle& t : mesh.triangles) {
    const Vec3d n = cross(edge(mesh, t, 1), edge(mesh, t, 2));
    if (result.edges.empty() && length(n) > 0) result.normal = normalize(n);
    if (result.edges.size() <= kMostEdges) result.edges.push_back({edge(mesh, t, 1), edge(mesh, t, 2)});
    for (const std::uint32_t corner : t)
      result.size = std::max(result.size, length(Vec3d(mesh.positions[corner]) - Vec3d(mesh.positions[0])));
    result.is_flat = result.is_flat && dot(n, result.normal) >= length(n) * (1 - 1e-6);
  }
  for (const Vec3f& p : mesh.positions)
    result.is_flat =
        result.is_flat && std::abs(dot(Vec3d(p) - Vec3d(mesh.positions[0]), result.normal)) <= 1e-5 * result.size;
  result.file = context_.files.write(mesh);
  return result;
}

void PbrtShapes::use(const Mesh& mesh, Placed& placed) {
  MeshDescription description;
  description.filename = mesh.file;
  description.face_normals = !mesh.has_normals;
  placed.shape.geometry = description;
  placed.mesh = &mesh;
}

/// The area that pbrt divides a light's power by. Each triangle is a light of its own there.
double PbrtShapes::emitting_area(const PbrtEntity& light, const Placed& placed) {
  if (placed.mesh == nullptr) return placed.area;
  if (placed.mesh->edges.empty() || placed.mesh->edges.size() > kMostEdges)
    light.parameters.fail("gives a power to a shape of so many triangles, each of which would have it");
  double area = 0;
  for (const auto& [a, b] : placed.mesh->edges) {
    const double own = length(cross(placed.shape.to_world.vector(a), placed.shape.to_world.vector(b))) / 2;
    if (area > 0 && std::abs(own / area - 1) > 1e-4)
      light.parameters.fail("gives a power to each triangle of a shape, expected triangles of the same area");
    area = own;
  }
  if (!(area > 0)) light.parameters.fail("gives a power to a shape without area");
  return area;
}

void PbrtShapes::add_light(const PbrtEntity& light, Placed& placed) {
  const PbrtParameters& p = light.parameters;
  if (light.type != "diffuse") p.fail("is not supported, expected diffuse");
  const bool two_sided = p.boolean("twosided", false);
  double factor = p.number("scale", 1, 0, 1e30) * context_.exposure;
  if (const double power = p.number("power", -1); power > 0)
    factor *= power / (std::numbers::pi * (two_sided ? 2 : 1) * emitting_area(light, placed));
  if (const PbrtParameter* file = p.find("filename", {"string"})) {
    if (p.has("L")) p.fail(*file, "is given beside L");
    if (p.has("power")) p.fail(*file, "is given beside power, expected scale");
    placed.shape.radiance = textures_.image(context_.files.find(p.text("filename", ""), file->at), false, RgbD(factor));
  } else {
    placed.shape.radiance = context_.spectra.light(p, "L") * factor;
  }
  p.finish();
  std::vector<ShapeDescription>& shapes = context_.scene.shapes;
  shapes.push_back(placed.shape);
  if (!two_sided) return;
  const bool is_disk = std::holds_alternative<DiskDescription>(placed.shape.geometry);
  if (!is_disk && (placed.mesh == nullptr || !placed.mesh->is_flat))
    return context_.log.note(p.at(), "lights that are 'twosided' shine on the front alone, except flat ones");
  const double apart = 1e-4 * (is_disk ? 1 : placed.mesh->size);
  const Vec3d front = (is_disk ? Vec3d(0, 0, 1) : placed.mesh->normal) * (placed.shape.flip_normals ? -apart : apart);
  ShapeDescription back = placed.shape;
  back.to_world = placed.shape.to_world * Transform::translate(-front);
  back.flip_normals = !back.flip_normals;
  std::swap(back.interior, back.exterior);
  shapes.push_back(back);
  context_.log.note(p.at(), "flat lights that are 'twosided' are two, a ten-thousandth of their size apart");
}

std::optional<MediumIndex> PbrtShapes::medium(const std::string& name, const PbrtParameters& p) const {
  if (name.empty()) return std::nullopt;
  const auto found = context_.media.find(name);
  if (found == context_.media.end()) p.fail("lies beside the medium " + in_quotes(name) + ", which is not defined");
  return found->second;
}

}  // namespace photonproof::inline scenes_pbrt
