// The areas that gathers on meshes divide by, compared with the shapes that the meshes approximate and with counting.

#include "renderer/areas/mesh_area.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_photon_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/shapes/surface.h"

namespace photonproof::inline renderer_areas {
namespace {

Mesh compiled(const MeshDescription& description, const Transform& to_world = {}) {
  Mesh mesh;
  mesh.source = description.mesh;
  for (const Vec3f& p : mesh.source->positions) mesh.positions.push_back(Vec3f(to_world.point(Vec3d(p))));
  mesh.positions.emplace_back();
  return mesh;
}

Vec3f normal_of(const Mesh& mesh, std::uint32_t t) {
  const Vec3d a(mesh.corner(t, 0)), b(mesh.corner(t, 1)), c(mesh.corner(t, 2));
  return Vec3f(normalize(cross(b - a, c - a)));
}

/// Area by the definition: the triangles are cut into pieces, each of which counts or does not. `unsure`: the area of
/// pieces whose normal is so near the limit that rounding decides.
double counted(const Mesh& mesh, const Vec3f& p, const Vec3f& normal, double radius, double piece, double* unsure) {
  double area = 0;
  *unsure = 0;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    const double degrees = std::acos(std::clamp<double>(dot(normal, normal_of(mesh, t)), -1, 1)) * 57.29577951;
    const bool alike = degrees <= 41.4096221;  // acos 3/4
    const Vec3d a = Vec3d(mesh.corner(t, 0)) - Vec3d(p), u = Vec3d(mesh.corner(t, 1)) - Vec3d(p) - a,
                v = Vec3d(mesh.corner(t, 2)) - Vec3d(p) - a;
    const auto cuts = static_cast<int>(std::ceil(std::max(length(u), length(v)) / piece));
    const double each = length(cross(u, v)) / 2 / cuts / cuts;
    double of_triangle = 0;
    for (int i = 0; i < cuts; ++i)
      for (int j = 0; j < 2 * (cuts - i) - 1; ++j) {
        const double third = j % 2 == 0 ? 1.0 / 3 : 2.0 / 3;
        const Vec3d x = a + u * ((i + third) / cuts) + v * ((j / 2 + third) / cuts);
        if (length(x) <= radius && std::abs(dot(Vec3d(normal), x)) <= 0.25 * radius) of_triangle += each;
      }
    if (alike) area += of_triangle;
    if (std::abs(degrees - 41.4096221) < 0.5) *unsure += of_triangle;
  }
  return area;
}

TEST(mesh_area, of_a_rectangle_is_the_quads_however_it_is_cut) {
  const Quad quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, 4};
  for (const int cells : {1, 3, 40, 200}) {
    const Mesh mesh = compiled(test::square_mesh(cells));
    const MeshArea area(mesh, Threads(1));
    double worst = 0, sum = 0, expected = 0;
    for (std::uint64_t i = 0; i < 500; ++i) {
      test::Random s(61, i);
      const auto uv = s.next2();
      const Vec3f p{2 * uv.x - 1, 2 * uv.y - 1, 0};
      const float radius = i % 2 == 0 ? 0.3f : 1.5f * s.next();
      const double found = area.within(p, {0, 0, 1}, radius), truth = double{disc_area(quad, p, radius)};
      worst = std::max(worst, std::abs(found - truth) / truth);
      sum += found / truth;
      expected += 1;
    }
    // Cells of an eighth of the radius and smaller count by their middles.
    EXPECT_LT(worst, cells <= 3 ? 1e-5 : 0.05) << cells;
    EXPECT_NEAR(sum / expected, 1, 1e-3) << cells;
  }
}

TEST(mesh_area, of_a_slab_is_that_of_the_face_looked_at) {
  const Mesh slab = compiled(test::box_mesh(), Transform::scale({1, 0.01, 1}));
  const MeshArea area(slab, Threads(1));
  const Quad face{{-1, -0.01f, -1}, {2, 0, 0}, {0, 0, 2}, {0, -1, 0}, 4};
  for (const float x : {0.0f, 0.95f, 1.0f})
    for (const float radius : {0.002f, 0.015f, 0.2f, 5.0f}) {
      const Vec3f p{x, -0.01f, 0.5f};
      EXPECT_NEAR(area.within(p, {0, -1, 0}, radius) / disc_area(face, p, radius), 1, 1e-4) << x << " " << radius;
    }
}

TEST(mesh_area, of_a_fine_sphere_is_nearly_the_spheres) {
  // 20 x 4^5 triangles of edges 0.036: by 1e-3 smaller than the sphere.
  const Mesh mesh = compiled(test::sphere_mesh(5));
  const MeshArea area(mesh, Threads(1));
  for (const float radius : {0.2f, 0.5f, 0.9f, 1.5f}) {
    double mean = 0;
    constexpr int points = 5000;
    for (std::uint64_t i = 0; i < points; ++i) {
      test::Random s(62, i);
      const Vec3f n = square_to_sphere(s.next2());
      mean += area.within(n, n, radius) / disc_area(Sphere{{0, 0, 0}, 1, false}, n, radius) / points;
    }
    EXPECT_NEAR(mean, 1, 0.01) << radius;
  }
}

