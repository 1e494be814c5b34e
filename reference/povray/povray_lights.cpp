#include "reference/povray/povray_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "reference/optics/point_sets.h"
#include "reference/optics/sky_lights.h"
#include "reference/povray/povray_shades.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_povray {
namespace {

std::string spot(const Vec3d& position, const Vec3d& normal) {
  return "Spot(" + sdl_vector(position) + ", " + sdl_vector(position + normal) + ")";
}

std::ptrdiff_t area_lights(const PovScene& scene) {
  return std::count_if(scene.surfaces.begin(), scene.surfaces.end(),
                       [](const PovSurface& surface) { return surface.emission == PovSurface::Emission::spots; });
}

/// Divides `points` among all area lights, so that they stay within the number for one. No light gets fewer than 4;
/// with more than kManyLights lights a rectangle has one.
PovrayLightPoints share(const PovrayLightPoints& points, const PovScene& scene) {
  const auto count = static_cast<double>(std::max<std::ptrdiff_t>(area_lights(scene), 1));
  const int least = has_many_lights(scene) ? 1 : 2;
  return {std::max(least, static_cast<int>(std::lround(points.rectangle / std::sqrt(count)))),
          std::max(4, static_cast<int>(std::lround(points.sphere / count)))};
}

struct Patch {
  Vec3d position, normal;
  double area;
};

/// Maps the unit square to the unit disc, preserving areas (Shirley and Chiu 1997).
Vec2<double> on_disc(const Vec2<double>& s) {
  const double a = 2 * s.x - 1, b = 2 * s.y - 1;
  if (a == 0 && b == 0) return {0, 0};
  const bool wide = std::abs(a) > std::abs(b);
  const double r = wide ? a : b;
  const double phi = wide ? std::numbers::pi / 4 * (b / a) : std::numbers::pi / 2 - std::numbers::pi / 4 * (a / b);
  return {r * std::cos(phi), r * std::sin(phi)};
}

std::vector<Patch> patches(const PovParallelogram& face, const PovrayLightPoints& points, std::uint64_t seed) {
  std::vector<Patch> found;
  for (const Vec2<double>& s : square_points(points.rectangle, seed))
    found.push_back({face.corner + face.edge_u * s.x + face.edge_v * s.y, face.normal(), 0});
  return found;
}

std::vector<Patch> patches(const PovSphere& sphere, const PovrayLightPoints& points, std::uint64_t seed) {
  std::vector<Patch> found;
  for (const Vec3d& n : sphere_points(points.sphere, seed)) found.push_back({sphere.center + n * sphere.radius, n, 0});
  return found;
}

std::vector<Patch> patches(const PovRound& round, const PovrayLightPoints& points, std::uint64_t seed) {
  std::vector<Patch> found;
  const Transform& t = round.to_world;
  if (round.kind == PovRound::Kind::disk) {
    const Vec3d across = normalize(cross(t.vector({1, 0, 0}), t.vector({0, 1, 0})));
    const Vec3d n = round.inward != (t.determinant() < 0) ? -across : across;
    for (const Vec2<double>& s : square_points(points.rectangle, seed)) {
      const Vec2<double> p = on_disc(s);
      found.push_back({t.point({p.x, p.y, 0}), n, 0});
    }
    return found;
  }
  // As many as for a sphere, more around than along.
  const int side = std::max(2, static_cast<int>(std::lround(std::sqrt(points.sphere))));
  for (const Vec2<double>& s : square_points(side, seed)) {
    const Vec3d out{std::cos(2 * std::numbers::pi * s.x), std::sin(2 * std::numbers::pi * s.x), 0};
    found.push_back({t.point({out.x, out.y, s.y}), normalize(t.vector(out)), 0});
  }
  return found;
}

/// Every triangle has its share of the points by its area, one at least and a square number.
std::vector<Patch> patches(const PovMesh& mesh, const PovrayLightPoints& points, std::uint64_t seed) {
  std::vector<Patch> found;
  for (std::size_t i = 0; i < mesh.mesh->triangles.size(); ++i) {
    const auto [a, b, c] = mesh.triangle(i);
    const Vec3d across = cross(b - a, c - a);
    const double size = length(across) / 2;
    if (!(size > 0)) continue;
    const double share = points.rectangle * points.rectangle * size / mesh.area;
    const int side = std::max(1, static_cast<int>(std::ceil(std::sqrt(share))));
    for (const Vec2<double>& s : square_points(side, seed + i)) {
      const double root = std::sqrt(s.x);  // area for area
      found.push_back({a + (b - a) * (1 - root) + (c - a) * (root * s.y), normalize(across), size / (side * side)});
    }
  }
  return found;
}

std::vector<Patch> patches(const PovBox&, const PovrayLightPoints&, std::uint64_t) {
  throw std::logic_error("cubes that shine are written side by side");
}

std::string with_photons(const PovPlan& plan) { return plan.photons ? " photons{reflection on refraction on}" : ""; }

struct LightWriter {
  const PovScene& scene;
  const PovPlan& plan;
  SdlWriter& out;

