// Irradiance records against closed forms, and the photon mapper that interpolates between them.

#include "renderer/irradiance/irradiance_cache.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>

#include "renderer/core/parallel.h"
#include "renderer/integrators/test_scenes.h"
#include "renderer/irradiance/cache_picture.h"
#include "renderer/irradiance/irradiance_record.h"
#include "renderer/photon_mapping/cache_prepass.h"
#include "renderer/planning/test_compiled.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

using test::job_with;
using test::render;

constexpr float pi = std::numbers::pi_v<float>;

/// Light of radiance 1, 2 and 3 in the channels from the rectangle [.2, 1.4] x [-.5, .7] at height 1 above points about
/// the origin; black elsewhere.
const std::array<Vec3d, 4> light{Vec3d{0.2, -0.5, 1}, Vec3d{1.4, -0.5, 1}, Vec3d{1.4, 0.7, 1}, Vec3d{0.2, 0.7, 1}};

/// Lambert's formula: the irradiance of a polygon above the horizon.
double irradiance_of_light(const Vec3d& p, const Vec3d& n) {
  double sum = 0;
  for (std::size_t i = 0; i < light.size(); ++i) {
    const Vec3d a = normalize(light[i] - p), b = normalize(light[(i + 1) % light.size()] - p);
    const Vec3d across = cross(a, b);
    sum += std::atan2(length(across), dot(a, b)) * dot(normalize(across), n);
  }
  return std::abs(sum) / 2;
}

/// Exact rays, through the middles of cells.
HemisphereRays rays_to_light(const HemisphereGrid& grid, const Vec3f& n) {
  HemisphereRays rays;
  const std::array<Vec3f, 2> axes = record_axes(n);
  for (std::size_t i = 0; i < grid.cells(); ++i) {
    const Vec3f local = grid.direction(i, 0.5f, 0.5f);
    const Vec3f to = axes[0] * local.x + axes[1] * local.y + n * local.z;
    const Vec3f at = to * (1 / std::max(to.z, 1e-6f));
    const bool meets = at.x > 0.2f && at.x < 1.4f && at.y > -0.5f && at.y < 0.7f;
    rays.radiance.push_back(meets ? Rgb{1, 2, 3} : Rgb(0.0f));
    rays.distance.push_back(meets ? length(at) : std::numeric_limits<float>::infinity());
  }
  return rays;
}

TEST(irradiance_record, of_an_even_hemisphere_is_pi_and_does_not_change) {
  const HemisphereGrid grid = hemisphere_grid(256);
  HemisphereRays rays{std::vector<Rgb>(grid.cells(), Rgb(1.0f)), std::vector<float>(grid.cells(), 2.0f)};
  const IrradianceRecord record = make_record({1, 2, 3}, normalize(Vec3f{1, -2, 2}), grid, rays, 0.01f);
  EXPECT_NEAR(record.irradiance.x, pi, 1e-5f);
  EXPECT_NEAR(record.radius, 2, 1e-5f);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(length(record.turned[c]), 1e-5f);
    EXPECT_LT(length(record.moved[c]), 1e-5f);
  }
}

TEST(irradiance_record, gradients_are_those_of_a_rectangle) {
  const HemisphereGrid grid{200, 628};
  for (const Vec3f& n : {Vec3f{0, 0, 1}, normalize(Vec3f{0.1f, 0.15f, 1})}) {
    const IrradianceRecord record = make_record({0, 0, 0}, n, grid, rays_to_light(grid, n), 0.01f);
    const Vec3d normal{double{n.x}, double{n.y}, double{n.z}};
    const double here = irradiance_of_light({0, 0, 0}, normal);
    const auto expect_change = [&](double expected, float found, const char* what) {
      EXPECT_NEAR(double{found}, expected, 0.02 * here) << what;
      EXPECT_NEAR(double{found}, expected, 0.04 * std::abs(expected) + 0.005 * here) << what;
    };
    EXPECT_NEAR(double{record.irradiance.x}, here, 0.005 * here);
    constexpr double step = 1e-4;
    const auto axes = record_axes(n);
    for (const Vec3f& axis : axes) {
      const Vec3d along{double{axis.x}, double{axis.y}, double{axis.z}};
      const double moved =
          (irradiance_of_light(along * step, normal) - irradiance_of_light(along * -step, normal)) / (2 * step);
      expect_change(moved, dot(axis, record.moved[0]), "moved");
      expect_change(moved, dot(axis, record.moved[2]) / 3, "moved, blue");
      // The normal turns towards the axis, that is about n x axis.
      const auto tilted = [&](double by) { return irradiance_of_light({0, 0, 0}, normalize(normal + along * by)); };
      const double turned = (tilted(step) - tilted(-step)) / (2 * step);
      expect_change(turned, dot(cross(n, axis), record.turned[0]), "turned");
    }
  }
}

