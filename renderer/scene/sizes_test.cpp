// A scene looks the same in any unit of length, and with any other shape far away from it or reaching far beyond it.

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>

#include "renderer/integrators/test_photon_scenes.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/scene/test_sizes.h"
#include "renderer/shapes/face_normal.h"
#include "scenes/description/plugin_name.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_scene {
namespace {

using std::numbers::pi;

constexpr std::size_t through_embree = 0;

class integrators_at_any_size : public ::testing::TestWithParam<const char*> {};

// Pixels agree within 0.4 % except for one in 25, the mean within 0.4 %.
TEST_P(integrators_at_any_size, give_the_same_picture) {
  const std::string name = GetParam();
  for (const bool other : {false, true}) {
    const auto room = [&](double unit) {
      return test::Room{unit, name == "volpath" && other, name != "volpath" && other};
    };
    const RenderJob job = test::job_with(4, 4000);
    const test::Rendered expected = test::render(test::room_of_all_shapes(room(1)), name.c_str(), job);
    ASSERT_GT(test::image_mean(expected.image.mean), 0.03);
    for (const int exponent : {-15, -9, -4, 5, 10, 15}) {
      const double unit = std::pow(10.0, exponent);
      const test::Rendered r = test::render(test::room_of_all_shapes(room(unit)), name.c_str(), job);
      test::expect_same_picture(r.image.mean, expected.image.mean, name + " at 1e" + std::to_string(exponent));
      if (r.stats.counts.count("radius_global") != 0) {
        const double radius = expected.stats.counts.at("radius_global");
        EXPECT_NEAR(r.stats.counts.at("radius_global"), radius * unit, 1e-4 * radius * unit);
      }
    }
  }
}

/// The names without `volprim_rf_basic`, which shows none of these shapes' light (radiance_field_test.cpp).
std::vector<const char*> names_of_integrators() {
  std::vector<const char*> names = plugin_names(decltype(IntegratorDescription::method)());
  std::erase_if(names, [](const char* name) { return std::string(name) == "volprim_rf_basic"; });
  return names;
}

INSTANTIATE_TEST_SUITE_P(all, integrators_at_any_size, ::testing::ValuesIn(names_of_integrators()),
                         [](const auto& name) { return std::string(name.param); });

TEST(sizes, of_the_library_are_ordinary) {
  // No scale, and faces met in double only where grounds and panes reach far beyond what is looked at.
  const std::set<std::string> far_reaching{"daylight", "glass-slab", "parallel-planes", "whitted",
                                           "whitted-orthographic"};
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_SOURCE_DIR "/scenes/library")) {
    if (entry.path().filename() == "million") continue;  // takes long to make, and is of ordinary size
    const SceneParts scene(parse_scene_file((entry.path() / "scene.xml").string(), {{{"size", "8"}}, false}), 8, 8);
    EXPECT_EQ(scene.scale(), 1) << entry.path();
    const bool has_long_faces = std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                                            [](const Surface& surface) { return surface.long_faces != nullptr; });
    EXPECT_EQ(has_long_faces, far_reaching.count(entry.path().filename().string()) != 0) << entry.path();
    ++scenes;
  }
  EXPECT_GT(scenes, 50);
}

TEST(face_normals, do_not_depend_on_the_size_of_the_face) {
  // The normal of (1,2,2)/3 x (2,1,-2)/3, orthonormal, is (-2,2,-1)/3. Edges of different sizes too.
  for (const float size : {1e-37f, 1e-30f, 1e-20f, 1e-10f, 1e-3f, 1.0f, 1e6f, 1e12f, 1e20f, 1e37f})
    for (const float other : {1e-37f, 1e-10f, 1.0f, 1e12f, 1e37f}) {
      const Vec3f n = face_normal(Vec3f(1.0f, 2.0f, 2.0f) * (size / 3), Vec3f(2.0f, 1.0f, -2.0f) * (other / 3));
      EXPECT_NEAR(length(Vec3d(n) - Vec3d{-2, 2, -1} / 3.0), 0, 3e-7) << size << " " << other;
    }
}

TEST(face_normals, of_a_light_a_ten_billionth_in_size_are_right) {
  // A triangle of legs e emits L over A = e^2/2 from height 2, downwards. Below it the floor has E = L A / h^2 (cosines
  // 1) and the radiance rho E / pi = 0.5 / pi at L A = 4.
  for (const double e : {1e-4, 1e-10, 1e-16}) {
    SceneDescription d = test::floor_under_point_light(3);
    d.emitters.clear();
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->resize_positions(3);
    mesh->positions = {Vec3f(0.0f), Vec3f(static_cast<float>(e), 0, 0), Vec3f(0, 0, static_cast<float>(e))};
    mesh->resize_positions(3);
    mesh->triangles = {{0, 1, 2}};
    test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "lamp.ply", true, false, mesh},
                    Transform::translate({0, 2, 0}), d.shapes[0].bsdf)
        .radiance = RgbD(8 / (e * e));
    test::set_camera(d, Transform::look_at({1, 1, 0}, {0, 0, 0}, {0, 0, 1}), 0.1, 3);
    for (const std::size_t limit : {brute_force_limit, through_embree})
      EXPECT_NEAR(test::image_mean(test::render(d, "direct", test::job_with(16), limit).image.mean), 0.5 / pi, 1e-3)
          << e << " " << limit;
  }
}

