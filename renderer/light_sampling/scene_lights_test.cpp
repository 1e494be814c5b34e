// The scalar interface of lights, for every kind: samples against densities, emitted flux, and closed forms of
// irradiance.

#include "renderer/light_sampling/scene_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "renderer/lanes/test_chi_square.h"
#include "renderer/light_sampling/test_lights.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

using test::Lights;
using test::Random;

constexpr double pi_d = std::numbers::pi;

Image sky_image() {
  Image image(8, 5);
  for (std::size_t i = 0; i < image.rgb.size(); ++i) image.rgb[i] = Random(1, i).next();
  for (int c = 0; c < 3; ++c) image.pixel(2, 1)[c] = 40;  // a sun
  for (int x = 0; x < 8; ++x)
    for (int c = 0; c < 3; ++c) image.pixel(x, 4)[c] = 0;
  return image;
}

const Transform turned = Transform::rotate({1, 2, 3}, 50);

IesProfile street_light() {
  return {{0, 20, 45, 60, 90}, {0, 30, 90}, {10, 20, 5, 1, 0, 10, 30, 9, 2, 0, 10, 5, 40, 0, 0}};
}

MeshShape tetrahedron() {
  return MeshShape({{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 0.5f}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                   {{0, 0}, {1, 0}, {0, 1}, {1, 1}}, false);
}

CylinderShape cylinder(float sign) { return {{0, 0, -1}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, 0.7f, sign}; }

Rgb stripes(const Vec2<float>& uv) { return uv.x < 0.5f ? Rgb(2, 1, 0.5f) : Rgb(0.25f, 0, 1); }

struct Named {
  const char* name;
  Light light;
};

std::vector<Named> surface_lights() {
  return {{"quad", QuadLight<float>{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}, 4, Rgb(1), told_by_corner}},
          {"sphere", SphereLight<float>{{0, 0, 1.5f}, 1.2f, 1, Rgb(1)}},
          {"disk", DiskLight<float>{{0, 0, 1}, {1, 0, 0}, {0, 0.5f, 0}, {0, 0, -1}, pi / 2, Rgb(1), told_by_corner}},
          {"cylinder", AreaLight(cylinder(-1), Rgb(1))},
          {"mesh", AreaLight(tetrahedron(), Rgb(1))},
          {"textured quad", AreaLight(QuadShape{{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, {0, 0, -1}}, stripes)}};
}

std::vector<Named> skies() {
  return {
      {"constant", EnvironmentLight(ConstantSky{Rgb(1, 2, 3)}, {0, 0, 0}, 2)},
      {"envmap", EnvironmentLight(EnvmapSky(sky_image(), 2, turned), {0, 0, 0}, 2)},
      {"sunsky", EnvironmentLight(SunSky({normalize(Vec3d(0.3, 0.2, 0.8)), 3, {0.3, 0.2, 0.6}, 1, 1, 0.3, turned}),
                                  {0, 0, 0}, 2)},
      {"low sun", EnvironmentLight(SunSky({normalize(Vec3d(1, 0, 0.15)), 8, RgbD(0.2), 1, 1, 0.2, {}}), {0, 0, 0}, 2)}};
}

std::vector<Named> points() {
  return {{"point", PointLight<float>{{0, 0, 0}, Rgb(1)}},
          {"spot", spot_light({0, 0, 0}, {0, 0.6f, 0.8f}, Rgb(2), 0.5, 0.9)},
          {"wide spot", spot_light({0, 0, 0}, {0, 0, 1}, Rgb(2), 1.0, 2.5)},
          {"sharp spot", spot_light({0, 0, 0}, {0, 0, 1}, Rgb(2), 0.7, 0.7)},
          {"textured spot",
           TexturedSpotLight(spot_light({0, 0, 0}, {0, 0, 1}, Rgb(2), 0.5, 0.9), {1, 0, 0}, {0, 1, 0}, stripes)},
          {"projector", ProjectorLight({{0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, 0.8f, 0.5f}, stripes, 16, 4)},
          {"ies", IesLight({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Rgb(1), street_light())}};
}

/// The integral of g over all directions, on a lattice of equal solid angles.
double over_sphere(const std::function<double(const Vec3f&)>& g, int rows = 800, int columns = 1600) {
  double sum = 0;
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const double z = (i + 0.5) / rows * 2 - 1, r = std::sqrt(1 - z * z), phi = (j + 0.5) / columns * 2 * pi_d;
      sum += g(Vec3f(Vec3d(r * std::cos(phi), r * std::sin(phi), z)));
    }
  return sum * 4 * pi_d / (double(rows) * columns);
}

TEST(scene_lights, directions_to_an_environment_match_their_density) {
  const auto all = skies();
  int seed = 200;
  for (const Named& sky : all) {
    const Lights lights({sky.light});
    const Vec3f p(0.1f, -0.3f, 0.2f);
    const double p_value =
        test::direction_p_value([&](Random& r) { return lights.scene.sample(p, 0.5f, r.next2()).wi; },
                                [&](const Vec3f& d) { return lights.scene.environment_pdf(p, d); },
                                static_cast<std::uint64_t>(++seed), 1'000'000);
    EXPECT_GT(p_value, test::sidak_level(static_cast<int>(all.size()))) << sky.name;
    EXPECT_NEAR(over_sphere([&](const Vec3f& d) { return double{lights.scene.environment_pdf(p, d)}; }), 1, 5e-3)
        << sky.name;
  }
}

TEST(scene_lights, a_sample_of_an_environment_has_the_density_and_radiance_of_its_direction) {
  for (const Named& sky : skies()) {
    const Lights lights({sky.light});
    for (std::uint64_t i = 0; i < 2000; ++i) {
      Random r(210, i);
      const LightSeen seen = lights.scene.sample({0.1f, 0.2f, 0.3f}, r.next(), r.next2());
      if (!(seen.pdf > 0)) continue;
      EXPECT_EQ(seen.pdf, lights.scene.environment_pdf({0.1f, 0.2f, 0.3f}, seen.wi)) << sky.name;
      EXPECT_EQ(seen.radiance, lights.scene.environment_radiance(seen.wi)) << sky.name;
      EXPECT_TRUE(seen.is_infinite && !seen.is_delta);
      EXPECT_GT(length(seen.at.p), 1000);
    }
  }
}

TEST(scene_lights, sampling_an_environment_finds_the_integral_of_its_radiance) {
  // Compares the mean of L / pdf with the lattice's integral and with the value used as the sky's power.
  for (const Named& sky : skies()) {
    const Lights lights({sky.light});
    double sum = 0;
    constexpr int samples = 400'000;
    for (int i = 0; i < samples; ++i) {
      Random r(220, static_cast<std::uint64_t>(i));
      const LightSeen seen = lights.scene.sample({0, 0, 0}, 0.5f, r.next2());
      if (seen.pdf > 0) sum += double{seen.radiance.y} / double{seen.pdf};
    }
    const double exact = over_sphere([&](const Vec3f& d) { return double{lights.scene.environment_radiance(d).y}; });
    EXPECT_NEAR(sum / samples, exact, 0.01 * exact) << sky.name;
    EXPECT_NEAR(double{flux(sky.light).y}, exact * 4 * pi_d, 0.03 * exact * 4 * pi_d) << sky.name;
  }
}

TEST(envmap, looks_where_mitsuba_does) {
  // The convention: +y is up; u = 0 is local -z, u = 1/4 is +x and u = 1/2 is +z. Texel columns are at half-integers,
  // rows end at the poles.
  Image image(4, 3);
  for (int x = 0; x < 4; ++x)
    for (int y = 0; y < 3; ++y)
      for (int c = 0; c < 3; ++c) image.pixel(x, y)[c] = static_cast<float>(10 * y + x);
  const EnvmapSky sky(image, 1, {});
  const auto horizontal = [](double u) { return Vec3f(Vec3d(std::sin(2 * pi_d * u), 0, -std::cos(2 * pi_d * u))); };
  for (int x = 0; x < 4; ++x) EXPECT_NEAR(sky.radiance(horizontal((x + 0.5) / 4)).x, 10 + x, 1e-4f);
  EXPECT_NEAR(sky.radiance({0, 0, -1}).x, 10 + 1.5f, 1e-4f);  // between columns 3 and 0
  EXPECT_NEAR(sky.radiance({1, 0, 0}).x, 10.5f, 1e-4f);
  EXPECT_NEAR(sky.radiance({0, 0, 1}).x, 11.5f, 1e-4f);
  EXPECT_LT(sky.radiance({0, 1, 0}).x, 4);
  EXPECT_GT(sky.radiance({0, -1, 0}).x, 19);
}

TEST(scene_lights, surface_samples_match_their_density_from_random_places) {
  // The light's point along a sampled direction is known, and so is the density. The test uses the mean of 1/pdf x
  // indicator, the light's solid angle. Another estimate, by uniform directions, gives it too.
  for (const Named& named : surface_lights()) {
    const Lights lights({named.light});
    for (std::uint64_t place = 0; place < 4; ++place) {
      Random at(230, place);
      const Vec3f p = Vec3f(at.next() - 0.5f, at.next() - 0.5f, -2 - at.next());
      double inverse = 0, checked = 0;
      constexpr int samples = 100'000;
      for (int i = 0; i < samples; ++i) {
        Random r(231 + place, static_cast<std::uint64_t>(i));
        const LightSeen seen = lights.scene.sample(p, 0, r.next2());
        if (!(seen.pdf > 0)) continue;
        const float again = lights.scene.pdf(seen.light, p, seen.at);
        ASSERT_NEAR(again, seen.pdf, 2e-3f * seen.pdf + 1e-5f) << named.name;
        // Projected area: the integral of cos / d^2 over the light's front, from the same points by area.
        inverse += 1 / double{seen.pdf};
        checked += 1;
      }
      ASSERT_GT(checked, 0) << named.name;
      // An independent estimate: points by area from emission, weighted by cos / d^2.
      double by_area = 0;
      for (int i = 0; i < samples; ++i) {
        Random r(241 + place, static_cast<std::uint64_t>(i));
        const LightStart e = lights.scene.emit(0, r.next2(), r.next2());
        const Vec3f d = p - e.at.p;
        const double cosine = double{dot(e.at.normal, d)} / double{length(d)};
        if (cosine > 0) by_area += cosine / double{dot(d, d)} / double{e.pdfs.first};
      }
      EXPECT_NEAR(inverse, by_area, 0.03 * by_area) << named.name;
    }
  }
}

TEST(scene_lights, photons_leave_with_their_density_and_carry_the_flux) {
  std::vector<Named> all = surface_lights();
  for (const Named& named : points()) all.push_back(named);
  std::uint64_t seed = 250;
  for (const Named& named : all) {
    const Lights lights({named.light});
    constexpr int samples = 200'000;
    RgbD sum(0.0);
    for (int i = 0; i < samples; ++i) {
      Random r(seed, static_cast<std::uint64_t>(i));
      const LightStart e = lights.scene.emit(0.5f, r.next2(), r.next2());
      sum += RgbD(e.flux);
      const EmissionPdfs<float> pdfs = lights.scene.emit_pdfs(0, e.at, e.direction);
      ASSERT_NEAR(pdfs.second, e.pdfs.second, 1e-3f * e.pdfs.second) << named.name;
      ASSERT_EQ(pdfs.first, e.pdfs.first) << named.name;
      const float cosine = e.is_delta ? 1 : dot(e.at.normal, e.direction);
      if (!(e.pdfs.second > 1e-4f)) continue;
      const Rgb carried = lights.scene.radiance(0, e.at, e.direction) * (cosine / (e.pdfs.first * e.pdfs.second));
      ASSERT_NEAR(carried.x, e.flux.x, 2e-3f * e.flux.x + 1e-6f) << named.name;
    }
    const Rgb whole = flux(named.light);
    EXPECT_NEAR(sum.x / samples, double{whole.x}, 0.01 * double{whole.x}) << named.name;
    EXPECT_NEAR(sum.z / samples, double{whole.z}, 0.01 * double{whole.z}) << named.name;
    ++seed;
  }
}

TEST(scene_lights, directions_of_photons_of_point_like_lights_match_their_density) {
  const auto all = points();
  std::uint64_t seed = 270;
  for (const Named& named : all) {
    const Lights lights({named.light});
    EXPECT_GT(test::direction_p_value([&](Random& r) { return lights.scene.emit(0, r.next2(), r.next2()).direction; },
                                      [&](const Vec3f& d) { return lights.scene.emit_pdfs(0, {}, d).second; }, ++seed,
                                      1'000'000),
              test::sidak_level(static_cast<int>(all.size())))
        << named.name;
    // The flux is the integral of the intensity.
    const double exact = over_sphere([&](const Vec3f& d) { return double{lights.scene.radiance(0, {}, d).x}; });
    EXPECT_NEAR(double{flux(named.light).x}, exact, 0.01 * exact) << named.name;
  }
}

TEST(scene_lights, photons_from_infinity_cross_the_ball_evenly) {
  // A small square in the ball faces up. The flux through it per area is E. A directional light straight down gives E =
  // 3, a constant sky pi L from above.
  std::vector<Named> all = skies();
  all.push_back({"directional", DirectionalLight<float>{normalize(Vec3f(0.3f, 0.1f, -1)), Rgb(3), {0, 0, 0}, 2}});
  for (const Named& named : all) {
    const Lights lights({named.light});
    double through = 0;
    constexpr int samples = 2'000'000;
    for (int i = 0; i < samples; ++i) {
      Random r(290, static_cast<std::uint64_t>(i));
      const LightStart e = lights.scene.emit(0, r.next2(), r.next2());
      if (e.direction.z >= 0) continue;
      ASSERT_LE(length(e.at.p), 2 * 1.42f);
      const float t = (0.5f - e.at.p.z) / e.direction.z;
      const Vec3f p = e.at.p + e.direction * t;
      if (std::abs(p.x - 0.4f) < 0.5f && std::abs(p.y) < 0.5f) through += double{e.flux.y};
      if (i < 100) {
        const auto pdfs = lights.scene.emit_pdfs(0, {p}, e.direction);
        EXPECT_NEAR(pdfs.second, 1 / (4 * pi), 1e-6f);
        EXPECT_NEAR(pdfs.first, e.pdfs.first, 1e-3f * e.pdfs.first);
      }
    }
    const double exact = lights.scene.environment() ? over_sphere([&](const Vec3f& d) {
      return double{lights.scene.environment_radiance(d).y} * std::max(0.0, double{d.z});
    })
                                                    : 3 / std::sqrt(1.1);
    EXPECT_NEAR(through / samples, exact, 0.015 * exact) << named.name;
    EXPECT_EQ(lights.scene.emit_pdfs(0, {{5, 5, 0}}, {0, 0, -1}).second, 0) << "beside the ball";
  }
}

TEST(spot_light, falls_linearly_with_the_angle_between_beam_and_cut_off) {
  const SpotLight<float> spot = spot_light({0, 0, 0}, {0, 0, 1}, Rgb(6), 0.2, 0.6);
  const auto at = [&](double angle) {
    const Vec3f d(Vec3d(std::sin(angle), 0, std::cos(angle)));
    return spot.sample(d * 2.0f, {}).radiance.x * 4;
  };
  EXPECT_NEAR(at(0.1), 6, 1e-5f);
  EXPECT_NEAR(at(0.3), 4.5f, 1e-4f);
  EXPECT_NEAR(at(0.5), 1.5f, 1e-4f);
  EXPECT_EQ(at(0.61), 0);
  // A beam of a hundredth of a degree has the same shape.
  const SpotLight<float> narrow = spot_light({0, 0, 0}, {0, 0, 1}, Rgb(1), 1e-4, 2e-4);
  EXPECT_NEAR(narrow.sample({1.5e-4f, 0, 1}, {}).radiance.x, 0.5f, 1e-3f);
}

TEST(ies_light, interpolates_between_angles_and_mirrors_quadrants) {
  const IesLight area_light({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, Rgb(2), street_light());
  const auto at = [&](double vertical, double horizontal) {
    const double v = vertical * pi_d / 180, h = horizontal * pi_d / 180;
    return area_light.leaving({}, Vec3f(Vec3d(std::sin(v) * std::cos(h), std::sin(v) * std::sin(h), -std::cos(v)))).x /
           2;
  };
  EXPECT_NEAR(at(0, 0), 10, 1e-3f);
  EXPECT_NEAR(at(20, 30), 30, 1e-3f);
  EXPECT_NEAR(at(20, 150), 30, 1e-2f);  // mirrored about 90
  EXPECT_NEAR(at(20, 210), 30, 1e-2f);  // and about 180
  EXPECT_NEAR(at(45, 60), (9 + 40) / 2.0f, 1e-2f);
  EXPECT_NEAR(at(52.5, 0), 3, 1e-2f);
  EXPECT_EQ(at(120, 0), 0);
}

TEST(scene_lights, an_environment_beside_lights_keeps_a_share) {
  const Lights lights(
      {PointLight<float>{{0, 0, 0}, Rgb(1e-3f)}, EnvironmentLight(ConstantSky{Rgb(100)}, {0, 0, 0}, 2)});
  EXPECT_NEAR(lights.scene.choice_probability({}, 0), 0.5f, 1e-6f);
  EXPECT_NEAR(lights.scene.emission_probability(1), 0.5f, 1e-6f);
}

TEST(scene_lights, nothing_shines_without_lights) {
  const Lights none({});
  EXPECT_EQ(none.scene.sample({}, 0.5f, {0.5f, 0.5f}).pdf, 0);
  EXPECT_EQ(none.scene.emit(0.5f, {}, {}).flux, Rgb(0.0f));
  EXPECT_EQ(none.scene.environment_radiance({0, 0, 1}), Rgb(0.0f));
  const Lights black({PointLight<float>{{}, Rgb(0.0f)}, EnvironmentLight(ConstantSky{Rgb(0.0f)}, {}, 1)});
  EXPECT_TRUE(std::isfinite(black.scene.sample({1, 0, 0}, 0.2f, {0.1f, 0.1f}).radiance.x));
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
