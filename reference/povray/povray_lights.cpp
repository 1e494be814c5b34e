#include "reference/povray/povray_lights.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "scenes/description/overloaded.h"
#include "scenes/text/text_numbers.h"

namespace photonproof {
namespace {

/// A permutation of 0..n-1. The engine's output is specified by the C++ standard, std::shuffle's use of it is not.
std::vector<int> permutation(int n, std::mt19937_64& random) {
  std::vector<int> order(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  return order;
}

std::string spot(const Vec3d& position, const Vec3d& normal) {
  return "Spot(" + sdl_vector(position) + ", " + sdl_vector(position + normal) + ")";
}

/// `points` shared out: all area lights keep within the number for one, but none gets fewer than 4.
PovrayLightPoints share(const PovrayLightPoints& points, const PovScene& scene) {
  const auto lights = std::count_if(scene.surfaces.begin(), scene.surfaces.end(), [](const PovSurface& surface) {
    return surface.emission == PovSurface::Emission::spots;
  });
  const auto count = static_cast<double>(std::max<std::ptrdiff_t>(lights, 1));
  return {std::max(2, static_cast<int>(std::lround(points.rectangle / std::sqrt(count)))),
          std::max(4, static_cast<int>(std::lround(points.sphere / count)))};
}

void write_area_light(const PovScene& scene, const PovSurface& surface, const PovPlan& plan,
                      const PovrayLightPoints& points, std::uint64_t seed, SdlWriter& out) {
  std::vector<std::string> spots;
  const auto refuse = []() { throw std::logic_error("lower_scene lets no such lamp through"); };
  std::visit(Overloaded{[&](const PovParallelogram& face) {
                          for (const Vec2<double>& s : square_points(points.rectangle, seed))
                            spots.push_back(spot((face.corner + face.edge_u * s.x + face.edge_v * s.y) * plan.scale,
                                                 face.normal()));
                        },
                        [&](const PovSphere& sphere) {
                          for (const Vec3d& n : sphere_points(points.sphere, seed))
                            spots.push_back(spot((sphere.center + n * sphere.radius) * plan.scale, n));
                        },
                        [&](const PovBox&) { refuse(); }, [&](const PovMesh&) { refuse(); }},
             surface.geometry);
  // Each is a small patch of the surface: intensity L A cos(angle) over the number of patches.
  const double patch = area(surface) * plan.scale * plan.scale / static_cast<double>(spots.size());
  out.explain("light of " + scene.description->where(surface.shape->loc) + ": " + std::to_string(spots.size()) +
              " points on its surface, each with its share of the flux and the cosine law");
  out.line("#declare Intensity = " + sdl_rgb(constant(*surface.shape->radiance) * (patch * plan.exposure)) + ";");
  for (const std::string& s : spots) out.line(s);
}

template <class Other>
void write_light(const Other&, const PovPlan&, SdlWriter&) {
  throw std::logic_error("lower_scene lets no such light through");
}

void write_light(const PointLightDescription& light, const PovPlan& plan, SdlWriter& out) {
  const RgbD intensity = light.intensity * (plan.scale * plan.scale * plan.exposure);
  out.line("light_source{" + sdl_vector(light.position * plan.scale) + " " + sdl_rgb(intensity) +
           "*Fade fade_distance Near fade_power 2" + (plan.photons ? " photons{reflection on refraction on}" : "") +
           "}");
}

}  // namespace

std::vector<Vec2<double>> square_points(int n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const std::vector<int> columns = permutation(n, random);
  const std::vector<int> rows = permutation(n, random);
  std::vector<Vec2<double>> points;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i)
      points.push_back({(i + (columns[static_cast<std::size_t>(j)] + 0.5) / n) / n,
                        (j + (rows[static_cast<std::size_t>(i)] + 0.5) / n) / n});
  return points;
}

std::vector<Vec3d> sphere_points(int count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const double turn = 2 * std::numbers::pi * static_cast<double>(random() >> 11) * 0x1p-53;
  const double golden_angle = std::numbers::pi * (3 - std::sqrt(5.0));
  std::vector<Vec3d> points;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count;
    const double r = std::sqrt(1 - z * z);
    const double phi = turn + golden_angle * i;
    points.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
  }
  return points;
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
    out.explain("light '" + emitter.id + "' of " + scene.description->where(emitter.loc) + ": a point");
    std::visit([&](const auto& light) { write_light(light, plan, out); }, emitter.light);
  }
  std::uint64_t number = 0;
  for (const PovSurface& surface : scene.surfaces)
    if (surface.emission == PovSurface::Emission::spots)
      write_area_light(scene, surface, plan, share(points, scene), seed + 0x9e3779b97f4a7c15u * number++, out);
}

}  // namespace photonproof
