// The directions in which photons leave lights, over random parameters and extreme ones, against their density.

#include <gtest/gtest.h>

#include <string>

#include "renderer/chi_square.h"
#include "renderer/test_lights.h"

namespace photonproof {
namespace {

using test::DirectionCells;
using test::Lights;
using test::Random;

constexpr int samples = 1'000'000;

struct Case {
  std::string name;
  Light light;
  DirectionCells cells;
};

std::vector<Case> spots() {
  std::vector<Case> all;
  std::uint64_t seed = 700;
  for (const double cutoff : {2e-3, 0.02, 0.3, 1.0, 1.6, 2.5, 3.14159}) {
    Random r(++seed);
    const Vec3f axis = square_to_sphere(r.next2());
    const double beam = cutoff * (seed % 3 == 0 ? 1 : double{r.next()}), half = std::sin(cutoff / 2);
    all.push_back({"spot of " + std::to_string(cutoff), spot_light({0, 0, 0}, axis, Rgb(1), beam, cutoff),
                   DirectionCells(axis, std::min(2.1 * half * half, 2.0))});
  }
  return all;
}

/// Lamps of random angles and candelas, some of them 0; whole turns, halves, quarters and round ones.
std::vector<Case> lamps() {
  std::vector<Case> all;
  for (const double turn : {0.0, 90.0, 180.0, 360.0})
    for (const double widest : {90.0, 180.0}) {
      Random r(720, static_cast<std::uint64_t>(turn + widest));
      IesProfile profile;
      for (int i = 0; i <= 5; ++i) profile.vertical_degrees.push_back(widest * i * i / 25);
      for (int i = 0; i <= (turn > 0 ? 4 : 0); ++i) profile.horizontal_degrees.push_back(turn * i / 4);
      for (std::size_t i = 0; i < profile.vertical_degrees.size() * profile.horizontal_degrees.size(); ++i)
        profile.candela.push_back(r.next() < 0.2f ? 0 : 1000 * double{r.next()});
      const Frame<float> frame(square_to_sphere(r.next2()));
      all.push_back({"ies of " + std::to_string(turn) + " and " + std::to_string(widest),
                     IesLight({0, 0, 0}, frame.s, frame.t, frame.n, Rgb(1), profile), DirectionCells()});
    }
  return all;
}

TEST(light_photons, of_point_like_lights_match_their_density) {
  std::vector<Case> all = spots();
  for (Case& lamp : lamps()) all.push_back(std::move(lamp));
  all.push_back({"point", PointLight<float>{{1, 2, 3}, Rgb(1)}, DirectionCells()});
  std::uint64_t seed = 740;
  for (const Case& c : all) {
    const Lights lights({c.light});
    EXPECT_GT(
        test::direction_p_value([&](Random& r) { return lights.scene.emit(0, r.next2(), r.next2()).direction; },
                                [&](const Vec3f& d) { return lights.scene.emission_pdfs(0, {}, {}, d).direction; },
                                ++seed, samples, 8, c.cells),
        test::sidak_level(static_cast<int>(all.size())))
        << c.name;
  }
}

}  // namespace
}  // namespace photonproof
