// Renders that are stopped at any unit and resumed, for every integrator of the table, inside one process. They stop
// after given numbers of units, at other thread counts, any number of times. The program's test kills the real one.
#include "renderer/passes/render_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <limits>
#include <thread>

#include "renderer/integrators/test_scenes.h"
#include "renderer/planning/test_compiled.h"
#include "scenes/files/test_folder.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline renderer_passes {
namespace {

class Resume : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    file_ = folder_ / "a.checkpoint";
  }

  CheckpointPolicy policy(bool resume, double interval_seconds = 1e6) const {
    return {file_, interval_seconds, resume, {{"scene", "room"}}};
  }
  static Film film_of(const SceneDescription& scene) { return {scene.sensor.film.width, scene.sensor.film.height}; }

  struct Outcome {
    Rendering image;
    RenderStats stats;
  };
  /// Renders until `progress` was called `calls` times, then interrupts; -1: to the end. With `after_each_unit`
  /// every call waits so long that the next unit calls again.
  Outcome part(const SceneDescription& description, const std::string& integrator, RenderJob job, bool resume,
               int calls, bool after_each_unit = false) const {
    const Scene scene = test::compiled(description, description.sensor.film.width, description.sensor.film.height);
    std::atomic<bool> stop{false};
    job.interrupt = &stop;
    job.checkpoint = policy(resume);
    job.progress = [&](double, const std::string&) {
      if (after_each_unit) std::this_thread::sleep_for(std::chrono::milliseconds(110));
      stop = stop || --calls == 0;
    };
    Film film = film_of(description);
    Outcome out;
    test::render(scene, with_integrator(description.integrator, integrator), job, film, out.stats);
    out.image = film.develop();
    return out;
  }
  /// Stops at the progress call of that number, and resumes with another number of threads, until the render is
  /// complete: at least three times.
  Outcome in_parts(const SceneDescription& description, const std::string& integrator, RenderJob job, int calls) const {
    int stops = 0;
    Outcome last = part(description, integrator, job, false, calls);
    for (; last.stats.interrupted && stops < 100; ++stops) {
      job.threads = 1 + stops % 7;
      // On a busy machine the phases before the first pass make calls, too: parts then grow until one gets further.
      last = part(description, integrator, job, true, calls + stops / 8);
    }
    EXPECT_LT(stops, 100) << integrator;
    EXPECT_GE(stops, 3) << integrator;
    return last;
  }
  static RenderJob job_of(const Integrator& row) {
    RenderJob job = test::job_with(24, 30'000);
    if (!row.heeds.photons) job.budget.photons.reset();
    return job;
  }
  /// Expects the bits and counts of both to be the same, and returns those in parts.
  Outcome whole_and_in_parts(const SceneDescription& scene, const std::string& integrator, RenderJob job,
                             const std::string& name) const {
    job.threads = 2;
    const test::Rendered whole = test::render(scene, integrator.c_str(), job);
    const Outcome parts = in_parts(scene, integrator, job, 2);
    EXPECT_EQ(parts.image.mean.rgb, whole.image.mean.rgb) << name;
    EXPECT_EQ(parts.image.variance->rgb, whole.image.variance->rgb) << name;
    EXPECT_EQ(parts.image.metadata, whole.image.metadata) << name;  // the MeanError
    for (const auto& [count, value] : whole.stats.counts)
      EXPECT_EQ(parts.stats.counts.at(count), value) << name << " " << count;
    return parts;
  }
  std::string problem(const SceneDescription& description, const std::string& integrator, const RenderJob& job) const {
    try {
      part(description, integrator, job, true, -1);
      return "";
    } catch (const InputError& error) {
      return error.summary().substr((file_.string() + ": error: the checkpoint is not one of this render: ").size());
    }
  }

  std::filesystem::path file_;
};

TEST_F(Resume, gives_the_bits_and_the_counts_of_a_render_never_stopped) {
  for (const Integrator& row : integrators()) whole_and_in_parts(test::room(48, true), row.name, job_of(row), row.name);
}

TEST_F(Resume, of_samples_of_negative_lobes_gives_the_bits_and_the_counts_of_a_render_never_stopped) {
  SceneDescription scene = test::room(48, true);
  scene.sensor.film.filter = {.kind = ReconstructionFilter::Kind::lanczos};
  for (const Integrator& row : integrators())
    // m is 0.42, and 24 times m / (1 + m) is 7.1.
    EXPECT_GE(whole_and_in_parts(scene, row.name, job_of(row), row.name).stats.counts.at("negative_samples_per_pixel"),
              8)
        << row.name;
}

