// The parameter hide_emitters in every integrator: the camera looks through lights, while mirrors and glass show them.
// References are closed forms, and Mitsuba 3.9.1's renders of the same stacks of panes.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "renderer/integrators/test_scenes.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_light_sampling {
namespace {

const std::string light_side = "<bsdf type='diffuse'><rgb name='reflectance' value='0.9'/></bsdf>";
const std::string shines = "<emitter type='area'><rgb name='radiance' value='7'/></emitter>";
const std::string black = "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf>";

/// The square [-1,1]^2 times `half` at this z, with its front towards the camera or away from it.
std::string pane(double z, const std::string& inner, double half = 1, bool turned = false) {
  return "<shape type='rectangle'><transform name='to_world'><scale value='" + std::to_string(half) + "'/>" +
         (turned ? "<rotate y='1' angle='180'/>" : "") + "<translate z='" + std::to_string(z) + "'/></transform>" +
         inner + "</shape>";
}

// The camera looks along -z from z = 10. A beam of irradiance 1 falls on the wall at z = -20 from the side. It passes
// the panes' planes 15 aside from them. The wall's radiance is 0.5 x 0.8 / pi.
const std::string wall = pane(-20, "<bsdf type='diffuse'/>", 40);
constexpr double wall_radiance = 0.4 / std::numbers::pi;

struct Seen {
  double mean, error;
};
Seen seen(const std::string& stack, const char* integrator, const std::string& far_clip = "",
          std::size_t small_limit = brute_force_limit) {
  const SceneDescription scene = parse_scene_text(
      "<scene version='3.0.0'><integrator type='path'><boolean name='hide_emitters' value='true'/></integrator><sensor "
      "type='perspective'><float name='fov' value='2'/>" +
          far_clip +
          "<transform name='to_world'><lookat origin='0,0,10' target='0,0,0' up='0,1,0'/></transform><film "
          "type='hdrfilm'><integer name='width' value='4'/><integer name='height' value='4'/><rfilter "
          "type='box'/></film></sensor><emitter type='directional'><vector name='direction' x='0.6' y='0' "
          "z='-0.8'/></emitter>" +
          stack + "</scene>",
      "scene.xml", {});
  const bool is_ptracer = std::string(integrator) == "ptracer";
  RenderJob job = test::job_with(is_ptracer ? 1 << 14 : 256, 1000);
  if (is_ptracer) job.budget.photons.reset();
  const Image image = test::render(scene, integrator, job, small_limit).image.mean;
  double sum = 0, squares = 0;
  for (std::size_t i = 0; i < image.pixels(); ++i) {
    const double value = image.rgb[3 * i];
    sum += value;
    squares += value * value;
  }
  const auto n = static_cast<double>(image.pixels());
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum * sum / n / n) / (n - 1))};
}

/// Checks the radiance to 0.01 %, or to the noise.
void expect_seen(const std::string& stack, const char* integrator, double radiance, const std::string& far_clip = "") {
  for (const std::size_t limit : {brute_force_limit, std::size_t{0}}) {
    const Seen found = seen(stack, integrator, far_clip, limit);
    EXPECT_NEAR(found.mean, radiance, 1e-4 * radiance + 5 * found.error) << integrator << " " << limit;
  }
}

constexpr const char* from_camera[] = {"path", "direct", "volpath", "bdpt", "whitted", "photonmapper", "sppm"};

TEST(hidden_lights, are_looked_through_by_every_integrator) {
  // Panes seen from the front, from the back, several in a row, and panes without emission.
  const std::string dark = "<emitter type='area'><rgb name='radiance' value='0'/></emitter>";
  for (const std::string& lights : {pane(0, light_side + shines), pane(0, black + shines, 1, true),
                                    pane(2, black + shines) + pane(1, black + shines) + pane(0, black + dark)})
    for (const char* integrator : from_camera) {
      // A light facing away lights the wall: 7 x 0.5 / pi times the form factor of the square from 20 away.
      const bool turned = lights.find("rotate") != std::string::npos;
      const double a = 1.0 / 20, of_light = 4 / (std::numbers::pi * 2) * 2 * (a / std::sqrt(1 + a * a)) *
                                            std::atan(a / std::sqrt(1 + a * a));
      const double noise = turned ? 3e-3 : 1e-4;
      const Seen found = seen(lights + wall, integrator);
      const double expected = wall_radiance + (turned ? 3.5 * of_light : 0);
      EXPECT_NEAR(found.mean, expected, noise * expected + 5 * found.error) << integrator << " " << turned;
    }
}

