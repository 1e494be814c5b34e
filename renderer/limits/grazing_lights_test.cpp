// Floors in the plane z = 0 of their own world, which is then turned so that no coordinate is special. Lights are so
// low above them that the rounding of their height in single precision shows. Stress sweeps ("near the floor, turned",
// "grazing, turned") show that the light is as wrong as noted, and right where no note is made.

#include "renderer/limits/grazing_lights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "renderer/limits/near_lights.h"

namespace photonproof::inline renderer_limits {
namespace {

using GeometryOfShape = decltype(ShapeDescription::geometry);

const Transform tilt = Transform::rotate({1, 2, 3}, 40);
/// Where lights hang over.
const Vec3d foot{1, -2, 0};
constexpr double half = 8;

MeshDescription mesh_of(const std::array<Vec3f, 4>& positions, const std::vector<TriangleMesh::Triangle>& triangles) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(positions.size());
  std::copy(positions.begin(), positions.end(), mesh->positions.begin());
  mesh->triangles = triangles;
  MeshDescription description;
  description.mesh = mesh;
  return description;
}

/// Seen from above, with one BSDF.
SceneDescription stage(const Transform& turned, const decltype(BsdfDescription::model)& model) {
  SceneDescription d;
  test::add_bsdf(d, model);
  test::set_camera(d, turned * Transform::look_at({0, -4, 12}, {0, 0, 0}, {0, 1, 0}), 40, 4);
  return d;
}

SceneDescription test_scene_on(const GeometryOfShape& geometry, const Transform& place, const Transform& turned,
                               const decltype(BsdfDescription::model)& model = DiffuseDescription{}) {
  SceneDescription d = stage(turned, model);
  test::add_shape(d, geometry, turned * place, {0});
  return d;
}

void add_point(SceneDescription& d, const Vec3d& at, const Transform& turned) {
  d.emitters.push_back({{}, "", PointLightDescription{turned.point(at), RgbD(1)}});
}

std::vector<GrazingLight> found(const SceneDescription& d) { return grazing_lights(SceneParts(d, 4, 4)); }

const Transform as_floor = Transform::scale(Vec3d(half));

/// Each touches z = 0 from below at the foot.
std::vector<std::pair<std::string, SceneDescription>> floors(const Transform& turned) {
  const auto over = [](const Vec3d& v) { return Transform::translate(foot + v); };
  const MeshDescription mesh =
      mesh_of({Vec3f(-1, -1, 0), Vec3f(1, -1, 0), Vec3f(1, 1, 0), Vec3f(-1, 1, 0)}, {{0, 1, 2}, {0, 2, 3}});
  SceneDescription instance = stage(turned, DiffuseDescription{});
  ShapeDescription member;
  member.geometry = mesh;
  member.bsdf = {0};
  instance.groups.push_back({{}, "", {member}});
  test::add_shape(instance, InstanceDescription{ShapeGroupIndex{0}}, turned * as_floor, {0});
  return {
      {"rectangle", test_scene_on(RectangleDescription{}, as_floor, turned)},
      {"disk", test_scene_on(DiskDescription{}, as_floor, turned)},
      {"huge rectangle", test_scene_on(RectangleDescription{}, Transform::scale(Vec3d(1e9)), turned)},
      {"plane", test_scene_on(PlaneDescription{}, {}, turned)},
      {"mesh", test_scene_on(mesh, as_floor, turned)},
      {"instance", instance},
      {"cube", test_scene_on(CubeDescription{}, over({0, 0, -half}) * as_floor, turned)},
      {"sphere", test_scene_on(SphereDescription{}, over({0, 0, -half}) * as_floor, turned)},
      {"cylinder", test_scene_on(CylinderDescription{{-half, 0, -half}, {half, 0, -half}, half}, over({}), turned)}};
}

TEST(grazing_lights, are_lights_low_above_every_shape) {
  for (auto& [name, floor] : floors(tilt)) {
    SceneDescription high = floor;
    add_point(floor, foot + Vec3d{0, 0, 1e-5}, tilt);
    const std::vector<GrazingLight> area_lights = found(floor);
    ASSERT_EQ(area_lights.size(), 1u) << name;
    EXPECT_EQ(area_lights[0].light, 0u) << name;
    EXPECT_FALSE(area_lights[0].from_one_side) << name;
    EXPECT_NEAR(area_lights[0].height, 1e-5, area_lights[0].rounding) << name;
    EXPECT_GT(area_lights[0].rounding, 6e-8) << name;  // coordinates of 2 are 2.4e-7 apart
    EXPECT_LT(area_lights[0].rounding, name == "huge rectangle" ? 2e-5 : 2e-6)
        << name;  // what of it is lit reaches further
    add_point(high, foot + Vec3d{0, 0, 0.05}, tilt);
    EXPECT_TRUE(found(high).empty()) << name;
  }
}

TEST(grazing_lights, are_none_where_an_axis_knows_the_height) {
  for (auto& [name, floor] : floors(Transform())) {
    if (name == "cube" || name == "sphere" || name == "cylinder") continue;  // whose middles are the origin
    add_point(floor, foot + Vec3d{0, 0, 1e-9}, Transform());
    EXPECT_TRUE(found(floor).empty()) << name;
  }
}

// A floor one above the origin, which the other shapes' middles keep where it is: a height of 1e-6 is eight steps.
TEST(grazing_lights, are_lights_above_a_floor_far_from_its_axis_origin) {
  SceneDescription d = test_scene_on(RectangleDescription{}, Transform::translate({0, 0, 1}) * as_floor, Transform());
  for (int i = 0; i < 2; ++i) test::add_shape(d, CubeDescription{}, Transform::translate({0, 0, -1.3}), {0});
  SceneDescription higher = d;
  add_point(d, foot + Vec3d{0, 0, 1 + 1e-6}, Transform());
  ASSERT_EQ(found(d).size(), 1u);
  EXPECT_GT(found(d)[0].loss(), 0.05);
  add_point(higher, foot + Vec3d{0, 0, 1 + 1e-3}, Transform());
  EXPECT_TRUE(found(higher).empty());
}

TEST(grazing_lights, are_none_on_mirrors) {
  for (const bool is_mirror : {true, false}) {
    SceneDescription d = is_mirror ? test_scene_on(RectangleDescription{}, as_floor, tilt, ConductorDescription{})
                                   : test_scene_on(RectangleDescription{}, as_floor, tilt, PhongDescription{});
    add_point(d, foot + Vec3d{0, 0, 1e-5}, tilt);
    EXPECT_EQ(found(d).empty(), is_mirror);
  }
}

// Flat lights and spots by where they shine: `facing` is their axis in the floor's world.
TEST(grazing_lights, are_those_that_shine_on_the_surface) {
  const std::vector<std::pair<Vec3d, bool>> facings{
      {{0, 0, 1}, false}, {{1, 0, 0.02}, true}, {{1, 0, 0}, true}, {{0, 0, -1}, true}};
  for (const auto& [facing, shines] : facings) {
    const Vec3d at = foot + Vec3d{0, 0, 1e-5};
    const Transform towards = tilt * Transform::look_at(at, at + facing, {0, 1, 0});
    SceneDescription flat = test_scene_on(RectangleDescription{}, as_floor, tilt), spot = flat;
    test::add_shape(flat, DiskDescription{}, towards * Transform::scale(Vec3d(1e-6)),
                    test::add_bsdf(flat, DiffuseDescription{}))
        .radiance = RgbD(1);
    EXPECT_EQ(!found(flat).empty(), shines) << facing.x << " " << facing.z;
    SpotLightDescription light;
    light.to_world = towards;
    light.beam_degrees = 20;
    light.cutoff_degrees = 40;
    spot.emitters.push_back({{}, "", light});
    EXPECT_EQ(!found(spot).empty(), shines) << facing.x << " " << facing.z;
  }
}

TEST(grazing_lights, are_none_for_being_near_to_themselves) {
  SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, tilt);
  const MeshDescription tetrahedron = mesh_of({Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)},
                                              {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}});
  test::add_shape(d, tetrahedron, tilt * Transform::translate({0, 0, 1}) * Transform::scale(Vec3d(1e-6)), {0})
      .radiance = RgbD(1);
  EXPECT_TRUE(found(d).empty());
}

