// Ray queries: exact answers, robustness far from the origin, hostile rays. Scenes go through the small scenes' own
// kernel and through Embree, with the same requirements.

#include "renderer/rays/trace.h"

#include <gtest/gtest.h>

#include <cmath>

#include "renderer/integrators/integrator.h"
#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/planning/test_compiled.h"
#include "renderer/rays/rays.h"

namespace photonproof::inline renderer_rays {
namespace {

Surface quad(const Vec3f& corner, const Vec3f& u, const Vec3f& v) {
  const Vec3f n = cross(u, v);
  return {Quad{corner, u, v, normalize(n), length(n)}};
}

/// Closed box [-1,1]^3 + center, normals inward.
std::vector<Surface> box(const Vec3f& center) {
  const float s = 2;
  const Vec3f low = center - Vec3f(1), high = center + Vec3f(1);
  return {quad(low, {s, 0, 0}, {0, s, 0}),    quad(low, {0, s, 0}, {0, 0, s}),    quad(low, {0, 0, s}, {s, 0, 0}),
          quad(high, {0, -s, 0}, {-s, 0, 0}), quad(high, {0, 0, -s}, {0, -s, 0}), quad(high, {-s, 0, 0}, {0, 0, -s})};
}

Hit intersect(const Tracer& tracer, const Vec3f& origin, const Vec3f& direction, std::uint32_t area_light = no_index) {
  RayBlock rays{};
  HitBlock hits;
  fill_block<float>(rays, origin, direction, area_light, true);
  tracer.intersect(rays, hits, false);
  if (hits.surface[0] == no_index) return {};
  return {
      hits.surface[0], {hits.p_x[0], hits.p_y[0], hits.p_z[0]}, {hits.normal_x[0], hits.normal_y[0], hits.normal_z[0]}};
}

bool occluded(const Tracer& tracer, const Vec3f& origin, const Vec3f& segment, std::uint32_t area_light = no_index) {
  RayBlock rays{};
  std::uint32_t blocked[RayBlock::width];
  fill_block<float>(rays, origin, segment, area_light, true);
  tracer.occluded(rays, blocked);
  return blocked[0] == 1;
}

TEST(tracer, hits_quads_and_spheres_where_geometry_says) {
  std::vector<Surface> surfaces = box({0, 0, 0});
  surfaces.push_back({Sphere{{0, 0, 0}, 0.5, false}});
  const Tracer tracer(surfaces);
  const Hit ball = intersect(tracer, {0, 0, 0.9f}, {0, 0, -1});
  EXPECT_EQ(ball.surface, 6u);
  EXPECT_NEAR(ball.p_world.z, 0.5f, 1e-6f);
  EXPECT_EQ(ball.normal, Vec3f(0, 0, 1));
  const Hit wall = intersect(tracer, {0.8f, 0.7f, 0}, {0, 0, -1});
  EXPECT_EQ(wall.surface, 0u);
  EXPECT_NEAR(length(wall.p_world - Vec3f(0.8f, 0.7f, -1)), 0, 2e-7f);
  EXPECT_TRUE(occluded(tracer, {0, 0, 0.9f}, {0, 0, -1.8f}));
  EXPECT_FALSE(occluded(tracer, {0.8f, 0.7f, 0.9f}, {0, 0, -1.8f}));
}

TEST(tracer, a_block_of_rays_ends_where_its_rays_do_one_by_one) {
  // Through the BVH together or not, with any lanes missing.
  std::vector<Surface> surfaces = box({0, 0, 0});
  surfaces.push_back({Sphere{{0.2, -0.3, 0.1}, 0.5, false}});
  const Tracer tracer(surfaces);
  for (std::uint64_t i = 0; i < 2000; ++i) {
    test::Random random(53, i);
    RayBlock rays{};
    HitBlock hits;
    Vec3f origins[RayBlock::width], directions[RayBlock::width];
    const auto lanes = static_cast<std::uint32_t>(random.next_bits() & 0xFFFF);
    for (std::size_t k = 0; k < RayBlock::width; ++k) {
      const Vec3f o = square_to_sphere(random.next2()) * 0.9f, d = square_to_sphere(random.next2());
      origins[k] = o;
      directions[k] = d;
      rays.origin_x[k] = o.x, rays.origin_y[k] = o.y, rays.origin_z[k] = o.z;
      rays.direction_x[k] = d.x, rays.direction_y[k] = d.y, rays.direction_z[k] = d.z;
    }
    rays.active = lanes;
    std::uint32_t blocked[RayBlock::width];
    tracer.occluded(rays, blocked);
    for (const bool coherent : {false, true}) {
      tracer.intersect(rays, hits, coherent);
      for (std::size_t k = 0; k < RayBlock::width; ++k) {
        if ((lanes >> k & 1u) == 0) {
          EXPECT_EQ(hits.surface[k], no_index);
          EXPECT_EQ(blocked[k], 0u);
          continue;
        }
        const Hit alone = intersect(tracer, origins[k], directions[k]);
        EXPECT_EQ(hits.surface[k], alone.surface);
        EXPECT_NEAR(length(Vec3f(hits.p_x[k], hits.p_y[k], hits.p_z[k]) - alone.p_world), 0, 2e-6f);
        EXPECT_EQ(blocked[k] == 1, occluded(tracer, origins[k], directions[k]));
      }
    }
  }
}

TEST(tracer, no_ray_leaves_a_closed_box_or_meets_its_own_surface_however_far_out_it_stands) {
  // From a random wall point into the room: the next hit is another wall, never a miss (leak), never the same wall
  // (self-hit).
  for (const float shift : {0.0f, 100.0f, 1e4f, 1e5f}) {
    const std::vector<Surface> surfaces = box(Vec3f(shift, -shift, shift));
    const Tracer tracer(surfaces);
    int leaks = 0, self_hits = 0;
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      test::Random s(51, i);
      const std::uint32_t start = static_cast<std::uint32_t>(i % 6);
      const auto& wall = std::get<Quad>(surfaces[start].geometry);
      const auto u = s.next2();
      const Vec3f p = wall.corner + wall.edge_u * u.x + wall.edge_v * u.y;
      const Vec3f d = Frame<float>(wall.normal).to_world(square_to_cosine_hemisphere(s.next2()));
      const Hit hit = intersect(tracer, offset_from(p, wall.normal, d, 1), d);
      if (!hit.valid()) ++leaks;
      if (hit.surface == start) ++self_hits;
    }
    EXPECT_EQ(leaks, 0) << shift;
    EXPECT_EQ(self_hits, 0) << shift;
  }
}

/// A light of this radius whose front comes down to y = 12: seen from below, or from within.
struct RoundLight {
  const char* name;
  Geometry geometry;
  double radius;
  bool inward;

