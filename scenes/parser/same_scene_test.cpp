// The comparison behind the round-trip tests notices a change of any field.
#include <gtest/gtest.h>

#include <functional>

#include "scenes/parser/test_same_scene.h"

namespace photonproof::inline scenes_parser {
namespace {

SceneDescription example() {
  SceneDescription scene;
  scene.bsdfs = {{{}, "a", DiffuseDescription{}}, {{}, "b", DielectricDescription{}}};
  ShapeDescription shape;
  shape.geometry = CubeDescription{};
  scene.shapes = {shape};
  scene.emitters = {{{}, "e", PointLightDescription{}}};
  scene.sensor.camera = PerspectiveDescription{};
  scene.integrator.method = PathDescription{};
  return scene;
}

TEST(first_difference, is_empty_for_scenes_that_differ_in_places_only) {
  SceneDescription moved = example();
  moved.files = {"other.xml"};
  moved.bsdfs[0].loc = moved.shapes[0].loc = moved.sensor.loc = {0, 7, 7};
  EXPECT_EQ(first_difference(example(), moved), "");
}

TEST(first_difference, names_every_field_that_can_differ) {
  const std::vector<std::pair<std::string, std::function<void(SceneDescription&)>>> changes = {
      {"bsdfs.size()", [](auto& s) { s.bsdfs.pop_back(); }},
      {"bsdfs[1].id", [](auto& s) { s.bsdfs[1].id = "c"; }},
      {"bsdfs[1].model",
       [](auto& s) {
         s.bsdfs[1].model = DielectricDescription{1.5, 1, RgbD(1.0), RgbD(1.0)};
       }},
      {"shapes.size()", [](auto& s) { s.shapes.clear(); }},
      {"shapes[0].id", [](auto& s) { s.shapes[0].id = "x"; }},
      {"shapes[0].geometry", [](auto& s) { s.shapes[0].geometry = RectangleDescription{}; }},
      {"shapes[0].to_world", [](auto& s) { s.shapes[0].to_world.m[3] = 1e-300; }},
      {"shapes[0].flip_normals", [](auto& s) { s.shapes[0].flip_normals = true; }},
      {"shapes[0].bsdf", [](auto& s) { s.shapes[0].bsdf.value = 1; }},
      {"shapes[0].radiance", [](auto& s) { s.shapes[0].radiance = RgbD(0.0); }},
      {"emitters[0].id", [](auto& s) { s.emitters[0].id = ""; }},
      {"emitters[0].light",
       [](auto& s) {
         s.emitters[0].light = PointLightDescription{{0, 0, 1}, RgbD(1.0)};
       }},
      {"sensor.id", [](auto& s) { s.sensor.id = "s"; }},
      {"sensor.camera",
       [](auto& s) {
         s.sensor.camera = PerspectiveDescription{50, FovAxis::y, 1e-2, 1e4};
       }},
      {"sensor.to_world", [](auto& s) { s.sensor.to_world.m[0] = -1; }},
      {"sensor.film", [](auto& s) { s.sensor.film.height = 1; }},
      {"sensor.sample_count", [](auto& s) { s.sensor.sample_count = 5; }},
      {"integrator.method", [](auto& s) { s.integrator.method = PhotonMapperDescription{}; }},
  };
  for (const auto& [field, change] : changes) {
    SceneDescription changed = example();
    change(changed);
    EXPECT_EQ(first_difference(example(), changed), field);
  }
}

}  // namespace
}  // namespace photonproof::inline scenes_parser