TEST(mesh_area, of_any_triangles_is_what_counting_finds) {
  // A crumpled surface side of large triangles, and a heap of triangles of all sizes.
  MeshDescription crumpled = test::square_mesh(6);
  auto heap = std::make_shared<TriangleMesh>();
  auto surface_side = std::make_shared<TriangleMesh>(*crumpled.mesh);
  test::Random s(63);
  for (Vec3f& p : surface_side->positions) p.z = 0.2f * s.next();
  crumpled.mesh = surface_side;
  heap->resize_positions(1200);
  for (std::uint32_t t = 0; t < 400; ++t) {
    const Vec3f middle{s.next() - 0.5f, s.next() - 0.5f, 0.2f * s.next()};
    for (std::uint32_t k = 0; k < 3; ++k)
      heap->positions[3 * t + k] = middle + Vec3f{s.next() - 0.5f, s.next() - 0.5f, 0.3f * (s.next() - 0.5f)} *
                                                (0.5f / static_cast<float>(1 + t % 9));
    heap->triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  for (const auto& source : {MeshDescription{MeshDescription::Format::obj, "heap.obj", true, false, heap}, crumpled}) {
    for (const bool inward : {false, true}) {
      Mesh mesh = compiled(source);
      mesh.inward = inward;
      const MeshArea area(mesh, Threads(2));
      for (std::uint32_t t = 0; t < mesh.triangle_count(); t += 40) {
        const Vec3f p = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) * (1.0f / 3);
        const Vec3f winding = normal_of(mesh, t);
        for (const float radius : {0.1f, 0.4f}) {
          double unsure = 0;
          const double expected = counted(mesh, p, winding, radius, 0.004, &unsure);
          EXPECT_NEAR(area.within(p, inward ? -winding : winding, radius), expected, 0.015 * expected + unsure)
              << t << " " << radius;
        }
      }
    }
  }
}

TEST(mesh_area, of_an_instance_is_that_of_the_mesh_where_it_is) {
  const MeshDescription ball = test::sphere_mesh(3);
  const Mesh local = compiled(ball);
  const MeshArea shared(local, Threads(1));
  const Transform placements[] = {
      Transform::translate({3, 4, 5}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale(Vec3d(2.5)),
      Transform::translate({3, 4, 5}) * Transform::rotate({1, 2, 3}, 40) * Transform::scale({2, -2, 2}),
      Transform::rotate({0, 0, 1}, 20) * Transform::scale({1, 3, 0.5}) * Transform::rotate({1, 0, 0}, 30)};
  for (const Transform& to_world : placements) {
    const AffineMap placement(to_world);
    Mesh placed = compiled(ball, to_world);
    placed.inward =
        to_world.determinant() < 0;  // an instance's normals stay outside, a mirrored mesh's winding does not
    const MeshArea own(placed, Threads(1));
    double mean = 0;
    int gathers = 0;
    for (std::uint32_t t = 0; t < local.triangle_count(); t += 37) {
      const Vec3f p = (placed.corner(t, 0) + placed.corner(t, 1) + placed.corner(t, 2)) * (1.0f / 3);
      const Vec3f normal = normalize(placement.normal(normal_of(local, t)));
      for (const float radius : {0.1f, 0.5f, 1.0f}) {
        const double ratio = shared.within(placement, p, normal, radius) / own.within(p, normal, radius);
        EXPECT_NEAR(ratio, 1, 0.06);  // some of the few triangles in a disc may be just as steep as is allowed
        mean += ratio;
        ++gathers;
      }
    }
    EXPECT_NEAR(mean / gathers, 1, 0.003);
  }
}

TEST(mesh_area, without_an_area_is_none) {
  const Mesh degenerate = compiled(test::mesh_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}}, true));
  EXPECT_EQ(MeshArea(degenerate, Threads(1)).within({1, 0, 0}, {0, 0, 1}, 1), 0);
}

TEST(mesh_area, is_the_same_by_any_number_of_threads) {
  const Mesh mesh = compiled(test::sphere_mesh(4));
  const MeshArea one(mesh, Threads(1)), seven(mesh, Threads(7));
  for (std::uint64_t i = 0; i < 300; ++i) {
    test::Random s(64, i);
    const Vec3f n = square_to_sphere(s.next2());
    EXPECT_EQ(one.within(n, n, 0.4f), seven.within(n, n, 0.4f));
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_areas
