// The photon mapper against closed forms and against the path tracer.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

#include "renderer/integrators/test_scenes.h"
#include "renderer/photon_mapping/photon_radius.h"

namespace photonproof::inline renderer_photon_mapping {
namespace {

using test::job_with;
using test::render;

TEST(photon_mapper, furnace_mean_and_blocks_are_two) {
  const auto out = render(test::furnace(0.5, 1, 32), "photonmapper", job_with(16, 2'000'000));
  EXPECT_NEAR(test::image_mean(out.image.mean), 2.0, 0.005 * 2);
  for (int y = 0; y < 32; y += 8)
    for (int x = 0; x < 32; x += 8)
      EXPECT_NEAR(test::block_mean(out.image.mean, x, y, 8, 8), 2.0, 0.02 * 2) << x << ", " << y;
}

TEST(photon_mapper, depth_counts_camera_and_light_edges_together) {
  // As for the path tracer, the sum is emission plus one and two bounces: 1 + 0.5 + 0.25 = 1.75.
  SceneDescription scene = test::furnace(0.5, 1, 16);
  scene.integrator.method = PathDescription{3, 24, false};
  const auto out = render(scene, "photonmapper", job_with(16, 1'000'000));
  EXPECT_NEAR(test::image_mean(out.image.mean), 1.75, 0.005 * 1.75);
}

TEST(photon_mapper, a_single_plane_needs_no_map) {
  const auto out = render(test::floor_under_point_light(16), "photonmapper", job_with(4));
  EXPECT_THAT(out.stats.skipped, testing::IsSupersetOf({"global-map: no two diffuse surfaces see each other",
                                                        "caustic-map: no specular surface"}));
  EXPECT_EQ(out.stats.counts.at("rays_photon"), 0);
}

TEST(photon_mapper, says_when_few_photons_arrive_where_the_camera_looks) {
  // A light between two planes lights them. At (1000, 0, 0), between two other planes and behind a wall, no light
  // arrives.
  SceneDescription d = test::floor_under_point_light(16);
  const auto facing_down = [](double x) { return Transform::translate({x, 6, 0}) * Transform::rotate({1, 0, 0}, 90); };
  const auto facing_up = Transform::translate({1000, 0, 0}) * Transform::rotate({1, 0, 0}, -90);
  test::add_shape(d, RectangleDescription{}, facing_down(0), {0});
  test::add_shape(d, RectangleDescription{}, facing_down(1000), {0});
  test::add_shape(d, RectangleDescription{}, facing_up, {0});
  test::add_shape(d, RectangleDescription{},
                  Transform::translate({990, 0, 0}) * Transform::rotate({0, 1, 0}, 90) * Transform::scale(Vec3d(20)),
                  {0});
  const RenderJob job = job_with(4, 400'000);
  const auto near = render(d, "photonmapper", job);
  EXPECT_THAT(near.stats.losses, testing::IsEmpty());
  EXPECT_GT(near.stats.counts.at("photons_in_disc_global"), 10);
  test::set_camera(d, Transform::look_at({1000, 2, 0.1}, {1000, 0, 0}, {0, 0, 1}), 20, 16);
  const auto far = render(d, "photonmapper", job);
  EXPECT_LT(far.stats.counts.at("photons_in_disc_global"), 10);
  EXPECT_THAT(far.stats.losses, testing::ElementsAre(testing::HasSubstr("too few arrive where the camera looks")));
}

// Most gathers miss caustics, however many photons there are. The photons around photons show whether a radius is too
// narrow.
TEST(photon_mapper, says_where_a_given_radius_of_caustics_is_too_narrow) {
  for (const IndirectLight indirect : {IndirectLight::map, IndirectLight::gather, IndirectLight::cache}) {
    const auto losses = [&](double radius) {
      SceneDescription room = test::room(16, true);
      PhotonMapperDescription method;
      method.indirect = indirect;
      method.caustic_radius = radius;
      room.integrator.method = method;
      return render(room, "photonmapper", job_with(8)).stats.losses;
    };
    EXPECT_THAT(losses(0), testing::IsEmpty()) << word_of(indirect);
    EXPECT_THAT(losses(0.1), testing::IsEmpty()) << word_of(indirect);
    EXPECT_THAT(losses(1e-4), testing::Contains(testing::HasSubstr("within 0.0001 of one of them")))
        << word_of(indirect);
  }
}

// The radius is too narrow to hold photons. The map has fewer than a thousand photons, which are a few per cent of
// those emitted.
TEST(photon_mapper, says_when_few_arrive_of_a_small_map_that_matters) {
  SceneDescription d = test::floor_under_point_light(16);
  const auto facing_down =
      Transform::translate({0, 6, 0}) * Transform::rotate({1, 0, 0}, 90) * Transform::scale(Vec3d(2));
  test::add_shape(d, RectangleDescription{}, facing_down, {0});
  PhotonMapperDescription method;
  method.global_radius = 1e-6;
  d.integrator.method = method;
  const auto small = render(d, "photonmapper", job_with(4, 20'000));
  const double stored = small.stats.counts.at("photons_stored_global");
  EXPECT_LT(stored, 1000);
  EXPECT_GT(stored, 200);
  EXPECT_THAT(small.stats.losses, testing::ElementsAre(testing::HasSubstr("too few arrive where the camera looks")));
}

TEST(photons_around_one, are_those_of_its_surface_within_the_radius) {
  Photons photons;
  for (const std::uint32_t surface : {0u, 1u})
    for (const float x : {0.0f, 10.0f})
      for (int i = 0; i < 5; ++i) {
        Photon photon;
        photon.p_world = {x, 0.25f * static_cast<float>(i), 0};
        photon.surface = surface;
        photons.push_back(photon);
      }
  const Threads threads(2);
  EXPECT_DOUBLE_EQ(photons_around_one(photons, 0.1f, threads), 0);
  EXPECT_DOUBLE_EQ(photons_around_one(photons, 0.3f, threads), 8 / 5.0);  // 1, 2, 2, 2, 1
  EXPECT_DOUBLE_EQ(photons_around_one(photons, 2, threads), 4);
  EXPECT_DOUBLE_EQ(photons_around_one(photons, 20, threads), 9);
  EXPECT_DOUBLE_EQ(photons_around_one(Photons{}, 1, threads), 0);
}

TEST(photon_mapper, says_where_radii_are_wider_than_what_is_seen_and_where_photons_are_few) {
  using testing::ElementsAre;
  using testing::HasSubstr;
  using testing::IsEmpty;
  for (const IndirectLight indirect : {IndirectLight::map, IndirectLight::gather, IndirectLight::cache}) {
    const auto losses = [&](double radius, std::int64_t photons) {
      const SceneDescription room = test::with_indirect(test::room(16, false), indirect, radius);
      return render(room, "photonmapper", job_with(8, photons)).stats.losses;
    };
    EXPECT_THAT(losses(0.2, 200'000), IsEmpty()) << word_of(indirect);
    EXPECT_THAT(losses(10, 10'000), ElementsAre(HasSubstr("global photons are looked up within 10")))
        << word_of(indirect);
    EXPECT_THAT(losses(0, 20), ElementsAre(HasSubstr("of 20 photons"))) << word_of(indirect);
  }
}

TEST(photon_mapper, says_that_fixed_radii_have_much_wrong_unless_an_error_is_asked_for) {
  const auto rendered = [](double radius, const RenderJob& job) {
    return render(test::with_indirect(test::room(16, true), IndirectLight::map, radius), "photonmapper", job).stats;
  };
  const RenderJob job = job_with(16, 50'000);
  EXPECT_THAT(rendered(0.1, job).losses, testing::IsEmpty());
  const RenderStats wide = rendered(0.5, job);
  EXPECT_GT(wide.counts.at("relative_bias"), 0.1);
  char text[160];
  std::snprintf(
      text, sizeof text,
      "the radii that the scene fixes have some %.2g %% of the image wrong, which does not fall with more samples",
      100 * wide.counts.at("relative_bias"));
  EXPECT_THAT(wide.losses, testing::ElementsAre(text));
  RenderJob rough = job;
  rough.budget = {};
  rough.budget.target_error = 0.5;
  EXPECT_THAT(rendered(0.5, rough).losses, testing::IsEmpty());
}

TEST(photon_mapper, skipping_the_maps_of_a_plane_changes_nothing) {
  // A distant second plane facing the first requires the maps, yet adds hardly any light. E of the far plane is
  // I/d^2 = 1e-4. Its albedo and its solid angle over pi, 0.5 x 4/(pi 1e4), reduce that to 6e-9, where the light gives
  // 0.25. So the images differ by rounding alone.
  const SceneDescription alone = test::floor_under_point_light(16);
  SceneDescription together = alone;
  test::add_shape(together, RectangleDescription{}, Transform::translate({0, 98, 0}) * Transform::rotate({1, 0, 0}, 90),
                  {0});
  const auto a = render(alone, "photonmapper", job_with(4));
  const auto b = render(together, "photonmapper", job_with(4));
  EXPECT_GT(b.stats.counts.at("rays_photon"), 0);
  for (std::size_t i = 0; i < a.image.mean.rgb.size(); ++i)
    EXPECT_NEAR(a.image.mean.rgb[i], b.image.mean.rgb[i], 1e-5f * a.image.mean.rgb[i]);
}

/// The room with the light out of view: its few bright pixels would carry most of the mean's noise.
SceneDescription room_without_light_pixels(bool with_balls) {
  SceneDescription scene = test::room(32, with_balls);
  scene.integrator.method = PathDescription{-1, 5, true};
  return scene;
}

TEST(photon_mapper, diffuse_room_has_the_path_tracers_mean) {
  const SceneDescription scene = room_without_light_pixels(false);
  const double path = test::image_mean(render(scene, "path", job_with(256)).image.mean);
  const double photons = test::image_mean(render(scene, "photonmapper", job_with(32, 1'000'000)).image.mean);
  EXPECT_NEAR(photons, path, 0.005 * path);
}

TEST(photon_mapper, room_with_glass_and_mirror_has_the_path_tracers_mean) {
  const SceneDescription scene = room_without_light_pixels(true);
  const double path = test::image_mean(render(scene, "path", job_with(1024)).image.mean);
  const double photons = test::image_mean(render(scene, "photonmapper", job_with(32, 1'000'000)).image.mean);
  EXPECT_NEAR(photons, path, 0.015 * path);
}

// Between diffuse bounces in a sphere photons land evenly over it, wherever they come from. In a furnace of albedo 1/2,
// N paths store N photons on average. A gather of radius r in a sphere of radius 1 finds a share r^2/4 of them. Their
// number is Poisson distributed up to terms of that share. The indirect radiance, 1/2, thus has the relative variance
// 1 / (N r^2/4). Emission and direct light are the same in every sample here. With 30 disjoint discs and 40 seeds the
// images' spread is known to 4 % (5 deviations are allowed here). With 16 passes the claimed variances are known to
// 1 %. Photons that ignore the seed leave no spread; passes that repeat photons make the claimed variance 0.
TEST(photon_mapper, images_of_other_seeds_differ_as_much_as_the_claimed_variance_and_the_photons_number_say) {
  constexpr int seeds = 40;
  constexpr double photons = 8000, radius = 0.15;
  SceneDescription furnace = test::furnace(0.5, 1, 16);
  PhotonMapperDescription settings;
  settings.max_depth = -1;
  settings.rr_depth = 24;
  settings.global_radius = radius;
  furnace.integrator.method = settings;
  RenderJob job = job_with(16, static_cast<std::int64_t>(photons));
  job.sampler = SamplerKind::independent;
  constexpr std::size_t values = 16 * 16 * 3;
  std::vector<double> sum(values), squares(values);
  double claimed = 0;
  for (int seed = 0; seed < seeds; ++seed) {
    job.seed = static_cast<std::uint64_t>(seed);
    const auto out = render(furnace, "photonmapper", job);
    for (std::size_t i = 0; i < values; ++i) {
      const double value = double{out.image.mean.rgb[i]};
      sum[i] += value;
      squares[i] += value * value;
      claimed += double{out.image.variance->rgb[i]} / (seeds * values);
    }
  }
  double spread = 0;
  for (std::size_t i = 0; i < values; ++i) spread += (squares[i] - sum[i] * sum[i] / seeds) / (seeds - 1) / values;
  const double expected = 0.25 / (photons * radius * radius / 4);
  std::printf("variance over what the number of photons says: %.3f by seeds, %.3f claimed\n", spread / expected,
              claimed / expected);
  EXPECT_NEAR(spread / expected, 1, 0.2);
  EXPECT_NEAR(claimed / expected, 1, 0.05);
}

TEST(photon_mapper, same_seed_gives_the_same_bits_at_1_2_and_7_threads) {
  test::expect_same_bits_at_any_threads(test::room(40, true), "photonmapper", job_with(8, 30'000));
}

TEST(photon_mapper, emits_the_photons_asked_for) {
  const auto out = render(test::room(16, true), "photonmapper", job_with(7, 100'003));
  EXPECT_EQ(out.stats.counts.at("photons_emitted_global"), 100'003);
  EXPECT_EQ(out.stats.counts.at("photons_emitted_caustic"), 100'003);
  EXPECT_GT(out.stats.counts.at("photons_stored_caustic"), 0);
}

/// The error message of a refused render, with "N" for the number of photons that this machine can hold.
std::string refusal(const SceneDescription& scene, const RenderJob& job) {
  try {
    render(scene, "photonmapper", job);
    return "";
  } catch (const InputError& error) {
    std::string text = error.summary();
    const std::size_t from = text.find("more than ") + 10;
    return text.replace(from, text.find(',', from) - from, "N");
  }
}

TEST(photon_mapper, refuses_more_photons_in_a_pass_than_memory_holds) {
  // 4e12 photons over four passes of a sample each.
  EXPECT_EQ(refusal(test::room(4, false), job_with(4, 4'000'000'000'000)),
            "--photons: error: 1000000000000 in one pass are more than N, what this machine's memory holds; more "
            "samples a pixel make more passes");
  SceneDescription room = test::room(4, false);
  room.integrator = with_integrator(room.integrator, "photonmapper");
  std::get<PhotonMapperDescription>(room.integrator.method).global_photons = 1'000'000'000'000;
  RenderJob job = job_with(4, 1);
  job.budget.photons.reset();
  job.integrator_place = "room.xml:2:3";
  EXPECT_EQ(refusal(room, job),
            "room.xml:2:3: error: global_photons: 250000000000 in one pass are more than N, what this machine's memory "
            "holds; more samples a pixel make more passes");
}

TEST(sppm, radius_shrinks_as_knaus_and_zwicker_have_it) {
  // r^2 of pass i + 1 is (i + a)/(i + 1) of that of pass i: after 9 passes of a = 1/2 the next one's is
  // (3/4)(5/6) ... (19/20) of the first.
  SceneDescription furnace = test::furnace(0.5, 1, 16);
  SppmDescription settings;
  settings.photons = 1000;
  settings.radius = 0.2;
  settings.alpha = 0.5;
  furnace.integrator.method = settings;
  RenderJob job = job_with(9);
  const auto out = render(furnace, "sppm", job);
  double square = 0.04;
  for (int i = 1; i <= 9; ++i) square *= (i + 0.5) / (i + 1);
  EXPECT_NEAR(out.stats.counts.at("radius_global"), std::sqrt(square), 1e-6);
  EXPECT_EQ(out.stats.counts.at("photons_emitted_global"), 9000);
  EXPECT_EQ(out.stats.counts.at("passes"), 9);
}

}  // namespace
}  // namespace photonproof::inline renderer_photon_mapping
