// Packs against one lane, for everything that is a template over lanes. Compiled once for each instruction set.

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "renderer/bsdfs/bsdf.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/kernels/lane_batch.h"
#include "renderer/kernels/lights.h"
#include "renderer/rays/small_scene.h"
#include "renderer/lights/light.h"
#include "renderer/light_choice/light_table.h"
#include "renderer/sensor/reconstruction_filter.h"
#include "renderer/lanes/sampler.h"
#include "renderer/rays/small_scene_tables.h"
#include "renderer/bsdfs/test_bsdf_records.h"
#include "renderer/lanes/test_lanes.h"
#include "renderer/lanes/warp.h"

namespace photonproof {
namespace {

using test::anything;
using test::expect_lanes_agree;
using test::Floats;
using test::Lanes;
using test::Random;
using test::width;
using LaneBits = UInt<Lanes>;

template <class T>
using Value = std::remove_cvref_t<decltype(std::declval<T>()[0])>;  // of std::array

template <class F>
Vec3<F> vec3(const F* from) {
  return {from[0], from[1], from[2]};
}
template <class F>
std::array<F, 3> words(const Vec3<F>& v) {
  return {v.x, v.y, v.z};
}
template <class F>
F zero_or_one(const Mask<F>& m) {
  return select(m, F(1.0f), F(0.0f));
}

/// A struct of F and nothing else as an array of them.
template <std::size_t m, class F, class Record>
std::array<F, m> words_of(const Record& record) {
  static_assert(sizeof(Record) == m * sizeof(F) && std::is_trivially_copyable_v<Record>);
  std::array<F, m> out;
  std::memcpy(&out, &record, sizeof record);
  return out;
}
template <class Record, class F>
Record record_of(const F* from) {
  static_assert(sizeof(Record) % sizeof(F) == 0 && std::is_trivially_copyable_v<Record>);
  Record record;
  std::memcpy(static_cast<void*>(&record), from, sizeof record);
  return record;
}

template <std::size_t n>
auto anythings() {
  return [](Random& random) {
    Floats<n> out;
    for (float& v : out) v = anything(random);
    return out;
  };
}
template <std::size_t n>
auto units() {
  return [](Random& random) {
    Floats<n> out;
    for (float& v : out) v = test::unit(random);
    return out;
  };
}

std::uint32_t some_bits(Random& random) { return static_cast<std::uint32_t>(random.next_bits() >> 32); }

/// The same bits in every lane, and lane by lane, of an integer function of k integers.
template <std::size_t k, class Fn>
void expect_same_bits(const char* name, const Fn& f) {
  for (std::uint64_t i = 0; i < 100'000 / width; ++i) {
    std::array<LaneBits, k> columns;
    std::array<std::array<std::uint32_t, k>, width> rows;
    for (std::size_t lane = 0; lane < width; ++lane) {
      Random random(72, i, lane);
      for (std::size_t j = 0; j < k; ++j) {
        rows[lane][j] = random.next() < 0.3f ? static_cast<std::uint32_t>(32 * random.next()) : some_bits(random);
        columns[j][lane] = rows[lane][j];
      }
    }
    const auto packed = f(columns);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const auto alone = f(rows[lane]);
      for (std::size_t r = 0; r < alone.size(); ++r)
        ASSERT_EQ(packed[r][lane], alone[r]) << name << " of " << testing::PrintToString(rows[lane]);
    }
  }
}

// --- lane.h ----------------------------------------------------------------------------------------------------------

TEST(lanes, arithmetic_is_that_of_floats) {
  expect_lanes_agree<2, 9>(
      "arithmetic",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        const F a = in[0], b = in[1];
        const Mask<F> less = a < b;
        return std::array<F, 9>{
            lane_min(a, b),      lane_max(a, b),     lane_sqrt(a),         lane_abs(a),
            lane_copysign(a, b), select(less, a, b), zero_or_one<F>(less), zero_or_one<F>(as_mask<F>(!less && a == a)),
            F(a + b * a)};
      },
      anythings<2>());
  expect_lanes_agree<3, 1>(
      "mul_add",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        return std::array<F, 1>{mul_add(in[0], in[1], in[2])};
      },
      anythings<3>());
}

TEST(lanes, minimum_and_maximum_of_a_nan_and_a_number_are_the_second) {
  // What keeps a clamp of an undefined value within its bounds: max(nan, 0) = 0.
  const float nan = std::nanf("");
  EXPECT_EQ(lane_max(nan, 0.0f), 0);
  EXPECT_EQ(lane_min(nan, 1.0f), 1);
  EXPECT_EQ(lane_max(Lanes(nan), Lanes(0.0f))[0], 0);
  EXPECT_EQ(lane_min(Lanes(nan), Lanes(1.0f))[0], 1);
  EXPECT_TRUE(std::isnan(lane_max(Lanes(0.0f), Lanes(nan))[0]));
  EXPECT_TRUE(std::isnan(lane_min(Lanes(1.0f), Lanes(nan))[0]));
}