// The note names the nearest surface, in the description's unit of length, for any unit of the scene.
TEST(grazing_lights, are_told_where_they_are_known_worst) {
  for (const double unit : {1.0, 1e9, 1e-9}) {
    const Transform turned = Transform::scale(Vec3d(unit)) * tilt;
    const Transform wall = Transform::translate(foot + Vec3d{3e-6, 0, 0}) * Transform::rotate({0, 1, 0}, 90);
    for (const bool wall_first : {false, true}) {
      SceneDescription d = stage(turned, DiffuseDescription{});
      if (wall_first) test::add_shape(d, RectangleDescription{}, turned * wall * as_floor, {0});
      test::add_shape(d, RectangleDescription{}, turned * as_floor, {0});
      if (!wall_first) test::add_shape(d, RectangleDescription{}, turned * wall * as_floor, {0});
      add_point(d, foot + Vec3d{0, 0, 1e-5}, turned);
      const std::vector<GrazingLight> area_lights = found(d);
      ASSERT_EQ(area_lights.size(), 1u) << unit;
      EXPECT_NEAR(area_lights[0].height, 3e-6 * unit, area_lights[0].rounding) << unit;
      EXPECT_LT(area_lights[0].rounding, 2e-6 * unit) << unit;
    }
  }
}

TEST(grazing_lights, are_none_that_are_larger_than_what_is_lost) {
  for (const double size : {1e-6, 1e-2}) {
    SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, tilt);
    test::add_shape(d, SphereDescription{},
                    tilt * Transform::translate(foot + Vec3d{0, 0, 1e-5 + size}) * Transform::scale(Vec3d(size)), {0})
        .radiance = RgbD(1);
    EXPECT_EQ(found(d).size(), size < 1e-5 ? 1u : 0u) << size;
  }
}

