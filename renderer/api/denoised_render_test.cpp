// Renders that are denoised. The fake library (renderer/denoising/test_fake_oidn.cpp) shows what they keep, refuse and
// report. Open Image Denoise itself, where PHOTONPROOF_OIDN names it, shows that the error falls.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>

#include "renderer/api/render_scene.h"
#include "renderer/denoising/denoiser.h"
#include "renderer/denoising/test_oidn.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_api {
namespace {

using renderer_denoising::test::fake_oidn;
using renderer_denoising::test::partial_oidn;
using renderer_denoising::test::Variable;

const DenoiseRequest by_fake{fake_oidn};

SceneDescription cornell(int width, int height) {
  SceneDescription scene = parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/cornell/scene.xml");
  scene.sensor.film.resize(width, height);
  return scene;
}

TEST(DenoisedRender, image_is_the_filter_s_and_has_no_variance_layer) {
  const SceneDescription scene = cornell(8, 8);
  const Rendered plain = render_scene(scene, {.budget = {.spp = 4}});
  const Rendered filtered = render_scene(scene, {.budget = {.spp = 4}, .denoise = by_fake});
  ASSERT_TRUE(plain.image.variance);
  EXPECT_FALSE(plain.denoised);
  EXPECT_FALSE(plain.image.metadata.contains("photonproof:denoised"));
  EXPECT_FALSE(filtered.image.variance);
  EXPECT_NE(filtered.image.mean.rgb, plain.image.mean.rgb);
  ASSERT_TRUE(filtered.denoised);
  EXPECT_EQ(filtered.denoised->library, "Open Image Denoise");
  EXPECT_EQ(filtered.denoised->version, "2.3.4");
  EXPECT_GT(filtered.denoised->seconds, 0);
  EXPECT_EQ(filtered.stats.phases.at("denoise"), filtered.denoised->seconds);
  EXPECT_EQ(filtered.not_denoised, "");
  EXPECT_EQ(filtered.image.metadata.at("photonproof:denoised"), "Open Image Denoise 2.3.4, biased");
  EXPECT_EQ(filtered.plan.runs.back().what, "denoiser");
}

// The fake's formula at one pixel, with guides as the denoiser's own test has them.
TEST(DenoisedRender, guides_are_the_scene_s) {
  const SceneDescription scene = parse_scene_text(
      "<scene version='3.0.0'><integrator type='path'/><sensor type='perspective'><float name='fov' value='10'/>"
      "<transform name='to_world'><lookat origin='0, 0, 4' target='0, 0, 0' up='0, 1, 0'/></transform></sensor>"
      "<emitter type='constant'/><shape type='rectangle'><bsdf type='diffuse'><rgb name='reflectance' "
      "value='.3, .6, .9'/></bsdf></shape></scene>",
      "wall.xml");
  SceneDescription one = scene;
  one.sensor.film.resize(1, 1);
  const Image plain = render_scene(one, {.budget = {.spp = 4}}).image.mean;
  const Image filtered = render_scene(one, {.budget = {.spp = 4}, .denoise = by_fake}).image.mean;
  const float albedo[3] = {0.3f, 0.6f, 0.9f}, normal[3] = {0, 0, 1};
  // The pixel is about the reflectance. Its exponents -2, -1 and -1 have the mean -1, as an integer: the filter sees it
  // doubled.
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(filtered.rgb[static_cast<std::size_t>(c)],
                2 * plain.rgb[static_cast<std::size_t>(c)] + (albedo[c] + 10 * normal[c]) / 2, 1e-4f)
        << c;
}

TEST(DenoisedRender, crop_keeps_its_place_and_alpha_stays) {
  SceneDescription scene = cornell(16, 12);
  scene.sensor.film.alpha = true;
  const RenderRequest request{.budget = {.spp = 2}, .crop = FilmDescription::Crop{3, 4, 5, 6}};
  RenderRequest denoised = request;
  denoised.denoise = by_fake;
  const Rendering plain = render_scene(scene, request).image, filtered = render_scene(scene, denoised).image;
  EXPECT_EQ(filtered.place, plain.place);
  EXPECT_EQ(filtered.mean.width, 5);
  EXPECT_EQ(filtered.alpha, plain.alpha);
}

TEST(DenoisedRender, failure_leaves_the_image_as_it_was_rendered) {
  const SceneDescription scene = cornell(8, 8);
  const Rendered plain = render_scene(scene, {.budget = {.spp = 4}});
  const Variable fails("FAKE_OIDN", "memory");
  const Rendered rendered = render_scene(scene, {.budget = {.spp = 4}, .denoise = by_fake});
  EXPECT_EQ(rendered.not_denoised, "Open Image Denoise: out of memory");
  EXPECT_FALSE(rendered.denoised);
  EXPECT_FALSE(rendered.stats.interrupted);
  EXPECT_EQ(rendered.image.mean.rgb, plain.image.mean.rgb);
  EXPECT_EQ(rendered.image.variance->rgb, plain.image.variance->rgb);
  EXPECT_FALSE(rendered.image.metadata.contains("photonproof:denoised"));
}

TEST(DenoisedRender, interrupt_of_the_filter_ends_the_render_with_its_image) {
  const SceneDescription scene = cornell(8, 8);
  const Rendered plain = render_scene(scene, {.budget = {.spp = 4}});
  for (const std::string phase : {"guides", "denoiser", "path"}) {
    std::atomic<bool> stop = false;
    RenderRequest request{.budget = {.spp = 4}, .denoise = by_fake, .interrupt = &stop};
    std::vector<std::string> phases;
    request.progress = [&](double, const std::string& at) {
      phases.push_back(at);
      stop = stop || at.starts_with(phase);
    };
    const Rendered rendered = render_scene(scene, request);
    EXPECT_TRUE(rendered.stats.interrupted) << phase;
    EXPECT_FALSE(rendered.denoised) << phase;
    EXPECT_EQ(rendered.not_denoised, "it was interrupted") << phase;
    ASSERT_FALSE(phases.empty());
    if (phase == "path") continue;  // and then not all samples are there
    EXPECT_EQ(rendered.image.mean.rgb, plain.image.mean.rgb) << phase;
    EXPECT_TRUE(rendered.image.variance) << phase;
  }
}

TEST(DenoisedRender, request_that_cannot_be_denoised_is_refused_before_the_render) {
  const SceneDescription scene = cornell(8, 8);
  bool rendered = false;
  RenderRequest request{.integrator = "photonmapper", .denoise = DenoiseRequest{partial_oidn}};
  request.progress = [&](double, const std::string&) { rendered = true; };
  EXPECT_TRUE(input_error_of([&] { render_scene(scene, request); }).starts_with("--denoise: error: '"));
  EXPECT_TRUE(input_error_of([&] { plan_scene(scene, request); }).starts_with("--denoise: error: '"));
  request.denoise = by_fake;
  request.view = Aov::caustics;
  EXPECT_EQ(input_error_of([&] { render_scene(scene, request); }),
            "--denoise: error: is for the whole image, not for the view 'caustics', which shows the method");
  EXPECT_FALSE(rendered);
}

// --- with the real library ---

class RealDenoiser : public testing::Test {
 protected:
  void SetUp() override {
    const char* place = std::getenv("PHOTONPROOF_OIDN");
    if (place == nullptr) GTEST_SKIP() << "PHOTONPROOF_OIDN names no Open Image Denoise";
    request_.denoise = DenoiseRequest{place};
    request_.budget.spp = 8;
  }
  Rendered render(const SceneDescription& scene, int threads = 0) const {
    RenderRequest request = request_;
    request.threads = threads;
    Rendered rendered = render_scene(scene, request);
    EXPECT_EQ(rendered.not_denoised, "");
    return rendered;
  }
  RenderRequest request_;
};

/// Even noise between two values.
Image noise(int side, float least, float most) {
  Image image(side, side);
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
    image.rgb[i] = least + (most - least) * static_cast<float>((i * 2654435761u) % 1000) / 1000;
  return image;
}

double relative_error(const Image& test, const Image& reference) {
  double sum = 0;
  for (std::size_t i = 0; i < test.rgb.size(); ++i) {
    const double r = double{reference.rgb[i]}, d = double{test.rgb[i]} - r;
    sum += d * d / (r * r + 0.01);
  }
  return sum / static_cast<double>(test.rgb.size());
}

TEST_F(RealDenoiser, error_falls_to_a_third) {
  const SceneDescription scene = cornell(64, 64);
  const Image reference = render_scene(scene, {.budget = {.spp = 512}, .seed = 9}).image.mean;
  const double noisy = relative_error(render_scene(scene, {.budget = {.spp = 8}}).image.mean, reference);
  const double filtered = relative_error(render(scene).image.mean, reference);
  std::printf("relmse of 8 samples: %.5f, denoised %.5f\n", noisy, filtered);
  EXPECT_LT(filtered, noisy / 3);
}

TEST_F(RealDenoiser, bits_do_not_depend_on_threads) {
  const SceneDescription scene = cornell(70, 50);
  const std::vector<float> one = render(scene, 1).image.mean.rgb;
  for (const int threads : {2, 7}) EXPECT_EQ(render(scene, threads).image.mean.rgb, one) << threads;
}

TEST_F(RealDenoiser, image_of_one_pixel_or_one_row_is_filtered) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(33, 1), std::pair(1, 17)}) {
    const Rendered rendered = render(cornell(width, height));
    for (const float v : rendered.image.mean.rgb) EXPECT_TRUE(std::isfinite(v) && v >= 0);
  }
}

