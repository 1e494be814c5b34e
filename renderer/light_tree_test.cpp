// Choosing among many lights by position.

#include "renderer/light_tree.h"

#include <gtest/gtest.h>

#include "renderer/chi_square.h"
#include "renderer/warp.h"

namespace photonproof {
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
        lights.emplace_back(QuadLight<float>{at, frame.s * size, frame.t * size, n, size * size, power});
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
    // Less than 1 only where a branch ends in lights that cannot shine there.
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

TEST(light_tree, the_nearest_of_equal_lamps_is_chosen_far_more_often_than_by_flux) {
  std::vector<Light> lights;
  for (int i = 0; i < 100; ++i) lights.emplace_back(PointLight<float>{{static_cast<float>(i), 0, 0}, Rgb(1)});
  const LightTree tree(lights);
  // By flux: 1/100. All others together bring a few hundredths of its light, but a node's importance is that of its
  // middle, so that every level but the last few gives much away.
  EXPECT_GT(tree.probability({70, 0.1f, 0}, 70), 0.05f);
  EXPECT_LT(tree.probability({70, 0.1f, 0}, 0), 0.01f);
  EXPECT_GT(tree.probability({70, 0.1f, 0}, 0), 0);
}

TEST(light_tree, lamps_in_one_place_do_no_harm) {
  const std::vector<Light> lights(40, PointLight<float>{{1, 1, 1}, Rgb(1)});
  const LightTree tree(lights);
  for (std::uint32_t i = 0; i < 40; ++i) EXPECT_NEAR(tree.probability({1, 1, 1}, i), 1.0f / 40, 1e-2f);
}

}  // namespace
}  // namespace photonproof