/// The floor's radiance under the point light of floor_under_point_light at distance r from below it.
double floor_radiance(double r) { return 0.5 / pi * 2 / std::pow(4 + r * r, 1.5); }

/// Every pixel of a picture of that floor within `tolerance` of the closed form, which sees through the pixel's centre.
void expect_lit_floor(const SceneDescription& d, std::size_t limit, double tolerance, const std::string& what) {
  RenderJob job = test::job_with(1);
  job.grid = 1;
  const Image image = test::render(d, "path", job, limit).image.mean;
  const double half = std::tan(20 * pi / 180) * 5;  // of what is seen of the floor
  double worst = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double at_x = (2 * (x + 0.5) / image.width - 1) * half, at_y = (2 * (y + 0.5) / image.height - 1) * half;
      const double expected = floor_radiance(std::hypot(at_x, at_y));
      const double error = std::abs(static_cast<double>(image.pixel(x, y)[0]) / expected - 1);
      worst = error <= worst ? worst : error;  // a NaN stays
    }
  EXPECT_LE(worst, tolerance) << what;
}

TEST(curved_floors, as_large_as_planets_are_lit_like_flat_ones) {
  // At 1e6 the curve lowers the floor by 2e-6 where the picture ends; of a centre in single precision 1e8 leaves steps
  // of 8.
  for (int k = 6; k <= 11; ++k)
    for (const bool is_sphere : {true, false}) {
      const double radius = 1.37 * std::pow(10.0, k);
      SceneDescription d = test::floor_under_point_light(5);
      const auto as_sphere = SphereDescription{{0, -radius, 0}, radius};
      const auto as_cylinder = CylinderDescription{{-radius, -radius, 0}, {radius, -radius, 0}, radius};
      d.shapes[0].to_world = Transform();
      if (is_sphere)
        d.shapes[0].geometry = as_sphere;
      else
        d.shapes[0].geometry = as_cylinder;
      for (const std::size_t limit : {brute_force_limit, through_embree})
        expect_lit_floor(d, limit, 1e-4, (is_sphere ? "sphere 1e" : "cylinder 1e") + std::to_string(k));
    }
}

TEST(far_shapes, do_not_cost_the_others_their_precision) {
  for (int others = 0; others < 5; ++others)
    for (const double distance : {1e8, 1e10, 1e12})
      for (const Vec3d& direction : {Vec3d{1, 0, 0}, Vec3d{0, 0, -1}, Vec3d{0.6, -0.64, 0.48}})
        for (int place = 0; place <= others + 1; place += std::max(1, (others + 1) / 2)) {
          SceneDescription d = test::floor_under_point_light(5);
          for (int i = 0; i < others; ++i)
            test::add_shape(d, SphereDescription{{20.0 + 3 * i, 1, i % 2 == 0 ? 3.0 : -3.0}, 1}, {}, d.shapes[0].bsdf);
          ShapeDescription far = d.shapes[0];
          far.to_world = {};
          far.geometry = SphereDescription{direction * distance, 1};
          d.shapes.insert(d.shapes.begin() + place, far);
          for (const std::size_t limit : {brute_force_limit, through_embree})
            expect_lit_floor(d, limit, 1e-4,
                             std::to_string(others) + " others, one at " + std::to_string(distance) + ", place " +
                                 std::to_string(place) + ", limit " + std::to_string(limit));
        }
}

TEST(far_shapes, do_not_even_when_they_are_most) {
  // Three at 1e9 in one direction, two here.
  SceneDescription d = test::floor_under_point_light(5);
  test::add_shape(d, SphereDescription{{20, 1, 0}, 1}, {}, d.shapes[0].bsdf);
  for (int i = 0; i < 3; ++i) test::add_shape(d, SphereDescription{{1e9, 1e9 + 3.0 * i, 0}, 1}, {}, d.shapes[0].bsdf);
  for (const std::size_t limit : {brute_force_limit, through_embree}) expect_lit_floor(d, limit, 1e-4, "");
}