  /// Point above (x, z), rounded as in single precision: `off` steps of the radius nearer or farther.
  Vec3f point(double x, double z, double off) const {
    const double across = std::holds_alternative<Sphere>(geometry) ? x * x + z * z : z * z;
    const double rise = radius - std::sqrt(radius * radius - across);
    return Vec3f(Vec3d(x, 12 + (inward ? -rise : rise) + off * 0x1p-23 * radius, z));
  }
};

std::vector<RoundLight> round_lights() {
  std::vector<RoundLight> area_lights;
  for (const double radius : {1e2, 1e4, 1e6})
    for (const bool inward : {false, true}) {
      const double y = 12 + (inward ? -radius : radius);
      area_lights.push_back({"sphere", Sphere{{0, y, 0}, radius, inward}, radius, inward});
      area_lights.push_back({"cylinder", Cylinder{{-1e7, y, 0}, {1, 0, 0}, 2e7, radius, inward}, radius, inward});
    }
  return area_lights;
}

TEST(tracer, rays_meet_nothing_of_the_light_that_they_leave_or_end_on_whatever_its_points_rounding) {
  for (const RoundLight& area_light : round_lights()) {
    SCOPED_TRACE(area_light.name + std::string(area_light.inward ? ", inward, " : ", ") +
                 std::to_string(area_light.radius));
    std::vector<Surface> surfaces{{area_light.geometry}};
    surfaces[0].light = 0;
    const Tracer tracer(surfaces);
    int named = 0, unnamed = 0, leaving = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
      test::Random random(57, i);
      const Vec3f below(6 * random.next() - 3, 0, 6 * random.next() - 3);
      const double x = 20 * double{random.next()} - 10, z = 20 * double{random.next()} - 10;
      const Vec3f end = area_light.point(x, z, 4 * double{random.next()} - 2);
      named += occluded(tracer, below, end - below, light_face | light_at_end) ? 1 : 0;
      unnamed += occluded(tracer, below, end - below) ? 1 : 0;
      const Hit hit = intersect(tracer, end, normalize(below - end), light_face);
      // A ray that leaves the inside meets the other end of its chord.
      leaving += hit.valid() != area_light.inward || (hit.valid() && length(hit.p_world - end) < area_light.radius / 2)
                     ? 1
                     : 0;
    }
    EXPECT_EQ(named, 0);
    EXPECT_EQ(leaving, 0);
    if (area_light.radius >= 1e4) {
      EXPECT_GT(unnamed, 500) << "points are not off: the test shows nothing";
    }
  }
}

