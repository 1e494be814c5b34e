// Refused scenes and jobs: the place and the words of each message.
#include "renderer/integrators/check_supported.h"

#include <gtest/gtest.h>

#include <map>

#include "renderer/integrators/test_scenes.h"
#include "renderer/photon_mapping/photon_tracing.h"
#include "scenes/description/plugin_name.h"

namespace photonproof::inline renderer_integrators {
namespace {

template <class Action>
std::string said(const Action& action) {
  try {
    action();
    return "";
  } catch (const InputError& error) {
    return error.summary();
  }
}

std::string refusal(const SceneDescription& scene, const char* integrator) {
  return said([&] { check_supported(scene, with_integrator(scene.integrator, integrator)); });
}

SceneDescription room_of_file() {
  SceneDescription scene = test::room(8, true);
  scene.files = {"room.xml"};
  return scene;
}

TEST(check_supported, lets_every_integrator_do_a_plain_room) {
  for (const Integrator& row : integrators()) EXPECT_EQ(refusal(room_of_file(), row.name), "") << row.name;
}

TEST(check_supported, knows_every_integrator_that_a_scene_file_may_name) {
  for (const char* name : plugin_names(decltype(IntegratorDescription::method)())) {
    ASSERT_NE(find_integrator(name), nullptr) << name;
    EXPECT_FALSE(find_integrator(name)->parts.empty()) << name;
  }
}

// Otherwise two integrators that are compared could have the same errors.
TEST(check_supported, integrators_draw_from_streams_of_their_own) {
  std::map<Stream, std::string> owners{
      {global_photon_stream, "photons"}, {caustic_photon_stream, "photons"}, {pilot_stream, "photons"}};
  for (const Integrator& row : integrators()) {
    const std::string owner = row.sampling != nullptr ? row.sampling : row.name;
    EXPECT_EQ(owners.try_emplace(row.stream, owner).first->second, owner) << row.name;
  }
}

TEST(check_supported, refuses_media_at_the_medium_for_integrators_that_do_none) {
  for (const char* integrator : {"path", "direct", "photonmapper"}) {
    SceneDescription scene = room_of_file();
    scene.media.push_back({{0, 7, 3}, "fog", HomogeneousDescription{}});
    EXPECT_EQ(refusal(scene, integrator), "") << "nothing is in it";
    const std::string expected =
        "room.xml:7:3: error: integrator '" + std::string(integrator) + "' does not do media: use 'volpath'";
    scene.shapes[2].exterior = MediumIndex{0};
    EXPECT_EQ(refusal(scene, integrator), expected);
    scene.shapes[2].exterior.reset();
    scene.sensor.medium = MediumIndex{0};
    EXPECT_EQ(refusal(scene, integrator), expected);
    scene.sensor.medium.reset();
    scene.groups.push_back({{}, "g", {scene.shapes[0]}});
    scene.groups[0].shapes[0].interior = MediumIndex{0};
    EXPECT_EQ(refusal(scene, integrator), expected);
  }
}

TEST(check_supported, refuses_media_that_vary_for_integrators_of_light_paths) {
  SceneDescription scene = room_of_file();
  scene.media.push_back({{0, 7, 3}, "cloud", HeterogeneousDescription{RgbD(1), RgbD(0), 1, {}}});
  scene.sensor.medium = MediumIndex{0};
  for (const char* integrator : {"bdpt", "ptracer"})
    EXPECT_EQ(refusal(scene, integrator), "room.xml:7:3: error: integrator '" + std::string(integrator) +
                                              "' does not do media that vary: use 'volpath'");
  EXPECT_EQ(refusal(scene, "volpath"), "");
}

TEST(check_supported, refuses_media_in_which_no_path_ends) {
  // The unit cube is 3 long along its edges: the bound is an extinction of 1e6 / 3.
  SceneDescription scene = room_of_file();
  scene.media.push_back({{0, 7, 3}, "cloud", HeterogeneousDescription{RgbD(1e6), RgbD(0), 1, {}}});
  scene.sensor.medium = MediumIndex{0};
  EXPECT_EQ(refusal(scene, "volpath"),
            "room.xml:7:3: error: the medium is up to 3e+06 mean free paths across, expected at most 1e6: light would "
            "collide too often to be followed");
  std::get<HeterogeneousDescription>(scene.media[0].model).scale = 0.3;
  EXPECT_EQ(refusal(scene, "volpath"), "");
}

TEST(check_supported, refuses_priorities_at_the_dielectric) {
  SceneDescription scene = room_of_file();
  DielectricDescription water;
  water.priority = 2;
  scene.bsdfs.push_back({{0, 4, 5}, "water", water});
  EXPECT_EQ(refusal(scene, "path"),
            "room.xml:4:5: error: integrator 'path' does not do priorities of dielectrics: use 'volpath'");
}

TEST(check_supported, refuses_direct_light_without_a_sample) {
  SceneDescription scene = room_of_file();
  DirectDescription direct;
  direct.emitter_samples = direct.bsdf_samples = 0;
  scene.integrator = {{0, 2, 1}, direct};
  EXPECT_EQ(refusal(scene, "direct"),
            "room.xml:2:1: error: emitter_samples and bsdf_samples must not be negative, nor both 0");
}

TEST(check_job, refuses_options_that_would_do_nothing) {
  RenderJob job;
  const auto refusal_of = [&](const char* integrator) {
    return said([&] { check_job(job, with_integrator({}, integrator)); });
  };
  EXPECT_EQ(refusal_of("path"), "");
  job.budget.photons = 1000;
  EXPECT_EQ(refusal_of("path"), "--photons: error: does nothing with integrator 'path', which stores no photons");
  EXPECT_EQ(refusal_of("photonmapper"), "");
  job.budget.seconds = 1;
  EXPECT_EQ(refusal_of("photonmapper"),
            "--photons: error: does nothing with --seconds, which decides how many there are");
}

TEST(check_job, refuses_views_of_integrators_without_photon_maps) {
  RenderJob job;
  job.view = Aov::caustics;
  for (const Integrator& row : integrators()) {
    const bool has_maps = row.name == std::string("photonmapper") || row.name == std::string("sppm");
    EXPECT_EQ(said([&] { check_job(job, with_integrator({}, row.name)); }),
              has_maps ? ""
                       : "--view: error: does nothing with integrator '" + std::string(row.name) +
                             "', which makes no photon maps");
  }
  job.grid = 2;
  EXPECT_EQ(said([&] { check_job(job, with_integrator({}, "photonmapper")); }), "");
  job.view = Aov::cache_records;
  EXPECT_EQ(said([&] { check_job(job, with_integrator({}, "photonmapper")); }), "");
  EXPECT_EQ(said([&] { check_job(job, with_integrator({}, "sppm")); }),
            "--view cache-records: error: does nothing with integrator 'sppm', which has no irradiance cache");
  job.view = Aov::photons;
  EXPECT_EQ(said([&] { check_job(job, with_integrator({}, "photonmapper")); }),
            "--grid: error: does nothing with --view photons, which takes no camera samples");
}

TEST(check_job, refuses_a_target_error_where_the_error_is_not_known_until_the_end) {
  RenderJob job;
  job.budget.target_error = 0.1;
  for (const char* name : {"path", "photonmapper", "sppm"})
    EXPECT_EQ(said([&] { check_job(job, with_integrator({}, name)); }), "") << name;
  EXPECT_EQ(said([&] { check_job(job, with_integrator({}, "bdpt")); }),
            "--target-error: error: integrator 'bdpt' cannot estimate its own error: give it another budget and "
            "compare its image");
}

TEST(with_integrator, keeps_what_all_integrators_know) {
  const IntegratorDescription asked{{0, 3, 4}, PathDescription{{7, 3, true}}};
  for (const char* name : {"path", "photonmapper", "volpath", "bdpt", "ptracer", "direct", "whitted", "sppm"}) {
    const IntegratorDescription other = with_integrator(asked, name);
    EXPECT_EQ(integrator_name(other), name);
    EXPECT_EQ(other.limits(), (PathLimits{7, 3, true})) << name;
    EXPECT_EQ(other.loc, asked.loc);
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
