#include <array>

#include "harness/stress/ladder_rows.h"
#include "harness/stress/stage.h"

namespace photonproof {
namespace {

constexpr std::array<const char*, 6> no_numbers{"nan", "inf", "-inf", "1e400", "-1e400", "0x1p3"};
constexpr std::array<const char*, 6> extreme_numbers{"1e39", "1e308", "1e-39", "1e-50", "1e-308", "1e-320"};

template <std::size_t n>
Ladder number_in(const char* where, const SceneDescription& scene, const char* marker, const char* measure,
                 const std::array<const char*, n>& numbers) {
  Ladder ladder{"input", where, measure, {}, -1, [=](double k) {
                  StressScene rung{scene};
                  rung.replaced = marker;
                  rung.replacement = numbers[static_cast<std::size_t>(k)];
                  return rung;
                }};
  for (std::size_t i = 0; i < n; ++i) ladder.heights.push_back(static_cast<double>(i));
  ladder.engines = {"path", "photonmapper"};
  return ladder;
}

/// The text of the scene has `marker` where the number goes.
void add_numbers(std::vector<Ladder>& ladders, const std::string& where, const SceneDescription& scene,
                 const char* marker) {
  ladders.push_back(number_in(("no number as " + where).c_str(), scene, marker,
                              "k-th of nan, inf, -inf, 1e400, -1e400, 0x1p3", no_numbers));
  ladders.back().must_refuse = true;
  ladders.back().climbs_on = true;
  ladders.push_back(number_in(("extreme as " + where).c_str(), scene, marker,
                              "k-th of 1e39, 1e308, 1e-39, 1e-50, 1e-308, 1e-320: a finite picture, or said",
                              extreme_numbers));
  ladders.back().climbs_on = true;
}

}  // namespace

std::vector<Ladder> input_ladders(const std::filesystem::path&) {
  const SceneDescription lamp = stage_under(PointLightDescription{{1, 5, -1}, RgbD(0.123456789)});
  SceneDescription place = lit_stage();
  add_shape(place, SphereDescription{}, standing({0, 0.123456789, 0}, 1), {0});
  SceneDescription radius = lit_stage();
  add_shape(radius, SphereDescription{{0, 1, 0}, 0.123456789}, Transform(), {0});
  DielectricDescription ior;
  ior.int_ior = 1.23456789;
  const SceneDescription glass = stage_with_bsdf(ior);
  const SceneDescription rough = stage_with_bsdf(of_roughness<RoughConductorDescription>(0.123456789));
  std::vector<Ladder> ladders;
  add_numbers(ladders, "intensity", lamp, "0.123456789");
  add_numbers(ladders, "place", place, "0.123456789");
  add_numbers(ladders, "radius", radius, "0.123456789");
  add_numbers(ladders, "ior", glass, "1.23456789");
  add_numbers(ladders, "roughness", rough, "0.123456789");
  return ladders;
}

}  // namespace photonproof