TEST(lanes, masks_count_and_name_their_lanes) {
  Random random(73);
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t bits = some_bits(random) & ((1u << (width - 1) << 1) - 1);
    const LaneBits set = (LaneBits(bits) >> lane_index<Lanes>()) & 1u;
    const Mask<Lanes> mask = equal<Lanes>(set, LaneBits(1u));
    ASSERT_EQ(to_bits(mask), bits);
    EXPECT_EQ(count_lanes(mask), static_cast<std::uint64_t>(std::popcount(bits)));
    EXPECT_EQ(any(mask), bits != 0);
    EXPECT_EQ(all(mask), std::popcount(bits) == static_cast<int>(width));
    const LaneBits chosen = select(mask, LaneBits(7u), LaneBits(9u));
    for (std::size_t lane = 0; lane < width; ++lane) EXPECT_EQ(chosen[lane], (bits >> lane & 1u) != 0 ? 7u : 9u);
  }
  for (std::size_t n = 0; n <= width + 3; ++n) {
    const std::size_t lanes = std::min(n, width);
    EXPECT_EQ(to_bits(first_lanes<Lanes>(n)), (std::uint64_t{1} << lanes) - 1);
  }
  EXPECT_EQ(to_bits(as_mask<Lanes>(true)), (std::uint64_t{1} << width) - 1);
  EXPECT_TRUE(first_lanes<float>(1));
  EXPECT_FALSE(first_lanes<float>(0));
}

TEST(lanes, integers_convert_as_single_ones_do) {
  expect_same_bits<1>("to_float", [](const auto& in) {
    auto below = in[0];
    below &= 0xFFFFFFu;
    const auto f = to_float(below);
    std::array<decltype(to_uint(f)), 1> out{to_uint(f)};
    return out;
  });
  expect_lanes_agree<1, 1>(
      "to_uint",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        return std::array<F, 1>{to_float(to_uint(in[0]))};
      },
      [](Random& random) { return Floats<1>{random.next() * std::pow(2.0f, 24 * random.next())}; });
}

TEST(lanes, memory_is_read_and_written_lane_by_lane) {
  Random random(74);
  std::vector<float> table(1000);
  std::vector<std::uint32_t> numbers(1000);
  for (std::size_t i = 0; i < 1000; ++i) {
    table[i] = anything(random);
    numbers[i] = some_bits(random);
  }
  for (int round = 0; round < 2000; ++round) {
    LaneBits index;
    for (std::size_t lane = 0; lane < width; ++lane) index[lane] = static_cast<std::uint32_t>(1000 * random.next());
    const Lanes floats = gather(table.data(), index);
    const LaneBits integers = gather(numbers.data(), index);
    for (std::size_t lane = 0; lane < width; ++lane) {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(float{floats[lane]}), std::bit_cast<std::uint32_t>(table[index[lane]]));
      ASSERT_EQ(integers[lane], numbers[index[lane]]);
    }
    // Stored, loaded, and stored in part: the chosen lanes one after the other, nothing beyond a pack's width.
    std::uint32_t row[width], packed_floats[2 * width], packed_integers[2 * width];
    store_from(floats, row);
    for (std::size_t lane = 0; lane < width; ++lane)
      ASSERT_EQ(row[lane], std::bit_cast<std::uint32_t>(table[index[lane]]));
    LaneBits again;
    load_into(again, row);
    for (std::size_t lane = 0; lane < width; ++lane) ASSERT_EQ(again[lane], row[lane]);
    const std::uint32_t bits = some_bits(random) & ((1u << (width - 1) << 1) - 1);
    const auto count = static_cast<std::size_t>(std::popcount(bits));
    std::fill_n(packed_floats, 2 * width, 0xABCDu);
    std::fill_n(packed_integers, 2 * width, 0xABCDu);
    compress_store(floats, bits, packed_floats);
    compress_store(integers, bits, packed_integers);
    std::size_t at = 0;
    for (std::size_t lane = 0; lane < width; ++lane) {
      if ((bits >> lane & 1u) == 0) continue;
      ASSERT_EQ(packed_floats[at], row[lane]);
      ASSERT_EQ(packed_integers[at], numbers[index[lane]]);
      ++at;
    }
    ASSERT_EQ(at, count);
    for (std::size_t k = width; k < 2 * width; ++k) {
      ASSERT_EQ(packed_floats[k], 0xABCDu);
      ASSERT_EQ(packed_integers[k], 0xABCDu);
    }
  }
}

