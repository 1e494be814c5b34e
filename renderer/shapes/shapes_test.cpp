// Discs, cylinders, planes, heightfields and smooth meshes: their hits, uv and normals.

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/rays/rays.h"
#include "renderer/scene/scene.h"
#include "renderer/scene/scene_frame.h"
#include "renderer/shapes/heightfield.h"
#include "scenes/meshes/icosphere.h"

namespace photonproof::inline renderer_shapes {
namespace {

using Shape = decltype(ShapeDescription::geometry);

SceneDescription only(const Shape& shape, const Transform& to_world) {
  SceneDescription d;
  test::add_shape(d, shape, to_world, test::add_bsdf(d, DiffuseDescription{}));
  return d;
}

/// uv, derivatives and shading normal where the ray meets the scene's first surface.
LocalGeometry geometry_at(const Scene& scene, const Vec3f& origin, const Vec3f& direction) {
  const SurfaceHit<float> hit = closest_hit<float>(scene.view(), origin, normalize(direction), no_index, true, false);
  EXPECT_TRUE(hit.valid);
  return scene.view().detail->local(hit.surface, hit.primitive, hit.p, hit.normal);
}

LocalGeometry geometry_at(const Shape& shape, const Vec3f& origin, const Vec3f& direction) {
  const SceneDescription description = only(shape, {});
  const Vec3f moved(scene_frame(description).moved);  // to the compiled scene's coordinates
  return geometry_at(test::compiled(description, 4, 4), origin + moved, direction);
}

constexpr double scales[] = {1e-6, 1e-3, 1, 1e3, 1e6};

/// Calls visit(scale, local ray, local-to-world, hit) for random rays at a shape of about unit size, which is turned,
/// scaled and moved a hundred times its size away.
template <class Visit>
void for_random_rays(const Shape& shape, Visit&& visit) {
  for (const double scale : scales) {
    const Transform to_world = Transform::translate(Vec3d(100, -30, 20) * scale) * Transform::scale(Vec3d(scale)) *
                               Transform::rotate({1, 2, 3}, 40);
    const Scene scene = test::compiled(only(shape, to_world), 4, 4);
    const Vec3d moved = scene.view().detail->uv_frames.empty()
                            ? Vec3d(0)
                            : Vec3d(scene.view().detail->uv_frames[0].origin) - to_world.point(Vec3d(0));
    for (std::uint64_t i = 0; i < 2000; ++i) {
      test::Random random(71, i);
      const Vec3d from = Vec3d(square_to_sphere(random.next2())) * 4;
      const Vec3d towards = Vec3d(square_to_sphere(random.next2())) * 1.3;
      const Vec3f origin(to_world.point(from) + moved);
      const Vec3f direction(normalize(to_world.vector(towards - from)));
      // The ray that single precision made of it.
      const Transform back = *to_world.inverse();
      visit(scale, back.point(Vec3d(origin) - moved), back.vector(Vec3d(direction)), moved, to_world,
            scene.intersect(origin, direction));
    }
  }
}

TEST(disk, is_met_within_its_radius) {
  int hits = 0;
  for_random_rays(DiskDescription{}, [&](double scale, const Vec3d& o, const Vec3d& d, const Vec3d& moved,
                                         const Transform& to_world, const Hit& hit) {
    const double t = -o.z / d.z;
    const Vec3d p = o + d * t;
    const double r2 = p.x * p.x + p.y * p.y;
    if (std::abs(r2 - 1) < 1e-4) return;
    ASSERT_EQ(hit.valid(), t > 0 && r2 < 1) << scale;
    if (!hit.valid()) return;
    ++hits;
    EXPECT_LT(length(Vec3d(hit.p_world) - moved - to_world.point(p)), 1e-5 * scale);
    EXPECT_NEAR(dot(Vec3d(hit.normal), normalize(to_world.vector({0, 0, 1}))), 1, 1e-6);
  });
  EXPECT_GT(hits, 1000);
}

TEST(cylinder, is_met_on_its_curved_side_only) {
  int hits = 0;
  for_random_rays(
      CylinderDescription{{0, 0, 0}, {0, 0, 1}, 0.5},
      [&](double scale, const Vec3d& o, const Vec3d& d, const Vec3d& moved, const Transform& to_world, const Hit& hit) {
        // |o + t d|^2 = 1/4 across z, by the textbook.
        const double a = d.x * d.x + d.y * d.y, b = o.x * d.x + o.y * d.y;
        const double c = o.x * o.x + o.y * o.y - 0.25, inside = b * b - a * c;
        if (std::abs(inside) < 1e-4 * a) return;
        double t = -1;
        bool near_rim = false;
        if (inside > 0)
          for (const double root : {(-b + std::sqrt(inside)) / a, (-b - std::sqrt(inside)) / a}) {
            const double z = o.z + root * d.z;
            near_rim = near_rim || std::abs(z) < 1e-4 || std::abs(z - 1) < 1e-4;
            if (root > 0 && z > 0 && z < 1) t = root;
          }
        if (near_rim) return;
        ASSERT_EQ(hit.valid(), t > 0) << scale;
        if (t < 0) return;
        ++hits;
        const Vec3d p = o + d * t;
        EXPECT_LT(length(Vec3d(hit.p_world) - moved - to_world.point(p)), 2e-5 * scale);
        EXPECT_NEAR(dot(Vec3d(hit.normal), normalize(to_world.vector({p.x, p.y, 0}))), 1, 1e-5);
      });
  EXPECT_GT(hits, 1000);
}

TEST(plane, is_met_wherever_it_is_and_moves_no_other_shape) {
  // Planes have no middle: with and without one the compiled scene has the same origin.
  SceneDescription with = only(SphereDescription{{1e5, 0, 0}, 1}, {});
  with.sensor.to_world = Transform::translate({1e5, 0, -5});  // looks at the sphere
  const Vec3d center = std::get<Sphere>(test::compiled(with, 4, 4).surfaces[0].geometry).center;
  test::add_shape(with, PlaneDescription{}, Transform::translate({0, 0, -2}), BsdfIndex{0});
  const Scene scene = test::compiled(with, 4, 4);
  EXPECT_EQ(std::get<Sphere>(scene.surfaces[0].geometry).center, center);
  for (const float far : {1.0f, 1e3f, 1e6f}) {
    const Hit hit = scene.intersect({0, 3, 1}, normalize(Vec3f{far, 0, -3}));
    ASSERT_TRUE(hit.valid()) << far;
    EXPECT_EQ(hit.p_world.z, -2) << far;
    EXPECT_NEAR(hit.p_world.x, far, 2e-6f * far);
    EXPECT_EQ(hit.normal, Vec3f(0, 0, 1));
  }
  EXPECT_FALSE(scene.intersect({0, 3, 1}, {0, 1, 0}).valid());
  EXPECT_TRUE(occluded<float>(scene.view(), {0, 3, 1}, {0, 0, -6}, no_index, no_index, true));
  EXPECT_FALSE(occluded<float>(scene.view(), {0, 3, 1}, {0, 0, -2}, no_index, no_index, true));
}

TEST(uv, of_a_rectangle_are_the_unit_square) {
  const LocalGeometry at = geometry_at(RectangleDescription{}, {-0.5f, 0.2f, 1}, {0, 0, -1});
  EXPECT_NEAR(at.uv.x, 0.25f, 1e-6f);
  EXPECT_NEAR(at.uv.y, 0.6f, 1e-6f);
  EXPECT_EQ(at.dp_du, Vec3f(2, 0, 0));
  EXPECT_EQ(at.dp_dv, Vec3f(0, 2, 0));
}

TEST(uv, of_a_sphere_are_longitude_and_colatitude) {
  // From the +y axis: phi = pi/2, theta = pi/2. One turn is one unit of u, half a turn one of v.
  const LocalGeometry at = geometry_at(SphereDescription{{0, 0, 0}, 2}, {0, 5, 0}, {0, -1, 0});
  EXPECT_NEAR(at.uv.x, 0.25f, 1e-6f);
  EXPECT_NEAR(at.uv.y, 0.5f, 1e-6f);
  EXPECT_NEAR(length(at.dp_du - Vec3f(-4 * pi, 0, 0)), 0, 1e-5f);
  EXPECT_NEAR(length(at.dp_dv - Vec3f(0, 0, -2 * pi)), 0, 1e-5f);
  EXPECT_NEAR(geometry_at(SphereDescription{}, {0.5f, -0.5f, 5}, {0, 0, -1}).uv.x, 0.875f, 1e-6f);
}

TEST(uv, of_a_disk_are_radius_and_angle) {
  const LocalGeometry at = geometry_at(DiskDescription{}, {0, -0.5f, 1}, {0, 0, -1});
  EXPECT_NEAR(at.uv.x, 0.5f, 1e-6f);
  EXPECT_NEAR(at.uv.y, 0.75f, 1e-6f);
  EXPECT_NEAR(length(at.dp_du - Vec3f(0, -1, 0)), 0, 1e-6f);
  // p = (u cos 2 pi v, u sin 2 pi v): dp/dv is 2 pi u long, as in Mitsuba 3.9.1.
  EXPECT_NEAR(length(at.dp_dv - Vec3f(pi, 0, 0)), 0, 1e-6f);
}

TEST(uv, of_a_cylinder_are_angle_and_height) {
  // Duff's frame around +z is x, y.
  const LocalGeometry at = geometry_at(CylinderDescription{{0, 0, 0}, {0, 0, 2}, 1}, {0, 5, 0.5f}, {0, -1, 0});
  EXPECT_NEAR(at.uv.x, 0.25f, 1e-6f);
  EXPECT_NEAR(at.uv.y, 0.25f, 1e-6f);
  EXPECT_NEAR(length(at.dp_du - Vec3f(-2 * pi, 0, 0)), 0, 1e-5f);
  EXPECT_EQ(at.dp_dv, Vec3f(0, 0, 2));
}

TEST(uv, of_a_plane_are_its_local_coordinates) {
  const LocalGeometry at = geometry_at(PlaneDescription{}, {17.5f, -3.25f, 1}, {0, 0, -1});
  EXPECT_NEAR(at.uv.x, 17.5f, 1e-5f);
  EXPECT_NEAR(at.uv.y, -3.25f, 1e-5f);
}

TEST(uv, of_a_cube_are_those_of_mitsubas_faces) {
  // Each face's corner (1, 1) of uv, from the table of Mitsuba's cube; the faces are seen from outside.
  const Vec3f corners[] = {{1, -1, 1}, {-1, 1, -1}, {1, 1, -1}, {1, 1, 1}, {-1, 1, 1}, {1, -1, -1}};
  const Vec3f outward[] = {{0, -1, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {-1, 0, 0}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    const Vec3f n = outward[face], c = corners[face];
    const Vec3f inside = n + (c - n) * 0.9f;  // nine tenths of the way to that corner
    const LocalGeometry at = geometry_at(CubeDescription{}, inside + n, -n);
    EXPECT_NEAR(at.uv.x, 0.95f, 1e-6f) << face;
    EXPECT_NEAR(at.uv.y, 0.95f, 1e-6f) << face;
  }
}

/// A heightfield of amplitude 0.5 with the image's heights.
TriangleMesh heightfield_of(const std::shared_ptr<Image>& image, int columns, int rows) {
  HeightfieldDescription field;
  field.columns = columns;
  field.rows = rows;
  field.amplitude = 0.5;
  field.height = TextureIndex{0};
  const Textures textures(
      {{{}, "", BitmapDescription{"", image, true, TextureFilter::bilinear, TextureWrap::clamp, {}}}});
  return make_heightfield(field, textures);
}

TEST(heightfield, spans_the_square_at_its_textures_height) {
  const auto image = std::make_shared<Image>(2, 1);
  for (int c = 0; c < 3; ++c) image->pixel(1, 0)[c] = 1;
  const TriangleMesh mesh = heightfield_of(image, 8, 3);
  EXPECT_EQ(mesh.positions.size(), 9u * 4u);
  EXPECT_EQ(mesh.triangles.size(), 2u * 8u * 3u);
  EXPECT_TRUE(mesh.is_padded());
  EXPECT_EQ(mesh.positions[0], Vec3f(-1, -1, 0));
  EXPECT_EQ(mesh.positions[8], Vec3f(1, -1, 0.5f));
  EXPECT_EQ(mesh.positions[4], Vec3f(0, -1, 0.25f));  // half way between the texels' middles
  for (const auto& t : mesh.triangles)
    EXPECT_GT(cross(mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]).z, 0);
}

TEST(heightfield, grows_with_v_as_its_textures_rows_do) {
  const auto image = std::make_shared<Image>(1, 2);  // the first row, at v = 0, is black
  for (int c = 0; c < 3; ++c) image->pixel(0, 1)[c] = 1;
  const TriangleMesh mesh = heightfield_of(image, 2, 4);
  EXPECT_EQ(mesh.positions[1], Vec3f(0, -1, 0));
  EXPECT_EQ(mesh.positions[3 * 4 + 1], Vec3f(0, 1, 0.5f));
}

TEST(heightfield, lets_no_ray_through_and_stays_within_its_amplitude) {
  HeightfieldDescription field;
  field.amplitude = 0.3;
  field.height = HeightfieldDescription::Noise{3, 2, 4, 5};
  for (const double shift : {0.0, 1e5}) {
    const Scene scene = test::compiled(only(field, Transform::translate(Vec3d(shift))), 4, 4);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      test::Random random(72, i);
      const auto u = random.next2();
      const Vec3f from(1.99f * u.x - 0.995f, 1.99f * u.y - 0.995f, 1);
      const Hit hit = scene.intersect(from, {0, 0, -1});
      ASSERT_TRUE(hit.valid()) << shift;
      EXPECT_LE(std::abs(hit.p_world.z), 0.3f);
      EXPECT_GT(hit.normal.z, 0);
    }
  }
}

TEST(smooth_normals, of_an_icosphere_approach_the_spheres) {
  // The error of linear interpolation falls with the square of the edges, which halve from level to level.
  double worst[2];
  for (const int level : {3, 4}) {
    const Icosphere ball = make_icosphere(level);
    auto mesh = std::make_shared<TriangleMesh>();
    mesh->resize_positions(ball.directions.size());
    std::transform(ball.directions.begin(), ball.directions.end(), mesh->positions.begin(),
                   [](const Vec3d& p) { return Vec3f(p); });
    mesh->triangles = ball.triangles;
    const Scene scene =
        test::compiled(only(MeshDescription{MeshDescription::Format::ply, "", false, false, mesh}, {}), 4, 4);
    double error = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      test::Random random(73, i);
      const Vec3f outward = square_to_sphere(random.next2());
      const LocalGeometry at = geometry_at(scene, outward * 3, -outward);
      error = std::max(error, double{length(at.normal - outward)});
    }
    worst[level - 3] = error;
  }
  EXPECT_LT(worst[1], 0.01);
  EXPECT_LT(worst[1], 0.5 * worst[0]);
}

