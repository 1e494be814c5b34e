// Packs against one lane: BSDFs, lights, rays. Compiled once for each instruction set.

#include <bit>
#include <vector>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/bsdfs/test_bsdf_records.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/kernels/lane_batch.h"
#include "renderer/kernels/lights.h"
#include "renderer/lanes/sampler.h"
#include "renderer/lanes/test_lane_words.h"
#include "renderer/light_sampling/light_table.h"
#include "renderer/light_sampling/test_lights.h"
#include "renderer/lights/light.h"
#include "renderer/rays/brute_force_intersector.h"
#include "renderer/rays/brute_force_tables.h"
#include "renderer/sensor/reconstruction_filter.h"

namespace photonproof::inline renderer_kernels {
namespace {

using namespace test;

// --- every kind of BSDF and light, with any parameters ---------------------------------------------------------------

TEST(lanes, every_bsdf_agrees) {
  BsdfKinds::for_each([]<template <class> class Kind>(std::uint32_t kind) {
    constexpr std::size_t record = sizeof(Kind<float>) / sizeof(float);
    constexpr std::size_t n = record + 9;  // wo, wi, three numbers
    for (const TransportMode mode : {TransportMode::radiance, TransportMode::importance}) {
      const auto f = [mode](const auto& in) {
        using F = Value<decltype(in)>;
        const auto bsdf = record_of<Kind<F>>(&in[0]);
        const F* rest = &in[record];
        const Vec3<F> wo = vec3(rest), wi = vec3(rest + 3);
        const Vec3<F> value = bsdf.eval(wo, wi);
        const BsdfSample<F> s = bsdf.sample(wo, rest[6], {rest[7], rest[8]}, mode);
        std::array<F, 13> out{value.x,      value.y,      value.z,    bsdf.pdf(wo, wi), s.wi_local.x,
                              s.wi_local.y, s.wi_local.z, s.weight.x, s.weight.y,       s.weight.z,
                              s.pdf,        s.eta,        F(0.0f)};
        for (std::size_t k = 4; k < 12; ++k) out[k] = select(s.valid, out[k], F(0.0f));
        out[12] = zero_or_one<F>(s.valid);
        return out;
      };
      expect_lanes_agree<n, 13>(
          "BSDF " + std::to_string(kind), f,
          [](Random& random) {
            Kind<float> bsdf;
            test::randomise(bsdf, random);
            Floats<n> in;
            std::memcpy(in.data(), static_cast<const void*>(&bsdf), sizeof bsdf);
            const Vec3f wo = test::direction(random), wi = test::direction(random);
            in[record] = wo.x, in[record + 1] = wo.y, in[record + 2] = wo.z;
            in[record + 3] = wi.x, in[record + 4] = wi.y, in[record + 5] = wi.z;
            // The very ends are left out: facets of GGX lie flat there up to rounding.
            for (std::size_t k = record + 6; k < n; ++k) in[k] = random.next();
            return in;
          },
          20'000);
    }
  });
}

/// Makes a light as the compiler does: the normal is that of the edges, disks are round, and heights follow from the
/// corner or centre or from an offset.
template <class Light>
void make_whole(Light& light, bool by_corner) {
  if constexpr (requires { light.edge_u; }) {
    light.normal = normalize(cross(light.edge_u, light.edge_v));
    light.offset = by_corner ? told_by_corner : dot(light.normal, light.corner);
  }
  if constexpr (requires { light.half_axis_u; }) {
    light.normal = normalize(cross(light.half_axis_u, light.half_axis_v));
    light.half_axis_v = cross(light.normal, light.half_axis_u);
    light.offset = by_corner ? told_by_corner : dot(light.normal, light.center);
  }
  if constexpr (requires { light.side; }) {
    light.radius = std::abs(light.radius);
    light.side = light.side > 0 ? 1 : -1;
    light.offset = by_corner ? told_by_corner : (dot(light.center, light.center) / light.radius - light.radius) / 2;
  }
}

TEST(lanes, every_light_agrees) {
  LightKinds::for_each([]<template <class> class Kind>(std::uint32_t kind) {
    constexpr std::size_t record = sizeof(Kind<float>) / sizeof(float);
    constexpr std::size_t n = record + 13;  // point, point of the light, its normal, four numbers
    const auto f = [](const auto& in) {
      using F = Value<decltype(in)>;
      const auto light = record_of<Kind<F>>(&in[0]);
      const F* rest = &in[record];
      const Vec3<F> p = vec3(rest), q = vec3(rest + 3), normal = vec3(rest + 6);
      const Vec2<F> u{rest[9], rest[10]}, v{rest[11], rest[12]};
      const LightPoint<F> at{q, normal};
      std::array<F, 48> out;
      std::size_t k = 0;
      for (const F& word : lane_words<16, F>(light.sample(p, u))) out[k++] = word;
      for (const F& word : lane_words<20, F>(light.emit(u, v))) out[k++] = word;
      for (const F& word : words(light.flux())) out[k++] = word;
      for (const F& word : words(light.leaving(at, q))) out[k++] = word;
      for (const F& word : words(light.flux_towards(at, q))) out[k++] = word;
      for (const F& word : lane_words<2, F>(light.emit_pdfs(at, q))) out[k++] = word;
      out[k++] = light.pdf(p, light.sample(p, v).at);
      return out;
    };
    expect_lanes_agree<n, 48>("light " + std::to_string(kind), f, [](Random& random) {
      Floats<n> in;
      // Lights of any size, and points near them. With independent sizes for all numbers, edges would be nearly
      // parallel, and points would lie in the light's plane up to rounding.
      const float size = random.next() < 0.5f ? 1.0f : anything(random);
      for (float& v : in) v = size * (4 * random.next() - 2);
      auto light = record_of<Kind<float>>(&in[0]);
      for (std::size_t k = n - 4; k < n; ++k) in[k] = test::unit(random);
      make_whole(light, random.next() < 0.5f);
      std::memcpy(in.data(), &light, sizeof light);
      return in;
    });
  });
}

TEST(lanes, records_of_every_kind_are_gathered_whole) {
  Random random(75);
  std::vector<float> table(100 * BsdfKinds::stride);
  for (float& v : table) v = random.next();
  BsdfKinds::for_each([&]<template <class> class Kind>(std::uint32_t) {
    constexpr std::size_t record = sizeof(Kind<float>) / sizeof(float);
    LaneBits index;
    for (std::size_t lane = 0; lane < width; ++lane) index[lane] = static_cast<std::uint32_t>(100 * random.next());
    const auto packed = lane_words<record, Lanes>(gather_record<Kind, Lanes>(table.data(), index, BsdfKinds::stride));
    for (std::size_t lane = 0; lane < width; ++lane)
      for (std::size_t k = 0; k < record; ++k) EXPECT_EQ(packed[k][lane], table[index[lane] * BsdfKinds::stride + k]);
  });
}

TEST(lanes, lights_are_chosen_alike) {
  std::vector<Light> lights;
  for (std::uint64_t i = 0; i < 50; ++i)
    lights.emplace_back(PointLight<float>{{}, Rgb(i % 5 == 0 ? 0.0f : Random(76, i).next())});
  const std::vector<LightWords> table = light_table(lights);
  SceneView scene;
  scene.light_words = table.data();
  scene.light_count = 50;
  expect_lanes_agree<1, 2>(
      "choose_light",
      [&](const auto& in) {
        using F = Value<decltype(in)>;
        const LightSampling<F> choice = choose_light(scene, in[0]);
        return std::array<F, 2>{to_float(choice.light), choice.probability};
      },
      units<1>());
}

// --- one lane after the other ----------------------------------------------------------------------------------------

LightPoint<float> random_point(Random& random) {
  const auto triangle = static_cast<std::uint32_t>(random.next() * 4);
  return {{random.next(), random.next(), random.next()}, test::direction(random), {0.25f, random.next()}, triangle};
}

TEST(lanes, single_lanes_of_a_record_are_its_words_in_that_lane) {
  Random random(77);
  std::array<LightPoint<float>, width> points;
  LightPoint<Lanes> packed{};
  for (std::size_t i = 0; i < width; ++i) set_lane<Lanes>(packed, i, points[i] = random_point(random));
  for (std::size_t i = 0; i < width; ++i) {
    EXPECT_EQ(packed.p.x[i], points[i].p.x);
    EXPECT_EQ(packed.normal.z[i], points[i].normal.z);
    EXPECT_EQ(packed.uv.y[i], points[i].uv.y);
    EXPECT_EQ(packed.triangle[i], points[i].triangle);
    EXPECT_EQ((lane_words<9, float>(lane_of(packed, i))), (lane_words<9, float>(points[i])));
  }
}

TEST(lanes, lights_that_need_tables_answer_for_every_lane) {
  const auto gaudy = [](const Vec2<float>& uv) { return Rgb(0.1f + uv.x, uv.y, 2); };
  const MeshShape mesh({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {},
                       false);
  const SpotLight<float> spot = spot_light({0, 0, 1}, {0, 0, -1}, Rgb(2), 0.5, 1.2);
  const test::Lights lights({AreaLight(mesh, gaudy), EnvironmentLight(ConstantSky{Rgb(1, 2, 3)}, {0, 0, 0}, 5),
                             TexturedSpotLight(spot, {1, 0, 0}, {0, 1, 0}, gaudy), PointLight<float>{{}, Rgb(1)}});
  Random random(78);
  for (int round = 0; round < 100; ++round) {
    LaneBits light;
    LightPoint<Lanes> at{};
    Vec3<Lanes> p, direction;
    Vec2<Lanes> u, v;
    for (std::size_t i = 0; i < width; ++i) {
      light[i] = static_cast<std::uint32_t>(random.next() * 4);
      set_lane<Lanes>(at, i, random_point(random));
      set_lane<Lanes>(p, i, test::direction(random) * 3.0f);
      set_lane<Lanes>(direction, i, test::direction(random));
      set_lane<Lanes>(u, i, Vec2<float>{random.next(), random.next()});
      set_lane<Lanes>(v, i, Vec2<float>{random.next(), random.next()});
    }
    const Mask<Lanes> lanes = direction.x > 0;
    const GeneralLight<Lanes> general(lights.scene, light, lanes);
    const LightSample<Lanes> sample = general.sample(p, u);
    const Emission<Lanes> emission = general.emit(u, v);
    const Vec3<Lanes> leaving = general.leaving(at, direction), towards = general.flux_towards(at, direction);
    const Lanes pdf = general.pdf(p, at);
    const std::uint32_t deltas = to_bits(general.is_delta()), infinite = to_bits(general.is_infinite());
    for (std::size_t i = 0; i < width; ++i) {
      if (!(direction.x[i] > 0)) {
        EXPECT_EQ((lane_words<16, float>(lane_of(sample, i))), (lane_words<16, float>(LightSample<float>{})));
        continue;
      }
      const SceneLights& all = lights.scene;
      const LightPoint<float> there = lane_of(at, i);
      const Vec3f from = lane_of(p, i), d = lane_of(direction, i);
      const LightSample<float> seen = all.sample_of(light[i], from, lane_of(u, i));
      const Emission<float> start = all.start_of(light[i], lane_of(u, i), lane_of(v, i));
      EXPECT_EQ((lane_words<16, float>(lane_of(sample, i))), (lane_words<16, float>(seen)));
      EXPECT_EQ((lane_words<20, float>(lane_of(emission, i))), (lane_words<20, float>(start)));
      EXPECT_EQ(lane_of(leaving, i), all.radiance(light[i], all.with_uv(light[i], there), d));
      EXPECT_EQ(lane_of(towards, i), all.flux_towards(light[i], there, d));
      EXPECT_EQ(pdf[i], all.pdf_of(light[i], from, there));
      EXPECT_EQ(deltas >> i & 1u, all.is_delta(light[i]) ? 1u : 0u);
      EXPECT_EQ(infinite >> i & 1u, all.is_infinite(light[i]) ? 1u : 0u);
    }
  }
}

// --- rays ------------------------------------------------------------------------------------------------------------

TEST(lanes, rays_leave_surfaces_alike) {
  const auto f = [](const auto& in) { return words(offset_from(vec3(&in[0]), vec3(&in[3]), vec3(&in[6]), 0.25f)); };
  expect_lanes_agree<9, 3>("offset_from", f, [](Random& random) {
    Floats<9> in;
    for (float& v : in) v = anything(random);
    const Vec3f n = test::mostly_direction(random), d = test::mostly_direction(random);
    in[3] = n.x, in[4] = n.y, in[5] = n.z, in[6] = d.x, in[7] = d.y, in[8] = d.z;
    return in;
  });
}

/// Camera rays of both parts of the filter.
void expect_camera_rays_agree(const ReconstructionFilter& filter, FilterPart part) {
  SceneView scene;
  CameraView& camera = scene.camera;
  camera.origin = {0.1f, 2, -3};
  camera.right = {1, 0, 0};
  camera.up = {0, 1, 0};
  camera.forward = {0, 0, 1};
  camera.tan_x = 0.7f;
  camera.tan_y = 0.4f;
  camera.width = 97;
  camera.height = 61;
  camera.inverse_width = 1.0f / 97;
  camera.inverse_height = 1.0f / 61;
  camera.near = 0.01f;
  camera.lens_radius = 0.1f;
  camera.focus_distance = 2;
  camera.max_angle = 1;
  camera.filter = compile_filter(filter, false);
  struct Case {
    CameraKind kind;
    int grid;
  };
  for (const auto& [kind, grid] :
       {Case{CameraKind::perspective, 0}, Case{CameraKind::perspective, 3}, Case{CameraKind::thin_lens, 0},
        Case{CameraKind::orthographic, 0}, Case{CameraKind::fisheye, 0}}) {
    camera.kind = kind;
    CameraTask task{};
    task.x0 = 80;
    task.y0 = 48;
    task.x1 = 97;
    task.y1 = 61;
    task.first_sample = 5;
    task.samples = 9;
    task.seed = 77;
    task.grid = grid;
    task.part = part;
    for (std::uint32_t first = 0; first + width <= task.paths(); first += static_cast<std::uint32_t>(width)) {
      const CameraRay<Lanes> packed = camera_rays<Lanes>(scene, task, first);
      for (std::uint32_t lane = 0; lane < width; ++lane) {
        const CameraRay<float> alone = camera_rays<float>(scene, task, first + lane);
        ASSERT_EQ(packed.key[lane], alone.key);
        ASSERT_EQ(packed.index[lane], alone.index);
        ASSERT_NEAR(packed.origin.x[lane], alone.origin.x, 1e-6f);
        ASSERT_NEAR(packed.direction.x[lane], alone.direction.x, 1e-6f);
        ASSERT_NEAR(packed.direction.y[lane], alone.direction.y, 1e-6f);
        ASSERT_NEAR(packed.direction.z[lane], alone.direction.z, 1e-6f);
      }
    }
  }
}

TEST(lanes, camera_rays_agree) {
  using Kind = ReconstructionFilter::Kind;
  expect_camera_rays_agree({Kind::gaussian, 0.5, 1}, FilterPart::positive);
  for (const FilterPart part : {FilterPart::positive, FilterPart::negative})
    expect_camera_rays_agree({.kind = Kind::lanczos}, part);
}

/// Parallelograms, triangles and spheres, eight of each, their sizes and distances to the origin 10^-2 to 10^2.
struct Clutter {
  std::vector<Vec3f> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<Surface> surfaces;

  explicit Clutter(std::uint64_t seed) {
    const auto scaled = [](Random& random) { return test::direction(random) * std::pow(10.0f, 4 * random.next() - 2); };
    for (std::uint64_t i = 0; i < 8; ++i) {
      Random random(seed, i);
      const Vec3f at = scaled(random);
      const float size = length(at);
      const Vec3f u = test::direction(random) * size, v = test::direction(random) * size;
      const Vec3f n = cross(u, v);
      surfaces.push_back({Quad{at, u, v, normalize(n), length(n)}});
      surfaces.push_back({Sphere{Vec3d(scaled(random)), 0.5 * double{size}, i % 2 == 0}});
      const Vec3f corner = scaled(random);
      for (const Vec3f& p : {corner, corner + test::direction(random) * size, corner + test::direction(random) * size})
        positions.push_back(p);
      const auto first = static_cast<std::uint32_t>(3 * i);
      triangles.push_back({first, first + 1, first + 2});
    }
    auto source = std::make_shared<TriangleMesh>();
    source->triangles = triangles;
    Mesh mesh;
    mesh.positions = positions;
    mesh.source = source;
    mesh.positions.emplace_back();
    Surface surface;
    surface.geometry = std::move(mesh);
    surfaces.push_back(std::move(surface));
  }
};

TEST(lanes, a_small_scenes_rays_meet_the_same_primitives) {
  // The primitive and the distance of the closest hit; another primitive is the same where the distances are.
  for (std::uint64_t seed = 80; seed < 84; ++seed) {
    const Clutter clutter(seed);
    const BruteForceTables tables(clutter.surfaces);
    const BruteForceView scene = tables.view();
    const auto count = scene.parallelograms + scene.triangles + scene.spheres;
    ASSERT_EQ(count, 24u);
    const auto from_primitive = [](const auto& v) {
      return to_uint(v);
    };  // primitive + 1; 0: none, as 0 - 1 is no_index
    const auto closest = [&](const auto& in) {
      using F = Value<decltype(in)>;
      const Vec3<F> origin = vec3(&in[0]);
      const SurfaceHit<F> hit =
          closest_small(scene, origin, vec3(&in[3]), UInt<F>(UInt<F>(from_primitive(in[6])) - 1u));
      const F t = length(Vec3<F>(hit.p - origin));
      const F none(-1.0f);
      return std::array<F, 5>{select(hit.valid, t, none), select(hit.valid, to_float(hit.primitive), none),
                              select(hit.valid, hit.normal.x, none), select(hit.valid, hit.normal.y, none),
                              select(hit.valid, hit.normal.z, none)};
    };
    const auto ray = [&](Random& random) {
      const bool tame = random.next() < 0.9f;
      const Vec3f o = tame ? test::direction(random) * std::pow(10.0f, 5 * random.next() - 3)
                           : Vec3f(anything(random), anything(random), anything(random));
      const Vec3f d = tame ? test::direction(random) : test::mostly_direction(random);
      return Floats<7>{o.x,
                       o.y,
                       o.z,
                       d.x,
                       d.y,
                       d.z,
                       static_cast<float>(static_cast<int>(2 * random.next()) * static_cast<int>(24 * random.next()))};
    };
    expect_lanes_agree<7, 5>("closest", closest, ray, 25'000);
    const auto blocked = [&](const auto& in) {
      using F = Value<decltype(in)>;
      const Vec3<F> segment = vec3(&in[3]) * F(10.0f);
      const UInt<F> from = UInt<F>(from_primitive(in[6])) - 1u;
      return std::array<F, 1>{zero_or_one<F>(occluded_small(scene, vec3(&in[0]), segment, from, UInt<F>(3u)))};
    };
    expect_lanes_agree<7, 1>("occluded", blocked, ray, 25'000);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_kernels
