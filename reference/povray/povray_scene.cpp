#include "reference/povray/povray_scene.h"

#include <numbers>

#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_povray {
namespace {

PovParallelogram flipped(const PovParallelogram& p) { return {p.corner, p.edge_v, p.edge_u}; }

}  // namespace

std::array<Vec3d, 4> PovParallelogram::vertices() const {
  return {corner, corner + edge_u, corner + edge_u + edge_v, corner + edge_v};
}
Vec3d PovParallelogram::normal() const { return normalize(cross(edge_u, edge_v)); }
double PovParallelogram::area() const { return length(cross(edge_u, edge_v)); }

std::array<PovParallelogram, 6> PovBox::faces() const {
  const Vec3d x = to_world.vector({1, 0, 0});
  const Vec3d y = to_world.vector({0, 1, 0});
  const Vec3d z = to_world.vector({0, 0, 1});
  const Vec3d c = to_world.point({0, 0, 0});
  // Seen from outside, each winds counter-clockwise as long as (x, y, z) is right-handed.
  const auto face = [&](const Vec3d& n, const Vec3d& u, const Vec3d& v) {
    const PovParallelogram p{c + n - u - v, u * 2.0, v * 2.0};
    return inward != (to_world.determinant() < 0) ? flipped(p) : p;
  };
  return {face(x, y, z), face(-x, z, y), face(y, z, x), face(-y, x, z), face(z, x, y), face(-z, y, x)};
}

double area(const PovSurface& surface) {
  constexpr double pi = std::numbers::pi;
  const auto of_box = [](const PovBox& box) {
    double sum = 0;
    for (const PovParallelogram& side : box.faces()) sum += side.area();
    return sum;
  };
  const auto of_round = [](const PovRound& round) {
    const double r = round.radius();
    return round.kind == PovRound::Kind::disk ? pi * r * r : 2 * pi * r * round.height();
  };
  return std::visit(Overloaded{[](const PovSphere& sphere) { return 4 * pi * sphere.radius * sphere.radius; },
                               [](const PovParallelogram& face) { return face.area(); },
                               [](const PovMesh& mesh) { return mesh.area; }, of_box, of_round},
                    surface.geometry);
}

PovExtent extent(const PovSurface& surface) {
  PovExtent found;
  const auto add_all = [&](const auto& corners) {
    found.points.insert(found.points.end(), corners.begin(), corners.end());
  };
  std::visit(Overloaded{[&](const PovSphere& sphere) {
                          found = {{sphere.center}, sphere.radius};
                        },
                        [&](const PovParallelogram& face) { add_all(face.vertices()); },
                        [&](const PovMesh& mesh) { add_all(mesh.box_corners()); },
                        [&](const PovRound& round) {
                          // The corners of the box around it, in its own axes.
                          const double top = round.kind == PovRound::Kind::cylinder ? 1 : 0;
                          for (const double z : {0.0, top})
                            for (const double x : {-1.0, 1.0})
                              for (const double y : {-1.0, 1.0})
                                found.points.push_back(round.to_world.point({x, y, z}));
                        },
                        [&](const PovBox& box) {
                          for (const PovParallelogram& side : box.faces()) add_all(side.vertices());
                        }},
             surface.geometry);
  return found;
}

bool is_diffuse(const PovSurface& surface) { return surface.optics.diffuse.greatest > 0; }

bool is_specular(const PovSurface& surface) { return surface.optics.specular; }

bool is_glass(const PovSurface& surface) { return surface.optics.refracts; }

std::optional<Vec3d> position_of(const EmitterDescription& emitter) {
  return std::visit(
      Overloaded{[](const PointLightDescription& light) -> std::optional<Vec3d> { return light.position; },
                 [](const SpotLightDescription& light) -> std::optional<Vec3d> {
                   return light.to_world.point({0, 0, 0});
                 },
                 [](const IesLightDescription& light) -> std::optional<Vec3d> {
                   return light.to_world.point({0, 0, 0});
                 },
                 [](const auto&) -> std::optional<Vec3d> { return std::nullopt; }},
      emitter.light);
}

bool is_sky(const EmitterDescription& emitter) {
  return std::holds_alternative<ConstantLightDescription>(emitter.light) ||
         std::holds_alternative<EnvmapDescription>(emitter.light) ||
         std::holds_alternative<SunSkyDescription>(emitter.light);
}

RgbD mean_radiance(const EmitterDescription& sky) {
  if (const auto* constant_sky = std::get_if<ConstantLightDescription>(&sky.light)) return constant_sky->radiance;
  const auto& map = std::get<EnvmapDescription>(sky.light);
  const Image& image = *map.image;
  RgbD sum(0.0);
  for (std::size_t i = 0; i < image.rgb.size(); i += 3)
    sum += RgbD(double{image.rgb[i]}, double{image.rgb[i + 1]}, double{image.rgb[i + 2]});
  return sum * (map.scale / static_cast<double>(image.pixels()));
}

}  // namespace photonproof::inline reference_povray
