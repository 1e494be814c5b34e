// Meshes in the compiled scene: the same image as the shapes they copy, little memory, clear refusals.

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/rays/trace.h"
#include "renderer/scene/nearest_point.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/scene/test_square_mesh.h"
#include "scenes/generators/terrain.h"

namespace photonproof::inline renderer_scene {
namespace {

SceneDescription with_meshes_for_rectangles(SceneDescription scene) {
  const auto square = test::square_mesh();
  for (ShapeDescription& shape : scene.shapes)
    if (std::holds_alternative<RectangleDescription>(shape.geometry) && !shape.radiance)
      shape.geometry = MeshDescription{MeshDescription::Format::ply, "square.ply", true, false, square};
  return scene;
}

Image render(const SceneDescription& description, const SkipSwitches& skips) {
  RenderJob job = test::job_with(8);
  job.skips = skips;
  const Scene scene = test::compiled(description, 24, 24, skips);
  Film film(24, 24);
  RenderStats stats;
  test::render(scene, description.integrator, job, film, stats);
  return film.develop().mean;
}

TEST(mesh_scene, triangles_render_as_the_rectangles_they_make_up) {
  const SceneDescription rectangles = test::room(24, true);
  const SceneDescription meshes = with_meshes_for_rectangles(rectangles);
  for (const SkipSwitches& skips : {SkipSwitches(), SkipSwitches({"bvh"})}) {
    const Image expected = render(rectangles, skips);
    const Image image = render(meshes, skips);
    int different = 0;  // rounding moves a few paths across an edge
    for (std::size_t i = 0; i < image.rgb.size(); ++i)
      if (std::abs(image.rgb[i] - expected.rgb[i]) > 1e-3f * (image.rgb[i] + expected.rgb[i])) ++different;
    EXPECT_LT(different, static_cast<int>(image.rgb.size() / 30));
    EXPECT_NEAR(test::image_mean(image), test::image_mean(expected), 0.01 * test::image_mean(expected));
  }
}

TEST(mesh_scene, the_normal_follows_the_winding_and_flip_normals) {
  for (const bool flip : {false, true}) {
    SceneDescription d;
    test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "square.ply", true, false, test::square_mesh()},
                    Transform::translate({5, 0, 0}), test::add_bsdf(d, DiffuseDescription{}))
        .flip_normals = flip;
    for (const SkipSwitches& skips : {SkipSwitches(), SkipSwitches({"bvh"})}) {
      const Scene scene = test::compiled(d, 4, 4, skips);
      const Hit hit = scene.intersect({0.2f, -0.3f, 1}, {0, 0, -1});
      ASSERT_TRUE(hit.valid());
      EXPECT_EQ(hit.normal.z, flip ? -1 : 1);
      EXPECT_NEAR(hit.p_world.z, 0, 1e-6f);
    }
  }
}

/// A room with a light of two triangles whose radiance is a checkerboard, optionally preceded by one without an area.
SceneDescription with_textured_light(bool with_flat_triangle) {
  SceneDescription scene = test::room(24, false);
  scene.textures.push_back({{}, "", CheckerboardDescription{RgbD(12), RgbD{1, 2, 6}, Transform::scale({3, 5, 1})}});
  auto light = std::make_shared<TriangleMesh>(*test::square_mesh());
  light->uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  if (with_flat_triangle) light->triangles.insert(light->triangles.begin(), {0, 1, 1});
  ShapeDescription& shape = scene.shapes.back();
  shape.geometry = MeshDescription{MeshDescription::Format::ply, "lamp.ply", true, false, light};
  shape.radiance = TextureIndex{0};
  // Seen by the camera, too: its hit must identify the triangle.
  shape.to_world =
      Transform::translate({0.3, 0.2, -0.5}) * Transform::rotate({0, 1, 0}, 20) * Transform::scale(Vec3d(0.4));
  return scene;
}

