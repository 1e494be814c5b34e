// The renderer's API as a program uses it: the same bits as the stages one by one, early stops, warnings, refusals.
#include "renderer/api/render_scene.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/test_compiled.h"
#include "scenes/base/input_error.h"
#include "scenes/files/test_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_api {
namespace {

constexpr const char* scene_text = R"(<scene version="3.0.0">
  <integrator type="path"/>
  <sensor type="perspective">
    <transform name="to_world"><lookat origin="0, 0, 4" target="0, 0, 0" up="0, 1, 0"/></transform>
    <sampler type="independent"><integer name="sample_count" value="4"/></sampler>
    <film type="hdrfilm"><integer name="width" value="24"/><integer name="height" value="16"/></film>
  </sensor>
  <shape type="rectangle"><bsdf type="diffuse"/></shape>
  <shape type="sphere">
    <point name="center" x="0" y="0" z="1.5"/><float name="radius" value="0.3"/>
    <bsdf type="dielectric"/>
  </shape>
  <shape type="sphere">
    <point name="center" x="0" y="3" z="3"/><float name="radius" value="0.5"/>
    <bsdf type="diffuse"><rgb name="reflectance" value="0"/></bsdf>
    <emitter type="area"><rgb name="radiance" value="20"/></emitter>
  </shape>
</scene>)";