TEST(irradiance_cache, finds_what_a_record_says_where_it_stands_for_the_point) {
  IrradianceCache cache(0.15f);
  IrradianceRecord record{{0, 0, 0}, {0, 0, 1}, Rgb{1, 2, 3}, 1.0f};
  record.moved[0] = {0.5f, 0, 0};
  cache.insert(record, 0.01f);
  const auto near = cache.find({0.1f, 0, 0}, {0, 0, 1});
  ASSERT_TRUE(near.has_value());
  EXPECT_NEAR(near->x, 1.05f, 1e-6f);
  EXPECT_NEAR(near->y, 2, 1e-6f);
  EXPECT_FALSE(cache.covers({0.16f, 0, 0}, {0, 0, 1}));
  EXPECT_FALSE(cache.covers({0.05f, 0, 0}, {0, 1, 0}));
  EXPECT_FALSE(cache.covers({0, 0, -0.1f}, {0, 0, 1})) << "it sees what lies between them";
  EXPECT_EQ(cache.interpolate({5, 0, 0}, {0, 0, 1}).z, 3) << "far from all records the nearest one";
}

TEST(irradiance_cache, neighbours_bound_each_others_radius) {
  IrradianceCache cache(0.5f);
  cache.insert({{0, 0, 0}, {0, 0, 1}, Rgb(1.0f), 4.0f}, 0.01f);
  cache.insert({{0.5f, 0, 0}, {0, 0, 1}, Rgb(1.0f), 1.0f}, 0.01f);
  EXPECT_NEAR(cache.records()[0].radius, 1.5f, 1e-6f);
  cache.insert({{1, 0, 0}, {0, 0, 1}, Rgb(1.0f), 9.0f}, 0.01f);
  EXPECT_NEAR(cache.records()[2].radius, 1.5f, 1e-6f);
}

SceneDescription cached(const SceneDescription& scene) { return test::with_indirect(scene, IndirectLight::cache); }

TEST(irradiance_cache, furnace_is_two_and_its_depth_counts) {
  const auto out = render(cached(test::furnace(0.5, 1, 32)), "photonmapper", job_with(16, 1'000'000));
  EXPECT_NEAR(test::image_mean(out.image.mean), 2.0, 0.005 * 2);
  for (int y = 0; y < 32; y += 8)
    for (int x = 0; x < 32; x += 8)
      EXPECT_NEAR(test::block_mean(out.image.mean, x, y, 8, 8), 2.0, 0.01 * 2) << x << ", " << y;
  SceneDescription shallow = test::furnace(0.5, 1, 16);
  shallow.integrator.method = PathDescription{3, 24, false};
  EXPECT_NEAR(test::image_mean(render(cached(shallow), "photonmapper", job_with(16)).image.mean), 1.75, 0.01 * 1.75);
}

TEST(irradiance_cache, rooms_have_the_path_tracers_mean_and_blocks) {
  for (const bool with_balls : {false, true}) {
    SceneDescription scene = test::room(32, with_balls);
    scene.integrator.method = PathDescription{-1, 5, true};
    const Image path = render(scene, "path", job_with(1024)).image.mean;
    const Image photons = render(cached(scene), "photonmapper", job_with(128, 1'000'000)).image.mean;
    EXPECT_NEAR(test::image_mean(photons), test::image_mean(path), 0.01 * test::image_mean(path));
    double worst = 0;
    for (int y = 0; y < 32; y += 8)
      for (int x = 0; x < 32; x += 8)
        worst =
            std::max(worst, std::abs(test::block_mean(photons, x, y, 8, 8) / test::block_mean(path, x, y, 8, 8) - 1));
    std::printf("%s: mean %+.2f %%, worst block %.2f %%\n", with_balls ? "balls" : "diffuse",
                100 * (test::image_mean(photons) / test::image_mean(path) - 1), 100 * worst);
    if (!with_balls) {
      EXPECT_LT(worst, 0.05);
    }
  }
}