  void point(const Vec3d& position, const RgbD& intensity, const std::string& more) const {
    out.line("light_source{" + sdl_vector(position * plan.scale) + " " +
             sdl_rgb(intensity * (plan.scale * plan.scale * plan.exposure)) + "*Fade fade_distance Near fade_power 2" +
             more + with_photons(plan) + "}");
  }

  void operator()(const PointLightDescription& light) const { point(light.position, light.intensity, ""); }
  void operator()(const SpotLightDescription& light) const {
    out.explain("  its cone is a shade around it that dims by the angle: POV-Ray's own falloff is another");
    const Vec3d at = light.to_world.point({0, 0, 0});
    out.line(spot_shade(light, plan.scale));
    if (light.texture) out.line(slide_shade(light, range_of(*scene.description, *light.texture).greatest, plan.scale));
    point(at, light.intensity, "");
  }
  void operator()(const IesLightDescription& light) const {
    out.explain("  its distribution is a shade around it that dims by direction, linear between the file's angles");
    const Vec3d at = light.to_world.point({0, 0, 0});
    out.line(ies_shade(light, plan.scale));
    point(at, light.intensity * greatest_candela(*light.profile), "");
  }
  void operator()(const DirectionalLightDescription& light) const { parallel(-light.direction, light.irradiance); }
  void parallel(const Vec3d& from, const RgbD& irradiance) const {
    const Vec3d at = scene.center + from * (4 * scene.radius);
    out.line("light_source{" + sdl_vector(at * plan.scale) + " " +
             sdl_rgb(irradiance * (plan.exposure / std::numbers::pi)) + "*Brightness parallel point_at " +
             sdl_vector(scene.center * plan.scale) + with_photons(plan) + "}");
  }
  template <class Other>
  void operator()(const Other&) const {
    throw std::logic_error("skies are no light_sources");
  }
};

void write_area_light(const PovScene& scene, const PovSurface& surface, const PovPlan& plan,
                      const PovrayLightPoints& points, std::uint64_t seed, double gain, SdlWriter& out) {
  if (const auto* ball = std::get_if<PovSphere>(&surface.geometry); ball && has_many_lights(scene)) {
    out.explain("light of " + scene.description->where(surface.shape->loc) +
                ": a point in its middle, pi radius^2 times its radiance, which its body lets through");
    LightWriter{scene, plan, out}.point(
        ball->center, constant(*surface.shape->radiance) * (std::numbers::pi * ball->radius * ball->radius * gain), "");
    return;
  }
  std::vector<Patch> found =
      std::visit([&](const auto& geometry) { return patches(geometry, points, seed); }, surface.geometry);
  // Each is a small patch of the surface: intensity L A cos(angle), of equal patches the whole over their number.
  for (Patch& patch : found)
    if (patch.area == 0) patch.area = area(surface) / static_cast<double>(found.size());
  out.explain("light of " + scene.description->where(surface.shape->loc) + ": " + std::to_string(found.size()) +
              " points on its surface, each with its share of the flux and the cosine law");
  double declared = 0;
  for (const Patch& patch : found) {
    if (patch.area != declared)
      out.line(
          "#declare Intensity = " +
          sdl_rgb(constant(*surface.shape->radiance) * (patch.area * gain * plan.scale * plan.scale * plan.exposure)) +
          ";");
    declared = patch.area;
    out.line(spot(patch.position * plan.scale, patch.normal));
  }
}

void write_sky_lights(const PovScene& scene, const PovPlan& plan, const PovrayLightPoints& points, std::uint64_t seed,
                      SdlWriter& out) {
  const LightWriter writer{scene, plan, out};
  if (scene.sun) {
    out.explain("the sun of " + scene.description->where(scene.sky->loc) +
                ": parallel lights from all over its disc, which itself is not drawn");
    for (const SkyLight& light : sun_lights(*scene.sun, points.sun, seed))
      writer.parallel(light.from, light.irradiance);
  }
  if (!scene.sky_as_lights) return;
  const auto lights = sky_lights(std::get<EnvmapDescription>(scene.sky->light), points.sky, seed);
  out.explain("the sky of " + scene.description->where(scene.sky->loc) + ": " + std::to_string(lights.size()) +
              " parallel lights, each with the same share of its flux");
  for (const SkyLight& light : lights) writer.parallel(light.from, light.irradiance);
}

const char* kind_of(const EmitterDescription& emitter) {
  return std::visit(
      Overloaded{[](const PointLightDescription&) { return "a point"; },
                 [](const SpotLightDescription&) { return "a spot"; },
                 [](const IesLightDescription&) { return "a point with a measured distribution"; },
                 [](const DirectionalLightDescription&) { return "parallel; POV-Ray's colour is irradiance over pi"; },
                 [](const auto&) { return "from all around"; }},
      emitter.light);
}

}  // namespace