class RenderScene : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    put("scene.xml", scene_text);
    scene_ = parse_scene_file((folder_ / "scene.xml").string());
  }
  std::string error_of(const RenderRequest& request) const {
    try {
      render_scene(scene_, request);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  SceneDescription scene_;
};

TEST_F(RenderScene, has_the_bits_of_plan_build_and_render_one_by_one) {
  for (const char* integrator : {"path", "photonmapper", "bdpt"}) {
    RenderJob job;
    job.budget.spp = 3;
    job.seed = 5;
    const Scene scene = test::compiled(scene_, 24, 16);
    Film film(24, 16);
    RenderStats stats;
    test::render(scene, with_integrator(scene_.integrator, integrator), job, film, stats);
    const Rendered rendered = render_scene(scene_, {.integrator = integrator, .budget = {.spp = 3}, .seed = 5});
    EXPECT_EQ(rendered.image.mean.rgb, film.develop().mean.rgb) << integrator;
    EXPECT_EQ(rendered.plan.integrator, integrator);
    EXPECT_EQ(rendered.stats.counts.at("samples_per_pixel"), 3);
    EXPECT_EQ(rendered.unsampled_pixels, 0u);
    EXPECT_EQ(rendered.non_finite_values, 0u);
  }
}

TEST_F(RenderScene, has_the_same_bits_for_any_number_of_threads) {
  const auto bits = [&](int threads) {
    return render_scene(scene_, {.integrator = "photonmapper", .threads = threads}).image.mean.rgb;
  };
  const std::vector<float> one = bits(1);
  EXPECT_EQ(bits(2), one);
  EXPECT_EQ(bits(7), one);
}

TEST_F(RenderScene, without_a_request_does_what_the_scene_asks_for) {
  const Rendered rendered = render_scene(scene_, {});
  EXPECT_EQ(rendered.plan.integrator, "path");
  EXPECT_EQ(rendered.stats.counts.at("samples_per_pixel"), 4);
  EXPECT_GT(rendered.threads, 0);
}

TEST_F(RenderScene, a_crop_is_that_part_of_the_whole_image) {
  const Rendering whole = render_scene(scene_, {}).image;
  const Rendering part = render_scene(scene_, {.crop = FilmDescription::Crop{8, 4, 10, 6}}).image;
  ASSERT_TRUE(part.place);
  EXPECT_EQ(part.place->x, 8);
  EXPECT_EQ(part.place->y, 4);
  for (int y = 0; y < 6; ++y)
    for (int x = 0; x < 10; ++x)
      for (int c = 0; c < 3; ++c)
        ASSERT_EQ(part.mean.pixel(x, y)[c], whole.mean.pixel(x + 8, y + 4)[c]) << x << " " << y;
}

TEST_F(RenderScene, a_caller_stops_it_from_its_progress) {
  std::atomic<bool> stop = false;
  int calls = 0;
  RenderRequest request{.budget = {.spp = 1 << 20}, .interrupt = &stop};
  request.progress = [&](double fraction, const std::string&) {
    EXPECT_LT(fraction, 1);
    stop = ++calls == 2;
  };
  const Rendered rendered = render_scene(scene_, request);
  EXPECT_TRUE(rendered.stats.interrupted);
  EXPECT_LT(rendered.stats.counts.at("samples_per_pixel"), 1 << 20);
}

TEST_F(RenderScene, resumes_from_a_checkpoint_to_the_bits_of_a_render_that_never_stopped) {
  const auto file = folder_ / "checkpoint";
  std::atomic<bool> stop = true;  // before the first sample
  RenderRequest request{.budget = {.spp = 8}, .interrupt = &stop};
  request.checkpoint = CheckpointPolicy{file, 60, false, {}};
  EXPECT_TRUE(render_scene(scene_, request).stats.interrupted);
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_NE(error_of(request), "");  // a new render would replace it
  request.interrupt = nullptr;
  request.checkpoint->resume = true;
  RenderRequest other = request;
  other.preset = "another";
  EXPECT_NE(error_of(other).find("its preset is none, this render's is another"), std::string::npos) << error_of(other);
  const Rendered resumed = render_scene(scene_, request);
  EXPECT_EQ(resumed.image.mean.rgb, render_scene(scene_, {.budget = {.spp = 8}}).image.mean.rgb);
  EXPECT_TRUE(std::filesystem::exists(file));  // until the caller has the image
  remove_checkpoint(file);
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(RenderScene, warnings_are_told_at_once_and_kept_in_the_stats) {
  put("point.xml", R"(<scene version="3.0.0"><sensor type="perspective">
    <transform name="to_world"><lookat origin="3, 0, 3" target="0, 0, -1" up="0, 1, 0"/></transform></sensor>
    <shape type="rectangle"><bsdf type="dielectric"/></shape>
    <shape type="rectangle"><transform name="to_world"><translate z="-1"/></transform><bsdf type="diffuse"/></shape>
    <emitter type="point"><point name="position" x="0" y="0" z="2"/></emitter></scene>)");
  scene_ = parse_scene_file((folder_ / "point.xml").string());
  scene_.sensor.film.resize(16, 16);
  std::vector<std::string> warnings;
  RenderRequest request{.integrator = "path", .budget = {.spp = 1}};
  request.warn = [&](const SceneNote& note) { warnings.push_back(note.where + ": " + note.text); };
  const Rendered rendered = render_scene(scene_, request);
  ASSERT_FALSE(warnings.empty());
  EXPECT_EQ(rendered.stats.losses, warnings);
  ASSERT_TRUE(rendered.plan.lost_light);  // a point light's caustic, which paths cannot meet
  warnings.clear();
  EXPECT_TRUE(plan_scene(scene_, request).lost_light);
}

TEST_F(RenderScene, a_request_that_cannot_be_done_is_refused_by_name) {
  EXPECT_EQ(error_of({.crop = FilmDescription::Crop{20, 0, 10, 6}}),
            "--crop: error: 20 0 10 6 is no part of the image of 24x16 pixels");
  EXPECT_EQ(error_of({.indirect = IndirectLight::cache}), "--indirect: error: does nothing with integrator 'path'");
  EXPECT_NE(
      error_of({.integrator = "pathh"}).find("--integrator: error: unknown integrator 'pathh' (did you mean 'path'?)"),
      std::string::npos);
  EXPECT_NE(error_of({.no_skip = {"everything"}}), "");
  EXPECT_NE(error_of({.isa = "v9"}), "");
}

}  // namespace
}  // namespace photonproof::inline renderer_api