/// Towards the floor at this sine of the angle.
Vec3d at_sine(double sine) { return tilt.vector({std::sqrt(1 - sine * sine), 0, -sine}); }

TEST(grazing_lights, are_beams_along_faces) {
  for (auto& [name, floor] : floors(tilt)) {
    if (name == "sphere" || name == "cylinder" || name == "cube") continue;
    for (const double sine : {1e-5, 0.01}) {
      SceneDescription beam = floor, far = floor;
      beam.emitters.push_back({{}, "", DirectionalLightDescription{at_sine(sine), RgbD(1)}});
      far.emitters.push_back({{}, "", PointLightDescription{at_sine(sine) * -1e6, RgbD(1)}});
      for (const SceneDescription* d : {&beam, &far}) {
        const std::vector<GrazingLight> lights = found(*d);
        ASSERT_EQ(lights.size(), sine < 1e-3 ? 1u : 0u) << name;
        if (lights.empty()) continue;
        EXPECT_TRUE(lights[0].from_one_side);
        EXPECT_NEAR(lights[0].height, sine, lights[0].rounding) << name;
        EXPECT_GT(lights[0].rounding, 1e-8);
        EXPECT_LT(lights[0].rounding, 2e-7);
      }
    }
  }
}

// The sides are a third of a cube: beside its top they are dark for any rounding.
TEST(grazing_lights, are_beams_by_their_least_angle) {
  for (const double first : {-1e-4, 1e-4}) {  // degrees
    SceneDescription d = stage(tilt, DiffuseDescription{});
    for (const double degrees : {first, -first})
      test::add_shape(d, RectangleDescription{}, tilt * Transform::rotate({0, 1, 0}, degrees) * as_floor, {0});
    d.emitters.push_back({{}, "", DirectionalLightDescription{at_sine(5e-6), RgbD(1)}});
    ASSERT_EQ(found(d).size(), 1u);
    EXPECT_NEAR(found(d)[0].height, 5e-6 - 1e-4 * std::numbers::pi / 180, 2e-7) << first;
  }
}