/// A wedge: no plane maps it onto itself, and its front is outside.
SceneDescription wedge_scene(bool face_normals, bool own_normals, double side) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(6);
  const Vec3f corners[] = {{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}};
  std::copy(std::begin(corners), std::end(corners), mesh->positions.begin());
  mesh->triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 5}, {0, 5, 4}, {1, 4, 5}, {1, 5, 2}, {0, 4, 1}, {3, 2, 5}};
  if (own_normals)
    for (const Vec3f& p : corners) mesh->normals.push_back(normalize(p - Vec3f(0.3f, 0.3f, 0.5f)));
  SceneDescription scene;
  test::add_shape(scene, MeshDescription{MeshDescription::Format::ply, "wedge.ply", face_normals, false, mesh}, {},
                  test::add_bsdf(scene, DiffuseDescription{RgbD{0.6, 0.3, 0.1}}));
  scene.emitters.push_back({{}, "", DirectionalLightDescription{normalize(Vec3d{-side, -1, -1}), RgbD(1)}});
  test::set_camera(scene, Transform::look_at({0, 1, 4}, {0, 0.3, 0}, {0, 1, 0}), 39.3, 24);
  scene.integrator.method = WhittedDescription{};
  return scene;
}

// Mitsuba 3.10 flips the winding of mirrored meshes as 3.9 does that of instances: the image is flipped, too.
TEST(mesh_scene, mirrored_is_the_image_flipped_by_its_own_transform_and_by_instances) {
  const Transform mirror = Transform::scale({-1, 1, 1});
  RenderJob job = test::job_with(16);
  job.budget.photons.reset();
  job.grid = 4;
  for (const bool face_normals : {true, false})
    for (const bool own_normals : {false, true}) {
      const Image plain = test::render(wedge_scene(face_normals, own_normals, 1), "whitted", job).image.mean;
      EXPECT_GT(test::image_mean(plain), 0.004) << "inside out it would be black";
      // Mirrored by the shape's transform, by the instance's, and by both, which is no mirroring.
      for (const auto& [inner, outer] : {std::pair{mirror, Transform()}, {Transform(), mirror}, {mirror, mirror}}) {
        const bool flipped = (inner * outer).determinant() < 0;
        for (const bool grouped : {false, true}) {
          SceneDescription scene = wedge_scene(face_normals, own_normals, flipped ? -1 : 1);
          if (grouped) {
            scene.shapes[0].to_world = inner;
            scene.groups.push_back({{}, "", scene.shapes});
            scene.shapes.clear();
            test::add_shape(scene, InstanceDescription{{0}}, outer, {});
          } else {
            scene.shapes[0].to_world = outer * inner;
          }
          const Image image = test::render(scene, "whitted", job).image.mean;
          double difference = 0;
          for (int y = 0; y < 24; ++y)
            for (int x = 0; x < 24; ++x)
              difference += double{std::abs(image.pixel(x, y)[0] - plain.pixel(flipped ? 23 - x : x, y)[0])};
          // A sample on an edge may fall to either side.
          EXPECT_LT(difference / (24 * 24), 0.01 * test::image_mean(plain)) << face_normals << own_normals << grouped;
        }
      }
    }
}

TEST(mesh_scene, a_triangle_without_area_changes_nothing_of_a_light) {
  for (const char* integrator : {"path", "bdpt", "ptracer", "photonmapper", "whitted"})
    for (const SkipSwitches& skips : {SkipSwitches(), SkipSwitches({"bvh"})}) {
      SceneDescription with = with_textured_light(true), without = with_textured_light(false);
      with.integrator = without.integrator = with_integrator(with.integrator, integrator);
      EXPECT_EQ(render(with, skips).rgb, render(without, skips).rgb)
          << integrator << (skips.on(Skip::bvh) ? ", few primitives" : ", Embree");
    }
}

