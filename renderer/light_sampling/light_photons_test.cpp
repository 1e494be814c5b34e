// The directions in which photons leave lights, over random and extreme parameters, against their density.

#include <gtest/gtest.h>

#include <numbers>
#include <string>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/light_sampling/test_lights.h"

namespace photonproof::inline renderer_light_sampling {
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

/// Textured spots: the texture changes a photon's flux, not its direction.
std::vector<Case> textured_spots() {
  std::vector<Case> all;
  std::uint64_t seed = 710;
  for (const double cutoff : {2e-3, 0.3, 1.2, 1.55}) {
    Random r(++seed);
    const Frame<float> frame(square_to_sphere(r.next2()));
    const double half = std::sin(cutoff / 2);
    all.push_back({"textured spot of " + std::to_string(cutoff),
                   TexturedSpotLight(spot_light({0, 0, 0}, frame.n, Rgb(1), cutoff * double{r.next()}, cutoff), frame.s,
                                     frame.t, [](const Vec2<float>& uv) { return Rgb(uv.x, uv.y, 1); }),
                   DirectionCells(frame.n, 2.1 * half * half)});
  }
  return all;
}

/// Projectors through narrow and wide screens, of one colour, or of an image with a dark quarter.
std::vector<Case> projectors() {
  std::vector<Case> all;
  std::uint64_t seed = 715;
  for (const float wide : {1e-3f, 0.5f, 4.0f})
    for (const bool image : {false, true}) {
      Random r(++seed);
      const Frame<float> frame(square_to_sphere(r.next2()));
      const ProjectorScreen screen{{0, 0, 0}, frame.s, frame.t, frame.n, wide, wide * 0.4f};
      const LightTexture shown = [image](const Vec2<float>& uv) {
        return image ? Rgb(uv.x > 0.5f && uv.y > 0.5f ? 0.0f : 0.2f + uv.x) : Rgb(1.0f);
      };
      const double corner = std::atan(std::hypot(double{wide}, 0.4 * double{wide})), half = std::sin(corner / 2);
      all.push_back({"projector " + std::to_string(wide) + (image ? " of an image" : ""),
                     ProjectorLight(screen, shown, image ? 8 : 1, 4), DirectionCells(frame.n, 2.1 * half * half)});
    }
  return all;
}

/// Lights of random angles and candelas, some of them 0. Their horizontal angles span 360, 180, 90 or 0
/// degrees.
std::vector<Case> area_lights() {
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
  for (Case& spot : textured_spots()) all.push_back(std::move(spot));
  for (Case& projector : projectors()) all.push_back(std::move(projector));
  for (Case& area_light : area_lights()) all.push_back(std::move(area_light));
  all.push_back({"point", PointLight<float>{{1, 2, 3}, Rgb(1)}, DirectionCells()});
  std::uint64_t seed = 740;
  for (const Case& c : all) {
    const Lights lights({c.light});
    EXPECT_GT(test::direction_p_value([&](Random& r) { return lights.scene.emit(0, r.next2(), r.next2()).direction; },
                                      [&](const Vec3f& d) { return lights.scene.emit_pdfs(0, {}, d).second; }, ++seed,
                                      samples, 8, c.cells),
              test::sidak_level(static_cast<int>(all.size())))
        << c.name;
  }
}

TEST(light_photons, from_infinity_enter_evenly_through_the_disc_that_covers_the_scene) {
  // Bins of the squared distance from the middle of the disc and of the azimuth: cells of equal areas.
  constexpr int rings = 16, sectors = 32, cells = rings * sectors;
  int tests = 0;
  for (const float radius : {1e-3f, 2.0f, 1e5f})
    for (const bool sky : {false, true}) {
      Random of(760, static_cast<std::uint64_t>(++tests));
      const Vec3f direction = square_to_sphere(of.next2()), center = square_to_sphere(of.next2()) * (3 * radius);
      const Lights lights({sky ? Light(EnvironmentLight(ConstantSky{Rgb(1)}, center, radius))
                               : Light(DirectionalLight<float>{direction, Rgb(1), center, radius})},
                          {center, radius});
      std::vector<double> observed(cells), expected(cells), tilted(cells);
      int wrong = 0;
      for (int i = 0; i < samples; ++i) {
        Random r(760 + static_cast<std::uint64_t>(tests), static_cast<std::uint64_t>(i));
        const Vec2<float> u = r.next2();
        const LightStart e = lights.scene.emit(0, u, r.next2());
        const Vec3d d(e.direction), at = (Vec3d(e.at.p) - Vec3d(center)) / double{radius};
        const Vec3d s = normalize(cross(std::abs(d.x) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0), d));
        const double x = dot(at, s), y = dot(at, cross(d, s)), turns = std::atan2(y, x) / (2 * std::numbers::pi) + 0.5;
        observed[static_cast<std::size_t>(std::min(static_cast<int>((x * x + y * y) * rings), rings - 1) * sectors +
                                          std::min(static_cast<int>(turns * sectors), sectors - 1))] += 1;
        // Starts are on the disc facing the scene, a radius before its middle, to a few roundings of 4 radii.
        wrong += std::abs(dot(at, d) + 1) > 4e-6 || x * x + y * y > 1 + 4e-6 || (!sky && e.direction != direction);
        wrong += e.pdfs.second != lights.scene.emit_pdfs(0, {center}, e.direction).second;
      }
      EXPECT_EQ(wrong, 0);
      const double disc = std::numbers::pi * double{radius} * double{radius};
      const double density = lights.scene.emit_pdfs(0, {center}, direction).second;
      for (std::size_t i = 0; i < cells; ++i) {
        expected[i] = samples * density * disc / cells;
        tilted[i] = expected[i] * (i < cells / 2 ? 1.02 : 0.98);
      }
      EXPECT_GT(test::chi_square_p_value(observed, expected), test::sidak_level(6)) << radius << sky;
      EXPECT_LT(test::chi_square_p_value(observed, tilted), test::sidak_level(6)) << "an error of 2 % is not noticed";
    }
}