TEST(grazing_lights, are_not_beams_along_what_is_dark_beside_the_rest) {
  SceneDescription cube = test_scene_on(CubeDescription{}, as_floor, tilt);
  cube.emitters.push_back({{}, "", DirectionalLightDescription{at_sine(0.5), RgbD(1)}});
  EXPECT_TRUE(found(cube).empty());
  for (const double small : {4.0, 12.0}) {  // beside 8 x 8
    SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, tilt);
    test::add_shape(d, RectangleDescription{}, tilt * Transform::rotate({0, 1, 0}, 60) * Transform::scale(Vec3d(small)),
                    {0});
    const double angle = 60 * std::numbers::pi / 180, sine = 1e-5;
    const Vec3d along{std::cos(angle), 0, -std::sin(angle)}, normal{std::sin(angle), 0, std::cos(angle)};
    d.emitters.push_back({{}, "", DirectionalLightDescription{tilt.vector(along - normal * sine), RgbD(1)}});
    EXPECT_EQ(found(d).size(), small > half ? 1u : 0u) << small;
  }
}

std::vector<NearLight> above_spots(const SceneDescription& d, double within) {
  return lights_above_spots(SceneParts(d, 4, 4), within);
}

TEST(lights_above_spots, are_lights_low_above_every_shape) {
  for (const double unit : {1.0, 1e9, 1e-9})
    for (auto& [name, floor] : floors(Transform::scale(Vec3d(unit)) * tilt)) {
      if (unit != 1 && (name == "huge rectangle" || name == "plane")) continue;  // whose own scale is another
      add_point(floor, foot + Vec3d{0, 0, 0.01}, Transform::scale(Vec3d(unit)) * tilt);
      const std::vector<NearLight> area_lights = above_spots(floor, 0.02 * unit);
      ASSERT_EQ(area_lights.size(), 1u) << name;
      EXPECT_NEAR(area_lights[0].height, 0.01 * unit, 1e-5 * unit) << name;
      EXPECT_TRUE(above_spots(floor, 0.009 * unit).empty()) << name;
    }
}

TEST(lights_above_spots, are_those_that_shine_on_what_scatters) {
  // A spot of a half-angle of 40 degrees, low above the floor or in it, by its axis; on a mirror never.
  for (const double height : {0.01, 0.0})
    for (const auto& [facing, shines] :
         {std::pair{Vec3d{0, 0, 1}, false}, {Vec3d{1, 0, 0}, false}, {Vec3d{1, 0, -2}, true}, {Vec3d{0, 0, -1}, true}})
      for (const bool is_mirror : {false, true}) {
        const Vec3d at = foot + Vec3d{0, 0, height};
        SceneDescription d = is_mirror ? test_scene_on(RectangleDescription{}, as_floor, {}, ConductorDescription{})
                                       : test_scene_on(RectangleDescription{}, as_floor, {});
        SpotLightDescription light;
        light.to_world = Transform::look_at(at, at + facing, {0, 1, 0});
        light.beam_degrees = 20;
        light.cutoff_degrees = 40;
        d.emitters.push_back({{}, "", light});
        EXPECT_EQ(!above_spots(d, 0.02).empty(), shines && !is_mirror && height > 0) << facing.z << " " << height;
      }
  // A point that lies in the floor lights it from both sides, as far as it does.
  SceneDescription inside = test_scene_on(RectangleDescription{}, as_floor, {});
  add_point(inside, foot, {});
  ASSERT_EQ(above_spots(inside, 0).size(), 1u);
  EXPECT_EQ(above_spots(inside, 0)[0].height, 0);
}