bool has_many_lights(const PovScene& scene) { return area_lights(scene) > kManyLights; }

std::size_t lights_for_one(const PovScene& scene) {
  return static_cast<std::size_t>((area_lights(scene) + kLightsForRays - 1) / kLightsForRays);
}

void write_spot_macro(const PovPlan& plan, SdlWriter& out) {
  out.explain("POV-Ray dims by 2/(1+(d/Near)^2): times Fade that is 1/(pi d^2), and a surface shows intensity times");
  out.explain("albedo times cosine over pi d^2");
  out.line("#declare Near = 0.001;");
  out.line("#declare Fade = Brightness/(2*pi*Near*Near);");
  out.line(std::string("#macro Spot(Where, Towards) light_source{Where Intensity*Fade fade_distance Near fade_power 2 "
                       "spotlight point_at Towards radius 90 falloff 90 tightness 1") +
           (plan.photons ? " photons{reflection on refraction on}" : "") + "} #end");
}

void write_lights(const PovScene& scene, const PovPlan& plan, const PovrayLightPoints& points, std::uint64_t seed,
                  SdlWriter& out) {
  for (const EmitterDescription& emitter : scene.description->emitters) {
    if (is_sky(emitter)) continue;
    out.explain("light '" + emitter.id + "' of " + scene.description->where(emitter.loc) + ": " + kind_of(emitter));
    std::visit(LightWriter{scene, plan, out}, emitter.light);
  }
  write_sky_lights(scene, plan, points, seed, out);
  const std::size_t every = points.fewer ? lights_for_one(scene) : 1;
  std::uint64_t number = 0;
  for (const PovSurface& surface : scene.surfaces) {
    if (surface.emission != PovSurface::Emission::spots) continue;
    if (number % every == 0)
      write_area_light(scene, surface, plan, share(points, scene), seed + 0x9e3779b97f4a7c15u * number,
                       static_cast<double>(every), out);
    ++number;
  }
}

}  // namespace photonproof::inline reference_povray
