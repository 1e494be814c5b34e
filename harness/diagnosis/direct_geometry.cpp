#include "harness/diagnosis/direct_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

#include "harness/pixels/middle_of.h"

namespace photonproof::inline harness_diagnosis {
namespace {

struct Light {
  Vec3d middle, normal;
  double power;
};

/// Divides each light into nine.
std::vector<Light> plain_lights(const SceneDescription& scene) {
  std::vector<Light> lights;
  for (const ShapeDescription& shape : scene.shapes) {
    if (!shape.radiance || !std::holds_alternative<RectangleDescription>(shape.geometry)) continue;
    const auto* radiance = std::get_if<RgbD>(&*shape.radiance);
    if (!radiance) continue;
    const Vec3d a = shape.to_world.vector({1, 0, 0}), b = shape.to_world.vector({0, 1, 0});
    const double power = length(cross(a, b)) * max_component(*radiance);
    for (const double x : {-0.67, 0.0, 0.67})
      for (const double y : {-0.67, 0.0, 0.67})
        lights.push_back({shape.to_world.point({x, y, 0}), normalize(shape.to_world.vector({0, 0, 1})), power});
  }
  return lights;
}

/// Factors of the formula at a surface point for one light.
struct Factors {
  double surface, area_light, distance;
};

struct FormulaRow {
  const char *kind, *sentence, *cause;
  bool has_unit;  ///< The factor has a unit of length: an author with this mistake adjusts the lights.
  double (*factor)(const Factors&);
};
constexpr FormulaRow formula_rows[] = {
    {"falloff-missing", "light does not fall off with distance",
     "direct light is not divided by the square of the distance", true,
     [](const Factors& f) { return f.distance * f.distance; }},
    {"falloff-linear", "light falls off too slowly with distance",
     "direct light is divided by the distance, not its square", true, [](const Factors& f) { return f.distance; }},
    {"falloff-twice", "light falls off too fast with distance",
     "direct light is divided by the square of the distance twice", true,
     [](const Factors& f) { return 1 / (f.distance * f.distance); }},
    {"cosine-missing", "direct light is too bright where it comes in flat, as if the surface's angle did not matter",
     "the cosine at the surface is missing (N dot L)", false, [](const Factors& f) { return 1 / f.surface; }},
    {"lamp-cosine-missing", "the lamp shines as brightly to the side as ahead", "the cosine at the lamp is missing",
     false, [](const Factors& f) { return 1 / f.area_light; }},
    {"cosine-twice", "direct light depends too strongly on the surface's angle",
     "the cosine at the surface is taken twice", false, [](const Factors& f) { return f.surface; }},
    {"lamp-cosine-twice", "the lamp shines too little to the side", "the cosine at the lamp is taken twice", false,
     [](const Factors& f) { return f.area_light; }},
    {"cosines-missing", "direct light depends on no angle", "the cosines at the surface and at the lamp are missing",
     false, [](const Factors& f) { return 1 / (f.surface * f.area_light); }},
};

/// The mean factor over lights, weighed by the light that each sends there.
double factor_at(const SeenPlace& point, const std::vector<Light>& lights, const FormulaRow& row) {
  double sum = 0, all = 0;
  for (const Light& area_light : lights) {
    const Vec3d to = area_light.middle - point.position_world;
    const double r = length(to);
    const Factors factors{std::max(0.05, dot(point.normal_world, to) / r),
                          std::max(0.05, std::abs(dot(area_light.normal, to)) / r), r};
    const double light = area_light.power * factors.surface * factors.area_light / (r * r);
    sum += light * row.factor(factors);
    all += light;
  }
  return all > 0 ? sum / all : 1;
}

Image times_factors(Image direct, const std::vector<double>& factor, double by) {
  for (std::size_t i = 0; i < direct.rgb.size(); ++i) direct.rgb[i] *= static_cast<float>(factor[i / 3] * by);
  return direct;
}

}  // namespace

std::vector<DirectMistake> direct_mistakes(const SceneDescription& scene, const std::vector<SeenPlace>& points,
                                           const Image& direct) {
  const std::vector<Light> lights = plain_lights(scene);
  std::vector<DirectMistake> mistakes;
  if (lights.empty()) return mistakes;
  for (const FormulaRow& row : formula_rows) {
    std::vector<double> factor(points.size(), 1), lit;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].object == 0) continue;
      factor[i] = factor_at(points[i], lights, row);
      if (direct.rgb[3 * i + 1] > 0.01f) lit.push_back(factor[i]);
    }
    if (lit.size() < 16) return {};
    const double median = middle_of(std::move(lit));
    mistakes.push_back({row.kind, row.sentence, row.cause, times_factors(direct, factor, 1 / median)});
    if (!row.has_unit) mistakes.push_back({row.kind, row.sentence, row.cause, times_factors(direct, factor, 1)});
  }
  return mistakes;
}

}  // namespace photonproof::inline harness_diagnosis
