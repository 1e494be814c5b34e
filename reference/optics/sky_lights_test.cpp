// Skies as parallel lights, compared with integrals and directions derived by hand.
#include "reference/optics/sky_lights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reference/povray/povray_export.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_optics {
namespace {

EnvmapDescription grey_map(int width, int height, float value) {
  auto image = std::make_shared<Image>(width, height);
  for (float& v : image->rgb) v = value;
  EnvmapDescription map;
  map.image = std::move(image);
  return map;
}

/// Irradiance on a surface that faces `n`.
RgbD irradiance_of(const std::vector<SkyLight>& lights, const Vec3d& n) {
  RgbD sum(0.0);
  for (const SkyLight& light : lights) sum += light.irradiance * std::max(0.0, dot(light.from, n));
  return sum;
}

TEST(sky_lights, that_is_grey_lights_every_side_by_pi) {
  const auto lights = sky_lights(grey_map(8, 5, 0.5f), 16, 1);
  ASSERT_EQ(lights.size(), 256u);
  for (const Vec3d& n : {Vec3d{0, 1, 0}, Vec3d{0, -1, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, -1}})
    EXPECT_NEAR(irradiance_of(lights, n).y, 0.5 * std::numbers::pi, 0.005 * 0.5 * std::numbers::pi);
  RgbD flux(0.0);
  for (const SkyLight& light : lights) flux += light.irradiance;
  EXPECT_NEAR(flux.x, 0.5 * 4 * std::numbers::pi, 1e-5);
}

TEST(sky_lights, shines_from_where_its_bright_texel_is_turned_with_the_map) {
  // The 21st of 64 columns has its middle at u = 20.5 / 64, a turn from -z by way of +x. The ninth of 33 rows is at 45
  // degrees from the zenith.
  EnvmapDescription map = grey_map(64, 33, 0);
  auto image = std::make_shared<Image>(*map.image);
  image->pixel(20, 8)[0] = 100;
  map.image = image;
  map.scale = 2;
  const double phi = 2 * std::numbers::pi * 20.5 / 64;
  const Vec3d local = Vec3d{std::sin(phi), 1, -std::cos(phi)} * std::sqrt(0.5);
  const auto mean_direction = [](const std::vector<SkyLight>& lights) {
    Vec3d sum(0.0);
    for (const SkyLight& light : lights) sum += light.from * light.irradiance.x;
    return normalize(sum);
  };
  EXPECT_GT(dot(mean_direction(sky_lights(map, 12, 3)), local), 0.999);
  map.to_world = Transform::scale({2, 2, 2});
  map.to_world.m = {0, 0, 2, 0, 0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 0, 1};  // x to -z, z to x
  EXPECT_GT(dot(mean_direction(sky_lights(map, 12, 3)), Vec3d{local.z, local.y, -local.x}), 0.999);
}

TEST(sky_lights, has_the_sun_in_its_disc_with_all_of_its_irradiance) {
  SunSkyDescription sunsky;
  sunsky.sun_direction = {0.6, 0, 0.8};
  sunsky.sun_aperture_degrees = 2;
  sunsky.sun_scale = 3;
  const auto narrow = [&] {
    SunSkyDescription other = sunsky;
    other.sun_aperture_degrees = 0.2;
    return irradiance_of(sun_lights(other, 4, 1), {0.6, 0, 0.8});
  }();
  const auto lights = sun_lights(sunsky, 6, 1);
  ASSERT_EQ(lights.size(), 36u);
  const double edge = std::cos(1.0001 * std::numbers::pi / 180);
  for (const SkyLight& light : lights) EXPECT_GT(dot(light.from, Vec3d{0.6, 0, 0.8}), edge);
  // The irradiance does not depend on the aperture, except by the cosines over a disc of 2 degrees: 1e-4.
  EXPECT_NEAR(irradiance_of(lights, {0.6, 0, 0.8}).y, narrow.y, 2e-4 * narrow.y);
  sunsky.sun_direction = {0.6, 0, -0.8};
  EXPECT_TRUE(sun_lights(sunsky, 6, 1).empty());
}

TEST(sky_lights, of_a_sunsky_is_up_where_its_z_is) {
  EmitterDescription emitter;
  SunSkyDescription sunsky;
  sunsky.sun_direction = {1, 0, 1};
  sunsky.to_world.m = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};  // z to y, y to -z
  emitter.light = sunsky;
  const auto lights = sky_lights(std::get<EnvmapDescription>(sky_without_sun(emitter).light), 16, 1);
  double towards_sun = 0, away = 0;
  for (const SkyLight& light : lights) {
    EXPECT_GT(light.from.y, -0.01) << "nothing below the horizon";
    (light.from.x > 0 ? towards_sun : away) += light.irradiance.y;
  }
  EXPECT_GT(towards_sun, 1.3 * away);
}

std::string sdl_of(const std::string& scene) {
  return export_povray(parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + scene + "/scene.xml"), {})
      .sdl.str();
}

TEST(sky_lights, becomes_lights_where_nothing_mirrors_and_is_then_hidden_from_radiosity) {
  const std::string dial = sdl_of("sundial");
  EXPECT_NE(dial.find(": parallel lights from all over its disc"), std::string::npos);
  EXPECT_NE(dial.find(": 256 parallel lights, each with the same share of its flux"), std::string::npos);
  EXPECT_EQ(dial.find("sky_sphere{"), std::string::npos);
  EXPECT_NE(dial.find(" no_shadow no_radiosity}"), std::string::npos);
  const std::string constant = sdl_of("light-constant");  // radiosity finds it exactly
  EXPECT_EQ(constant.find("light_source{"), std::string::npos);
  EXPECT_EQ(constant.find("background{rgb 0}"), std::string::npos);
}

TEST(povray_lights, that_fill_half_the_sky_of_what_they_light_are_left_to_radiosity) {
  EXPECT_EQ(sdl_of("parallel-planes").find("light_source{"), std::string::npos);
  EXPECT_NE(sdl_of("light-area").find("light_source{"), std::string::npos);
}

}  // namespace
}  // namespace photonproof::inline reference_optics