TEST(tracer, the_far_inside_of_a_light_is_hidden_by_its_near_side) {
  for (const RoundLight& area_light : round_lights()) {
    if (!area_light.inward) continue;
    std::vector<Surface> surfaces{{area_light.geometry}};
    surfaces[0].light = 0;
    const Tracer tracer(surfaces);
    const auto radius = static_cast<float>(area_light.radius);
    const Vec3f above(0, 12 + radius, 0), bottom(0, 12 - 2 * radius, 0), middle(0, 12 - radius, 0);
    EXPECT_TRUE(occluded(tracer, above, bottom - above, light_face | light_at_end)) << area_light.name;
    EXPECT_FALSE(occluded(tracer, middle, bottom - middle, light_face | light_at_end)) << area_light.name;
    EXPECT_TRUE(occluded(tracer, above, bottom - above, (light_face | light_at_end) + 1)) << "another light's face";
  }
}

TEST(tracer, of_a_long_light_of_triangles_rays_pass_the_face_they_end_on_alone) {
  // A roof of two long faces: from below one its other side hides it.
  const auto face = [](double slope, std::uint32_t primitive) {
    const Vec3d corner{0, 12, -1e6}, edge_u{0, 0, 2e6}, edge_v{slope > 0 ? -1e6 : 1e6, -1e6 * std::abs(slope), 0};
    const Vec3d normal = normalize(cross(edge_u, edge_v)) * (slope > 0 ? -1.0 : 1.0);
    return LongFace{corner, edge_u, edge_v, normal, dot(normal, corner), false, primitive};
  };
  auto source = std::make_shared<TriangleMesh>();
  source->triangles = {{0, 1, 2}, {0, 1, 2}};
  Mesh mesh;
  mesh.positions.resize(4);
  mesh.source = source;
  std::vector<Surface> roof{{mesh}};
  roof[0].long_faces = std::make_shared<const std::vector<LongFace>>(std::vector<LongFace>{face(1, 0), face(-1, 1)});
  roof[0].light = 0;
  const Tracer tracer(roof);
  const Vec3f inside(0, 0, 0), left(-5, 7.0001f, 0), right(5, 7.0001f, 0);  // by rounding behind the faces
  EXPECT_TRUE(occluded(tracer, inside, left - inside));
  EXPECT_FALSE(occluded(tracer, inside, left - inside, light_face | light_at_end));
  EXPECT_TRUE(occluded(tracer, inside, right - inside, light_face | light_at_end));
  EXPECT_FALSE(occluded(tracer, inside, right - inside, (light_face | light_at_end) + 1));
}

TEST(tracer, rays_leaving_a_sphere_never_meet_it_again) {
  for (const float shift : {0.0f, 100.0f, 1e4f}) {
    const Vec3f center(shift, shift, -shift);
    const std::vector<Surface> surfaces{{Sphere{Vec3d(center), 1, false}}};
    const Tracer tracer(surfaces);
    for (std::uint64_t i = 0; i < 20'000; ++i) {
      test::Random s(52, i);
      const Vec3f from = center + square_to_sphere(s.next2()) * 3;
      const Hit first = intersect(tracer, from, normalize(center + square_to_sphere(s.next2()) * 0.99f - from));
      ASSERT_TRUE(first.valid());
      const Vec3f d = Frame<float>(first.normal).to_world(square_to_cosine_hemisphere(s.next2()));
      EXPECT_FALSE(intersect(tracer, offset_from(first.p_world, first.normal, d, 1), d).valid()) << shift;
    }
  }
}

TEST(tracer, a_ray_with_a_nan_or_infinity_hits_nothing) {
  const std::vector<Surface> surfaces = box({0, 0, 0});
  const Tracer tracer(surfaces);
  for (const float bad : {std::nanf(""), INFINITY, -INFINITY}) {
    EXPECT_FALSE(intersect(tracer, {bad, 0, 0}, {0, 0, 1}).valid());
    EXPECT_FALSE(intersect(tracer, {0, 0, 0}, {0, bad, 1}).valid());
    EXPECT_FALSE(occluded(tracer, {0, 0, bad}, {0, 0, 5}));
  }
}