TEST(irradiance_cache, same_seed_gives_the_same_bits_at_1_2_and_7_threads) {
  const auto one =
      test::expect_same_bits_at_any_threads(cached(test::room(40, true)), "photonmapper", job_with(4, 30'000));
  EXPECT_GT(one.stats.counts.at("cache_records"), 100);
}

/// The irradiance cache of a room rendered in so many pixels a side.
IrradianceCache records_of(const SceneDescription& room, const RenderJob& job, int size) {
  const Scene scene = test::compiled(room, size, size);
  const RenderPlan plan = plan_render(analyse(SceneParts(room, size, size)), room.integrator, job);
  const PhotonSettings settings(room.integrator, job);
  const Threads threads(2);
  const GatherAreas areas(scene, threads);
  RenderStats stats;
  return make_irradiance_cache(plan, {scene, settings, job, threads}, areas, {0, 0, size, size}, stats).cache;
}

TEST(irradiance_cache, has_more_records_at_edges_than_in_the_middle_of_walls) {
  const SceneDescription room = cached(test::room(128, false));
  const RenderJob job = job_with(1, 100'000);
  const IrradianceCache cache = records_of(room, job, 128);
  const double scale = test::compiled(room, 128, 128).scale();
  int at_edges = 0, in_middles = 0;
  for (const IrradianceRecord& record : cache.records()) {
    const Vec3d p = Vec3d(record.p) / scale;
    std::array<double, 3> from_middle{std::abs(p.x), std::abs(p.y), std::abs(p.z)};
    std::ranges::sort(from_middle);
    const double from_edge = 1 - from_middle[1];
    at_edges += from_edge < 0.15;
    in_middles += from_edge > 0.4;
  }
  // A wall of 2 x 2 has an area of 1.11 within .15 of its edges, and 1.44 further than .4 from them.
  std::printf("%zu records: %d a unit of area at edges, %d in middles\n", cache.records().size(),
              static_cast<int>(at_edges / 1.11), static_cast<int>(in_middles / 1.44));
  EXPECT_GT(at_edges / 1.11, 2 * in_middles / 1.44);
}

// The room's camera looks from (0, 0, 3.9) along -z; 64 pixels from the middle of its image to an edge span 18 degrees.
// In the room only the light, below the ceiling, hides other surfaces.
TEST(irradiance_cache, its_picture_has_a_coloured_dot_at_every_record_and_is_grey_elsewhere) {
  SceneDescription room = test::room(128, false);
  room.integrator.method = PhotonMapperDescription{};  // with direct gathers: the view selects the cache by itself
  RenderJob job = job_with(8, 100'000);
  job.view = Aov::cache_records;
  const IrradianceCache cache = records_of(room, job, 128);
  const Image picture = render(room, "photonmapper", job).image.mean;
  const double scale = test::compiled(room, 128, 128).scale();
  const auto coloured = [&](int x, int y) {
    const float* p = picture.pixel(x, y);
    return p[0] != p[1] || p[1] != p[2];
  };
  std::vector<bool> near_record(std::size_t{128} * 128);
  int dots = 0;
  for (const IrradianceRecord& record : cache.records()) {
    const Vec3d p = Vec3d(record.p) / scale;
    const double pixels = 64 / ((3.9 - p.z) * std::tan(pi / 10));
    const int x = static_cast<int>(std::floor(64 + pixels * p.x)), y = static_cast<int>(std::floor(64 - pixels * p.y));
    for (int v = std::max(0, y - 2); v <= std::min(127, y + 2); ++v)
      for (int u = std::max(0, x - 2); u <= std::min(127, x + 2); ++u)
        near_record[static_cast<std::size_t>(128 * v + u)] = true;
    ++dots;
    // Dots lie on the walls, some of which the camera sees at an angle.
    bool dot = false;
    for (int v = std::max(0, y - 1); v <= std::min(127, y + 1); ++v)
      for (int u = std::max(0, x - 1); u <= std::min(127, x + 1); ++u) dot = dot || coloured(u, v);
    EXPECT_TRUE(dot) << x << ", " << y;
  }
  EXPECT_GT(dots, 500);
  int grey = 0;
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 128; ++x) {
      if (near_record[static_cast<std::size_t>(128 * y + x)]) continue;
      ++grey;
      EXPECT_FALSE(coloured(x, y)) << x << ", " << y;
      EXPECT_LT(picture.pixel(x, y)[0], 0.3f);
    }
  EXPECT_GT(grey, 200);
}

TEST(irradiance_cache, colours_of_its_picture_go_from_red_to_blue_as_records_reach_further) {
  // Equal steps of the logarithm: 1.5 times 16^(i/3).
  const auto expect = [](float reach, const Rgb& colour) { EXPECT_LT(length(colour_of_reach(reach) - colour), 1e-4f); };
  expect(1.5f, {1, 0.05f, 0.05f});
  expect(0.1f, {1, 0.05f, 0.05f});
  expect(1.5f * 2.5198421f, {1, 0.85f, 0});
  expect(6, {0.55f, 0.875f, 0.1f});
  expect(24, {0.15f, 0.4f, 1});
  expect(1000, {0.15f, 0.4f, 1});
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