TEST(lanes, vectors_are_those_of_floats) {
  const auto f = [](const auto& in) {
    using F = Value<decltype(in)>;
    const Vec3<F> a = vec3(&in[0]), b = vec3(&in[3]);
    const Vec3<F> n = normalize(a), moved = advance(a, in[0], b);
    return std::array<F, 9>{dot(a, b), length(a), n.x, n.y, n.z, max_component(b), moved.x, moved.y, moved.z};
  };
  expect_lanes_agree<6, 9>("vectors", f, [](Random& random) {
    const Vec3f a = test::mostly_direction(random), b = test::mostly_direction(random);
    return Floats<6>{a.x, a.y, a.z, b.x, b.y, b.z};
  });
}

// --- functions of numbers --------------------------------------------------------------------------------------------

TEST(lanes, sine_and_cosine_agree) {
  const auto turn = [](const auto& in) {
    using F = Value<decltype(in)>;
    return words_of<2, F>(sincos_turn(in[0]));
  };
  expect_lanes_agree<1, 2>("sincos_turn", turn, units<1>());
  expect_lanes_agree<1, 2>("sincos_turn", turn, anythings<1>());
  expect_lanes_agree<1, 2>(
      "sincos_quarter",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        return words_of<2, F>(sincos_quarter(in[0]));
      },
      anythings<1>());
}

TEST(lanes, sine_and_cosine_are_true) {
  // Against double: within an ulp of 1 on the whole turn, both ends included.
  double worst = 0;
  for (int i = 0; i <= 1 << 16; ++i) {
    const float u = static_cast<float>(i) / (1 << 16);
    const SinCos<float> s = sincos_turn(u);
    const double x = 2 * std::numbers::pi * static_cast<double>(u);
    worst = std::max({worst, std::abs(double{s.sin} - std::sin(x)), std::abs(double{s.cos} - std::cos(x))});
  }
  EXPECT_LT(worst, 0x1p-23);
}

TEST(lanes, random_numbers_are_the_same_bits) {
  expect_same_bits<3>("draws", [](const auto& in) {
    using U = Value<decltype(in)>;
    using F = std::conditional_t<std::is_same_v<U, std::uint32_t>, float, Lanes>;
    const U key = in[0], index = in[1], dimension = in[2];
    const F one = draw_independent<F>(key, index, dimension);
    const Vec2<F> sobol = draw2<F>(SamplerKind::sobol, key, index, dimension);
    const Vec2<F> independent = draw2<F>(SamplerKind::independent, key, index, dimension);
    return std::array<F, 5>{one, sobol.x, sobol.y, independent.x, independent.y};
  });
  expect_same_bits<2>("bits", [](const auto& in) {
    using U = Value<decltype(in)>;
    return std::array<U, 4>{mix_bits(in[0]), reverse_bits(in[0]), scramble_reversed(in[0], in[1]),
                            sobol_second_reversed(in[0])};
  });
}

TEST(lanes, warps_and_frames_agree) {
  expect_lanes_agree<2, 11>(
      "warps",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        const Vec2<F> u{in[0], in[1]};
        const Vec2<F> disc = square_to_disc(u);
        const Vec3<F> c = square_to_cosine_hemisphere(u), s = square_to_sphere(u);
        const Vec3<F> k = square_to_cone(u, F(0.3f));
        return std::array<F, 11>{disc.x, disc.y, c.x, c.y, c.z, s.x, s.y, s.z, k.x, k.y, k.z};
      },
      units<2>());
  const auto cone = [](const auto& in) {
    const Vec2<Value<decltype(in)>> u{in[0], in[1]};
    return words(square_to_cone(u, in[2]));
  };
  expect_lanes_agree<3, 3>("cone", cone, [](Random& random) {
    return Floats<3>{test::unit(random), test::unit(random), test::positive(random)};
  });
  expect_lanes_agree<1, 1>(
      "cosine_hemisphere_pdf",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        return std::array<F, 1>{cosine_hemisphere_pdf(in[0])};
      },
      anythings<1>());
  const auto frame = [](const auto& in) {
    using F = Value<decltype(in)>;
    const Frame<F> frame_of_normal(vec3(&in[0]));
    const Vec3<F> v = vec3(&in[3]);
    const Vec3<F> local = frame_of_normal.to_local(v), world = frame_of_normal.to_world(v);
    const Vec3<F>& s = frame_of_normal.s;
    const Vec3<F>& t = frame_of_normal.t;
    return std::array<F, 12>{s.x, s.y, s.z, t.x, t.y, t.z, local.x, local.y, local.z, world.x, world.y, world.z};
  };
  expect_lanes_agree<6, 12>("frame", frame, [](Random& random) {
    const Vec3f n = test::mostly_direction(random), v = test::mostly_direction(random);
    return Floats<6>{n.x, n.y, n.z, v.x, v.y, v.z};
  });
}