TEST(mesh_scene, triangles_without_area_are_in_no_box) {
  // Each ray through the boxes of all of them would be tested against all: 30 times as long with 10^4 on the diagonal.
  constexpr std::size_t count = 10'000, bytes_of_indices = sizeof(TriangleMesh::Triangle) * count;
  const auto bytes = [](std::size_t flat) {
    auto square = std::make_shared<TriangleMesh>(*test::square_mesh());
    for (std::size_t i = 0; i < flat; ++i)
      square->triangles.push_back(i % 2 == 0 ? TriangleMesh::Triangle{0, 0, 2} : TriangleMesh::Triangle{1, 1, 1});
    SceneDescription d;
    test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "square.ply", true, false, square}, {},
                    test::add_bsdf(d, DiffuseDescription{}));
    return test::compiled(d, 4, 4, SkipSwitches({"bvh"})).view().tracer->bvh_bytes();
  };
  // Embree sets some 3 bytes a triangle aside; with boxes it would be 48.
  EXPECT_LT(bytes(count), bytes(0) + bytes_of_indices + 10 * count);
}

TEST(mesh_scene, the_origin_is_amid_copies_where_their_group_puts_them) {
  SceneDescription d;
  ShapeGroupDescription group;
  for (const double x : {100.0, 140.0}) {
    ShapeDescription member;
    member.geometry = MeshDescription{MeshDescription::Format::ply, "square.ply", true, false, test::square_mesh()};
    member.to_world = Transform::translate({x, 0, 0});
    group.shapes.push_back(member);
  }
  d.groups.push_back(group);
  const BsdfIndex bsdf = test::add_bsdf(d, DiffuseDescription{});
  test::add_shape(d, InstanceDescription{ShapeGroupIndex{0}}, Transform::translate({0, 50, 0}), bsdf);
  EXPECT_EQ(scene_frame(d).moved, Vec3d(-120, -50, 0));
}

TEST(nearest_on_mesh, leaves_out_only_what_is_farther) {
  test::Random random(17);
  const auto within = [&](double size) {
    return Vec3d{size * (2 * random.next() - 1), size * (2 * random.next() - 1), size * (2 * random.next() - 1)};
  };
  // The larger one's vertices stand for its triangles.
  for (const TriangleMesh& mesh : {make_ground(12, 17), make_ground(60, 50)}) {
    const NearestOnMesh pruned(mesh);
    const bool by_vertices = mesh.triangles.size() > 4096;
    for (int i = 0; i < 200; ++i) {
      // Askew and stretched by 10^4, and each fourth time flattened to a line.
      const Transform to_world =
          Transform::translate(within(20)) * Transform::rotate(within(1), 360 * random.next()) *
          Transform::scale({std::exp(within(4).x), i % 4 == 0 ? 0.0 : -1.0, std::exp(within(4).x)}) *
          Transform::rotate(within(1), 360 * random.next());
      const Vec3d to = within(30);
      NearestPoint found{to}, nearest{to};
      pruned.add_to(found, to_world);
      for (const TriangleMesh::Triangle& t : mesh.triangles) {
        const auto corner = [&](std::size_t k) { return to_world.point(Vec3d(mesh.positions[t[k]])); };
        const Vec3d a = corner(0), b = corner(1), c = corner(2);
        if (!by_vertices) nearest.add(nearest_on_triangle(to, a, b - a, c - a));
        for (const Vec3d& vertex : {a, b, c})
          if (by_vertices) nearest.add(vertex);
      }
      EXPECT_NEAR(found.distance, nearest.distance, 1e-12 * nearest.distance);
    }
  }
}

TEST(mesh_scene, takes_little_memory_a_triangle) {
  // Half a vertex (12 bytes, twice: as in the file and in the world) and a triangle's indices (12): 24 bytes.

  SceneDescription d;
  auto ground = std::make_shared<TriangleMesh>(make_ground(200, 200));
  test::add_shape(d, MeshDescription{MeshDescription::Format::ply, "ground.ply", true, false, ground}, {},
                  test::add_bsdf(d, DiffuseDescription{}));
  const Scene scene = test::compiled(d, 4, 4);
  EXPECT_EQ(scene.primitives, 80'000u);
  EXPECT_LT(static_cast<double>(scene.memory_bytes()) / 80'000, 30);
  EXPECT_GT(static_cast<double>(scene.memory_bytes()) / 80'000, 20);
}

}  // namespace
}  // namespace photonproof::inline renderer_scene
