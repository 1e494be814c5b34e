// Packs against one lane: numbers, vectors, samplers. Compiled once for each instruction set.

#include <bit>
#include <vector>

#include "renderer/bsdfs/fresnel.h"
#include "renderer/lanes/sampler.h"
#include "renderer/lanes/test_lane_words.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lanes {
namespace {

using namespace test;

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
  // This rule keeps a clamp of an undefined value within its bounds: max(nan, 0) = 0.
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
    return lane_words<2, F>(sincos_turn(in[0]));
  };
  expect_lanes_agree<1, 2>("sincos_turn", turn, units<1>());
  expect_lanes_agree<1, 2>("sincos_turn", turn, anythings<1>());
  expect_lanes_agree<1, 2>(
      "sincos_quarter",
      [](const auto& in) {
        using F = Value<decltype(in)>;
        return lane_words<2, F>(sincos_quarter(in[0]));
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
    return lane_words<2, F>(fresnel_dielectric(in[0], in[1]));
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

}  // namespace
}  // namespace photonproof::inline renderer_lanes
