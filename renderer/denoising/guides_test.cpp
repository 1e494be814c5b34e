// Guides of scenes whose first surfaces are known. A wall of reflectance (.2, .5, .8) fills z = 0 and faces the camera
// at z = 4; what is between them changes.
#include "renderer/denoising/guides.h"

#include <gtest/gtest.h>

#include <atomic>

#include "renderer/planning/test_compiled.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_denoising {
namespace {

constexpr const char* wall =
    "<shape type='rectangle'><transform name='to_world'><scale x='50' y='50'/></transform>"
    "<bsdf type='diffuse'><rgb name='reflectance' value='.2, .5, .8'/></bsdf></shape>";

std::string scene_text(const std::string& shapes) {
  return "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'><float name='fov' value='10'/>"
         "<transform name='to_world'><lookat origin='0, 0, 4' target='0, 0, 0' up='0, 1, 0'/></transform>"
         "<film type='hdrfilm'><rfilter type='box'/></film></sensor>" +
         shapes + "</scene>";
}

/// A rectangle across the view, at z and turned about y.
std::string across(double z, double degrees, const std::string& bsdf) {
  return "<shape type='rectangle'><transform name='to_world'><rotate y='1' angle='" + std::to_string(degrees) +
         "'/><translate z='" + std::to_string(z) + "'/></transform>" + bsdf + "</shape>";
}

struct Asked {
  int width = 4, height = 4, samples = 16, threads = 1;
  bool hide_emitters = false;
  std::optional<Tile> window{};
};

std::optional<Guides> guides_of(const std::string& shapes, const Asked& asked = {},
                                const std::atomic<bool>* interrupt = nullptr) {
  const SceneDescription description = parse_scene_text(scene_text(shapes), "guides.xml");
  const Scene scene = photonproof::test::compiled(description, asked.width, asked.height);
  RenderJob job;
  job.threads = asked.threads;
  job.interrupt = interrupt;
  return trace_guides(scene, job, asked.hide_emitters, asked.window.value_or(Tile{0, 0, asked.width, asked.height}),
                      asked.samples);
}

void expect_all(const Image& image, float r, float g, float b, float within = 1e-6f) {
  for (std::size_t i = 0; i < image.rgb.size(); i += 3) {
    EXPECT_NEAR(image.rgb[i], r, within);
    EXPECT_NEAR(image.rgb[i + 1], g, within);
    EXPECT_NEAR(image.rgb[i + 2], b, within);
  }
}

TEST(Guides, wall_has_its_reflectance_and_the_normal_that_faces_the_viewer) {
  const auto front = guides_of(wall);
  expect_all(front->albedo, 0.2f, 0.5f, 0.8f);
  expect_all(front->normal, 0, 0, 1);
  const auto back = guides_of(across(0, 180, "<bsdf type='twosided'><bsdf type='diffuse'/></bsdf>"));
  expect_all(back->albedo, 0.5f, 0.5f, 0.5f);
  expect_all(back->normal, 0, 0, 1);
  const auto black = guides_of(across(0, 180, "<bsdf type='diffuse'/>"));  // which reflects on its other side alone
  expect_all(black->albedo, 0, 0, 0);
  expect_all(black->normal, 0, 0, 1);
}

TEST(Guides, mirror_shows_the_wall_behind_the_camera_in_its_colour) {
  const std::string mirror = across(0, 0,
                                    "<bsdf type='conductor'><string name='material' value='none'/>"
                                    "<rgb name='specular_reflectance' value='1, .5, .25'/></bsdf>");
  const std::string behind =
      "<shape type='rectangle'><transform name='to_world'><scale x='50' y='50'/><rotate y='1' angle='180'/>"
      "<translate z='9'/></transform><bsdf type='diffuse'><rgb name='reflectance' value='.2, .4, .8'/></bsdf></shape>";
  const auto seen = guides_of(mirror + behind);
  expect_all(seen->albedo, 0.2f, 0.2f, 0.2f);
  expect_all(seen->normal, 0, 0, -1);
}

// At normal incidence an interface of index 1.5 transmits 1 - (0.5 / 2.5)^2 = 0.96, the rest is reflected past the
// camera. Radiance behind it would be 1.5^2 times less, which albedo is not. 4096 samples: sigma 0.2 * 0.8 / 64.
TEST(Guides, wall_in_glass_keeps_its_albedo_but_for_reflection) {
  const auto seen = guides_of(across(1, 0,
                                     "<bsdf type='dielectric'><float name='int_ior' value='1.5'/><float "
                                     "name='ext_ior' value='1'/></bsdf>") +
                                  wall,
                              {.width = 1, .height = 1, .samples = 4096});
  expect_all(seen->albedo, 0.96f * 0.2f, 0.96f * 0.5f, 0.96f * 0.8f, 0.01f);
  expect_all(seen->normal, 0, 0, 0.96f, 0.01f);
}

TEST(Guides, without_a_surface_they_are_0_and_at_an_edge_a_mean) {
  const auto nothing = guides_of("<emitter type='constant'/>");
  expect_all(nothing->albedo, 0, 0, 0);
  expect_all(nothing->normal, 0, 0, 0);
  // Half of the view: a rectangle of x from 0 to 2.
  const auto half = guides_of(
      "<shape type='rectangle'><transform name='to_world'><translate x='1'/></transform><bsdf "
      "type='diffuse'/></shape>",
      {.width = 1, .height = 1, .samples = 1024});
  expect_all(half->albedo, 0.25f, 0.25f, 0.25f, 0.01f);
  expect_all(half->normal, 0, 0, 0.5f, 0.02f);
}

TEST(Guides, lights_count_unless_they_are_hidden_and_masks_are_passed) {
  const std::string light = across(1, 0,
                                   "<bsdf type='diffuse'><rgb name='reflectance' value='0'/></bsdf><emitter "
                                   "type='area'><rgb name='radiance' value='7'/></emitter>");
  expect_all(guides_of(light + wall)->albedo, 0, 0, 0);
  expect_all(guides_of(light + wall, {.hide_emitters = true})->albedo, 0.2f, 0.5f, 0.8f);
  const std::string hole =
      across(1, 0, "<bsdf type='mask'><float name='opacity' value='0'/><bsdf type='diffuse'/></bsdf>");
  expect_all(guides_of(hole + wall)->albedo, 0.2f, 0.5f, 0.8f);
}

TEST(Guides, bits_do_not_depend_on_threads_or_the_window) {
  const std::string shapes = across(0, 30, "<bsdf type='plastic'/>") +
                             "<shape type='sphere'><point name='center' x='.2' y='0' z='1'/><float name='radius' "
                             "value='.2'/><bsdf type='dielectric'/></shape>" +
                             wall;
  const auto one = guides_of(shapes, {.width = 40, .height = 33, .samples = 3});
  for (const int threads : {2, 7}) {
    const auto several = guides_of(shapes, {.width = 40, .height = 33, .samples = 3, .threads = threads});
    EXPECT_EQ(several->albedo.rgb, one->albedo.rgb);
    EXPECT_EQ(several->normal.rgb, one->normal.rgb);
  }
  const auto part = guides_of(shapes, {.width = 40, .height = 33, .samples = 3, .window = Tile{7, 20, 31, 30}});
  ASSERT_EQ(part->albedo.width, 24);
  for (int y = 0; y < 10; ++y)
    for (int x = 0; x < 24; ++x)
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(part->albedo.pixel(x, y)[c], one->albedo.pixel(x + 7, y + 20)[c]);
        ASSERT_EQ(part->normal.pixel(x, y)[c], one->normal.pixel(x + 7, y + 20)[c]);
      }
}

TEST(Guides, interrupt_ends_them_without_a_result) {
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(guides_of(wall, {}, &stop).has_value());
}

}  // namespace
}  // namespace photonproof::inline renderer_denoising