TEST(tracer, an_empty_scene_is_all_misses) {
  const std::vector<Surface> none;
  EXPECT_FALSE(intersect(Tracer(none), {0, 0, 0}, {0, 0, 1}).valid());
}

// --- whole scenes, through both ways of tracing ----------------------------------------------------------------------

constexpr std::size_t by_embree = 0, by_small_kernel = brute_force_limit;

/// Place of a scene in its file, and distance of its shapes from their common middle. The compiled scene's origin is
/// that middle: single precision must resolve the distance, the place costs nothing.
struct Placement {
  double shift, from_middle;
};
std::ostream& operator<<(std::ostream& out, const Placement& p) {
  return out << "shifted by " << p.shift << ", " << p.from_middle << " from the scene's middle";
}
const Placement placements[] = {{0, 0}, {100, 0}, {1e4, 0}, {1e5, 0}, {0, 100}, {0, 1e4}, {0, 1e5}};

/// Number of `hits` on a wall of edge 2 that may lie on an edge within single precision, and so on either side of the
/// next wall. Coordinates have a grain of 2^-23 times the distance from the middle. Eight grains by each of four edges
/// are a part 16 x grain of the wall. It is 0 where the scene is centred.
std::int64_t hits_on_edges(const Placement& at, std::int64_t hits) {
  return static_cast<std::int64_t>(static_cast<double>(hits) * 16 * 0x1p-23 * std::max(1.0, at.from_middle));
}

Vec3d center_of(const Placement& at) { return Vec3d(1, -1, 1) * at.shift + Vec3d(-1, 1, 1) * at.from_middle; }

/// A shape at the far end, which puts the scene's middle at the origin.
void add_counterweight(SceneDescription& scene, const Placement& at, BsdfIndex bsdf) {
  if (at.from_middle == 0) return;
  test::add_shape(scene, SphereDescription{}, Transform::translate(Vec3d(1, -1, -1) * at.from_middle), bsdf);
}

void set_camera(SceneDescription& scene, const Vec3d& center) {
  test::set_camera(scene, Transform::look_at(center + Vec3d(0.1, 0.2, 0.3), center + Vec3d(-0.3, 0.1, -0.5), {0, 1, 0}),
                   120, 16);
}

/// A closed cube of half edge 1 seen from inside that reflects everything, a point light in its middle.
SceneDescription white_box(const Placement& at) {
  SceneDescription scene;
  const BsdfIndex white = test::add_bsdf(scene, DiffuseDescription{RgbD(1)});
  const Vec3d center = center_of(at);
  test::add_shape(scene, CubeDescription{}, Transform::translate(center), white).flip_normals = true;
  add_counterweight(scene, at, white);
  scene.emitters.push_back({{}, "", PointLightDescription{center + Vec3d(-0.1, 0.05, 0.2), RgbD(1)}});
  set_camera(scene, center);
  return scene;
}

/// The same inside a sphere.
SceneDescription white_sphere(const Placement& at) {
  SceneDescription scene;
  const BsdfIndex white = test::add_bsdf(scene, DiffuseDescription{RgbD(1)});
  const Vec3d center = center_of(at);
  test::add_shape(scene, SphereDescription{}, Transform::translate(center), white).flip_normals = true;
  add_counterweight(scene, at, white);
  scene.emitters.push_back({{}, "", PointLightDescription{center + Vec3d(-0.1, 0.05, 0.2), RgbD(1)}});
  set_camera(scene, center);
  return scene;
}

/// The box with a ball of lossless glass and one of lossless metal in it.
SceneDescription white_box_with_balls(const Placement& at) {
  SceneDescription scene = white_box(at);
  const Vec3d center = center_of(at);
  test::add_shape(scene, SphereDescription{{0.5, -0.5, 0.2}, 0.4}, Transform::translate(center),
                  test::add_bsdf(scene, DielectricDescription{1.5, 1.0}));
  test::add_shape(scene, SphereDescription{{-0.5, -0.5, -0.2}, 0.4}, Transform::translate(center),
                  test::add_bsdf(scene, ConductorDescription{}));
  return scene;
}

