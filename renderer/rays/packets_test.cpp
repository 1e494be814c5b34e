// Rays in packets end at the bits at which they end alone, whatever other rays their packets hold.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/rays/mesh_hits.h"
#include "renderer/rays/rays.h"
#include "renderer/rays/trace_tables.h"
#include "scenes/generators/terrain.h"

namespace photonproof::inline renderer_rays {
namespace {

std::shared_ptr<const Mesh> mesh_of(TriangleMesh source, bool inward) {
  auto mesh = std::make_shared<Mesh>();
  mesh->positions = source.positions;
  mesh->positions.emplace_back();
  mesh->source = std::make_shared<const TriangleMesh>(std::move(source));
  mesh->inward = inward;
  return mesh;
}

Surface quad(const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  const Vec3f n = cross(u, v);
  return {Quad{corner, u, v, normalize(n), length(n)}};
}

constexpr std::uint32_t parts = 10;  ///< of a group, more than a tracer has kinds of shapes

/// Ground and rocks, three copies of a group of sheets, two walls, a ball, a disc and a plane below.
std::vector<Surface> landscape() {
  std::vector<Surface> surfaces{{*mesh_of(make_ground(60, 60), false)},
                                {*mesh_of(make_rocks(30, 2), true)},
                                quad({-10, -1, -10}, {20, 0, 0}, {0, 8, 0}),
                                quad({-10, -1, 10}, {0, 0, -20}, {0, 8, 0}),
                                {Sphere{{2, 3, 1}, 0.8, false}},
                                {Disk{{-3, 3, 2}, {1, 0, 0}, {0, 0.6f, 0.8f}, {0, -0.8f, 0.6f}}},
                                {Plane{{0, -2, 0}, {0, 1, 0}}}};
  for (std::uint32_t part = 0; part < parts; ++part) {
    TriangleMesh sheet = make_ground(6, 6);
    for (Vec3f& p : sheet.positions) p.y += 2 * static_cast<float>(part);
    const std::shared_ptr<const Mesh> mesh = mesh_of(std::move(sheet), false);
    for (std::uint32_t copy = 0; copy < 3; ++copy) {
      const auto placement = std::make_shared<const AffineMap>(Vec3d(0.2, 0.1 * copy, 0), Vec3d(0, 0.1, 0),
                                                               Vec3d(-0.1, 0, 0.15), Vec3d(3.0 * copy - 3, 3, -2));
      surfaces.push_back({MeshInstance{mesh, placement, copy, 0, part}});
    }
  }
  return surfaces;
}

RayBlock alone(const RayBlock& rays, std::size_t lane) {
  RayBlock one{};
  one.origin_x[0] = rays.origin_x[lane], one.origin_y[0] = rays.origin_y[lane], one.origin_z[0] = rays.origin_z[lane];
  one.direction_x[0] = rays.direction_x[lane], one.direction_y[0] = rays.direction_y[lane];
  one.direction_z[0] = rays.direction_z[lane];
  one.light[0] = rays.light[lane];
  one.active = 1;
  return one;
}

void set_ray(RayBlock& rays, std::size_t lane, const Vec3f& origin, const Vec3f& direction) {
  rays.origin_x[lane] = origin.x, rays.origin_y[lane] = origin.y, rays.origin_z[lane] = origin.z;
  rays.direction_x[lane] = direction.x, rays.direction_y[lane] = direction.y, rays.direction_z[lane] = direction.z;
  rays.light[lane] = no_index;
}

/// Rays from points above the ground in all directions, any lanes of them, now and then one that cannot be traced.
RayBlock random_block(std::uint64_t number, float length) {
  test::Random random(91, number);
  RayBlock rays{};
  for (std::size_t lane = 0; lane < RayBlock::width; ++lane) {
    const Vec3f origin(16 * random.next() - 8, 1 + 4 * random.next(), 16 * random.next() - 8);
    Vec3f direction = square_to_sphere(random.next2()) * length;
    if (random.next() < 0.02f) direction.y = std::numeric_limits<float>::quiet_NaN();
    set_ray(rays, lane, origin, direction);
  }
  constexpr std::uint32_t whole[] = {0xFFFF, 0xFF, 0xF};  // packets of 16, 8 and 4
  rays.active = whole[number / 2 % 3];
  if (number % 2 == 0) rays.active &= static_cast<std::uint32_t>(random.next_bits());
  return rays;
}

std::array<float, 6> numbers(const HitBlock& hits, std::size_t lane) {
  return {hits.p_x[lane],      hits.p_y[lane],      hits.p_z[lane],
          hits.normal_x[lane], hits.normal_y[lane], hits.normal_z[lane]};
}

/// Traces blocks and each of their rays alone. Adds to `met`, by surface, the rays that ended there; returns the
/// misses.
int compare_with_rays_alone(const std::vector<Surface>& surfaces, bool coherent, std::vector<int>& met) {
  const Tracer tracer(surfaces);
  met.assign(surfaces.size(), 0);
  int missed = 0;
  for (std::uint64_t number = 0; number < 4000; ++number) {
    const RayBlock rays = random_block(number, 1);
    HitBlock together, single;
    tracer.intersect(rays, together, coherent);
    for (std::size_t lane = 0; lane < RayBlock::width; ++lane) {
      if ((rays.active >> lane & 1u) == 0) {
        EXPECT_EQ(together.surface[lane], no_index);
        continue;
      }
      tracer.intersect(alone(rays, lane), single, false);
      EXPECT_EQ(together.surface[lane], single.surface[0]) << number << ' ' << lane;
      if (single.surface[0] == no_index) {
        ++missed;
        continue;
      }
      ++met[single.surface[0]];
      EXPECT_EQ(together.primitive[lane], single.primitive[0]);
      EXPECT_EQ(numbers(together, lane), numbers(single, 0)) << "surface " << single.surface[0];
      if (const auto* mesh = std::get_if<Mesh>(&surfaces[single.surface[0]].geometry)) {
        const OnTriangle at = on_triangle(*mesh, together.primitive[lane], 0, 0);
        EXPECT_EQ(at.normal, Vec3f(together.normal_x[lane], together.normal_y[lane], together.normal_z[lane]));
      }
    }
  }
  return missed;
}

TEST(packets, end_where_their_rays_do_alone_to_the_bit) {
  for (const bool coherent : {false, true}) {
    std::vector<int> met;
    EXPECT_GT(compare_with_rays_alone(landscape(), coherent, met), 1000);
    for (std::size_t i = 0; i < met.size(); ++i) EXPECT_GT(met[i], 20) << "surface " << i;
  }
}

TEST(packets, among_curves_end_there_too_unless_they_are_coherent) {
  Curves tubes;
  for (int i = 0; i < 40; ++i) {
    test::Random random(94, static_cast<std::uint64_t>(i));
    const Vec3f at(16 * random.next() - 8, 1 + 4 * random.next(), 16 * random.next() - 8);
    for (int k = 0; k < 4; ++k) tubes.points.push_back({at + square_to_sphere(random.next2()) * 2.0f, 0.4f});
    tubes.segments.push_back(static_cast<std::uint32_t>(4 * i));
  }
  std::vector<int> met;
  compare_with_rays_alone({{tubes}, {*mesh_of(make_ground(60, 60), false)}}, false, met);
  EXPECT_GT(met[0], 1000);
  EXPECT_GT(met[1], 1000);
}

TEST(packets, are_hidden_where_their_rays_are_alone) {
  const std::vector<Surface> surfaces = landscape();
  const Tracer tracer(surfaces);
  int hidden = 0, open = 0;
  for (std::uint64_t number = 0; number < 4000; ++number) {
    const RayBlock rays = random_block(number, 6);
    std::uint32_t together[RayBlock::width], single[RayBlock::width];
    tracer.occluded(rays, together);
    for (std::size_t lane = 0; lane < RayBlock::width; ++lane) {
      if ((rays.active >> lane & 1u) == 0) {
        EXPECT_EQ(together[lane], 0u);
        continue;
      }
      tracer.occluded(alone(rays, lane), single);
      ASSERT_EQ(together[lane], single[0]) << number << ' ' << lane;
      ++(single[0] == 1 ? hidden : open);
    }
  }
  EXPECT_GT(hidden, 5000);
  EXPECT_GT(open, 5000);
}

TEST(packets, are_hidden_by_a_plane_that_they_cross) {
  std::vector<Surface> surfaces{{Plane{{0, -2, 0}, {0, 1, 0}}}};
  surfaces.resize(11, quad({50, 50, 50}, {1, 0, 0}, {0, 0, 1}));  // enough faces for packets
  const Tracer tracer(surfaces);
  RayBlock rays{};
  rays.active = 0xFFFF;
  for (std::size_t lane = 0; lane < RayBlock::width; ++lane)
    set_ray(rays, lane, {0, 0, 0}, {1, lane % 3 == 0 ? -3.0f : -1.0f, 0});
  std::uint32_t hidden[RayBlock::width];
  tracer.occluded(rays, hidden);
  for (std::size_t lane = 0; lane < RayBlock::width; ++lane) EXPECT_EQ(hidden[lane], lane % 3 == 0 ? 1u : 0u) << lane;
}

TEST(packets, end_before_the_light_that_they_name) {
  // Both ways between a point below a round light and its surface: only the lane that names the light passes.
  std::vector<Surface> surfaces{{Sphere{{0, 1e4 + 12, 0}, 1e4, false}}};
  surfaces[0].light = 0;
  surfaces.resize(11, quad({0, -1, 0}, {1, 0, 0}, {0, 0, 1}));  // enough faces for packets
  const Tracer tracer(surfaces);
  RayBlock rays{};
  for (std::size_t lane = 0; lane < RayBlock::width; ++lane) {
    set_ray(rays, lane, {0, 0, 0}, {0, 12.01f, 0});  // by rounding inside the light
    if (lane % 2 == 0) rays.light[lane] = light_face | light_at_end;
  }
  rays.active = 0xFFFF;
  std::uint32_t blocked[RayBlock::width];
  tracer.occluded(rays, blocked);
  for (std::size_t lane = 0; lane < RayBlock::width; ++lane) EXPECT_EQ(blocked[lane], lane % 2) << lane;
}

TEST(trace_tables, are_flat_with_ten_faces_for_each_other_shape_and_no_curves) {
  const auto is_flat = [](std::size_t faces, std::size_t balls, const std::vector<Surface>& more) {
    std::vector<Surface> surfaces(faces, quad({0, 0, 0}, {1, 0, 0}, {0, 1, 0}));
    surfaces.insert(surfaces.end(), balls, {Sphere{{0, 0, 0}, 1, false}});
    surfaces.insert(surfaces.end(), more.begin(), more.end());
    return TraceTables(surfaces).is_flat();
  };
  const std::shared_ptr<const Mesh> sheet = mesh_of(make_ground(1, 1), false);  // two triangles
  const auto placement = std::make_shared<const AffineMap>();
  EXPECT_TRUE(is_flat(10, 1, {}));
  EXPECT_FALSE(is_flat(9, 1, {}));
  EXPECT_FALSE(is_flat(19, 2, {}));
  EXPECT_TRUE(is_flat(8, 1, {{*sheet}}));
  EXPECT_FALSE(is_flat(7, 1, {{*sheet}}));
  EXPECT_TRUE(is_flat(6, 1, {{MeshInstance{sheet, placement, 0, 0, 0}}, {MeshInstance{sheet, placement, 1, 0, 0}}}));
  EXPECT_FALSE(is_flat(6, 1, {{MeshInstance{sheet, placement, 0, 0, 0}}}));
  for (const bool linear : {false, true}) {
    Curves tube{{{{0, 0, 0}, 1}, {{1, 0, 0}, 1}, {{2, 0, 0}, 1}, {{3, 0, 0}, 1}}, {0}, linear};
    EXPECT_FALSE(is_flat(100, 0, {{tube}}));
  }
}

TEST(mesh_hits, are_those_of_single_triangles_of_any_size) {
  TriangleMesh source;
  constexpr std::uint32_t count = 300;
  source.resize_positions(3 * count);
  for (std::uint32_t i = 0; i < count; ++i) {
    test::Random random(92, i);
    const float size = std::exp2(80 * random.next() - 40);  // squares of areas from 1e-48 to 1e48
    for (std::uint32_t k = 0; k < 3; ++k) source.positions[3 * i + k] = square_to_sphere(random.next2()) * size;
    source.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  const std::shared_ptr<const Mesh> outward = mesh_of(source, false), inward = mesh_of(source, true);
  int extreme = 0;
  for (std::uint64_t number = 0; number < 1000; ++number) {
    test::Random random(93, number);
    const auto lanes = static_cast<std::uint32_t>(random.next_bits() & 0xFFFF);
    float u[RayBlock::width], v[RayBlock::width];
    std::uint32_t primitive[RayBlock::width];
    MeshHits on_meshes;
    for (std::size_t lane = 0; lane < RayBlock::width; ++lane) {
      u[lane] = random.next(), v[lane] = random.next();
      primitive[lane] = static_cast<std::uint32_t>(count * random.next());
      if ((lanes >> lane & 1u) != 0) on_meshes.add(lane, lane % 2 == 0 ? *outward : *inward, primitive[lane]);
    }
    HitBlock hits;
    on_meshes.locate(u, v, hits);
    for_each_lane(lanes, [&](std::size_t lane) {
      const OnTriangle at = on_triangle(lane % 2 == 0 ? *outward : *inward, primitive[lane], u[lane], v[lane]);
      const Vec3f p = at.p, n = at.normal;
      EXPECT_EQ(numbers(hits, lane), (std::array{p.x, p.y, p.z, n.x, n.y, n.z}));
      EXPECT_NEAR(length(n), 1, 1e-6f);
      const Vec3f corner = outward->corner(primitive[lane], 0);
      const Vec3f normal =
          cross(outward->corner(primitive[lane], 1) - corner, outward->corner(primitive[lane], 2) - corner);
      if (!fits_single(dot(normal, normal))) ++extreme;
    });
  }
  EXPECT_GT(extreme, 1000);
}

}  // namespace
}  // namespace photonproof::inline renderer_rays