TEST(light_photons, from_infinity_that_are_guided_carry_what_enters_everywhere) {
  // Flux through the ball of radius rho around any place. For light of irradiance E it is E pi rho^2. A sky of radiance
  // E/pi from all directions gives 4 times that, from the integral over directions. The places are the guiding places,
  // the rims of their discs, and beside them. A wrong density would make a part brighter; within the places the test
  // detects 5 %.
  constexpr int draws = 200'000;
  const SceneBall scene{{1, -2, 0.5f}, 100};
  const std::vector<ProjectionTarget> seen{{{3, 0, 1}, 0.7f}, {{3.5f, 0, 1}, 0.7f}, {{-6, 2, 0}, 2}, {{0, 0, 0}, 50}};
  const std::vector<std::pair<Vec3d, double>> places{
      {{3.2, 0, 1}, 0.4}, {{3, 0, 1}, 2}, {{-6, 2, 0}, 1}, {{-4, 2, 0}, 1}, {{40, 3, 9}, 20}};
  for (const bool sky : {false, true}) {
    Lights lights(
        {sky ? Light(EnvironmentLight(ConstantSky{Rgb(1 / pi)}, scene.center, scene.radius))
             : Light(DirectionalLight<float>{normalize(Vec3f(0.2f, -0.9f, 0.3f)), Rgb(1), scene.center, scene.radius})},
        scene);
    const auto cross_section_error = [&](std::size_t k, double& mean) {
      double sum = 0, squares = 0;
      for (int i = 0; i < draws; ++i) {
        Random r(780, static_cast<std::uint64_t>(i));
        const Vec2<float> u = r.next2();
        const LightStart e = lights.scene.emit(0, u, r.next2());
        const Vec3d d(e.direction);
        if (length(cross(places[k].first - Vec3d(e.at.p), d)) > places[k].second) continue;
        sum += double{e.flux.x};
        squares += double{e.flux.x} * double{e.flux.x};
      }
      mean = sum / draws;
      return std::sqrt((squares / draws - mean * mean) / draws);
    };
    for (const bool guided : {false, true}) {
      if (guided) lights.scene.guide_emission(EmissionGuiding(lights.lights, seen, scene));
      EXPECT_EQ(lights.scene.has_guide(), guided);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double rho = places[k].second, expected = std::numbers::pi * rho * rho * (sky ? 4 : 1);
        double mean = 0;
        const double error = cross_section_error(k, mean);
        EXPECT_NEAR(mean, expected, 4 * error) << sky << guided << k;
        if (guided && (k == 0 || k == 2)) {
          EXPECT_LT(error, 0.012 * expected) << sky << k;
        }
      }
    }
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