TEST(smooth_normals, are_turned_by_the_inverse_transpose) {
  // On a mesh whose one normal is (0, 1, 1) / sqrt 2, stretched twofold along z: (0, 1, 1/2), normalised.
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(3);
  mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh->resize_positions(3);
  mesh->normals.assign(3, {0, 0.70710678f, 0.70710678f});
  mesh->triangles = {{0, 1, 2}};
  for (const bool flip : {false, true}) {
    SceneDescription d =
        only(MeshDescription{MeshDescription::Format::obj, "", false, true, mesh}, Transform::scale({1, 1, 2}));
    d.shapes[0].flip_normals = flip;
    const Vec3f expected = normalize(Vec3f(0, 1, 0.5f)) * (flip ? -1.0f : 1.0f);
    EXPECT_NEAR(length(geometry_at(test::compiled(d, 4, 4), {0, 0, 1}, {0, 0, -1}).normal - expected), 0, 1e-6f);
  }
}

TEST(smooth_normals, of_an_instance_are_turned_by_the_inverse_transpose) {
  // As above, but the placement stretches: the normal must not go along.
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(3);
  mesh->positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  mesh->resize_positions(3);
  mesh->normals.assign(3, {0, 0.70710678f, 0.70710678f});
  mesh->triangles = {{0, 1, 2}};
  SceneDescription d = only(InstanceDescription{{0}}, Transform::scale({1, 1, 2}));
  ShapeDescription member;
  member.geometry = MeshDescription{MeshDescription::Format::obj, "", false, true, mesh};
  member.bsdf = d.shapes[0].bsdf;
  d.groups.push_back({{}, "", {member}});
  const Vec3f expected = normalize(Vec3f(0, 1, 0.5f));
  EXPECT_NEAR(length(geometry_at(test::compiled(d, 4, 4), {0, 0, 1}, {0, 0, -1}).normal - expected), 0, 1e-6f);
}