TEST(hidden_lights, are_looked_through_by_rays_of_the_small_kernel_and_of_embree) {
  for (const char* integrator : {"path", "volpath", "bdpt"})
    expect_seen(pane(1, black + shines) + pane(0, black + shines) + wall, integrator, wall_radiance);
}

TEST(hidden_lights, let_light_paths_through_to_the_camera) {
  // A wall that fits into the view: light tracing would rarely find a part of a wide one.
  const std::string narrow = pane(-20, "<bsdf type='diffuse'/>", 0.3);
  const Seen open = seen(narrow, "ptracer"), behind = seen(pane(0, light_side + shines, 0.9) + narrow, "ptracer");
  ASSERT_GT(open.mean, 0.01);
  EXPECT_NEAR(behind.mean, open.mean, 5 * std::hypot(behind.error, open.error));
  EXPECT_NEAR(behind.mean, seen(narrow, "path").mean, 5 * behind.error);
}

TEST(hidden_lights, are_shown_by_mirrors) {
  // The ray passes the light's back, is reflected and meets its front.
  const std::string mirror = pane(-20, "<bsdf type='conductor'><string name='material' value='none'/></bsdf>", 40);
  for (const char* integrator : {"path", "direct", "volpath", "bdpt", "whitted", "photonmapper"})
    expect_seen(pane(0, black + shines, 1, true) + mirror, integrator, 7);
}

TEST(hidden_lights, are_shown_behind_straight_ways_by_all_but_volpath) {
  // Mitsuba 3.9.1 gives 7 by `path` and `direct`. `volpath` does not count surfaces that light passes straight through.
  const std::string stack = pane(1, "<bsdf type='null'/>") + pane(0, black + shines) + wall;
  for (const char* integrator : {"path", "direct", "bdpt", "whitted"}) expect_seen(stack, integrator, 7);
  expect_seen(stack, "volpath", wall_radiance);
  // A quarter of the pane is present, and black.
  const std::string mask = "<bsdf type='mask'><float name='opacity' value='0.25'/>" + black + "</bsdf>";
  expect_seen(pane(1, mask) + pane(0, black + shines) + wall, "path", 5.25);
  expect_seen(pane(1, mask) + pane(0, black + shines) + wall, "volpath", 0.75 * wall_radiance);
}

TEST(hidden_lights, and_environments_are_not_seen_on_straight_ways_but_by_direct) {
  // Mitsuba 3.9.1 gives these values for an environment of 3. Behind nothing, a light, or a null surface: 0 by `path`
  // and `volpath`, and 3 by `direct`. Behind nearly index-matched glass: 3 by all.
  const std::string sky = "<emitter type='constant'><rgb name='radiance' value='3'/></emitter>";
  const std::string null = pane(0, "<bsdf type='null'/>");
  const std::string glass = pane(0,
                                 "<bsdf type='dielectric'><float name='int_ior' value='1.0001'/><float "
                                 "name='ext_ior' value='1'/></bsdf>");
  for (const char* integrator : from_camera) {
    EXPECT_EQ(seen(sky + pane(-30, black, 0.001), integrator).mean, 0) << integrator;
    EXPECT_EQ(seen(sky + pane(0, black + shines), integrator).mean, 0) << integrator;
    EXPECT_NEAR(seen(sky + glass, integrator).mean, 3, 2e-3) << integrator;
    const bool is_direct = std::string(integrator) == "direct";
    EXPECT_NEAR(seen(sky + null, integrator).mean, is_direct ? 3 : 0, 1e-5) << integrator;
  }
}

TEST(hidden_lights, do_not_take_the_camera_beyond_its_far_plane) {
  const std::string far_clip = "<float name='far_clip' value='20'/>";
  for (const char* integrator : {"path", "volpath", "bdpt", "whitted"})
    EXPECT_EQ(seen(pane(0, black + shines) + wall, integrator, far_clip).mean, 0) << integrator;
}

}  // namespace
}  // namespace photonproof::inline renderer_light_sampling