TEST(scene_rays, no_ray_leaves_a_closed_box_or_meets_its_own_wall) {
  for (const std::size_t limit : {by_embree, by_small_kernel}) {
    for (const Placement& at : placements) {
      const Scene scene = test::compiled(white_box(at), 4, 4, {}, limit);
      int leaks = 0, self_hits = 0, shadowed = 0;
      for (std::uint64_t i = 0; i < 20'000; ++i) {
        test::Random s(54, i);
        const auto start = static_cast<std::uint32_t>(i % 6);
        const auto& wall = std::get<Quad>(scene.surfaces[start].geometry);
        const auto u = s.next2();
        const Vec3f p = wall.corner + wall.edge_u * u.x + wall.edge_v * u.y;
        const Vec3f d = Frame<float>(wall.normal).to_world(square_to_cosine_hemisphere(s.next2()));
        const std::uint32_t from = scene.view().small ? start : no_index;
        const float floor = scene.view().coordinate_floor;
        const SurfaceHit<float> hit =
            closest_hit<float>(scene.view(), offset_from(p, wall.normal, d, floor), d, from, true, false);
        if (!hit.valid || hit.surface >= 6) ++leaks;
        if (hit.valid && hit.surface == start) ++self_hits;
        const Vec3f light = std::get<PointLight<float>>(scene.lights[0]).position;
        const Vec3f origin = offset_from(p, wall.normal, Vec3f(light - p), floor);
        if (occluded<float>(scene.view(), origin, light - origin, from, no_index, true)) ++shadowed;
      }
      EXPECT_LE(leaks, hits_on_edges(at, 20'000)) << (limit == by_embree ? "Embree, " : "small, ") << at;
      EXPECT_EQ(self_hits, 0) << (limit == by_embree ? "Embree, " : "small, ") << at;
      EXPECT_LE(shadowed, hits_on_edges(at, 20'000)) << (limit == by_embree ? "Embree, " : "small, ") << at;
    }
  }
}

TEST(scene_rays, leave_a_sphere_and_cross_it_once) {
  // Outward from its surface nothing is met; inward the far side is.
  for (const std::size_t limit : {by_embree, by_small_kernel}) {
    for (const Placement& at : placements) {
      SceneDescription d;
      const BsdfIndex white = test::add_bsdf(d, DiffuseDescription{RgbD(1)});
      test::add_shape(d, SphereDescription{}, Transform::translate(center_of(at)), white);
      add_counterweight(d, at, white);
      const Scene scene = test::compiled(d, 4, 4, {}, limit);
      const Vec3f center(std::get<Sphere>(scene.surfaces[0].geometry).center);
      int met_again = 0, lost = 0;
      for (std::uint64_t i = 0; i < 20'000; ++i) {
        test::Random s(55, i);
        const Vec3f from = center + square_to_sphere(s.next2()) * 3;
        const Vec3f towards = center + square_to_sphere(s.next2()) * 0.99f;
        const SurfaceHit<float> hit =
            closest_hit<float>(scene.view(), from, normalize(towards - from), no_index, true, false);
        ASSERT_TRUE(hit.valid);
        const Vec3f out = Frame<float>(hit.normal).to_world(square_to_cosine_hemisphere(s.next2()));
        const float floor = scene.view().coordinate_floor;
        const auto next = [&](const Vec3f& direction) {
          return closest_hit<float>(scene.view(), offset_from(hit.p, hit.normal, direction, floor), direction,
                                    hit.primitive, true, false);
        };
        const SurfaceHit<float> away = next(out);
        if (away.valid && away.surface == 0) ++met_again;
        const SurfaceHit<float> through = next(-out);
        if (!through.valid || through.surface != 0 || dot(through.normal, out) > 0) ++lost;
      }
      EXPECT_EQ(met_again, 0) << (limit == by_embree ? "Embree, " : "small, ") << at;
      EXPECT_EQ(lost, 0) << (limit == by_embree ? "Embree, " : "small, ") << at;
    }
  }
}

/// The same inside an octahedron whose triangles are each cut in four and bulged to the unit sphere: 32 triangles,
/// whose edges run in all directions.
SceneDescription white_facets(const Placement& at) {
  auto mesh = std::make_shared<TriangleMesh>();
  std::vector<Vec3f> corners;
  for (int octant = 0; octant < 8; ++octant) {
    const Vec3f x((octant & 1) != 0 ? 1.0f : -1.0f, 0, 0), y(0, (octant & 2) != 0 ? 1.0f : -1.0f, 0);
    const Vec3f z(0, 0, (octant & 4) != 0 ? 1.0f : -1.0f);
    const Vec3f xy = normalize(x + y), yz = normalize(y + z), zx = normalize(z + x);
    const bool mirrored = x.x * y.y * z.z < 0;  // keeps the winding counter-clockwise seen from outside
    for (std::array<Vec3f, 3> t : {std::array{x, xy, zx}, {xy, y, yz}, {zx, yz, z}, {xy, yz, zx}}) {
      if (mirrored) std::swap(t[1], t[2]);
      corners.insert(corners.end(), t.begin(), t.end());
    }
  }
  mesh->resize_positions(corners.size());
  std::copy(corners.begin(), corners.end(), mesh->positions.begin());
  for (std::uint32_t i = 0; i < corners.size(); i += 3) mesh->triangles.push_back({i, i + 1, i + 2});
  SceneDescription scene = white_sphere(at);
  const ShapeDescription sphere = scene.shapes[0];
  scene.shapes[0].geometry = MeshDescription{MeshDescription::Format::ply, "facets.ply", true, false, mesh};
  scene.shapes[0].to_world = sphere.to_world * Transform::rotate({1, 2, 3}, 25);
  return scene;
}

/// Camera paths of `edges` edges in a closed scene without absorption: the number that ended early. They leaked, met
/// the surface they left from behind, or lost their throughput.
std::int64_t camera_paths_lost(const Kernels& kernels, const Scene& scene, int edges) {
  PathTask task;
  task.scene = &scene.view();
  task.camera = {0, 0, 16, 16, 0, 32, 1};
  task.settings = {.max_depth = edges, .rr_depth = 1000, .direct_light = DirectLight::unweighted};
  std::vector<float> radiance(3 * std::size_t{task.camera.paths()});
  std::vector<std::uint32_t> scratch(kernels.path.scratch);
  task.radiance = radiance.data();
  task.scratch = scratch.data();
  kernels.path.trace(task);
  return static_cast<std::int64_t>(task.camera.paths()) * (edges - 1) - static_cast<std::int64_t>(task.counts.bounce);
}

/// Photons that a closed white scene should have stored at every edge but the first, less those it did.
std::int64_t photons_lost(const Kernels& kernels, const Scene& scene, int edges) {
  std::vector<std::uint32_t> scratch(kernels.photon.scratch);
  const auto deposits = std::make_unique<PhotonDeposits>();
  std::uint64_t stored = 0;
  PhotonTask task;
  task.scene = &scene.view();
  task.seed = 7;
  task.count = 8000;
  task.max_edges = edges;
  task.scratch = scratch.data();
  task.deposits = deposits.get();
  task.sink = &stored;
  task.drain = [](PhotonTask& t) {
    *static_cast<std::uint64_t*>(t.sink) += t.deposits->count;
    t.deposits->count = 0;
  };
  kernels.photon.trace(task);
  return static_cast<std::int64_t>(task.count) * (edges - 1) - static_cast<std::int64_t>(stored);
}

TEST(scene_rays, no_path_of_any_kernel_is_lost_in_a_closed_white_scene) {
  for (const std::size_t limit : {by_embree, by_small_kernel}) {
    for (const Placement& at : placements) {
      const Scene in_box = test::compiled(white_box(at), 16, 16, {}, limit);
      const Scene in_sphere = test::compiled(white_sphere(at), 16, 16, {}, limit);
      const Scene with_balls = test::compiled(white_box_with_balls(at), 16, 16, {}, limit);
      const Scene in_facets = test::compiled(white_facets(at), 16, 16, {}, limit);
      for (const Kernels& kernels : available_kernels()) {
        const std::string what =
            std::string(limit == by_embree ? "Embree, " : "small, ") + kernels.isa + ", " + testing::PrintToString(at);
        const std::int64_t allowed = hits_on_edges(at, 5 * 8192);
        EXPECT_LE(camera_paths_lost(kernels, in_box, 6), allowed) << "box, " << what;
        EXPECT_LE(photons_lost(kernels, in_box, 6), allowed) << "box, " << what;
        EXPECT_LE(camera_paths_lost(kernels, in_sphere, 6), allowed) << "sphere, " << what;
        EXPECT_LE(photons_lost(kernels, in_sphere, 6), allowed) << "sphere, " << what;
        EXPECT_LE(camera_paths_lost(kernels, in_facets, 6), allowed) << "facets, " << what;
        EXPECT_LE(photons_lost(kernels, in_facets, 6), allowed) << "facets, " << what;
        EXPECT_LE(camera_paths_lost(kernels, with_balls, 6), allowed) << "balls, " << what;
      }
    }
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_rays