TEST(lanes, fresnel_agrees) {
  const auto dielectric = [](const auto& in) {
    using F = Value<decltype(in)>;
    return words_of<2, F>(fresnel_dielectric(in[0], in[1]));
  };
  expect_lanes_agree<2, 2>("dielectric", dielectric, [](Random& random) {
    return Floats<2>{test::unit(random), 0.3f + 3 * random.next()};
  });
  expect_lanes_agree<2, 2>("dielectric of anything", dielectric, anythings<2>());
  const auto conductor = [](const auto& in) {
    using F = Value<decltype(in)>;
    return std::array<F, 1>{fresnel_conductor(in[0], in[1], in[2])};
  };
  expect_lanes_agree<3, 1>("conductor", conductor, [](Random& random) {
    return Floats<3>{test::unit(random), 4 * random.next(), 8 * random.next()};
  });
  expect_lanes_agree<3, 1>("conductor of anything", conductor, anythings<3>());
}

// --- every kind of BSDF and light, whatever it is made of ------------------------------------------------------------

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
            // Not the very ends, where facets of GGX lie flat but for rounding.
            for (std::size_t k = record + 6; k < n; ++k) in[k] = random.next();
            return in;
          },
          20'000);
    }
  });
}

/// As flat lamps are compiled: the normal is that of the edges, and disks are round.
template <class Light>
void make_flat(Light& light) {
  if constexpr (requires { light.edge_u; }) light.normal = normalize(cross(light.edge_u, light.edge_v));
  if constexpr (requires { light.half_axis_u; }) {
    light.normal = normalize(cross(light.half_axis_u, light.half_axis_v));
    light.half_axis_v = cross(light.normal, light.half_axis_u);
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
      std::array<F, 37> out;
      std::size_t k = 0;
      for (const F& word : words_of<13, F>(light.sample(p, u))) out[k++] = word;
      for (const F& word : words_of<12, F>(light.emit(u, v))) out[k++] = word;
      for (const F& word : words(light.flux())) out[k++] = word;
      for (const F& word : words(light.leaving(normal, q))) out[k++] = word;
      for (const F& word : words(light.flux_towards(normal, q))) out[k++] = word;
      for (const F& word : words_of<2, F>(light.emit_pdfs(normal, q))) out[k++] = word;
      const LightSample<F> drawn = light.sample(p, v);
      out[k++] = light.pdf(p, drawn.p_light, drawn.normal_light);
      return out;
    };
    expect_lanes_agree<n, 37>("light " + std::to_string(kind), f, [](Random& random) {
      Floats<n> in;
      // Lamps of any size, and points near them: had each number a size of its own, edges would nearly be parallel and
      // points lie in the lamp's plane but for rounding.
      const float size = random.next() < 0.5f ? 1.0f : anything(random);
      for (float& v : in) v = size * (4 * random.next() - 2);
      auto light = record_of<Kind<float>>(&in[0]);
      for (std::size_t k = n - 4; k < n; ++k) in[k] = test::unit(random);
      make_flat(light);
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
    const auto packed = words_of<record, Lanes>(gather_record<Kind, Lanes>(table.data(), index, BsdfKinds::stride));
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
        const LightChoice<F> choice = choose_light(scene, in[0]);
        return std::array<F, 2>{to_float(choice.light), choice.probability};
      },
      units<1>());
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

TEST(lanes, camera_rays_agree) {
  SceneView scene;
  CameraView& camera = scene.camera;
  camera.origin = {0.1f, 2, -3};
  camera.right = {1, 0, 0};
  camera.up = {0, 1, 0};
  camera.forward = {0, 0, 1};
  camera.tan_x = 0.7f;
  camera.tan_y = 0.4f;
  camera.inverse_width = 1.0f / 97;
  camera.inverse_height = 1.0f / 61;
  camera.near = 0.01f;
  camera.lens_radius = 0.1f;
  camera.focus_distance = 2;
  camera.max_angle = 1;
  camera.filter = compile_filter(ReconstructionFilter{ReconstructionFilter::Kind::gaussian, 0.5, 1});
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
      surfaces.push_back({Sphere{scaled(random), 0.5f * size, i % 2 == 0}});
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
    const SmallSceneTables tables(clutter.surfaces);
    const SmallSceneView scene = tables.view();
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
}  // namespace photonproof