TEST(lights_above_spots, are_on_either_side_of_a_wall_across_any_axis) {
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}})
    for (const double side : {-0.01, 0.01}) {
      const Transform wall = Transform::look_at({0, 0, 0}, axis, {0.3, 0.5, 0.8});
      SceneDescription d = test_scene_on(RectangleDescription{}, wall * as_floor, {});
      d.emitters.push_back({{}, "", PointLightDescription{axis * side, RgbD(1)}});
      ASSERT_EQ(above_spots(d, 0.02).size(), 1u) << axis.x << " " << axis.y << " " << side;
      EXPECT_NEAR(above_spots(d, 0.02)[0].height, 0.01, 1e-6);
    }
}

TEST(lights_above_spots, are_none_for_being_near_to_themselves) {
  SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, tilt);
  test::add_shape(d, SphereDescription{},
                  tilt * Transform::translate(foot + Vec3d{0, 0, 1}) * Transform::scale(Vec3d(0.01)), {0})
      .radiance = RgbD(1);
  EXPECT_TRUE(above_spots(d, 0.05).empty());
}

TEST(lights_above_spots, are_no_higher_than_they_are_large) {
  SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, tilt);
  test::add_shape(d, SphereDescription{},
                  tilt * Transform::translate(foot + Vec3d{0, 0, 0.01}) * Transform::scale(Vec3d(0.01)), {0})
      .radiance = RgbD(1);
  ASSERT_EQ(above_spots(d, 0.05).size(), 1u);
  EXPECT_NEAR(above_spots(d, 0.05)[0].height, 0.01 * std::sqrt(3.0), 1e-5);  // half the diagonal of the box around it
  EXPECT_TRUE(above_spots(d, 0.012).empty());
}

TEST(lights_on_surfaces, are_flat_ones_nearer_than_rays_tell) {
  for (auto& [name, floor] : floors(Transform()))
    for (const auto& [area_light, is_flat] : {std::pair<GeometryOfShape, bool>{RectangleDescription{}, true},
                                              {DiskDescription{}, true},
                                              {CubeDescription{}, false}})
      for (const double height : {0.0, 1e-9, 1e-7, 1e-3, 0.5}) {
        if (!is_flat && height < 0.5) continue;  // its faces are flat, but it is closed
        SceneDescription d = floor;
        test::add_shape(d, area_light, Transform::translate(foot + Vec3d{0, 0, height}) * Transform::scale(Vec3d(0.1)),
                        {0})
            .radiance = RgbD(1);
        const std::vector<NearLight> area_lights = lights_on_surfaces(SceneParts(d, 4, 4));
        ASSERT_EQ(area_lights.size(), height < 1e-6 ? 1u : 0u) << name << " " << height;
        if (area_lights.empty()) continue;
        EXPECT_NEAR(area_lights[0].height, height, 1e-6) << name;
        EXPECT_GT(area_lights[0].resolved, 4e-7) << name;
        EXPECT_LT(area_lights[0].resolved, 2e-4) << name;
      }
}

TEST(lights_on_surfaces, are_none_that_a_surface_goes_through) {
  SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, {});
  test::add_shape(d, RectangleDescription{},
                  Transform::translate(foot) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(0.1)), {0})
      .radiance = RgbD(1);
  EXPECT_TRUE(lights_on_surfaces(SceneParts(d, 4, 4)).empty());
}

TEST(lights_on_surfaces, are_none_where_there_is_no_surface) {
  SceneDescription d = test_scene_on(RectangleDescription{}, as_floor, {}, NullDescription{});
  test::add_shape(d, RectangleDescription{}, Transform::translate(foot) * Transform::scale(Vec3d(0.1)), {0}).radiance =
      RgbD(1);
  EXPECT_TRUE(lights_on_surfaces(SceneParts(d, 4, 4)).empty());
}

}  // namespace
}  // namespace photonproof::inline renderer_limits