TEST(far_shapes, light_what_is_here) {
  // A sphere of radius 1e7 and radiance L is at distance 1e9, at 60 degrees from the floor's normal. The floor has
  // E = pi L (R/D)^2 cos 60 and the radiance rho E / pi = 0.5 L 1e-4 0.5.
  SceneDescription d = test::floor_under_point_light(5);
  d.emitters.clear();
  const double cos60 = 0.5, sin60 = std::sqrt(0.75);
  test::add_shape(d, SphereDescription{Vec3d{sin60, cos60, 0} * 1e9, 1e7}, {}, d.shapes[0].bsdf).radiance = RgbD(1e4);
  for (const std::size_t limit : {brute_force_limit, through_embree})
    EXPECT_NEAR(test::image_mean(test::render(d, "direct", test::job_with(4), limit).image.mean), 0.25, 0.25 * 2e-3);
}

/// The same floor as a shape that reaches 10^k far, all of it turned by `turn`, the shape `shift` times its size aside.
SceneDescription long_floor(const decltype(ShapeDescription::geometry)& geometry, double size, double shift,
                            const Transform& turn) {
  SceneDescription d = test::floor_under_point_light(5);
  d.shapes[0].geometry = geometry;
  d.shapes[0].to_world = turn * Transform::rotate({1, 0, 0}, -90) * Transform::scale(Vec3d(size)) *
                         Transform::translate(Vec3d{shift, shift, 0});
  auto& area_light = std::get<PointLightDescription>(d.emitters[0].light);
  area_light.position = turn.point(area_light.position);
  d.sensor.to_world = turn * d.sensor.to_world;
  return d;
}

// Turned ones to 10^12: there the double precision of the corners is a thousandth of what is seen.
TEST(long_triangles, meet_rays_where_they_are) {
  const auto triangle = test::large_triangle(1);
  const MeshDescription mesh{MeshDescription::Format::ply, "floor.ply", true, false, triangle};
  const Transform turns[] = {{}, Transform::rotate({0.3, 0.5, 0.8}, 37)};
  for (int k = 0; k <= 15; ++k)
    for (const Transform& turn : turns)
      for (const double shift : {0.0, 0.37}) {
        if (k == 0 && shift > 0) continue;               // it would not reach
        if (!(turn == Transform()) && k > 12) continue;  // see below
        const SceneDescription d = long_floor(mesh, 4 * std::pow(10.0, k), shift, turn);
        for (const std::size_t limit : {brute_force_limit, through_embree})
          expect_lit_floor(
              d, limit, 1e-3,
              "1e" + std::to_string(k) + " limit " + std::to_string(limit) + " shift " + std::to_string(shift));
      }
}

TEST(long_triangles, of_rectangles_heightfields_and_instances_do_too) {
  HeightfieldDescription flat{2, 2, 0, true, HeightfieldNoise{}};
  const auto triangle = test::large_triangle(1);
  for (int k = 0; k <= 14; ++k) {
    const double size = 4 * std::pow(10.0, k);
    for (const Transform& turn : {Transform{}, Transform::rotate({0.3, 0.5, 0.8}, 37)}) {
      if (!(turn == Transform()) && k > 12) continue;
      for (const std::size_t limit : {brute_force_limit, through_embree}) {
        const std::string what = "1e" + std::to_string(k) + " limit " + std::to_string(limit);
        expect_lit_floor(long_floor(RectangleDescription{}, size, 0.01, turn), limit, 1e-3, "rectangle " + what);
        expect_lit_floor(long_floor(flat, size, 0.01, turn), limit, 1e-3, "heightfield " + what);
        SceneDescription d = long_floor(InstanceDescription{{0}}, size, 0.01, turn);
        ShapeGroupDescription group;
        ShapeDescription member;
        member.geometry = MeshDescription{MeshDescription::Format::ply, "floor.ply", true, false, triangle};
        group.shapes.push_back(member);
        d.groups.push_back(group);
        expect_lit_floor(d, limit, 1e-3, "instance " + what);
      }
    }
  }
}

TEST(long_faces, are_as_far_as_the_nearest_of_their_edges) {
  // The square with corners (-1, -2) and (3, 4) in z = 12, each of its edges the nearest once, a corner, and its
  // inside.
  const auto face = [](double x, double y, bool is_triangle) {
    return LongFace{{-1 + x, -2 + y, 12}, {4, 0, 0}, {0, 6, 0}, {0, 0, 1}, 12, is_triangle, 0};
  };
  EXPECT_NEAR(rim_distance(face(6, 0, false)), 13, 1e-12);   // the edge x = 5
  EXPECT_NEAR(rim_distance(face(-8, 0, false)), 13, 1e-12);  // x = -5
  EXPECT_NEAR(rim_distance(face(0, 7, false)), 13, 1e-12);   // y = 5
  EXPECT_NEAR(rim_distance(face(0, -9, false)), 13, 1e-12);  // y = -5
  EXPECT_NEAR(rim_distance(face(6, 7, false)), std::sqrt(25 + 25 + 144), 1e-12);
  EXPECT_NEAR(rim_distance(face(0, 0, false)), std::sqrt(1 + 144), 1e-12);
  // Half of it: the longest edge, 3x + 2y = 5, and moved by (0, -1), 3x + 2y = 3.
  EXPECT_NEAR(rim_distance(face(0, 0, true)), std::sqrt(1 + 144), 1e-12);
  EXPECT_NEAR(rim_distance(face(0, -1, true)), std::sqrt(9.0 / 13 + 144), 1e-12);
}

