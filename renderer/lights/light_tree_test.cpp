// Choosing one of many lights by position.

#include "renderer/lights/light_tree.h"

#include <gtest/gtest.h>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/lanes/warp.h"

namespace photonproof::inline renderer_lights {
namespace {

using test::Random;

std::vector<Light> many_lights(std::uint64_t seed, int count) {
  std::vector<Light> lights;
  for (int i = 0; i < count; ++i) {
    Random r(seed, static_cast<std::uint64_t>(i));
    const Vec3f at = Vec3f(r.next(), r.next(), r.next()) * 10.0f;
    const Vec3f n = square_to_sphere(r.next2());
    const Frame<float> frame(n);
    const Rgb power(std::pow(10.0f, 4 * r.next() - 2));
    const float size = 0.3f * r.next() + 1e-3f;
    switch (i % 5) {
      case 0:
        lights.emplace_back(PointLight<float>{at, power});
        break;
      case 1:
        lights.emplace_back(
            QuadLight<float>{at, frame.s * size, frame.t * size, n, size * size, power, told_by_corner});
        break;
      case 2:
        lights.emplace_back(SphereLight<float>{at, size, 1, power});
        break;
      case 3:
        lights.emplace_back(spot_light(at, n, power, 0.2, 0.5));
        break;
      default:
        lights.emplace_back(PointLight<float>{at, Rgb(0.0f)});
    }
  }
  return lights;
}

TEST(light_tree, probabilities_sum_to_one_and_belong_to_what_is_drawn) {
  const std::vector<Light> lights = many_lights(300, 400);
  const LightTree tree(lights);
  for (std::uint64_t place = 0; place < 40; ++place) {
    Random at(301, place);
    const Vec3f p = Vec3f(at.next(), at.next(), at.next()) * 14.0f - Vec3f(2);
    double sum = 0;
    for (std::uint32_t i = 0; i < lights.size(); ++i) sum += double{tree.probability(p, i)};
    // The sum is below 1 only where a branch ends in lights that cannot shine there.
    EXPECT_LE(sum, 1 + 1e-4);
    EXPECT_GT(sum, 0.9);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto choice = tree.choose(p, Random(302 + place, i).next());
      if (choice) {
        ASSERT_NEAR(choice->probability, tree.probability(p, choice->light), 1e-5f * choice->probability);
      }
    }
  }
}

TEST(light_tree, frequencies_match_probabilities) {
  const std::vector<Light> lights = many_lights(310, 300);
  const LightTree tree(lights);
  constexpr int places = 3, samples = 1'000'000;
  for (std::uint64_t place = 0; place < places; ++place) {
    Random at(311, place);
    const Vec3f p = Vec3f(at.next(), at.next(), at.next()) * 10.0f;
    std::vector<double> observed(lights.size() + 1), expected(lights.size() + 1);
    for (int i = 0; i < samples; ++i) {
      const auto choice = tree.choose(p, Random(312 + place, static_cast<std::uint64_t>(i)).next());
      observed[choice ? choice->light : lights.size()] += 1;
    }
    expected.back() = samples;
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      expected[i] = samples * double{tree.probability(p, i)};
      expected.back() -= expected[i];
    }
    expected.back() = std::max(expected.back(), 0.0);
    EXPECT_GT(test::chi_square_p_value(observed, expected), test::sidak_level(places));
  }
}

TEST(light_tree, no_light_that_shines_on_a_point_is_left_out) {
  const std::vector<Light> lights = many_lights(320, 250);
  const LightTree tree(lights);
  for (std::uint64_t place = 0; place < 200; ++place) {
    Random at(321, place);
    const Vec3f p = Vec3f(at.next(), at.next(), at.next()) * 12.0f - Vec3f(1);
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
      if (!(max_component(flux(lights[i])) > 0)) continue;
      bool shines = false;
      for (std::uint64_t k = 0; k < 8; ++k)
        std::visit(
            [&](const auto& l) {
              const LightSample<float> s = l.sample(p, Random(322, k).next2());
              shines = shines || (s.pdf > 0 && max_component(s.radiance) > 0);
            },
            lights[i]);
      if (shines) {
        ASSERT_GT(tree.probability(p, i), 0) << i;
      }
    }
  }
}

TEST(light_tree, the_nearest_of_equal_lights_is_chosen_far_more_often_than_by_flux) {
  // Sixteen lights in a corridor: pairs 1 apart, pairs of pairs 10, then 100 and 1000. Whatever a split costs, the one
  // in the widest gap is the cheapest, so the tree is known. Light i turns right where bit k of i is set. Its node at
  // level k is the lights from `first` to first + 2^(k+1) - 1. Lights shine everywhere. A node's importance is its
  // power over the squared distance of its box's middle, or over its box's half diagonal squared where p is nearer.
  const auto at = [](std::uint32_t i) { return i % 2 + 10 * (i / 2 % 2) + 100 * (i / 4 % 2) + 1000.0 * (i / 8); };
  std::vector<Light> lights;
  for (std::uint32_t i = 0; i < 16; ++i) lights.emplace_back(PointLight<float>{Vec3f(Vec3d(at(i), 2, -1)), Rgb(3)});
  const LightTree tree(lights);
  const Vec3d p(100, 2.1, -1);  // 0.1 from light 4
  const auto promise = [&](std::uint32_t first, std::uint32_t count) {
    const double middle = (at(first) + at(first + count - 1)) / 2, half = (at(first + count - 1) - at(first)) / 2;
    const Vec3d d = p - Vec3d(middle, 2, -1);
    return count / std::max(dot(d, d), half * half);
  };
  double sum = 0;
  for (std::uint32_t i = 0; i < 16; ++i) {
    double expected = 1, rounding = 0;  // 1 minus the left share has the rounding of 1
    for (std::uint32_t count = 8; count > 0; count /= 2) {
      const std::uint32_t mine = i / count * count, other = mine ^ count;
      const double share = promise(mine, count) / (promise(mine, count) + promise(other, count));
      expected *= share;
      rounding += 0x1p-22 / share;
    }
    EXPECT_NEAR(tree.probability(Vec3f(p), i), expected, rounding * expected) << i;
    sum += expected;
  }
  EXPECT_NEAR(sum, 1, 1e-12);
  // The probability by flux is 1/16; these are the shares of light 4's nodes.
  EXPECT_NEAR(tree.probability(Vec3f(p), 4), 0.99664 * 0.99662 * 0.99765 * 0.99020, 1e-4);
}

TEST(light_tree, lights_in_one_place_do_no_harm) {
  const std::vector<Light> lights(40, PointLight<float>{{1, 1, 1}, Rgb(1)});
  const LightTree tree(lights);
  for (std::uint32_t i = 0; i < 40; ++i) EXPECT_NEAR(tree.probability({1, 1, 1}, i), 1.0f / 40, 1e-2f);
}

}  // namespace
}  // namespace photonproof::inline renderer_lights
