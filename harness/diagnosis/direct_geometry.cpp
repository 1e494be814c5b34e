#include "harness/diagnosis/direct_geometry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <variant>

namespace photonproof {
namespace {

struct Lamp {
  Vec3d middle, normal;
  double power;
};

std::vector<Lamp> plain_lamps(const SceneDescription& scene) {
  std::vector<Lamp> lamps;
  for (const ShapeDescription& shape : scene.shapes) {
    if (!shape.radiance || !std::holds_alternative<RectangleDescription>(shape.geometry)) continue;
    const auto* radiance = std::get_if<RgbD>(&*shape.radiance);
    if (!radiance) continue;
    const Vec3d a = shape.to_world.vector({1, 0, 0}), b = shape.to_world.vector({0, 1, 0});
    lamps.push_back({shape.to_world.point({0, 0, 0}), normalize(shape.to_world.vector({0, 0, 1})),
                     length(cross(a, b)) * max_component(*radiance)});
  }
  return lamps;
}

/// Means over lamps, by how much light they send there.
struct Factors {
  double surface = 0, lamp = 0, distance = 0;
};

Factors factors_at(const SeenPoint& point, const std::vector<Lamp>& lamps) {
  Factors sum;
  double all = 0;
  for (const Lamp& lamp : lamps) {
    const Vec3d to = lamp.middle - point.position_world;
    const double r = length(to);
    const double surface = std::max(0.05, dot(point.normal_world, to) / r);
    const double emits = std::max(0.05, std::abs(dot(lamp.normal, to)) / r);
    const double light = lamp.power * surface * emits / (r * r);
    sum.surface += light * surface;
    sum.lamp += light * emits;
    sum.distance += light * r;
    all += light;
  }
  if (all > 0) return {sum.surface / all, sum.lamp / all, sum.distance / all};
  return {1, 1, 1};
}

struct FormulaRow {
  const char *kind, *sentence, *cause;
  double (*factor)(const Factors&);
};
constexpr FormulaRow formula_rows[] = {
    {"falloff-missing", "light does not fall off with distance",
     "direct light is not divided by the square of the distance",
     [](const Factors& f) { return f.distance * f.distance; }},
    {"falloff-linear", "light falls off too slowly with distance",
     "direct light is divided by the distance, not its square", [](const Factors& f) { return f.distance; }},
    {"falloff-twice", "light falls off too fast with distance",
     "direct light is divided by the square of the distance twice",
     [](const Factors& f) { return 1 / (f.distance * f.distance); }},
    {"cosine-missing", "direct light does not depend on the surface's angle",
     "the cosine at the surface is missing (N dot L)", [](const Factors& f) { return 1 / f.surface; }},
    {"lamp-cosine-missing", "the lamp shines as brightly to the side as ahead", "the cosine at the lamp is missing",
     [](const Factors& f) { return 1 / f.lamp; }},
    {"cosine-twice", "direct light depends too strongly on the surface's angle",
     "the cosine at the surface is taken twice", [](const Factors& f) { return f.surface; }},
};

}  // namespace

std::vector<DirectMistake> direct_mistakes(const SceneDescription& scene, const std::vector<SeenPoint>& points,
                                           const Image& direct) {
  const std::vector<Lamp> lamps = plain_lamps(scene);
  std::vector<DirectMistake> mistakes;
  if (lamps.empty()) return mistakes;
  for (const FormulaRow& row : formula_rows) {
    std::vector<double> factor(points.size(), 1), lit;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (points[i].object == 0) continue;
      factor[i] = row.factor(factors_at(points[i], lamps));
      if (direct.rgb[3 * i + 1] > 0.01f) lit.push_back(factor[i]);
    }
    if (lit.size() < 16) return {};
    std::nth_element(lit.begin(), lit.begin() + static_cast<std::ptrdiff_t>(lit.size() / 2), lit.end());
    DirectMistake mistake{row.kind, row.sentence, row.cause, direct};
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        float& v = mistake.direct.rgb[3 * i + c];
        v = static_cast<float>(v * factor[i] / lit[lit.size() / 2]);
      }
    mistakes.push_back(std::move(mistake));
  }
  return mistakes;
}

}  // namespace photonproof
