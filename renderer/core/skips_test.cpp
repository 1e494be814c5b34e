// Work that a plan skips must not change the image.

#include "renderer/core/skips.h"

#include <gtest/gtest.h>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/plan.h"
#include "renderer/planning/test_compiled.h"

namespace photonproof::inline renderer_core {
namespace {

Rendering render_without(const SceneDescription& description, const char* integrator,
                         const std::vector<std::string>& switched_off) {
  RenderJob job = test::job_with(8, 20'000);
  job.skips = SkipSwitches(switched_off);
  const FilmDescription size = description.sensor.film;
  const Scene scene = test::compiled(description, size.width, size.height, job.skips);
  Film film(size.width, size.height);
  RenderStats stats;
  test::render(scene, with_integrator(description.integrator, integrator), job, film, stats);
  return film.develop();
}

std::vector<SceneDescription> scenes() {
  return {test::room(24, false), test::room(24, true), test::floor_under_point_light(24), test::furnace(0.5, 1, 24)};
}

TEST(skips, each_switched_off_alone_leaves_every_bit_of_the_image) {
  for (const SceneDescription& scene : scenes()) {
    for (const char* integrator : {"path", "photonmapper"}) {
      const Rendering with_all = render_without(scene, integrator, {});
      for (const SkipRow& row : skip_table()) {
        if (row.skip == Skip::bvh || row.skip == Skip::stray_photons)
          continue;  // other arithmetic, other photons: below
        EXPECT_EQ(render_without(scene, integrator, {row.name}).mean.rgb, with_all.mean.rgb)
            << integrator << ' ' << row.name;
      }
    }
  }
}

TEST(skips, embree_and_the_packed_kernel_give_the_same_image_up_to_rounding) {
  // Rounding moves a few paths across an edge; those differ completely, the others in the last digits.
  for (const SceneDescription& scene : scenes()) {
    const Rendering packed = render_without(scene, "path", {});
    const Rendering embree = render_without(scene, "path", {"bvh"});
    int different = 0;
    for (std::size_t i = 0; i < packed.mean.rgb.size(); ++i) {
      const float a = packed.mean.rgb[i], b = embree.mean.rgb[i];
      if (std::abs(a - b) > 1e-4f * (std::abs(a) + std::abs(b))) ++different;
    }
    EXPECT_LT(different, static_cast<int>(packed.mean.rgb.size() / 50));
    EXPECT_NEAR(test::image_mean(packed.mean), test::image_mean(embree.mean), 5e-3 * test::image_mean(packed.mean));
  }
}

TEST(skips, photons_aimed_at_specular_surfaces_bring_the_same_light_as_all) {
  // Means over seeds of the image and of the floor, where the caustics are, agree within 4 standard errors of their
  // difference. One ball inside the other's cone, so that cones overlap.
  SceneDescription scene = test::room(24, true);
  test::add_shape(scene, SphereDescription{{0.3, 0.0, 0.2}, 0.3}, {}, scene.shapes[6].bsdf);
  constexpr int seeds = 12;
  double mean[2][2] = {}, variance[2][2] = {};
  double stored[2] = {};
  for (int off = 0; off < 2; ++off) {
    std::vector<double> whole, floor;
    for (int seed = 1; seed <= seeds; ++seed) {
      RenderJob job = test::job_with(16, 50'000, static_cast<std::uint64_t>(seed));
      if (off == 1) job.skips = SkipSwitches({"stray-photons"});
      const Scene compiled = test::compiled(scene, 24, 24, job.skips);
      Film film(24, 24);
      RenderStats stats;
      test::render(compiled, with_integrator(scene.integrator, "photonmapper"), job, film, stats);
      const Image image = film.develop().mean;
      whole.push_back(test::image_mean(image));
      floor.push_back(test::block_mean(image, 4, 18, 16, 5));
      stored[off] += stats.counts["photons_stored_caustic"];
    }
    for (const auto& [values, which] : {std::pair{&whole, 0}, std::pair{&floor, 1}}) {
      for (const double v : *values) mean[off][which] += v / seeds;
      for (const double v : *values)
        variance[off][which] += (v - mean[off][which]) * (v - mean[off][which]) / (seeds - 1) / seeds;
    }
  }
  for (const int which : {0, 1})
    EXPECT_NEAR(mean[0][which], mean[1][which], 4 * std::sqrt(variance[0][which] + variance[1][which])) << which;
  EXPECT_GT(stored[0], 3 * stored[1]);
}

TEST(skips, lights_chosen_by_place_bring_the_same_light_as_those_chosen_by_flux) {
  // 20 lights, more than are chosen from a table, in a row over a floor: means over seeds agree within 4 standard
  // errors of their difference.
  SceneDescription scene = test::floor_under_point_light(16);
  scene.emitters.clear();
  for (int i = 0; i < 20; ++i)
    scene.emitters.push_back({{}, "", PointLightDescription{{0.5 * i - 4.75, 0.5, 0}, RgbD(1)}});
  constexpr int seeds = 12;
  double mean[2] = {}, variance[2] = {};
  for (int off = 0; off < 2; ++off) {
    std::vector<double> means;
    for (int seed = 1; seed <= seeds; ++seed) {
      RenderJob job = test::job_with(16, 0, static_cast<std::uint64_t>(seed));
      if (off == 1) job.skips = SkipSwitches({"far-lights"});
      means.push_back(test::image_mean(test::render(scene, "path", job).image.mean));
    }
    for (const double v : means) mean[off] += v / seeds;
    for (const double v : means) variance[off] += (v - mean[off]) * (v - mean[off]) / (seeds - 1) / seeds;
  }
  EXPECT_NEAR(mean[0], mean[1], 4 * std::sqrt(variance[0] + variance[1]));
  EXPECT_NE(mean[0], mean[1]) << "the switch does nothing";
}

TEST(skips, the_plan_says_what_the_scene_does_not_need_and_why) {
  const SceneDescription description = test::floor_under_point_light(8);
  const SceneFacts facts = analyse(SceneParts(description, 8, 8));
  RenderJob job;
  job.isa = "scalar";
  const IntegratorDescription mapper = with_integrator(description.integrator, "photonmapper");
  EXPECT_EQ(
      plan_text(plan_render(facts, mapper, job)),
      "photonmapper, kernels scalar (1 lane)\n"
      "runs\n"
      "  camera paths        to their first diffuse surface, where photons are looked up, once for all samples of a "
      "pixel "
      "that end alike; paths of any length\n"
      "  more camera paths   up to 64 times as many in pixels whose earlier passes disagree\n"
      "  rays                packed kernel over all primitives\n"
      "skips\n"
      "  global-map          the global photon map: no two diffuse surfaces see each other\n"
      "  caustic-map         the caustic photon map: no specular surface\n"
      "  camera-pilot        samples beforehand that find where lights are rarely seen: no mirror and no smooth glass\n"
      "  bvh                 Embree and its hierarchy: 1 primitive, tested one after the other\n"
      "  bsdf-groups         sorting lanes by the kind of their BSDF: all BSDFs are of one kind\n"
      "  surface-detail      texture coordinates, shading normals and nested BSDFs of every hit: no textures, shading "
      "normals, tangents or nested BSDFs\n"
      "  light-choice        the random choice among lights: 1 light\n"
      "  shadow-rays         shadow rays to lights that a cosine of 0 hides: where the light or the BSDF gives "
      "nothing, none is traced\n"
      "  mis                 weights against lights that rays meet by themselves: every light is a point, no ray can "
      "hit one\n");
}

TEST(skips, a_switch_that_is_off_is_in_the_plan) {
  const SceneDescription description = test::floor_under_point_light(8);
  RenderJob job;
  job.skips = SkipSwitches({"mis"});
  const RenderPlan plan =
      plan_render(analyse(SceneParts(description, 8, 8)), with_integrator(description.integrator, "path"), job);
  EXPECT_FALSE(plan.skips(Skip::mis));
  EXPECT_NE(plan_text(plan).find("switched off by --no-skip, though every light is a point"), std::string::npos);
}

TEST(skips, fewer_shadow_rays_are_traced_where_cosines_hide_the_light) {
  const SceneDescription description = test::room(16, true);
  const auto shadow_rays = [&](const std::vector<std::string>& off) {
    RenderJob job = test::job_with(4);
    job.skips = SkipSwitches(off);
    const Scene scene = test::compiled(description, 16, 16, job.skips);
    Film film(16, 16);
    RenderStats stats;
    test::render(scene, with_integrator(description.integrator, "path"), job, film, stats);
    return stats.counts["rays_shadow"];
  };
  EXPECT_LT(shadow_rays({}), 0.95 * shadow_rays({"shadow-rays"}));
}

TEST(skips, an_unknown_name_is_refused_with_the_known_ones) {
  try {
    SkipSwitches({"bhv"});
    FAIL();
  } catch (const InputError& e) {
    EXPECT_STREQ(
        e.what(),
        "--no-skip: error: there is no skip 'bhv', expected one of bvh, mis, light-choice, far-lights, direct-light, "
        "bsdf-groups, shadow-rays, global-map, caustic-map, stray-photons, camera-pilot, surface-detail, all");
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_core