TEST_F(Resume, of_a_view_gives_the_bits_of_a_render_never_stopped) {
  for (const Aov view : {Aov::caustics, Aov::photons, Aov::radius, Aov::samples}) {
    RenderJob job = test::job_with(24, 300'000);
    job.view = view;
    whole_and_in_parts(test::room(48, true), "photonmapper", job, aov_row(view).name);
  }
}

TEST_F(Resume, of_the_photon_mapper_goes_on_inside_a_pass) {
  const SceneDescription scene = test::room(32, true);
  for (const Aov view : {Aov::whole, Aov::photons}) {
    RenderJob job = test::job_with(3, 24'000);
    job.view = view;
    job.threads = 1;
    const test::Rendered whole = test::render(scene, "photonmapper", job);
    int stops = 0;
    Outcome last = part(scene, "photonmapper", job, false, 2, true);
    for (; last.stats.interrupted; ++stops) {
      ASSERT_LT(stops, 100);
      last = part(scene, "photonmapper", job, true, 2, true);
    }
    EXPECT_GE(stops, 6) << "passes are not cut";
    EXPECT_EQ(last.image.mean.rgb, whole.image.mean.rgb);
    EXPECT_EQ(last.image.variance->rgb, whole.image.variance->rgb);
    for (const auto& [name, count] : whole.stats.counts) EXPECT_EQ(last.stats.counts.at(name), count) << name;
  }
}

TEST_F(Resume, of_every_kind_of_indirect_light_gives_the_bits_of_a_render_never_stopped) {
  for (const IndirectLight indirect : {IndirectLight::gather, IndirectLight::cache, IndirectLight::path}) {
    const SceneDescription scene = test::with_indirect(test::room(48, true), indirect);
    RenderJob job = test::job_with(12, 30'000);
    const test::Rendered whole = test::render(scene, "photonmapper", job);
    const Outcome last = in_parts(scene, "photonmapper", job, 3);
    EXPECT_EQ(last.image.mean.rgb, whole.image.mean.rgb);
    EXPECT_EQ(last.image.variance->rgb, whole.image.variance->rgb);
  }
}

TEST_F(Resume, of_fewer_or_more_samples_is_for_passes_that_the_whole_render_makes) {
  const SceneDescription scene = test::room(32, false);
  // Passes of 1, 1, 2, 4 and 8 samples and so on: the third progress call, at the start of the third pass, stops it.
  RenderJob job = test::job_with(11);
  job.budget.photons.reset();
  const Outcome stopped = part(scene, "path", job, false, 3);
  ASSERT_TRUE(stopped.stats.interrupted);
  const std::filesystem::path kept = folder_ / "kept";
  std::filesystem::copy_file(file_, kept);
  for (const int spp : {4, 9, 64}) {
    std::filesystem::copy_file(kept, file_, std::filesystem::copy_options::overwrite_existing);
    job.budget.spp = spp;
    EXPECT_EQ(part(scene, "path", job, true, -1).image.mean.rgb, test::render(scene, "path", job).image.mean.rgb)
        << spp;
  }
  job.budget.spp = 1;
  EXPECT_NE(problem(scene, "path", job).find("in a pass that --spp 1 does not make"), std::string::npos);
  job.budget.spp.reset();
  job.budget.seconds = 10;
  EXPECT_EQ(problem(scene, "path", job), "its kind of budget is --spp, this render's is --seconds");
}

TEST_F(Resume, of_the_photon_mapper_wants_the_same_photons) {
  const SceneDescription scene = test::room(32, true);
  RenderJob job = test::job_with(8, 20'000);
  ASSERT_TRUE(part(scene, "photonmapper", job, false, 3).stats.interrupted);
  job.budget.photons = 30'000;
  EXPECT_EQ(problem(scene, "photonmapper", job),
            "its budget is 2500 global and 2500 caustic photons a sample, indirect light by map, this render's is 3750 "
            "global and 3750 caustic photons a sample, indirect light by map");
}

// Two estimates, 1 and 3: mean 2, variance of the mean ((1 - 2)^2 + (3 - 2)^2) / (1 * 2) = 1, relative to 2^2 + 0.01.
TEST(Film, tells_its_relative_standard_error) {
  Film film(1, 1);
  film.add(0, 0, RgbD(1.0), 1);
  EXPECT_FALSE(film.relative_standard_error());
  film.add(0, 0, RgbD(3.0), 1);
  EXPECT_NEAR(*film.relative_standard_error(), std::sqrt(1 / 4.01), 1e-12);
}

// Where squares of radiances are beyond single precision, too: 2^100 is an exact factor, beside which 0.01 is nothing.
TEST(Film, tells_its_errors_of_any_radiance) {
  Film ordinary(1, 1), bright(1, 1);
  for (const double radiance : {0x1p30, 0x3p30, 0x5p30}) {
    for (Film* film : {&ordinary, &bright}) {
      film->add(0, 0, RgbD(film == &bright ? radiance * 0x1p70 : radiance), 1);
      film->end_shared_pass(1);
    }
  }
  EXPECT_DOUBLE_EQ(*bright.relative_standard_error(), *ordinary.relative_standard_error());
  const auto error_of = [](const Film& film) { return stored_mean_error(film.develop())->standard_error[0]; };
  EXPECT_GT(error_of(ordinary), 0x1p29);
  EXPECT_DOUBLE_EQ(error_of(bright), error_of(ordinary) * 0x1p70);
}

// Two estimates of a pixel, r and 3 r, have a variance of r^2.
Film two_estimates(std::initializer_list<double> pixels) {
  Film film(static_cast<int>(pixels.size()), 1);
  int x = 0;
  for (const double r : pixels) {
    film.add(x, 0, RgbD(r), 1);
    film.add(x++, 0, RgbD(3 * r), 1);
  }
  return film;
}

TEST(Film, has_a_variance_layer_where_floats_hold_it) {
  for (const auto& pixels : {std::initializer_list<double>{1, 2}, {1, 0}, {1e19, 1e-18}, {0, 0}}) {
    const Film film = two_estimates(pixels);
    EXPECT_EQ(film.variance_in_float().lost, 0u);
    ASSERT_TRUE(film.develop().variance);
    EXPECT_FLOAT_EQ(film.develop().variance->rgb[0], static_cast<float>(*pixels.begin() * *pixels.begin()));
  }
  for (const auto& pixels : {std::initializer_list<double>{1, 1e20}, {1e-20, 1e-20}, {0, 1e-20}}) {
    const Film film = two_estimates(pixels);
    EXPECT_GT(film.variance_in_float().lost, 0u);
    EXPECT_FALSE(film.variance_in_float().fits);
    EXPECT_FALSE(film.develop().variance);
  }
  const Film broken = two_estimates({1, std::numeric_limits<double>::quiet_NaN()});
  ASSERT_TRUE(broken.develop().variance);
  EXPECT_TRUE(std::isnan(broken.develop().variance->rgb[3]));
  EXPECT_TRUE(std::isnan(*broken.relative_standard_error()));
  const Film dark_corner = two_estimates({1, 1e-20});
  EXPECT_EQ(dark_corner.variance_in_float().lost, 1u);
  ASSERT_TRUE(dark_corner.develop().variance);
  EXPECT_NEAR(dark_corner.develop().variance->rgb[3], 1e-40f, 1e-44f);
}

// The noise of a dim scene is below relmse's 0.01, so the target error is reached at once, and the render reports this.
TEST_F(Resume, target_error_of_a_dim_scene_is_said_to_say_little) {
  for (const double dimmer : {1.0, 1e-6}) {
    SceneDescription scene = test::room(32, false);
    for (ShapeDescription& shape : scene.shapes)
      if (shape.radiance) std::get<RgbD>(*shape.radiance) = std::get<RgbD>(*shape.radiance) * dimmer;
    RenderJob job;
    job.budget.target_error = 0.02;
    const Outcome out = part(scene, "path", job, false, -1);
    ASSERT_EQ(out.stats.losses.size(), dimmer < 1 ? 1u : 0u);
    if (dimmer < 1) {
      EXPECT_EQ(out.stats.counts.at("samples_per_pixel"), 16);
      EXPECT_NE(out.stats.losses[0].find("of themselves pixels err by"), std::string::npos) << out.stats.losses[0];
    }
  }
}

// Passes end after 1, 2, 4, 8, 16 samples and so on. The last is the first of 16 or more with a small enough error. A
// render of half as many misses the target, and one with a budget of as many samples has the same bits.
TEST_F(Resume, target_error_ends_the_render_at_the_first_pass_that_reaches_it) {
  const SceneDescription scene = test::room(32, false);
  for (const char* name : {"path", "volpath", "whitted"}) {
    RenderJob job;
    job.budget.target_error = name == std::string("whitted") ? 0.005 : 0.1;
    const Outcome out = part(scene, name, job, false, -1);
    const auto samples = static_cast<std::int64_t>(out.stats.counts.at("samples_per_pixel"));
    EXPECT_LE(out.stats.counts.at("relative_standard_error"), *job.budget.target_error) << name;
    EXPECT_GE(samples, 16) << name;

    RenderJob counted;
    counted.budget.spp = samples;
    EXPECT_EQ(part(scene, name, counted, false, -1).image.mean.rgb, out.image.mean.rgb) << name;
    if (samples == 16) continue;
    const Scene compiled = test::compiled(scene, 32, 32);
    counted.budget.spp = samples / 2;
    Film film(32, 32);
    RenderStats stats;
    test::render(compiled, with_integrator(scene.integrator, name), counted, film, stats);
    EXPECT_GT(*film.relative_standard_error(), *job.budget.target_error) << name;
  }
}

TEST_F(Resume, of_a_target_error_goes_on_to_the_same_bits) {
  const SceneDescription scene = test::room(32, false);
  RenderJob job;
  job.budget.target_error = 0.1;
  const Outcome whole = part(scene, "path", job, false, -1);
  ASSERT_TRUE(part(scene, "path", job, false, 4).stats.interrupted);
  EXPECT_EQ(part(scene, "path", job, true, -1).image.mean.rgb, whole.image.mean.rgb);
}

TEST_F(Resume, takes_the_seconds_already_spent_from_the_budget) {
  const SceneDescription scene = test::room(32, false);
  RenderJob job;
  job.budget.seconds = 1e6;
  ASSERT_TRUE(part(scene, "path", job, false, 3).stats.interrupted);
  job.budget.seconds = 1e-6;  // less than were spent: nothing is left to do but the pass that was begun
  const Outcome out = part(scene, "path", job, true, -1);
  EXPECT_FALSE(out.stats.interrupted);
  EXPECT_GT(out.stats.counts.at("resumed_after_seconds"), 1e-6);
}

TEST_F(Resume, loses_at_most_the_interval_inside_a_pass) {
  // Checkpoints that are due all the time: one a tile, since a tile is made however often they are due.
  const SceneDescription description = test::room(40, false);
  const Scene scene = test::compiled(description, 40, 40);
  RenderJob job = test::job_with(2);
  job.threads = 1;
  job.checkpoint = policy(false, 1e-9);
  Film film = film_of(description);
  RenderStats stats;
  test::render(scene, description.integrator, job, film, stats);
  EXPECT_GE(stats.counts.at("checkpoints"), 2 * 9);  // 3 x 3 tiles of 16 pixels, two passes
  EXPECT_TRUE(std::filesystem::exists(file_));
  EXPECT_EQ(film.develop().mean.rgb, test::render(description, "path", test::job_with(2)).image.mean.rgb);
}

TEST_F(Resume, a_checkpoint_that_cannot_be_written_does_not_end_the_render) {
  const SceneDescription description = test::room(16, false);
  const Scene scene = test::compiled(description, 16, 16);
  RenderJob job = test::job_with(4);
  job.checkpoint = policy(false, 1e-9);
  job.checkpoint->file = folder_ / "missing/a.checkpoint";
  Film film = film_of(description);
  RenderStats stats;
  test::render(scene, description.integrator, job, film, stats);
  EXPECT_FALSE(stats.interrupted);
  EXPECT_EQ(stats.checkpoint_problem,
            job.checkpoint->file.string() + ": error: folder '" + (folder_ / "missing").string() + "' does not exist");
}

/// Units with common results: the sum so far is scaled down before each is added, so that their order shows.
struct OrderedWork {
  double sum = 1;
  double run(const RenderJob& job, RenderStats& stats) {
    Film film(1, 1);
    const Threads threads(job.threads);
    RenderLoop loop(job, threads, film, stats, {.phase = "test"});
    loop.keep(sum);
    while (loop.next()) {
      std::vector<double> slots(loop.slots());
      loop.for_each_in_order(
          200, [&](std::size_t unit, std::size_t slot) { slots[slot] = double(unit + 1) + double(loop.first()); },
          [&](std::size_t, std::size_t slot) { sum = 0.999 * sum + slots[slot]; });
    }
    return sum;
  }
};

TEST_F(Resume, of_units_in_order_gives_the_same_bits) {
  RenderJob job = test::job_with(6);
  RenderStats stats;
  const double whole = OrderedWork().run(job, stats);
  for (const int threads : {1, 2, 7}) {
    job.threads = threads;
    job.checkpoint = policy(false, 1e-9);
    std::atomic<bool> stop{false};
    job.interrupt = &stop;
    int calls = 3;
    job.progress = [&](double, const std::string&) { stop = stop || --calls == 0; };
    RenderStats first, second;
    OrderedWork().run(job, first);
    EXPECT_TRUE(first.interrupted);
    stop = false;
    job.checkpoint->resume = true;
    EXPECT_EQ(OrderedWork().run(job, second), whole) << threads;
    std::filesystem::remove(file_);
  }
}

TEST(pass_schedule, knows_the_passes_it_makes) {
  const PassSchedule passes(100, std::nullopt);  // from 0, 1, 2, 4, 8, 16, 32, and 36 samples from 64
  for (const auto& [first, samples] : {std::pair{0, 1}, {1, 1}, {2, 2}, {32, 32}, {64, 36}, {64, 0}, {100, 0}})
    EXPECT_TRUE(passes.makes_pass(first, samples)) << first << " " << samples;
  for (const auto& [first, samples] : {std::pair{0, 2}, {3, 1}, {64, 64}, {65, 0}, {101, 0}, {128, 64}})
    EXPECT_FALSE(passes.makes_pass(first, samples)) << first << " " << samples;
}

}  // namespace
}  // namespace photonproof::inline renderer_passes