TEST(mesh_uv, are_the_files_or_barycentric) {
  auto mesh = std::make_shared<TriangleMesh>();
  mesh->resize_positions(3);
  mesh->positions[1] = {2, 0, 0};
  mesh->positions[2] = {0, 4, 0};
  mesh->triangles = {{0, 1, 2}};
  const auto at = [&](bool flip_v) {
    return geometry_at(MeshDescription{MeshDescription::Format::obj, "", true, flip_v, mesh}, {0.5f, 1, 1}, {0, 0, -1});
  };
  EXPECT_NEAR(at(false).uv.x, 0.25f, 1e-6f);  // without uvs: a quarter of the way along each edge
  EXPECT_NEAR(at(false).uv.y, 0.25f, 1e-6f);
  mesh->uvs = {{0, 0}, {0, 1}, {0.5f, 0}};  // u = y / 8, v = x / 2
  EXPECT_NEAR(at(false).uv.x, 0.125f, 1e-6f);
  EXPECT_NEAR(at(false).uv.y, 0.25f, 1e-6f);
  EXPECT_NEAR(at(true).uv.y, 0.75f, 1e-6f);
  EXPECT_NEAR(length(at(false).dp_du - Vec3f(0, 8, 0)), 0, 1e-5f);
  EXPECT_NEAR(length(at(false).dp_dv - Vec3f(2, 0, 0)), 0, 1e-5f);
  EXPECT_NEAR(length(at(true).dp_dv - Vec3f(-2, 0, 0)), 0, 1e-5f);
}

}  // namespace
}  // namespace photonproof::inline renderer_shapes