TEST_F(RealDenoiser, radiance_in_any_unit_is_the_same_image) {
  const Image usual = noise(48, 0.1f, 0.9f);
  const Denoiser denoiser(request_.denoise->library, 2);
  const auto filtered = [&](int exponent) {
    Image image = usual;
    for (float& v : image.rgb) v = std::ldexp(v, exponent);
    Guides guides{Image(48, 48), Image(48, 48)};
    EXPECT_FALSE(denoiser.filter(image, guides, {}).has_value());
    for (float& v : image.rgb) v = std::ldexp(v, -exponent);
    return image.rgb;
  };
  EXPECT_EQ(filtered(-60), filtered(0));
  EXPECT_EQ(filtered(60), filtered(0));
}

TEST_F(RealDenoiser, firefly_and_values_that_are_not_finite_do_not_spread) {
  Image image = noise(64, 0, 1);
  for (int c = 0; c < 3; ++c) image.pixel(20, 20)[c] = 1e5f;
  image.pixel(40, 40)[1] = std::numeric_limits<float>::quiet_NaN();
  Guides guides{Image(64, 64), Image(64, 64)};
  std::ranges::fill(guides.albedo.rgb, 0.5f);
  for (std::size_t i = 2; i < guides.normal.rgb.size(); i += 3) guides.normal.rgb[i] = 1;
  EXPECT_FALSE(Denoiser(request_.denoise->library, 2).filter(image, guides, {}).has_value());
  EXPECT_LT(image.pixel(20, 20)[0], 2);
  EXPECT_TRUE(std::isnan(image.pixel(40, 40)[1]));
  for (const auto& [x, y] : {std::pair(40, 20), std::pair(41, 40), std::pair(5, 60), std::pair(60, 5)})
    EXPECT_NEAR(image.pixel(x, y)[0], 0.5f, 0.15f) << x << " " << y;
}

}  // namespace
}  // namespace photonproof::inline renderer_api