// The top of a box under a sky shows half of its radiance for sides of any length that end there. Both ways to meet
// faces are tested, straight and turned. An edge that is off by a hundredth of the top's width would be detected.
TEST(long_triangles, end_where_they_are) {
  const decltype(ShapeDescription::geometry) shapes[] = {CubeDescription{}, test::box_mesh()};
  for (const auto& shape : shapes)
    for (int k = 0; k <= 9; ++k)
      for (const Transform& turn : {Transform{}, Transform::rotate({0.3, 0.5, 0.8}, 37)}) {
        if (!(turn == Transform()) && k > 7) continue;  // turning so long a box flattens it
        SceneDescription d;
        const double half = 0.5 * std::pow(10.0, k);
        test::add_shape(d, shape, turn * Transform::translate({0, 0, -half}) * Transform::scale({1, 1, half}),
                        test::add_bsdf(d, DiffuseDescription{}));
        d.emitters.push_back({{}, "", ConstantLightDescription{}});
        test::set_camera(d, turn * Transform::look_at({0, 0, 4}, {0, 0, 0}, {0, 1, 0}), 25, 8);
        for (const std::size_t limit : {brute_force_limit, through_embree}) {
          const test::Rendered r = test::render(d, "path", test::job_with(64), limit);
          EXPECT_NEAR(test::image_mean(r.image.mean), 0.5, 0.5e-3) << k << " limit " << limit;
        }
      }
}

TEST(long_triangles, of_every_size_do_not_shade_themselves) {
  // From what is looked at to where faces are long ones, in steps of 2 and with turns that round otherwise.
  HeightfieldDescription flat{2, 2, 0, true, HeightfieldNoise{}};
  const MeshDescription mesh{MeshDescription::Format::ply, "floor.ply", true, false, test::large_triangle(1)};
  for (int k = 0; k <= 14; ++k)
    for (int turned = 0; turned < 6; ++turned) {
      const double size = 4 * std::pow(2.0, k), shift = k == 0 ? 0 : 0.07 * turned;
      const Transform turn = Transform::rotate({0.3, 0.5, 0.8 - 0.3 * turned}, 37 + 59 * turned);
      const std::string what = "2^" + std::to_string(k) + " turn " + std::to_string(turned);
      expect_lit_floor(long_floor(RectangleDescription{}, size, shift, turn), through_embree, 1e-3,
                       "rectangle " + what);
      expect_lit_floor(long_floor(flat, size, shift, turn), through_embree, 1e-3, "heightfield " + what);
      expect_lit_floor(long_floor(mesh, size, shift, turn), through_embree, 1e-3, "mesh " + what);
    }
}

TEST(long_triangles, share_their_edges_without_a_gap) {
  // Rays from a point at directions about the seam of two triangles, which runs through what is seen.
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(4);
  mesh->positions[0] = {-1e7f, -1.3e7f, 0};
  mesh->positions[1] = {1.1e7f, -0.9e7f, 0};
  mesh->positions[2] = {1e7f, 1.3e7f, 0};
  mesh->positions[3] = {-1.2e7f, 0.8e7f, 0};
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
  SceneDescription d = long_floor(MeshDescription{MeshDescription::Format::ply, "floor.ply", true, false, mesh}, 1, 0,
                                  Transform::rotate({0.3, 0.5, 0.8}, 37));
  d.sensor.film.width = d.sensor.film.height = 65;
  for (const std::size_t limit : {brute_force_limit, through_embree}) expect_lit_floor(d, limit, 1e-3, "");
}

TEST(long_triangles, keep_the_sides_of_mirrored_instances) {
  // A group's face seen from its front stays lit when a mirroring instance makes it long.
  for (const double size : {4.0, 4e9}) {
    SceneDescription d = long_floor(InstanceDescription{{0}}, size, 0, {});
    d.shapes[0].to_world = d.shapes[0].to_world * Transform::scale({-1, 1, 1});
    ShapeGroupDescription group;
    ShapeDescription member;
    member.geometry = MeshDescription{MeshDescription::Format::ply, "floor.ply", false, false, test::large_triangle(1)};
    group.shapes.push_back(member);
    d.groups.push_back(group);
    expect_lit_floor(d, through_embree, 1e-3, std::to_string(size));
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
